"""Sensors as nodes, what links them as edges: health by colour, the figure beside it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from fruitgui.gui.theme import icons
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID

ICON_PX = 22.0
SHARES = (0.5, 0.42, 0.58, 0.35, 0.65, 0.28, 0.72, 0.22, 0.78)
"""Where on a line its figure may be, the best first: diagonals of a ring all cross in the middle."""


@dataclass(frozen=True, slots=True)
class GraphNode:
    """One sensor.

    Attributes:
        name: of it. note: a word or two below its name.
        health: `good`, `warn`, `bad`, or empty. reference: whether it is the reference.
    """

    name: str
    note: str = ""
    health: str = ""
    reference: bool = False


@dataclass(frozen=True, slots=True)
class GraphLink:
    """What links two sensors.

    Attributes:
        ends: their names. health: `good`, `warn`, `bad`; empty for a link that does not count.
        figure: beside it; empty for none.
    """

    ends: tuple[str, str]
    health: str = ""
    figure: str = ""


class RigGraph(QWidget):
    """Paints nodes on a ring and links between them."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._nodes: tuple[GraphNode, ...] = ()
        self._links: tuple[GraphLink, ...] = ()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(200, 120)
        theme.changed.connect(self.update)

    @property
    def nodes(self) -> tuple[GraphNode, ...]:
        """The sensors shown."""
        return self._nodes

    @property
    def links(self) -> tuple[GraphLink, ...]:
        """The links shown."""
        return self._links

    def show_graph(self, nodes: Sequence[GraphNode], links: Sequence[GraphLink]) -> None:
        """Show these."""
        if (tuple(nodes), tuple(links)) == (self._nodes, self._links):
            return
        self._nodes, self._links = tuple(nodes), tuple(links)
        said = [f"{' – '.join(link.ends)}: {link.figure}" for link in self._links if link.figure]
        self.setAccessibleName("; ".join([*(f"{node.name} {node.note}".strip() for node in self._nodes), *said]))
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(360, 260)

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            boxes = {node.name: self._box(node) for node in self._nodes}
            places = placed(self.width(), self.height(), boxes)
            for link in sorted(self._links, key=lambda one: bool(one.health)):
                self._paint_line(painter, link, places)
            taken = []
            for node in self._nodes:
                taken.append(self._paint_node(painter, node, places[node.name], boxes[node.name]))
            for link in self._links:
                self._paint_figure(painter, link, places, taken)

    def _box(self, node: GraphNode) -> QSize:
        strong, small = self._fonts()
        name, note = QFontMetricsF(strong), QFontMetricsF(small)
        width = max(name.horizontalAdvance(node.name) + ICON_PX + GRID, note.horizontalAdvance(node.note)) + 3 * GRID
        height = name.height() + (note.height() + 2 if node.note else 0) + 1.5 * GRID
        return QSize(math.ceil(width), math.ceil(height))

    def _fonts(self) -> tuple[QFont, QFont]:
        return self._theme.font("small", QFont.Weight.DemiBold), self._theme.font("small")

    def _paint_line(self, painter: QPainter, link: GraphLink, places: Mapping[str, QPointF]) -> None:
        theme = self._theme
        if not link.health:
            painter.setPen(QPen(theme.colour("line"), 1.5, Qt.PenStyle.DashLine))
        else:
            painter.setPen(QPen(theme.colour(link.health), 3.0))
        painter.drawLine(places[link.ends[0]], places[link.ends[1]])

    def _paint_figure(
        self, painter: QPainter, link: GraphLink, places: Mapping[str, QPointF], taken: list[QRectF]
    ) -> None:
        if not link.figure:
            return
        theme, (strong, _) = self._theme, self._fonts()
        first, second = places[link.ends[0]], places[link.ends[1]]
        metrics = QFontMetricsF(strong)
        box = QRectF(0, 0, metrics.horizontalAdvance(link.figure) + 2 * GRID, metrics.height() + GRID / 2)
        box = _free(box, first, second, taken)
        taken.append(box)
        painter.setPen(QPen(theme.colour(link.health or "line"), 1.5))
        painter.setBrush(theme.colour("surface"))
        painter.drawRoundedRect(box, box.height() / 2, box.height() / 2)
        painter.setFont(strong)
        painter.setPen(theme.colour(link.health or "text_dim"))
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, link.figure)

    def _paint_node(self, painter: QPainter, node: GraphNode, at: QPointF, size: QSize) -> QRectF:
        theme, (strong, small) = self._theme, self._fonts()
        box = QRectF(0, 0, size.width(), size.height())
        box.moveCenter(at)
        painter.setBrush(theme.colour("raised"))
        painter.setPen(QPen(theme.colour(node.health or "line"), 2.0))
        painter.drawRoundedRect(box, GRID, GRID)
        high = QFontMetricsF(strong).height()
        row = QRectF(box.left() + 1.5 * GRID, box.top() + 0.75 * GRID, box.width() - 3 * GRID, high)
        icon = QRectF(row.left(), row.center().y() - ICON_PX / 2, ICON_PX, ICON_PX)
        icons.paint(painter, icon, "link" if node.reference else "camera", theme.colour(node.health or "text_dim"))
        painter.setFont(strong)
        painter.setPen(theme.colour("text"))
        painter.drawText(row.adjusted(ICON_PX + GRID, 0, 0, 0), Qt.AlignmentFlag.AlignVCenter, node.name)
        if node.note:
            painter.setFont(small)
            painter.setPen(theme.colour(node.health or "text_dim"))
            below = QRectF(row.left(), row.bottom() + 2, row.width(), box.bottom() - row.bottom())
            painter.drawText(below, Qt.AlignmentFlag.AlignTop | Qt.AlignmentFlag.AlignHCenter, node.note)
        return box


def _free(box: QRectF, first: QPointF, second: QPointF, taken: Sequence[QRectF]) -> QRectF:
    """Return a box moved onto a line to where it lies on nothing else; to the middle where there is no such place."""
    for share in SHARES:
        moved = QRectF(box)
        moved.moveCenter(first + (second - first) * share)
        if not any(moved.intersects(one) for one in taken):
            return moved
    box.moveCenter((first + second) / 2)
    return box


def placed(width: int, height: int, boxes: Mapping[str, QSize]) -> dict[str, QPointF]:
    """Return the middles of the nodes' boxes: one in the middle, two side by side, more on a ring inside the area."""
    count = len(boxes)
    middle = QPointF(width / 2, height / 2)
    if count < 2:
        return dict.fromkeys(boxes, middle)
    widest, highest = max(box.width() for box in boxes.values()), max(box.height() for box in boxes.values())
    across, down = max((width - widest) / 2 - 2, 20.0), max((height - highest) / 2 - 2, 20.0)
    turn = math.pi if count == 2 else -math.pi / 2 - (math.pi / count if count % 2 == 0 else 0.0)
    angles = [turn + 2.0 * math.pi * number / count for number in range(count)]
    wide = max(abs(math.cos(angle)) for angle in angles)
    high = max(max(abs(math.sin(angle)) for angle in angles), 1e-6)
    return {
        name: middle + QPointF(across * math.cos(angle) / wide, down * math.sin(angle) / high if count > 2 else 0.0)
        for name, angle in zip(boxes, angles, strict=True)
    }
