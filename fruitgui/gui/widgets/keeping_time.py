"""How long something is kept: a few spans in words, or a number of days of one's own."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QWidget

from fruitgui.gui.theme.tokens import GRID, TOUCH
from fruitgui.gui.widgets.choice_box import ChoiceBox
from fruitgui.gui.widgets.decimal_box import DecimalBox

FOR_EVER = 0
MOST_DAYS = 36_500
USUAL_DAYS = 90
_OWN = -1
_BOX_PX = 136


class KeepingTime(QWidget):
    """A list of spans; the last of them shows a box for the number of days beside it.

    Attributes:
        changed: another span was chosen or typed.
        choice: the list. own: the box.
    """

    changed = Signal()

    def __init__(self, days: int, parent: QWidget | None = None) -> None:
        """Show how long it is now.

        Args:
            days: 0 for ever.
        """
        super().__init__(parent)
        self.choice, self.own = ChoiceBox(), DecimalBox()
        for text, span in (
            (self.tr("A week"), 7),
            (self.tr("A month"), 30),
            (self.tr("A season: three months"), 90),
            (self.tr("A year"), 365),
            (self.tr("For ever"), FOR_EVER),
            (self.tr("Another number of days"), _OWN),
        ):
            self.choice.addItem(text, span)
        listed = self.choice.findData(days)
        self.choice.setCurrentIndex(listed if listed >= 0 else self.choice.findData(_OWN))
        self.own.setDecimals(0)
        self.own.setRange(1, MOST_DAYS)
        self.own.setSuffix(self.tr(" days"))
        self.own.setAccessibleName(self.tr("Number of days"))
        self.own.setValue(days or USUAL_DAYS)
        self.own.setFixedWidth(_BOX_PX)
        self.own.setMinimumHeight(TOUCH)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(GRID)
        row.addWidget(self.choice, 1)
        row.addWidget(self.own)
        self.setFocusProxy(self.choice)
        self.choice.currentIndexChanged.connect(self._show)
        self.own.valueChanged.connect(self.changed)
        self._show()

    @property
    def days(self) -> int:
        """How long; 0 for ever."""
        span = int(self.choice.currentData())
        return round(self.own.value()) if span == _OWN else span

    def _show(self) -> None:
        self.own.setVisible(self.choice.currentData() == _OWN)
        self.changed.emit()


def shorter(days: int, before_days: int) -> bool:
    """Tell whether less is kept than before; 0 is for ever."""
    return days != FOR_EVER and (before_days == FOR_EVER or days < before_days)
