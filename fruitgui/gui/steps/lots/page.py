"""The screen of what has been run."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QEvent, QPoint, Qt, QTimer
from PySide6.QtGui import QAction, QKeySequence, QResizeEvent, QShortcut
from PySide6.QtWidgets import QHBoxLayout, QStackedWidget, QVBoxLayout, QWidget

from fruitgui.gui.session import Session
from fruitgui.gui.steps.lots.desk import Desk, ReadLot
from fruitgui.gui.steps.lots.hand import Word
from fruitgui.gui.steps.lots.handing_on import HandingOn
from fruitgui.gui.steps.lots.lot_entry import lot_entry
from fruitgui.gui.steps.lots.lot_list import LotList
from fruitgui.gui.steps.lots.lot_view import LotView
from fruitgui.gui.steps.lots.store_menu import StoreMenu
from fruitgui.gui.steps.page import StepPage
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.told import Told
from fruitgui.gui.widgets.cards import Card, EmptyPlace
from fruitgui.records.lot_search import LotPage, LotQuery
from fruitgui.station.workflow import Step

LIST_WIDTH, WIDEST_LIST = 300, 440
LIST_SHARE = 5
"""Times as wide as the list is the screen, where there is room."""

LOOK_MS = 2_000
"""How often a lot that is not ended is read again while it is looked at."""

SPREADS_EVERY = 5
"""Reading how sizes are spread takes longer; it is done only every so many times."""


class LotsPage(StepPage):
    """The list of lots at the left, the chosen one at the right."""

    def __init__(self, session: Session, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._chosen: int | None = None
        self._looks = 0
        self._spreads_old = True
        self._in_view = False
        self._line_lot: int | None = None
        self.desk = Desk(session.store, self)
        self._stack = QStackedWidget(self)
        self._nothing = Card(parent=self._stack)
        self._empty = EmptyPlace(theme, "lots", parent=self._nothing)
        self.lots, self.lot = LotList(theme, self), LotView(theme, self.desk, session.looks, self._stack)
        self.handing_on = HandingOn(session.store, session.tasks, session.messages, self)
        self.store_menu = StoreMenu(
            session.workspace.folder, session.tasks, session.messages, self, lambda: session.running.running
        )
        self.report_action, self.table_action = QAction(self), QAction(self)
        self._look = QTimer(self, interval=LOOK_MS)
        self._lay_out()
        self._connect()
        self._say_words()
        self._show()

    def complete(self) -> None:
        """Make the list of fruit."""
        _ = self.lot.fruit

    def entered(self) -> None:
        """Read what has been run."""
        self._in_view = True
        self.desk.known = self._session.running.kinds
        self._follow_line()
        self.lots.model.restart()
        self._look.start()
        if self._chosen is not None:
            self._read_lot()

    def left(self) -> None:
        """Rest."""
        self._in_view = False
        self._look.stop()
        self.desk.queries.rest()

    def choose(self, lot: int) -> None:
        """Show a lot."""
        if lot != self._chosen:
            self._chosen = lot
            self.lots.choose(lot)
            self._read_lot()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        """Let the list have its share: in a wide one, growers' names are whole."""
        super().resizeEvent(event)
        self.lots.setFixedWidth(min(max(self.width() // LIST_SHARE, LIST_WIDTH), WIDEST_LIST))

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Take over another language."""
        if event.type() == QEvent.Type.LanguageChange:
            self._say_words()
            self._show()
            self.lots.model.refresh()
        super().changeEvent(event)

    def _lay_out(self) -> None:
        self._nothing.body.addWidget(self._empty)
        self._stack.addWidget(self._nothing)
        self._stack.addWidget(self.lot)
        row = QHBoxLayout()
        row.setSpacing(2 * GRID)
        row.addWidget(self.lots)
        row.addWidget(self._stack, 1)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(2 * GRID, 2 * GRID, 2 * GRID, 2 * GRID)
        whole.addLayout(row)

    def _connect(self) -> None:
        desk, lots = self.desk, self.lots
        lots.searched.connect(lots.model.restart)
        lots.model.wanted.connect(self._ask_lots)
        lots.chosen.connect(self.choose)
        lots.store_wanted.connect(self.store_menu.open_at)
        desk.lots_read.connect(self._take_lots)
        desk.lot_read.connect(self._take_lot)
        desk.spread_read.connect(self.lot.show_spread)
        desk.corrected.connect(self._corrected)
        desk.failed.connect(self._session.messages.error)
        self._session.running.changed.connect(self._follow_line)
        self.lot.turned.connect(self._turned)
        self._look.timeout.connect(self._look_again)
        self.report_action.triggered.connect(self._hand_on_report)
        self.table_action.triggered.connect(self._hand_on_table)
        context = Qt.ShortcutContext.WidgetWithChildrenShortcut
        for keys, act in (
            ("Ctrl+1", self.lot.show_summary), ("Ctrl+2", self.lot.show_fruit), ("Ctrl+F", self._search),
            ("Ctrl+B", self._open_store),
        ):  # fmt: skip
            QShortcut(QKeySequence(keys), self, context=context).activated.connect(act)

    def _say_words(self) -> None:
        for action, text, tip, icon, key in (
            (self.report_action, self.tr("Report …"), self.tr("A PDF to hand to the grower"), "report", "Ctrl+R"),
            (self.table_action, self.tr("Table …"), self.tr("All fruit of the lot as CSV"), "export", "Ctrl+E"),
        ):
            action.setText(text)
            action.setToolTip(tip)
            action.setProperty("drawing", icon)
            action.setShortcut(key)

    def show_line(self, lot: int | None) -> None:
        """Show which lot the line counts into."""
        if lot != self._line_lot:
            self._line_lot = lot
            if self._in_view:
                self.lots.model.refresh()
                self._read_lot()

    # what is shown

    def _show(self) -> None:
        read = self.lot.read
        there = read is not None and read.figures.lot.key == self._chosen
        self._stack.setCurrentIndex(1 if there else 0)
        if there:
            self.offer(self.report_action, self.table_action)
        else:
            self.offer(self.way_to(Step.LIVE))
        found, narrowed = self.lots.model.pages.found, self.lots.narrowed
        self._empty.show_words(*self._empty_words(found, narrowed=narrowed))
        self.say(self._next_words(there=there))

    def _empty_words(self, found: int, *, narrowed: bool) -> tuple[str, str]:
        if found or narrowed:
            return self.tr("No lot is chosen"), self.tr(
                "Choose one at the left: its counts, sizes and fruit appear here."
            )
        how = self.tr(
            "Start a lot on the live screen. Its counts, volumes and sizes appear here, every fruit with its pictures, "
            "and a report to hand to the grower."
        )
        return self.tr("Nothing has been run yet"), how

    def _next_words(self, *, there: bool) -> str:
        if not there:
            some = self.lots.model.pages.found or self.lots.narrowed
            return self.tr("Choose a lot at the left.") if some else self.tr("Start a lot on the live screen first.")
        if not self.lot.at_fruit:
            return self.tr("Look through the fruit, correct what is wrong, then hand on the report.")
        if self.lot.fruit.opened:
            return self.tr("Keys 1 to 9 name the fruit, Delete leaves it out, PgUp and PgDn go through the list.")
        return self.tr("A picture or Return opens a fruit. Keys 1 to 9 name the chosen ones, Delete leaves them out.")

    # what is asked and answered

    def _turned(self) -> None:
        self._show()
        self._read_spreads()

    def _ask_lots(self, page: int) -> None:
        from_s, to_s = self.lots.bounds_s()
        size = self.lots.model.pages.size
        self.desk.ask_lots(LotQuery(self.lots.words.text(), from_s, to_s, page * size, size), page)

    def _follow_line(self) -> None:
        running = self._session.running
        lot = running.lot if running.running else None
        self.show_line(None if lot is None else lot.key)
        if self._in_view and running.lot is not None:
            self.lots.model.refresh()

    def _take_lots(self, page: int, found: LotPage) -> None:
        now_s = self._session.store.now_s()
        self.lots.model.take(page, [lot_entry(line, self._line_lot, now_s) for line in found.lots], found.found)
        if self._chosen is None and found.lots:
            self.choose(found.lots[0].lot.key)
        self._show()

    def _read_lot(self) -> None:
        if self._chosen is not None:
            self.desk.ask_lot(self._chosen)
            self._spreads_old = True
            self._read_spreads()

    def _read_spreads(self) -> None:
        """Read how sizes are spread, when it is looked at; it takes longest."""
        if self._chosen is not None and self._spreads_old and not self.lot.at_fruit:
            self._spreads_old = False
            self.desk.ask_spreads(self._chosen)

    def _take_lot(self, read: ReadLot) -> None:
        if read.figures.lot.key == self._chosen:
            self.lot.show_lot(read, self._line_lot)
            self._show()

    def _look_again(self) -> None:
        read = self.lot.read
        self.lots.model.refresh()
        if read is None or self._chosen is None or read.figures.lot.ended_s is not None:
            return
        self._looks += 1
        self.desk.ask_lot(self._chosen)
        if self._looks % SPREADS_EVERY == 0:
            self._spreads_old = True
            self._read_spreads()
        if self.lot.at_fruit and not self.lot.fruit.opened:
            self.lot.fruit.table.model.refresh()

    def _corrected(self, word: Word) -> None:
        self._session.running.corrected(word.lot)
        self.lots.model.refresh()
        self._read_lot()
        undo = partial(self.desk.undo, word.lot) if self.desk.can_undo(word.lot) else None
        self._session.messages.info(lambda: Told(word.text, action=self.tr("Undo") if undo else ""), undo)

    # what is done

    def _hand_on_report(self) -> None:
        if self.lot.read is not None:
            marks = self._session.looks(self.lot.read.kinds)
            self.handing_on.ask_report(self.lot.read.figures.lot, tuple(marks.values()))

    def _hand_on_table(self) -> None:
        if self.lot.read is not None:
            self.handing_on.ask_table(self.lot.read.figures.lot)

    def _search(self) -> None:
        self.lots.words.setFocus()
        self.lots.words.selectAll()

    def _open_store(self) -> None:
        button = self.lots.store
        self.store_menu.open_at(button.mapToGlobal(QPoint(0, button.height())))
