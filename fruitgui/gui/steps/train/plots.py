"""The learning curve, and true against estimated volumes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QWidget

from fruitgui.classification.account import CurvePoint
from fruitgui.gui.steps.train.axes import Axes, round_step
from fruitgui.gui.theme.kinds import UNKNOWN_MARK, KindMark
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.kind_mark import paint_mark
from fruitgui.measurement.checking import Check
from fruitgui.measurement.fruit import Quantity
from fruitgui.station.report import ML_PER_M3

INTERVAL = 1.96
DOT, MARK = 5.0, 16.0


class Plot(QWidget):
    """A plot in the colours of the theme."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        theme.changed.connect(self.update)

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(520, 320)

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            self.draw(painter, QRectF(self.rect()))

    def draw(self, painter: QPainter, box: QRectF) -> None:
        """Draw what it shows; every plot has its own."""


class CurvePlot(Plot):
    """How the share of right ones grew with the fruit in training, with 95 % intervals."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(theme, parent)
        self._curve: tuple[CurvePoint, ...] = ()

    def show_curve(self, curve: Sequence[CurvePoint]) -> None:
        """Show another curve."""
        self._curve = tuple(point for point in curve if point.right.trials)
        self.update()

    def draw(self, painter: QPainter, box: QRectF) -> None:
        """Draw the curve."""
        if not self._curve:
            return
        theme = self._theme
        most = max(point.fruit for point in self._curve)
        lowest = 100.0 * min(point.right.low for point in self._curve)
        axes = Axes.within(box, (0.0, most * 1.08), (max(round_step(100) * (lowest // round_step(100)), 0.0), 101.0))
        axes.paint(painter, theme, self.tr("Fruit in training"), self.tr("% right of fruit held out"))
        places = [axes.at(point.fruit, 100.0 * point.right.value) for point in self._curve]
        painter.setPen(QPen(theme.colour("accent"), 2.0))
        painter.drawPolyline(QPolygonF(places))
        for point, place in zip(self._curve, places, strict=True):
            painter.setPen(QPen(theme.colour("accent"), 1.5))
            low, high = (axes.at(point.fruit, 100.0 * end).y() for end in (point.right.low, point.right.high))
            painter.drawLine(QPointF(place.x(), low), QPointF(place.x(), high))
            for end in (low, high):
                painter.drawLine(QPointF(place.x() - DOT, end), QPointF(place.x() + DOT, end))
            painter.setBrush(theme.colour("accent"))
            painter.drawEllipse(place, DOT, DOT)


class VolumePlot(Plot):
    """True volumes against those estimated, before and after correction, with 95 % intervals."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(theme, parent)
        self._checks: tuple[Check, ...] = ()
        self._marks: Mapping[str, KindMark] = {}

    def show_checks(self, checks: Sequence[Check], marks: Mapping[str, KindMark]) -> None:
        """Show other fruit."""
        self._checks, self._marks = tuple(checks), marks
        self.update()

    def draw(self, painter: QPainter, box: QRectF) -> None:
        """Draw the fruit about the line of equality."""
        if not self._checks:
            return
        theme = self._theme
        values = [one.true_m3 * ML_PER_M3 for one in self._checks]
        ends = [value * ML_PER_M3 for one in self._checks for value in _ends(one.corrected_m3)]
        low, high = min(*values, *ends), max(*values, *ends)
        room = 0.06 * (high - low)
        span = (max(low - room, 0.0), high + room)
        axes = Axes.within(box, span, span)
        axes.paint(painter, theme, self.tr("Measured volume, ml"), self.tr("Estimated volume, ml"))
        painter.setPen(QPen(theme.colour("text_dim"), 1.5, Qt.PenStyle.DashLine))
        painter.drawLine(axes.at(span[0], span[0]), axes.at(span[1], span[1]))
        painter.setClipRect(axes.box)
        for one in self._checks:
            self._draw_check(painter, axes, one)
        painter.setClipping(False)
        self._draw_legend(painter, axes)

    def _draw_check(self, painter: QPainter, axes: Axes, one: Check) -> None:
        mark = self._marks.get(one.kind, UNKNOWN_MARK)
        true_ml = one.true_m3 * ML_PER_M3
        before = axes.at(true_ml, one.fitted_m3.value * ML_PER_M3)
        after = axes.at(true_ml, one.corrected_m3.value * ML_PER_M3)
        painter.setPen(QPen(self._theme.colour("text_dim"), 1.5))
        low, high = (axes.at(true_ml, end * ML_PER_M3) for end in _ends(one.corrected_m3))
        painter.drawLine(low, high)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(self._theme.colour("text_dim"), 1.5))
        painter.drawEllipse(before, DOT - 1, DOT - 1)
        paint_mark(painter, QRectF(after.x() - MARK / 2, after.y() - MARK / 2, MARK, MARK), mark)

    def _draw_legend(self, painter: QPainter, axes: Axes) -> None:
        theme = self._theme
        painter.setFont(theme.font("small"))
        place = QPointF(axes.box.right() - 160, axes.box.bottom() - 38)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(theme.colour("text_dim"), 1.5))
        painter.drawEllipse(place, DOT - 1, DOT - 1)
        below = place + QPointF(0, 20)
        painter.setPen(QPen(theme.colour("text"), 1.5))
        painter.setBrush(theme.colour("text"))
        painter.drawLine(below + QPointF(0, -0.6 * MARK), below + QPointF(0, 0.6 * MARK))
        painter.drawEllipse(below, DOT, DOT)
        for point, text in ((place, self.tr("uncorrected")), (below, self.tr("corrected, ± 95 %"))):
            words = QRectF(point.x() + 2 * GRID, point.y() - 10, 150, 20)
            painter.drawText(words, Qt.AlignmentFlag.AlignVCenter, text)


def _ends(value: Quantity) -> tuple[float, float]:
    return value.value - INTERVAL * value.std, value.value + INTERVAL * value.std
