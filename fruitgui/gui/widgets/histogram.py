"""A measure of fruit as a histogram, stacked bars of each kind."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from fruitgui.frame import Ints
from fruitgui.gui.numbers import THIN, count_text, number_text
from fruitgui.gui.theme.contrast import SHAPES, contrast
from fruitgui.gui.theme.kinds import KindMark
from fruitgui.gui.theme.theme import Theme

BOTTOM, TOP = 22.0, 16.0


@dataclass(frozen=True, slots=True, eq=False)
class Bars:
    """One kind's fruit by what is measured: how many in each bin."""

    mark: KindMark
    counts: Ints


class HistogramView(QWidget):
    """Paints stacked bars over one axis.

    Attributes:
        empty: what is written where there is nothing to show; empty says that volumes will come.
    """

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._bars: tuple[Bars, ...] = ()
        self.empty = ""
        self._low, self._high, self._unit = 0.0, 1.0, "ml"
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumHeight(72)
        theme.changed.connect(self.update)

    def show_bars(self, bars: Sequence[Bars], low: float, high: float, unit: str = "ml") -> None:
        """Show other counts; every kind has the same bins, from `low` to `high` of the unit."""
        self._bars, self._low, self._high, self._unit = tuple(bars), low, high, unit
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(320, 120)

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        with QPainter(self) as painter:
            plot = QRectF(0, TOP, self.width(), self.height() - TOP - BOTTOM)
            stacked = np.sum([one.counts for one in self._bars], axis=0) if self._bars else np.zeros(1, dtype=np.intp)
            most = int(np.max(stacked, initial=0))
            painter.setFont(self._theme.font("small"))
            if most:
                self._paint_bars(painter, plot, most)
            else:
                painter.setPen(self._theme.colour("text_dim"))
                painter.drawText(
                    plot,
                    Qt.AlignmentFlag.AlignCenter,
                    self.empty or self.tr("The volumes of what was counted appear here."),
                )
            painter.setPen(self._theme.colour("line"))
            painter.drawLine(plot.bottomLeft(), plot.bottomRight())
            if most:
                self._paint_axis(painter, plot, most)

    def _paint_bars(self, painter: QPainter, plot: QRectF, most: int) -> None:
        bins = len(self._bars[0].counts)
        width = plot.width() / bins
        floor = np.full(bins, plot.bottom())
        for bars in self._bars:
            painter.setPen(self._edge(bars.mark.colour))
            painter.setBrush(QColor(bars.mark.colour))
            for number in np.flatnonzero(bars.counts).tolist():
                height = plot.height() * int(bars.counts[number]) / most
                floor[number] -= height
                painter.drawRect(QRectF(plot.left() + number * width + 0.5, floor[number], max(width - 1, 1), height))

    def _edge(self, colour: str) -> QPen:
        """Return the edge of bars of a colour: none where they stand out from the ground by themselves."""
        faint = contrast(colour, self._theme.colours.surface) < SHAPES
        return QPen(self._theme.colour("edge"), 1) if faint else QPen(Qt.PenStyle.NoPen)

    def _paint_axis(self, painter: QPainter, plot: QRectF, most: int) -> None:
        painter.setPen(self._theme.colour("text_dim"))
        painter.drawText(QRectF(0, 0, self.width(), TOP), Qt.AlignmentFlag.AlignLeft, count_text(most))
        marks = ticks(self._low, self._high)
        for value in marks:
            x = plot.left() + plot.width() * (value - self._low) / (self._high - self._low)
            text = number_text(value, 0) + (f"{THIN}{self._unit}" if value == marks[-1] else "")
            painter.drawText(QRectF(x - 40, plot.bottom() + 3, 80, BOTTOM - 3), Qt.AlignmentFlag.AlignHCenter, text)


def ticks(low: float, high: float, most: int = 6) -> list[float]:
    """Return round values strictly between two, at most so many: steps of 1, 2 or 5 times a power of ten."""
    if not high > low:
        return []
    rough = (high - low) / most
    power = 10.0 ** np.floor(np.log10(rough))
    step = next(power * one for one in (1, 2, 5, 10) if power * one >= rough * (1 - 1e-9))
    first = np.floor(low / step) + 1
    return [float(number * step) for number in np.arange(first, np.ceil(high / step)) if low < number * step < high]
