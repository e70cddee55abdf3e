"""The fruit of a lot: the table, or one of them large, and corrections by hand below."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QStackedWidget, QWidget

from fruitgui.gui.steps.lots.desk import Desk
from fruitgui.gui.steps.lots.fruit_details import FruitDetails
from fruitgui.gui.steps.lots.fruit_pictures import ShownFruit
from fruitgui.gui.steps.lots.fruit_rows import Wanted
from fruitgui.gui.steps.lots.fruit_table import FruitTable
from fruitgui.gui.steps.lots.hand import Deed, Word
from fruitgui.gui.steps.lots.hand_bar import HandBar
from fruitgui.gui.theme.kinds import KindMark
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import Card
from fruitgui.records.fruit_record import FruitRecord
from fruitgui.records.fruit_search import FruitPage


class FruitPanel(Card):
    """Asks the desk for what is looked at, and tells it what a person says.

    Attributes:
        turned: the list is shown, or one fruit.
    """

    turned = Signal()

    def __init__(self, theme: Theme, desk: Desk, parent: QWidget | None = None) -> None:
        super().__init__("", parent)
        self._desk = desk
        self._marks: Mapping[str, KindMark] = {}
        self._row = 0
        self._stack = QStackedWidget(self)
        self.table, self.large = FruitTable(theme, self._stack), FruitDetails(theme, self._stack)
        self.hand = HandBar(theme, self)
        self._stack.addWidget(self.table)
        self._stack.addWidget(self.large)
        column = self.body
        column.setSpacing(GRID)
        column.addWidget(self._stack, 1)
        column.addWidget(self.hand)
        self._connect()
        self._follow_chosen()

    @property
    def opened(self) -> bool:
        """Whether one fruit is shown large."""
        return self._stack.currentWidget() is self.large

    def show_lot(self, lot: int) -> None:
        """Show the fruit of another lot."""
        self.close_fruit()
        self.table.show_lot(lot)

    def show_kinds(self, kinds: Sequence[str], marks: Mapping[str, KindMark]) -> None:
        """Take over the kinds that fruit can be."""
        self._marks = marks
        self.table.show_kinds(kinds, marks)
        self.hand.show_kinds(kinds, marks)

    def take_focus(self) -> None:
        """Take the keyboard."""
        (self.large.picture if self.opened else self.table.view).setFocus()

    def refresh(self) -> None:
        """Ask again for what is in view."""
        self.table.model.refresh()
        if self.opened and self.large.fruit is not None:
            self._desk.open_again(self.table.wanted, self.large.fruit.key, self._row)

    def open_row(self, row: int) -> None:
        """Show the fruit of a row large."""
        self._desk.open_row(self.table.wanted, row)

    def close_fruit(self) -> None:
        """Go back to the list."""
        if self.opened:
            self._stack.setCurrentWidget(self.table)
            self._follow_chosen()
            self.take_focus()
            self.turned.emit()

    def _connect(self) -> None:
        desk, table = self._desk, self.table
        table.wanted_changed.connect(table.model.restart)
        table.model.wanted.connect(self._ask_page)
        table.opened.connect(self.open_row)
        table.chosen_changed.connect(self._follow_chosen)
        self.large.closed.connect(self.close_fruit)
        self.large.stepped.connect(self._step)
        self.hand.said.connect(self._say)
        self.hand.undo_wanted.connect(self._undo)
        desk.fruit_read.connect(self._take_page)
        desk.pictures_read.connect(table.model.take_pictures)
        desk.fruit_shown.connect(self._show_fruit)
        desk.corrected.connect(self.refresh)
        context = Qt.ShortcutContext.WidgetWithChildrenShortcut
        large = self.large
        for keys, act in (
            ("Backspace", self.close_fruit), ("PgUp", large.before.click), ("PgDown", large.after.click),
            ("V", self._next_picture), ("O", large.outline.toggle),
        ):  # fmt: skip
            QShortcut(QKeySequence(keys), large, context=context).activated.connect(act)

    def _ask_page(self, page: int) -> None:
        self._desk.ask_fruit(self.table.wanted, page, self.table.model.pages.size)

    def _take_page(self, page: int, found: FruitPage, wanted: Wanted) -> None:
        if wanted == self.table.wanted:
            self.table.model.take(page, found.fruit, found.found)
            self._follow_chosen()

    def _show_fruit(self, shown: ShownFruit | None, row: int, found: int) -> None:
        if shown is None:
            self.close_fruit()
            return
        self._row = row
        self.large.show_fruit(shown, (row, found), self._marks)
        if row < self.table.model.pages.found:
            self.table.view.selectRow(row)
        turned = not self.opened
        self._stack.setCurrentWidget(self.large)
        self._follow_chosen()
        if turned:
            self.take_focus()
            self.turned.emit()

    def _step(self, by: int) -> None:
        row = self._row_after(by)
        if row is not None:
            self.open_row(row)

    def _row_after(self, by: int) -> int | None:
        """Return another row; where a correction took this fruit out of the list, the next has come to its row."""
        fruit, there = self.large.fruit, self.table.model.pages.row(self._row)
        gone = there is not None and fruit is not None and there.key != fruit.key
        row = self._row + (0 if gone and by > 0 else by)
        return row if 0 <= row < self.table.model.pages.found else None

    def _next_picture(self) -> None:
        self.large.picture.choose(self.large.picture.chosen + 1)

    def _chosen(self) -> list[FruitRecord]:
        if self.opened:
            return [] if self.large.fruit is None else [self.large.fruit]
        return self.table.chosen()

    def _follow_chosen(self) -> None:
        chosen = self._chosen()
        kind, counted = (chosen[0].kind, chosen[0].counted) if chosen else ("", True)
        self.large.show_steps(before=self._row_after(-1) is not None, after=self._row_after(1) is not None)
        self.hand.show_chosen(len(chosen), kind, counted, self._desk.can_undo(self.table.wanted.lot))

    def _undo(self) -> None:
        self._desk.undo(self.table.wanted.lot)

    def _say(self, deed: Deed, kind: str, note: str) -> None:
        chosen = [] if deed is Deed.ADD else self._chosen()
        if chosen or deed is Deed.ADD:
            keys = tuple(one.key for one in chosen)
            self._desk.say(Word(deed, keys, kind, note, self.table.wanted.lot), chosen)
