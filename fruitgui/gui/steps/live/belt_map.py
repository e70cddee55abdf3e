"""The belt from above: what each sensor sees of it, and every fruit on it with how surely its place is known."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, QSizeF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter, QPaintEvent, QPen, QPixmap, QTransform
from PySide6.QtWidgets import QSizePolicy, QWidget

from fruitgui.frame import F64
from fruitgui.gui.drawn import BeltMap, MappedFruit
from fruitgui.gui.numbers import THIN, number_text
from fruitgui.gui.steps.live.belt_tags import tag_places
from fruitgui.gui.theme.stamps import drawn_pixmap, stamp
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import DARK, GRID, RADIUS
from fruitgui.gui.widgets.kind_mark import mark_pixmap, point_pixmap
from fruitgui.gui.widgets.strokes import ellipse, on_screen, paint_lines, path_of

PAPER, INK, DIM = (QColor(one) for one in (DARK.surface, DARK.text, DARK.text_dim))
SEEN, WARN, BAD = (QColor(one) for one in (DARK.accent, DARK.warn, DARK.bad))
"""It lies on a picture's ground, dark in either theme: trails of a light kind would not be seen on a light one."""

MARGIN = 0.04
TAG_INSET = 2.0
LETTERS_FROM_PX = 9.0


