"""A lot: what it is called, and below its summary or its fruit."""

from __future__ import annotations

from PySide6.QtCore import QSize, Signal
from PySide6.QtWidgets import QButtonGroup, QHBoxLayout, QLabel, QPushButton, QStackedWidget, QVBoxLayout, QWidget

from fruitgui.gui.numbers import count_text
from fruitgui.gui.steps.lots.desk import Desk, ReadLot
from fruitgui.gui.steps.lots.figures import about_text
from fruitgui.gui.steps.lots.fruit_panel import FruitPanel
from fruitgui.gui.steps.lots.lot_entry import LotState, state_of, state_word
from fruitgui.gui.steps.lots.lot_list import STATE_LOOKS
from fruitgui.gui.steps.lots.summary import Summary
from fruitgui.gui.theme import icons
from fruitgui.gui.theme.kinds import Looks, kind_marks
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import label
from fruitgui.gui.widgets.worded import Worded
from fruitgui.records.distribution import Distribution


class LotView(Worded, QWidget):
    """Shows one lot in two ways.

    Attributes:
        turned: the other way, or a fruit opened or closed.
    """

    turned = Signal()

    def __init__(self, theme: Theme, desk: Desk, looks: Looks = kind_marks, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._desk = desk
        self._looks = looks
        self._fruit: FruitPanel | None = None
        self._read: ReadLot | None = None
        self._state = LotState.ENDED
        self.name, self.about, self.state, self._icon = label("", "page"), label("", "dim"), label("", "dim"), QLabel()
        self.note = label("", "dim")
        self._stack = QStackedWidget(self)
        self.summary = Summary(theme, self._stack)
        self.summary_button, self.fruit_button = QPushButton(self), QPushButton(self)
        self._lay_out()
        self._connect()
        self._say_words()

    @property
    def lot(self) -> int | None:
        """The key of the lot that is shown."""
        return None if self._read is None else self._read.figures.lot.key

    @property
    def fruit(self) -> FruitPanel:
        """Its fruit; made when they are first asked for."""
        if self._fruit is None:
            self._fruit = FruitPanel(self._theme, self._desk, self._stack)
            self._fruit.turned.connect(self.turned)
            self._stack.addWidget(self._fruit)
            if self._read is not None:
                self._fruit.show_kinds(self._read.kinds, self._looks(self._read.kinds))
                self._fruit.show_lot(self._read.figures.lot.key)
        return self._fruit

    @property
    def read(self) -> ReadLot | None:
        """What is shown of the lot."""
        return self._read

    def show_lot(self, read: ReadLot, running: int | None) -> None:
        """Show a lot, or the same at another moment."""
        other = self.lot != read.figures.lot.key
        self._read = read
        self._state = state_of(read.figures.lot, running)
        marks = self._looks(read.kinds)
        self.summary.show_figures(read.figures, marks)
        if self._fruit is not None:
            self._fruit.show_kinds(read.kinds, marks)
            if other:
                self._fruit.show_lot(read.figures.lot.key)
        self._say_words()

    def show_spread(self, lot: int, spread: Distribution) -> None:
        """Show how a measure is spread, where it is of this lot."""
        if lot == self.lot:
            self.summary.show_spread(spread)

    def show_fruit(self) -> None:
        """Turn to the fruit."""
        self.fruit_button.setChecked(True)

    def show_summary(self) -> None:
        """Turn to the summary."""
        self.summary_button.setChecked(True)

    @property
    def at_fruit(self) -> bool:
        """Whether the fruit are shown."""
        return self._stack.currentWidget() is self._fruit

    def _lay_out(self) -> None:
        self._icon.setFixedSize(20, 20)
        self._stack.addWidget(self.summary)
        group = QButtonGroup(self)
        for button in (self.summary_button, self.fruit_button):
            button.setCheckable(True)
            group.addButton(button)
        self.summary_button.setChecked(True)
        title, top, words = QHBoxLayout(), QHBoxLayout(), QVBoxLayout()
        title.setSpacing(GRID)
        title.addWidget(self.name)
        title.addSpacing(GRID)
        title.addWidget(self._icon)
        title.addWidget(self.state)
        title.addStretch()
        words.setSpacing(0)
        words.addLayout(title)
        words.addWidget(self.about)
        top.setSpacing(GRID)
        top.addLayout(words, 1)
        top.addWidget(self.summary_button)
        top.addWidget(self.fruit_button)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.setSpacing(GRID)
        whole.addLayout(top)
        whole.addWidget(self.note)
        whole.addWidget(self._stack, 1)

    def _connect(self) -> None:
        self.fruit_button.toggled.connect(self._turn)
        self._theme.changed.connect(self._draw)

    def _turn(self) -> None:
        at_fruit = self.fruit_button.isChecked()
        self._stack.setCurrentWidget(self.fruit if at_fruit else self.summary)
        if at_fruit:
            self.fruit.take_focus()
        self.turned.emit()

    def _say_words(self) -> None:
        self.summary_button.setText(self.tr("Summary"))
        self.summary_button.setToolTip(self.tr("Counts, volumes and sizes of the lot (Ctrl+1)"))
        self.fruit_button.setText(self.tr("Fruit"))
        self.fruit_button.setToolTip(self.tr("Each fruit of the lot, to look at and to correct (Ctrl+2)"))
        self._draw()
        if self._read is None:
            return
        lot = self._read.figures.lot
        self.name.setText(self.tr("Lot {name}").format(name=lot.name))
        self.about.setText(about_text(lot) or " ")
        self.state.setText(state_word(self._state))
        self.note.setText(lot.note)
        self.note.setVisible(bool(lot.note))
        self.fruit_button.setText(self.tr("Fruit ({count})").format(count=count_text(self._read.figures.fruit)))

    def _draw(self) -> None:
        icon, colour = STATE_LOOKS[self._state]
        self._icon.setPixmap(icons.pixmap(icon, self._theme.colour(colour), 20, self.devicePixelRatioF()))
        for button, name in ((self.summary_button, "scale"), (self.fruit_button, "eye")):
            button.setIcon(icons.icon(name, self._theme.colour("text")))
            button.setIconSize(QSize(20, 20))
