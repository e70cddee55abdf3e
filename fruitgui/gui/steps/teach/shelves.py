"""The row above the grid: which fruit are looked at, how large, and what can be done with them."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSignalBlocker, QSize, Qt, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QButtonGroup, QComboBox, QHBoxLayout, QPushButton, QSlider, QToolButton, QWidget

from fruitgui.gui.kind_words import kind_name
from fruitgui.gui.numbers import count_text
from fruitgui.gui.steps.teach.desk import KindLine, Pile, Shelf
from fruitgui.gui.steps.teach.grid import LARGEST, SMALLEST, USUAL
from fruitgui.gui.theme import icons
from fruitgui.gui.theme.kinds import KindMark
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.choice_box import ChoiceBox
from fruitgui.gui.widgets.kind_mark import mark_pixmap
from fruitgui.gui.widgets.worded import Worded

ICON_PX = 20


class ToolActionButton(QToolButton):
    """A square button that is an action; its words are in its tooltip."""

    def __init__(self, action: QAction, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._action = action
        self._theme = theme
        self.setCheckable(action.isCheckable())
        self.clicked.connect(action.trigger)
        action.changed.connect(self._follow)
        theme.changed.connect(self._follow)
        self._follow()

    def _follow(self) -> None:
        action, theme = self._action, self._theme
        self.setEnabled(action.isEnabled())
        self.setChecked(action.isChecked())
        key = action.shortcut().toString()
        self.setToolTip(f"{action.text()} ({key})" if key else action.text())
        self.setAccessibleName(action.text())
        self.setIcon(
            icons.icon(str(action.property("drawing")), theme.colour("accent" if action.isChecked() else "text"),
                       theme.colour("line"))
        )  # fmt: skip
        self.setIconSize(QSize(ICON_PX, ICON_PX))


class Shelves(Worded, QWidget):
    """Buttons for the piles, the kinds of the named fruit, the size of the pictures, and tools.

    Attributes:
        chosen: another `Shelf`.
        resized: another side of tiles, pixels.
    """

    chosen = Signal(object)
    resized = Signal(int)

    def __init__(self, theme: Theme, tools: Sequence[QAction], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._counts = dict.fromkeys(Pile, 0)
        self.shelf = Shelf()
        self.piles = {pile: QPushButton() for pile in Pile}
        self.kinds, self.scale = ChoiceBox(), QSlider(Qt.Orientation.Horizontal)
        self.tools = [ToolActionButton(action, theme) for action in tools]
        self._group = QButtonGroup(self)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(GRID)
        for button in self.piles.values():
            button.setCheckable(True)
            self._group.addButton(button)
            row.addWidget(button)
        row.addWidget(self.kinds)
        row.addStretch()
        self.scale.setRange(SMALLEST, LARGEST)
        self.scale.setValue(USUAL)
        self.scale.setPageStep(32)
        self.scale.setSingleStep(16)
        self.scale.setFixedWidth(64)
        row.addWidget(self.scale)
        for tool in self.tools:
            row.addWidget(tool)
        self.kinds.setMinimumContentsLength(10)
        self.kinds.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self._group.buttonClicked.connect(self._choose_pile)
        self.kinds.activated.connect(self._choose_kind)
        self.scale.valueChanged.connect(self.resized)
        self._say_words()
        self.show_shelf(self.shelf)

    def show_counts(self, counts: dict[Pile, int], lines: Sequence[KindLine], marks: dict[str, KindMark]) -> None:
        """Show how many fruit are on each pile, and of each kind."""
        self._counts = counts
        self._say_counts()
        with QSignalBlocker(self.kinds):
            self.kinds.clear()
            self.kinds.addItem(self.tr("All kinds"), None)
            for line in lines:
                if line.fruit:
                    text = f"{kind_name(line.kind)} · {count_text(line.fruit)}"
                    self.kinds.addItem(mark_pixmap(marks[line.kind], ICON_PX), text, line.kind)
            self.kinds.setCurrentIndex(max(self.kinds.findData(self.shelf.kind), 0))

    def show_shelf(self, shelf: Shelf) -> None:
        """Show which shelf is looked at."""
        self.shelf = shelf
        self.piles[shelf.pile].setChecked(True)
        self.kinds.setVisible(shelf.pile is Pile.NAMED)
        self.kinds.setCurrentIndex(max(self.kinds.findData(shelf.kind), 0))

    def _say_words(self) -> None:
        self.kinds.setAccessibleName(self.tr("Kind to review"))
        self.kinds.setToolTip(self.tr("Review the fruit of one kind"))
        self.scale.setAccessibleName(self.tr("Size of the pictures"))
        self.scale.setToolTip(self.tr("Size of the pictures (+ and −)"))
        for pile, tip in (
            (Pile.WAITING, self.tr("Fruit that wait to be named (Ctrl+1)")),
            (Pile.NAMED, self.tr("Fruit that have a kind, to look over (Ctrl+2)")),
            (Pile.DOUBTFUL, self.tr("Fruit that a model which never saw them takes for something else (Ctrl+3)")),
        ):
            self.piles[pile].setToolTip(tip)
        self._say_counts()

    def _say_counts(self) -> None:
        words = {
            Pile.WAITING: self.tr("Waiting"),
            Pile.NAMED: self.tr("Named"),
            Pile.DOUBTFUL: self.tr("Doubtful"),
        }
        for pile, button in self.piles.items():
            button.setText(f"{words[pile]}  {count_text(self._counts[pile])}")

    def _choose_pile(self) -> None:
        pile = next(pile for pile, button in self.piles.items() if button.isChecked())
        self.chosen.emit(Shelf(pile, self.shelf.kind if pile is Pile.NAMED else None))

    def _choose_kind(self) -> None:
        self.chosen.emit(Shelf(Pile.NAMED, self.kinds.currentData()))
