"""What lies before the sensors of a simulated rig: the belt runs, rests with fruit on it, or is empty."""

from __future__ import annotations

from PySide6.QtWidgets import QButtonGroup, QHBoxLayout, QPushButton, QVBoxLayout, QWidget

from fruitgui.gui.source_runner import SourceRunner
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import label
from fruitgui.gui.widgets.worded import Worded
from fruitgui.simulation.show import Showing


class ShowSwitch(Worded, QWidget):
    """Three buttons; seen only where the sensors are simulated."""

    def __init__(self, source: SourceRunner, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._source = source
        self._title = label("", "small")
        self.buttons = {showing: QPushButton() for showing in (Showing.LINE, Showing.STILL, Showing.EMPTY)}
        self._group = QButtonGroup(self)
        row = QHBoxLayout()
        row.setSpacing(GRID // 2)
        for button in self.buttons.values():
            button.setCheckable(True)
            self._group.addButton(button)
            row.addWidget(button, 1)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(GRID // 2)
        column.addWidget(self._title)
        column.addLayout(row)
        self._group.buttonClicked.connect(self._choose)
        source.changed.connect(self.follow)
        self._say_words()
        self.follow()

    def follow(self) -> None:
        """Show what lies before the sensors now."""
        rig = self._source.rig
        self.setVisible(rig is not None)
        if rig is not None and rig.showing in self.buttons:
            self.buttons[rig.showing].setChecked(True)

    def _say_words(self) -> None:
        self._title.setText(self.tr("Simulated belt"))
        words = {
            Showing.LINE: (self.tr("Runs"), self.tr("Let the simulated belt run with fruit on it")),
            Showing.STILL: (self.tr("Rests"), self.tr("Stop the simulated belt, and lay fruit on it")),
            Showing.EMPTY: (self.tr("Empty"), self.tr("Stop the simulated belt, and clear it")),
        }
        for showing, (text, tip) in words.items():
            self.buttons[showing].setText(text)
            self.buttons[showing].setToolTip(tip)
            self.buttons[showing].setAccessibleName(tip)

    def _choose(self) -> None:
        rig = self._source.rig
        chosen = next(showing for showing, button in self.buttons.items() if button.isChecked())
        if rig is not None:
            rig.show(chosen)
