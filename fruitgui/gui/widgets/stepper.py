"""A number between two large buttons: typed, or stepped with a gloved finger."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QToolButton, QWidget

from fruitgui.gui.theme import icons
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.decimal_box import DecimalBox

LEAST_WIDTH = 96


class Stepper(QWidget):
    """A decimal number with a unit.

    Attributes:
        changed: the number, as it is typed or stepped.
    """

    changed = Signal(float)

    def __init__(self, theme: Theme, digits: int = 0, unit: str = "", parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self.box = DecimalBox()
        self.box.setDecimals(digits)
        self.box.setSuffix(f"\u2009{unit}" if unit else "")
        self.box.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.box.setMinimumWidth(LEAST_WIDTH)
        self.box.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.less, self.more = QToolButton(), QToolButton()
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(GRID // 2)
        for one, stretch in ((self.less, 0), (self.box, 1), (self.more, 0)):
            row.addWidget(one, stretch)
        for button in (self.less, self.more):
            button.setAutoRepeat(True)
            button.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # the number itself steps with the arrow keys
        self.setFocusProxy(self.box)
        self.less.clicked.connect(self.box.stepDown)
        self.more.clicked.connect(self.box.stepUp)
        self.box.valueChanged.connect(self.changed)
        theme.changed.connect(self._draw)
        self._draw()

    def set_range(self, low: float, high: float, step: float) -> None:
        """Set the least and the largest number, and by how much one press changes it."""
        self.box.setRange(low, high)
        self.box.setSingleStep(step)

    @property
    def value(self) -> float:
        """The number."""
        return self.box.value()

    def show_value(self, value: float) -> None:
        """Show another number; `changed` tells of it."""
        self.box.setValue(value)

    def name(self, name: str, tip: str, fewer: str, more: str) -> None:
        """Say what the number is, and what the two buttons do."""
        self.box.setAccessibleName(name)
        self.box.setToolTip(tip)
        for button, text in ((self.less, fewer), (self.more, more)):
            button.setToolTip(text)
            button.setAccessibleName(f"{name}: {text}")

    def _draw(self) -> None:
        for button, icon in ((self.less, "remove"), (self.more, "add")):
            button.setIcon(icons.icon(icon, self._theme.colour("text"), self._theme.colour("text_dim")))
            button.setIconSize(QSize(20, 20))
