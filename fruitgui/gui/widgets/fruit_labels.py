"""What is written beside each fruit in a picture: none over another, and each drawn once, then only copied."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Hashable, Iterator, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter, QPixmap

from fruitgui.frame import F64
from fruitgui.gui.drawn import DrawnFruit
from fruitgui.gui.theme.kinds import KindMark
from fruitgui.gui.theme.stamps import drawn_pixmap
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.kind_mark import paint_mark

CHIP = QColor(10, 12, 13, 205)
INK = QColor("#f4f6f7")
Box = tuple[float, float, float, float]
"""Left, top, right, bottom on the screen."""


MOST_LABELS = 200
"""That are kept drawn: those of all fruit in view, with all their words and with fewer."""


@dataclass(frozen=True, slots=True, eq=False)
class Label:
    """What is copied, and its size on the screen."""

    picture: QPixmap
    width: float
    height: float


class FruitLabels:
    """Draws labels, with fewer words where there is no room for more."""

    def __init__(self, theme: Theme) -> None:
        self._theme = theme
        self._drawn: OrderedDict[Hashable, Label] = OrderedDict()

    def paint(
        self, painter: QPainter, fruit: Sequence[tuple[DrawnFruit, F64]], place: QRectF, *, worded: bool, ratio: float
    ) -> None:
        """Draw the labels of fruit, each with its outline on the screen, within a place.

        Args:
            worded: with words; without, mark and number only.
            ratio: device pixels to each of ours.
        """
        room = (place.left(), place.top(), place.right(), place.bottom())
        taken: list[Box] = []
        for one, outline in sorted(fruit, key=lambda pair: -float(pair[1][:, 1].max(initial=0.0))):
            if len(outline):
                self._paint_one(painter, one, _bounds(outline), room, taken, worded=worded, ratio=ratio)

    def _paint_one(
        self, painter: QPainter, fruit: DrawnFruit, around: Box, room: Box, taken: list[Box], *, worded: bool,
        ratio: float,
    ) -> None:  # fmt: skip
        words = (str(fruit.number), *(fruit.words if worded else ()))
        for count in range(len(words), 0, -1):
            label = self._label(fruit.mark, words[:count], ratio)
            for box in _beside(around, label.width, label.height):
                if _within(box, room) and not any(_meet(box, one) for one in taken):
                    taken.append(box)
                    painter.drawPixmap(QPointF(box[0], box[1]), label.picture)
                    return

    def _label(self, mark: KindMark, words: tuple[str, ...], ratio: float) -> Label:
        """Return a label, drawn before where it was; kept here, as asking Qt's own store takes longer than drawing."""
        key = (mark, words, ratio)
        label = self._drawn.get(key)
        if label is None:
            picture = self._draw(mark, words, ratio)
            label = Label(picture, picture.width() / ratio, picture.height() / ratio)
            self._drawn[key] = label
            if len(self._drawn) > MOST_LABELS:
                self._drawn.popitem(last=False)
        else:
            self._drawn.move_to_end(key)
        return label

    def _draw(self, mark: KindMark, words: tuple[str, ...], ratio: float) -> QPixmap:
        font = self._theme.font("small", QFont.Weight.DemiBold)
        metrics = QFontMetricsF(font)
        side = metrics.height() + 2
        rows = ["  ".join(words[:2]), *words[2:]]
        width = max(metrics.horizontalAdvance(row) for row in rows) + side + 1.25 * GRID
        box = QRectF(0, 0, width, len(rows) * metrics.height() + GRID / 2)

        def paint(painter: QPainter) -> None:
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(CHIP)
            painter.drawRoundedRect(box, 5, 5)
            paint_mark(painter, QRectF(3, 2, side, side), mark)
            painter.setFont(font)
            painter.setPen(INK)
            text = box.adjusted(side + GRID * 0.75, 2, 0, 0)
            painter.drawText(text, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop, "\n".join(rows))

        return drawn_pixmap(box.width(), box.height(), ratio, paint)


def _bounds(points: F64) -> Box:
    (left, top), (right, bottom) = points.min(axis=0).tolist(), points.max(axis=0).tolist()
    return left, top, right, bottom


def _beside(around: Box, width: float, height: float) -> Iterator[Box]:
    """Give the places for a label: above, below, at the right, at the left of what it belongs to."""
    left, top, right, bottom = around
    x, y = (left + right - width) / 2.0, (top + bottom - height) / 2.0
    for at_x, at_y in ((x, top - height - 3), (x, bottom + 3), (right + 3, y), (left - width - 3, y)):
        yield at_x, at_y, at_x + width, at_y + height


def _within(box: Box, room: Box) -> bool:
    return box[0] >= room[0] and box[1] >= room[1] and box[2] <= room[2] and box[3] <= room[3]


def _meet(one: Box, other: Box) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]
