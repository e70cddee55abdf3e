"""The row above the belt: from where it is looked at, and what can be done with the region's corners."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSize, Signal
from PySide6.QtWidgets import QButtonGroup, QHBoxLayout, QPushButton, QToolButton, QWidget

from fruitgui.gui.numbers import THIN, number_text
from fruitgui.gui.theme import icons
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import label
from fruitgui.gui.widgets.worded import Worded

ABOVE = ""
NAMES_UP_TO = 3
"""With more sensors their numbers stand for their names."""

_TOOLS = {"add": ("add", "Ctrl++"), "remove": ("remove", "Ctrl+-"), "reset": ("undo", "Ctrl+R")}


class ToolRow(Worded, QWidget):
    """Views at the left, tools at the right.

    Attributes:
        chosen: name of the sensor through which the belt is looked at; `ABOVE` for from above.
        add, remove, reset: asked for.
    """

    chosen = Signal(str)
    add = Signal()
    remove = Signal()
    reset = Signal()

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._count, self._area_m2 = 0, 0.0
        self.views: dict[str, QPushButton] = {}
        self.tools = {name: QToolButton() for name in _TOOLS}
        self._size = label("", "dim")
        self._group = QButtonGroup(self)
        self._views = QHBoxLayout()
        self._views.setSpacing(GRID // 2)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(GRID)
        row.addLayout(self._views)
        row.addStretch()
        row.addWidget(self._size)
        for button in self.tools.values():
            row.addWidget(button)
        self._group.buttonClicked.connect(self._tell)
        for name, wanted in (("add", self.add), ("remove", self.remove), ("reset", self.reset)):
            self.tools[name].clicked.connect(wanted)
        theme.changed.connect(self._draw_icons)
        self._draw_icons()
        self._say_words()

    def show_sensors(self, sensors: Sequence[str], shown: str) -> None:
        """Offer these sensors; `shown` is what is looked through."""
        if list(self.views) != [ABOVE, *sensors]:
            for button in self.views.values():
                self._group.removeButton(button)
                self._views.removeWidget(button)
                button.hide()
                button.deleteLater()
            self.views = {name: QPushButton() for name in (ABOVE, *sensors)}
            for button in self.views.values():
                button.setCheckable(True)
                self._group.addButton(button)
                self._views.addWidget(button)
            self._say_words()
        self.views[shown].setChecked(True)

    def show_region(self, count: int, area_m2: float) -> None:
        """Say how many corners the region has, and how large it is."""
        self._count, self._area_m2 = count, area_m2
        self.tools["remove"].setEnabled(count > 3)
        self._say_size()

    def _tell(self) -> None:
        self.chosen.emit(next(name for name, button in self.views.items() if button.isChecked()))

    def _say_words(self) -> None:
        for number, (name, button) in enumerate(self.views.items()):
            short = name if len(self.views) <= NAMES_UP_TO + 1 else str(number)
            said = self.tr("Through {sensor}").format(sensor=name) if name else self.tr("From above")
            button.setText(short if name else said)
            button.setShortcut(f"F{number + 3}")
            button.setToolTip(f"{said} (F{number + 3})")
            button.setAccessibleName(said)
        tips = {
            "add": self.tr("Add a corner after the chosen one"),
            "remove": self.tr("Remove the chosen corner"),
            "reset": self.tr("Go back to what is saved"),
        }
        for name, tip in tips.items():
            key = _TOOLS[name][1]
            self.tools[name].setShortcut(key)
            self.tools[name].setToolTip(f"{tip} ({key})")
            self.tools[name].setAccessibleName(tip)
        self._say_size()

    def _say_size(self) -> None:
        area = f"{number_text(self._area_m2, 2)}{THIN}m²"
        self._size.setText(self.tr("{count} corners, {area}").format(count=self._count, area=area))
        self._size.setVisible(self._count > 0)

    def _draw_icons(self) -> None:
        for name, button in self.tools.items():
            text, dim = self._theme.colour("text"), self._theme.colour("text_dim")
            button.setIcon(icons.icon(_TOOLS[name][0], text, dim))
            button.setIconSize(QSize(20, 20))
