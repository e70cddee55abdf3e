"""The frame of a small plot: two axes with round numbers, and the way from values to the screen."""

from __future__ import annotations

import math
from dataclasses import dataclass

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QPainter, QPen

from fruitgui.gui.numbers import number_text
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID

LEFT, BOTTOM, TOP, RIGHT = 52.0, 48.0, 12.0, 20.0
TICKS = 5


def round_step(span: float, most: int = TICKS) -> float:
    """Return 1, 2 or 5 times a power of ten that divides a span into at most so many parts."""
    rough = max(span, 1e-12) / most
    power = 10.0 ** math.floor(math.log10(rough))
    return next(power * factor for factor in (1.0, 2.0, 5.0, 10.0) if power * factor >= rough * (1 - 1e-9))


@dataclass(frozen=True, slots=True)
class Axes:
    """Where values lie on the screen.

    Attributes:
        box: of the plot, pixels.
        x, y: lowest and highest value along each axis.
    """

    box: QRectF
    x: tuple[float, float]
    y: tuple[float, float]

    @classmethod
    def within(cls, whole: QRectF, x: tuple[float, float], y: tuple[float, float]) -> Axes:
        """Return axes with room for their words."""
        return cls(whole.adjusted(LEFT, TOP, -RIGHT, -BOTTOM), x, y)

    def at(self, x: float, y: float) -> QPointF:
        """Return where a point lies."""
        across = (x - self.x[0]) / max(self.x[1] - self.x[0], 1e-12)
        up = (y - self.y[0]) / max(self.y[1] - self.y[0], 1e-12)
        return QPointF(self.box.left() + across * self.box.width(), self.box.bottom() - up * self.box.height())

    def paint(self, painter: QPainter, theme: Theme, x_name: str, y_name: str) -> None:
        """Draw lines, numbers and names."""
        painter.setFont(theme.font("small"))
        for value in _ticks(self.x):
            place = self.at(value, self.y[0])
            box = QRectF(place.x() - 40, place.y() + 4, 80, 18)
            self._tick(painter, theme, QPointF(place.x(), self.box.top()), place, box, Qt.AlignmentFlag.AlignHCenter,
                       value)  # fmt: skip
        for value in _ticks(self.y):
            place = self.at(self.x[0], value)
            box = QRectF(0, place.y() - 10, LEFT - GRID, 20)
            self._tick(painter, theme, place, QPointF(self.box.right(), place.y()), box, Qt.AlignmentFlag.AlignRight,
                       value)  # fmt: skip
        painter.setPen(theme.colour("text_dim"))
        below = QRectF(self.box.left(), self.box.bottom() + 24, self.box.width(), 20)
        painter.drawText(below, Qt.AlignmentFlag.AlignCenter, x_name)
        above = QRectF(self.box.left() + GRID, self.box.top(), self.box.width(), 20)
        painter.drawText(above, Qt.AlignmentFlag.AlignLeft, y_name)

    def _tick(
        self, painter: QPainter, theme: Theme, one: QPointF, other: QPointF, box: QRectF, side: Qt.AlignmentFlag,
        value: float,
    ) -> None:  # fmt: skip
        painter.setPen(QPen(theme.colour("line"), 1.0))
        painter.drawLine(one, other)
        painter.setPen(theme.colour("text_dim"))
        painter.drawText(box, side | Qt.AlignmentFlag.AlignVCenter, number_text(value, 0))


def _ticks(ends: tuple[float, float]) -> list[float]:
    step = round_step(ends[1] - ends[0])
    first = math.ceil(ends[0] / step - 1e-9)
    return [number * step for number in range(first, math.floor(ends[1] / step + 1e-9) + 1)]
