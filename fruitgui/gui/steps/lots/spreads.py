"""How the measures of a lot's fruit are spread: as many histograms as there is room for, the others by their name."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QButtonGroup, QGridLayout, QHBoxLayout, QPushButton, QVBoxLayout, QWidget

from fruitgui.gui.kind_words import kind_name
from fruitgui.gui.steps.lots.words import SPREAD, UNITS, measure_name
from fruitgui.gui.theme.kinds import KindMark
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import label
from fruitgui.gui.widgets.histogram import Bars, HistogramView
from fruitgui.gui.widgets.worded import Worded
from fruitgui.records.distribution import Distribution, Measured

LEAST_WIDTH, LEAST_HEIGHT = 320, 150


class Spreads(Worded, QWidget):
    """Histograms of the four measures."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.histograms = {measured: HistogramView(theme) for measured in SPREAD}
        self.buttons = {measured: QPushButton() for measured in SPREAD}
        self._titles = {measured: label("", "strong") for measured in SPREAD}
        self._places = {measured: QWidget() for measured in SPREAD}
        self._bar, self._grid = QWidget(), QGridLayout()
        self._group = QButtonGroup(self)
        self._spreads: dict[Measured, Distribution] = {}
        self._arranged: tuple[int, tuple[Measured, ...]] | None = None
        self._lay_out()
        self._say_words()

    def show_spread(self, spread: Distribution, marks: Mapping[str, KindMark]) -> None:
        """Show how one measure is spread."""
        measured = spread.measured
        self._spreads[measured] = spread
        factor, unit = UNITS[measured]
        kinds = [kind for kind in marks if kind in spread.counts]
        bars = [Bars(marks[kind], spread.counts[kind]) for kind in kinds]
        low, high = (0.0, 1.0) if not spread.edges.size else (spread.edges[0] * factor, spread.edges[-1] * factor)
        view = self.histograms[measured]
        view.show_bars(bars, float(low), float(high), unit)
        counts = ", ".join(f"{kind_name(kind)} {int(spread.counts[kind].sum())}" for kind in kinds)
        view.setAccessibleName(f"{measure_name(measured)}: {counts or view.empty}")

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        """Show as many as there is room for."""
        super().resizeEvent(event)
        self._arrange()

    def _lay_out(self) -> None:
        bar = QHBoxLayout(self._bar)
        bar.setContentsMargins(0, 0, 0, 0)
        bar.setSpacing(GRID)
        for measured in SPREAD:
            button = self.buttons[measured]
            button.setCheckable(True)
            self._group.addButton(button)
            bar.addWidget(button)
            column = QVBoxLayout(self._places[measured])
            column.setContentsMargins(0, 0, 0, 0)
            column.setSpacing(0)
            column.addWidget(self._titles[measured])
            column.addWidget(self.histograms[measured], 1)
        bar.addStretch()
        self.buttons[SPREAD[0]].setChecked(True)
        self._group.buttonToggled.connect(self._arrange)
        self._grid.setSpacing(2 * GRID)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.addWidget(self._bar)
        whole.addLayout(self._grid, 1)
        self._arrange()

    def _arrange(self) -> None:
        columns = columns_for(self.width(), self.height())
        chosen = next(one for one in SPREAD if self.buttons[one].isChecked())
        shown = SPREAD if columns else (chosen,)
        if (columns, shown) == self._arranged:
            return  # laying out anew asks for another size, which lays out anew, without an end
        self._arranged = (columns, shown)
        self._bar.setVisible(not columns)
        for measured in SPREAD:
            self._grid.removeWidget(self._places[measured])
            self._places[measured].setVisible(measured in shown)
            self._titles[measured].setVisible(bool(columns))
        for number, measured in enumerate(shown):
            self._grid.addWidget(self._places[measured], number // max(columns, 1), number % max(columns, 1))

    def _say_words(self) -> None:
        for measured in SPREAD:
            name = measure_name(measured)
            self.buttons[measured].setText(name)
            self.buttons[measured].setToolTip(self.tr("Show how the fruit are spread by this measure"))
            self._titles[measured].setText(name)
            self.histograms[measured].empty = self.tr("Nothing of this was measured in this lot.")


def columns_for(width: int, height: int) -> int:
    """Return in how many columns all four fit; 0 where they do not."""
    if width >= 4 * LEAST_WIDTH and LEAST_HEIGHT <= height <= width / 3:
        return 4  # where there is more height than that, two rows show more
    return 2 if width >= 2 * LEAST_WIDTH and height >= 2 * LEAST_HEIGHT else 0
