"""The mark of a kind: colour, shape and letter."""

from __future__ import annotations

import math

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QPainter, QPainterPath, QPaintEvent, QPen, QPixmap, QPolygonF
from PySide6.QtWidgets import QWidget

from fruitgui.gui.theme.kinds import KindMark, Shape
from fruitgui.gui.theme.stamps import drawn_pixmap, stamp
from fruitgui.gui.theme.theme import FAMILY

INK = QColor("#0b0e10")
_CORNERS = {Shape.SQUARE: 4, Shape.DIAMOND: 4, Shape.PENTAGON: 5, Shape.HEXAGON: 6}
_TURN = {Shape.SQUARE: math.pi / 4.0, Shape.HEXAGON: math.pi / 6.0}

ONE, TWO = 0.5, 0.38
"""Height of the letters in parts of the mark's side: one, two."""

TAPERING, IN_TAPERING = (Shape.TRIANGLE, Shape.DIAMOND, Shape.STAR), 0.86
"""Shapes that leave letters less room, and how much of their size is left."""

RING_ROOM = 0.13
"""Between a ring and the one inside it, in parts of the mark's side."""

LOW_IN_TRIANGLE = 0.155
"""A triangle is wide below its middle only."""


def paint_mark(painter: QPainter, place: QRectF, mark: KindMark) -> None:
    """Draw a mark into a place, as large as it fits."""
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    side = min(place.width(), place.height())
    box = QRectF(0, 0, side, side)
    box.moveCenter(place.center())
    _paint_shape(painter, _inner(box), mark)
    painter.setPen(INK)
    font = QFont(FAMILY)
    room = (ONE if len(mark.letters) == 1 else TWO) * (IN_TAPERING if mark.shape in TAPERING else 1.0)
    font.setPixelSize(max(round(side * room), 6))
    font.setWeight(QFont.Weight.Bold)
    painter.setFont(font)
    low = side * LOW_IN_TRIANGLE if mark.shape is Shape.TRIANGLE else 0.0
    painter.drawText(box.translated(0, low), Qt.AlignmentFlag.AlignCenter, mark.letters)
    painter.restore()


def _inner(box: QRectF) -> QRectF:
    room = box.width() * 0.06
    return box.adjusted(room, room, -room, -room)


def _paint_shape(painter: QPainter, box: QRectF, mark: KindMark) -> None:
    """Draw a mark without its letters, with a dark rim: on a light ground some of the colours have no edge."""
    colour, path, side = QColor(mark.colour), _path(mark.shape, box), box.width()
    rim = max(side / 24.0, 1.0)
    painter.setPen(QPen(INK, rim))
    painter.setBrush(colour)
    painter.drawPath(path)
    if mark.shape is Shape.RING:  # a second one inside tells it from a circle of the same colour
        room = side * RING_ROOM
        painter.drawPath(_path(mark.shape, box.adjusted(room, room, -room, -room)))


def mark_pixmap(mark: KindMark, size_px: float, ratio: float = 1.0) -> QPixmap:
    """Return a mark as a picture."""
    place = QRectF(0, 0, size_px, size_px)

    def make() -> QPixmap:
        return drawn_pixmap(size_px, size_px, ratio, lambda painter: paint_mark(painter, place, mark))

    return stamp(("mark", mark, size_px, ratio), make)


def point_pixmap(mark: KindMark, size_px: float, ratio: float = 1.0) -> QPixmap:
    """Return a point of a kind's colour and shape, for where its letters would be too small to be read."""
    place = QRectF(0, 0, size_px, size_px)

    def paint(painter: QPainter) -> None:
        _paint_shape(painter, _inner(place), mark)

    return stamp(("point", mark.colour, mark.shape, size_px, ratio),
                 lambda: drawn_pixmap(size_px, size_px, ratio, paint))  # fmt: skip


class KindMarkView(QWidget):
    """A mark as a widget."""

    def __init__(self, mark: KindMark, size_px: int = 28, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._mark = mark
        self.setFixedSize(QSize(size_px, size_px))
        self.setAccessibleName(mark.kind)

    def show_mark(self, mark: KindMark) -> None:
        """Show another mark."""
        self._mark = mark
        self.setAccessibleName(mark.kind)
        self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        with QPainter(self) as painter:
            paint_mark(painter, QRectF(self.rect()), self._mark)


def _path(shape: Shape, box: QRectF) -> QPainterPath:
    path = QPainterPath()
    path.setFillRule(Qt.FillRule.WindingFill)
    if shape in (Shape.CIRCLE, Shape.RING):
        path.addEllipse(box)
    elif shape is Shape.CROSS:
        third = box.width() / 3.0
        path.addRect(box.adjusted(third * 0.8, 0, -third * 0.8, 0))
        path.addRect(box.adjusted(0, third * 0.8, 0, -third * 0.8))
        return path.simplified()  # one outline, not that of two bars
    elif shape is Shape.TRIANGLE:
        top = QPointF(box.center().x(), box.top())
        path.addPolygon(QPolygonF([top, box.bottomRight(), box.bottomLeft()]))
    elif shape is Shape.STAR:
        path.addPolygon(_ring(box, 10, 0.0, 0.62))
    else:
        grown = box.adjusted(-2, -2, 2, 2) if shape is Shape.SQUARE else box
        path.addPolygon(_ring(grown, _CORNERS[shape], _TURN.get(shape, 0.0), 1.0))
    path.closeSubpath()
    return path


def _ring(box: QRectF, corners: int, turn: float, inner: float) -> QPolygonF:
    """Return corners round a box, every second one drawn in by `inner`."""
    middle, radius = box.center(), box.width() / 2.0
    points = []
    for number in range(corners):
        angle = turn + 2.0 * math.pi * number / corners - math.pi / 2.0
        far = radius * (inner if number % 2 and inner < 1.0 else 1.0)
        points.append(QPointF(middle.x() + far * math.cos(angle), middle.y() + far * math.sin(angle)))
    return QPolygonF(points)
