"""One fruit large: its pictures, its way, what was measured, what was said."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from PySide6.QtCore import QSize, Signal
from PySide6.QtWidgets import (
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from fruitgui.gui.kind_words import kind_name
from fruitgui.gui.numbers import count_text
from fruitgui.gui.steps.lots.fruit_facts import facts, machine_text, person_text, said_lines
from fruitgui.gui.steps.lots.fruit_picture import FruitPicture, WayView
from fruitgui.gui.steps.lots.fruit_pictures import ShownFruit
from fruitgui.gui.theme import icons
from fruitgui.gui.theme.kinds import UNKNOWN_MARK, KindMark
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import label, set_health
from fruitgui.gui.widgets.kind_mark import KindMarkView
from fruitgui.gui.widgets.scrolled import Scrolled
from fruitgui.gui.widgets.tick_box import TickBox
from fruitgui.gui.widgets.worded import Worded
from fruitgui.records.fruit_record import FruitRecord

WIDEST_PICTURE, WIDEST_FACTS = 1100, 760
"""Pixels: beyond, a picture shows nothing more, and a fact is far from its name."""


class FruitDetails(Worded, QWidget):
    """Shows one fruit of a list.

    Attributes:
        closed: back to the list. stepped: so many fruit further in the list.
    """

    closed = Signal()
    stepped = Signal(int)

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._shown: ShownFruit | None = None
        self._place = (0, 0)
        self._marks: Mapping[str, KindMark] = {}
        self.back, self.before, self.after = QToolButton(), QToolButton(), QToolButton()
        self.title, self.place = label("", "title"), label("", "dim")
        self.mark = KindMarkView(UNKNOWN_MARK, 36)
        self.picture, self.way, self.outline = FruitPicture(theme), WayView(theme), TickBox()
        self.machine, self.person, self.said = label("", "dim"), label("", "strong"), label("", "small")
        self._facts = QGridLayout()
        self._lay_out()
        self._connect()
        self._say_words()
        self._draw()

    @property
    def fruit(self) -> FruitRecord | None:
        """The fruit that is shown."""
        return None if self._shown is None else self._shown.fruit

    def show_fruit(self, shown: ShownFruit, place: tuple[int, int], marks: Mapping[str, KindMark]) -> None:
        """Show a fruit; it is so far down a list of so many."""
        same = self._shown is not None and self._shown.fruit.key == shown.fruit.key
        large = self.picture.chosen if same else 0
        self._shown, self._place, self._marks = shown, place, marks
        mark = marks.get(shown.fruit.kind, UNKNOWN_MARK)
        self.mark.show_mark(mark)
        self.picture.show_views(shown.views, mark)
        self.picture.choose(large)
        self.way.show_way(shown.way, mark)
        self._show_words()

    def show_steps(self, *, before: bool, after: bool) -> None:
        """Say whether there are fruit before and after this one."""
        self.before.setEnabled(before)
        self.after.setEnabled(after)

    def _lay_out(self) -> None:
        for one in (self.machine, self.person, self.said):
            one.setWordWrap(True)
        set_health(self.person, "warn")
        self.outline.setChecked(True)
        top = QHBoxLayout()
        top.setSpacing(GRID)
        top.addWidget(self.back)
        top.addWidget(self.mark)
        top.addWidget(self.title)
        top.addStretch()
        top.addWidget(self.place)
        top.addWidget(self.before)
        top.addWidget(self.after)
        side = QWidget()
        right = QVBoxLayout(side)
        right.setContentsMargins(0, 0, GRID, 0)
        right.setSpacing(GRID // 2)
        self._facts.setHorizontalSpacing(2 * GRID)
        self._facts.setVerticalSpacing(3)
        self._facts.setColumnStretch(1, 1)
        right.addWidget(self.person)
        right.addWidget(self.machine)
        right.addSpacing(GRID // 2)
        right.addLayout(self._facts)
        right.addSpacing(GRID // 2)
        right.addWidget(self.way)
        right.addWidget(self.said)
        right.addStretch()
        scroll = Scrolled(side)
        self.picture.setMaximumSize(WIDEST_PICTURE, WIDEST_PICTURE)
        scroll.setMaximumWidth(WIDEST_FACTS)
        left = QVBoxLayout()
        left.setSpacing(GRID // 2)
        left.addWidget(self.picture, 1)
        left.addWidget(self.outline)
        left.addStretch()
        middle = QHBoxLayout()
        middle.setSpacing(2 * GRID)
        middle.addLayout(left, 5)
        middle.addWidget(scroll, 5)
        middle.addStretch()
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.setSpacing(GRID)
        whole.addLayout(top)
        whole.addLayout(middle, 1)

    def _connect(self) -> None:
        self.back.clicked.connect(self.closed)
        self.before.clicked.connect(self._step_back)
        self.after.clicked.connect(self._step_on)
        self.outline.toggled.connect(self.picture.show_outline)
        self._theme.changed.connect(self._draw)

    def _say_words(self) -> None:
        for button, name, tip, key in (
            (self.back, self.tr("Back"), self.tr("Back to the list"), "Backspace"),
            (self.before, self.tr("Before"), self.tr("The fruit before this one"), "PgUp"),
            (self.after, self.tr("Next"), self.tr("The next fruit"), "PgDown"),
        ):
            button.setAccessibleName(name)
            button.setToolTip(f"{tip} ({key})")
        self.outline.setText(self.tr("Outline"))
        self.outline.setToolTip(self.tr("Draw the outline that was measured (O); V shows the next picture"))
        self._show_words()

    def _draw(self) -> None:
        colour, dim = self._theme.colour("text"), self._theme.colour("line")
        for button, icon in ((self.back, "left"), (self.before, "up"), (self.after, "down")):
            button.setIcon(icons.icon(icon, colour, dim))
            button.setIconSize(QSize(20, 20))

    def _show_words(self) -> None:
        if self._shown is None:
            return
        fruit, (row, found) = self._shown.fruit, self._place
        text = self.tr("{kind}, No. {number}")
        self.title.setText(text.format(kind=kind_name(fruit.kind), number=count_text(fruit.number)))
        self.place.setText(self.tr("{row} of {found}").format(row=count_text(row + 1), found=count_text(found)))
        self.machine.setText(machine_text(fruit))
        self.person.setText(person_text(fruit))
        self.person.setVisible(bool(person_text(fruit)))
        self.said.setText("\n".join(said_lines(self._shown.corrections)))
        self.said.setVisible(bool(self._shown.corrections))
        self._show_facts(facts(fruit))

    def _show_facts(self, rows: Sequence[tuple[str, str]]) -> None:
        for number, texts in enumerate(rows):
            for column, text in enumerate(texts):
                self._fact(number, column).setText(text)
        for number in range(self._facts.rowCount()):
            for column in range(2):
                self._fact(number, column).setVisible(number < len(rows))

    def _fact(self, row: int, column: int) -> QLabel:
        item = self._facts.itemAtPosition(row, column)
        widget = None if item is None else item.widget()
        if isinstance(widget, QLabel):
            return widget
        made = label("", "" if column else "dim")
        self._facts.addWidget(made, row, column)
        return made

    def _step_back(self) -> None:
        self.stepped.emit(-1)

    def _step_on(self) -> None:
        self.stepped.emit(1)