class BeltView(QWidget):
    """Paints a `BeltMap`; the belt runs from left to right."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._map: BeltMap | None = None
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumHeight(96)
        theme.changed.connect(self.update)

    def show_map(self, belt: BeltMap) -> None:
        """Show another moment."""
        self._map = belt
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(640, 160)

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            belt = self._map
            if belt is not None and belt.footprints_m:
                to_screen = self._fitted(belt)
                painter.drawPixmap(0, 0, self._ground_of(belt, to_screen))
                self._paint_fruit(painter, belt.fruit, to_screen)
                self._paint_speed(painter, belt)
                self._paint_words(painter, belt)
            else:
                painter.setFont(self._theme.font("small"))
                painter.setPen(DIM)
                text = self.tr("The belt from above appears here while a lot runs.")
                painter.drawText(QRectF(self.rect()), Qt.AlignmentFlag.AlignCenter, text)

    def _fitted(self, belt: BeltMap) -> QTransform:
        """Return the way from metres to the screen that fits all footprints; y goes up on the screen."""
        corners = np.concatenate(list(belt.footprints_m.values()))
        low, high = corners.min(axis=0), corners.max(axis=0)
        size = np.maximum(high - low, 1e-3) * (1.0 + 2.0 * MARGIN)
        scale = min(self.width() / size[0], self.height() / size[1])
        middle = (low + high) / 2.0
        to_screen = QTransform.fromTranslate(self.width() / 2.0, self.height() / 2.0)
        return to_screen.scale(scale, -scale).translate(-middle[0], -middle[1])

    def _ground_of(self, belt: BeltMap, to_screen: QTransform) -> QPixmap:
        """Return what the sensors see of the belt, drawn anew only where that changed."""
        corners = tuple((sensor, one.tobytes()) for sensor, one in belt.footprints_m.items())
        ratio, speed = self.devicePixelRatioF(), self._speed(belt)
        key = ("belt", corners, sorted(belt.blind), speed, self.size().toTuple(), ratio)

        def paint(painter: QPainter) -> None:
            edges_px = {sensor: on_screen(one, to_screen) for sensor, one in belt.footprints_m.items()}
            for sensor, edge_px in edges_px.items():
                self._paint_footprint(painter, edge_px, blind=sensor in belt.blind)
            self._paint_tags(painter, edges_px, belt)

        return stamp(key, lambda: drawn_pixmap(self.width(), self.height(), ratio, paint))

    def _paint_footprint(self, painter: QPainter, edge_px: F64, *, blind: bool) -> None:
        colour = BAD if blind else SEEN
        fill = QColor(colour)
        fill.setAlpha(18)
        painter.setBrush(Qt.BrushStyle.BDiagPattern if blind else fill)
        painter.setPen(QPen(colour, 1.5, Qt.PenStyle.DashLine if blind else Qt.PenStyle.SolidLine))
        painter.drawPath(path_of([edge_px], closed=True))

    def _paint_tags(self, painter: QPainter, edges_px: Mapping[str, F64], belt: BeltMap) -> None:
        """Write each sensor's name on the edge of what it sees, on a ground of its own: no line crosses it."""
        painter.setFont(self._theme.font("small", QFont.Weight.DemiBold))
        metrics = QFontMetricsF(painter.font())
        height = metrics.height() + TAG_INSET
        sizes = {one: QSizeF(metrics.horizontalAdvance(one) + 1.5 * GRID, height) for one in edges_px}
        speed = QRectF(0, 0, metrics.horizontalAdvance(self._speed(belt)) + 2 * GRID, height + GRID / 2)
        for sensor, box in tag_places(edges_px, sizes, QRectF(self.rect()), [speed]).items():
            blind = sensor in belt.blind
            painter.setPen(QPen(BAD if blind else SEEN, 1.0))
            painter.setBrush(PAPER)
            painter.drawRoundedRect(box.adjusted(0.5, 0.5, -0.5, -0.5), box.height() / 2, box.height() / 2)
            painter.setPen(BAD if blind else INK)
            painter.drawText(box, Qt.AlignmentFlag.AlignCenter, sensor)

    def _paint_fruit(self, painter: QPainter, fruit: Sequence[MappedFruit], to_screen: QTransform) -> None:
        painter.setBrush(Qt.BrushStyle.NoBrush)
        for colour in dict.fromkeys(one.mark.colour for one in fruit):
            some = [one for one in fruit if one.mark.colour == colour]
            paint_lines(painter, [on_screen(one.trail_m, to_screen) for one in some], QColor(colour))
        scale, ratio = to_screen.m11(), self.devicePixelRatioF()
        for one in fruit:
            size = round(2.0 * max(one.radius_m * scale, 4.0))
            x, y = one.ellipse.x * scale + to_screen.dx(), one.ellipse.y * to_screen.m22() + to_screen.dy()
            draw = mark_pixmap if size >= 2.0 * LETTERS_FROM_PX else point_pixmap
            painter.drawPixmap(QPointF(x - size / 2, y - size / 2), draw(one.mark, size, ratio))
        ellipses = [ellipse(one.ellipse, to_screen) for one in fruit]
        paint_lines(painter, ellipses, INK, closed=True)

    def _paint_speed(self, painter: QPainter, belt: BeltMap) -> None:
        painter.setFont(self._theme.font("small", QFont.Weight.DemiBold))
        painter.setPen(DIM)
        painter.drawText(QRectF(self.rect()).adjusted(GRID, GRID / 2, -GRID, -GRID / 2),
                         Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop, self._speed(belt))  # fmt: skip

    def _speed(self, belt: BeltMap) -> str:
        return "" if belt.speed_m_s is None else f"→  {number_text(belt.speed_m_s, 2)}{THIN}m/s"

    def _paint_words(self, painter: QPainter, belt: BeltMap) -> None:
        """Say over the belt what nobody sees of it."""
        if not belt.words:
            return
        theme = self._theme
        painter.setFont(theme.font("small", QFont.Weight.DemiBold))
        wrapped = int(Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap)
        room = QRectF(self.rect()).adjusted(3 * GRID, GRID, -3 * GRID, -GRID)
        text = painter.boundingRect(room, wrapped, belt.words)
        text.moveBottom(self.height() - GRID)
        painter.setPen(QPen(BAD if belt.lost else WARN, 1.5))
        painter.setBrush(PAPER)
        painter.drawRoundedRect(text.adjusted(-GRID, -GRID / 2, GRID, GRID / 2), RADIUS, RADIUS)
        painter.setPen(INK)
        painter.drawText(text, wrapped, belt.words)
