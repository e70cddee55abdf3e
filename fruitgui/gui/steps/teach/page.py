"""The teaching screen."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QAction, QKeySequence, QShortcut
from PySide6.QtWidgets import QHBoxLayout, QStackedLayout, QVBoxLayout, QWidget

from fruitgui.gui.queries import Queries
from fruitgui.gui.session import Session
from fruitgui.gui.step_words import reason_text
from fruitgui.gui.steps.page import StepPage
from fruitgui.gui.steps.teach import work
from fruitgui.gui.steps.teach.actions import TeachActions
from fruitgui.gui.steps.teach.advice import advice, nothing_words
from fruitgui.gui.steps.teach.asking import Asking
from fruitgui.gui.steps.teach.classroom import Classroom
from fruitgui.gui.steps.teach.desk import Pile, Shelf
from fruitgui.gui.steps.teach.field_keys import FieldKeys
from fruitgui.gui.steps.teach.fruit_model import FruitModel
from fruitgui.gui.steps.teach.grid import FruitGrid
from fruitgui.gui.steps.teach.kind_keys import KindKeys
from fruitgui.gui.steps.teach.shelves import Shelves
from fruitgui.gui.steps.teach.side_panel import SidePanel
from fruitgui.gui.steps.teach.tile import Tiles
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.told import Told
from fruitgui.gui.ways import at_root, ways_on
from fruitgui.gui.widgets.cards import EmptyPlace
from fruitgui.station.workflow import State, Step, StepState

SIZE_STEP = 32


class TeachPage(StepPage):
    """Fruit come in, a person says what they are."""

    def __init__(self, session: Session, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.room = Classroom(session, self)
        self._asking = Asking(self.room, self)
        self._tiles = Tiles(self.room.desk, session.looks)
        self._seen = Queries(self)
        self._panel_key: int | None = None
        self._shelf = Shelf()
        self._wanted: int | None = None
        self.choices = TeachActions(self)
        self.model = FruitModel(session.store.crops, self._tiles.described, self)
        self.kinds, self.grid = KindKeys(theme), FruitGrid(self.model, self._tiles, theme)
        self.shelves = Shelves(theme, self.choices.tools)
        self.shelves.addActions(self.choices.tools)
        self.panel, self.empty = SidePanel(theme), EmptyPlace(theme, "teach")
        self._lay_out()
        self._connect()
        self._show()
        self.room.load()

    def entered(self) -> None:
        """Show what is taught now, others may have added to it."""
        self.room.enter()
        self.grid.setFocus()
        self._show()

    def left(self) -> None:
        """Rest; a lesson goes on."""
        self.room.leave()
        self.model.rest()
        self._seen.rest()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Take over another language."""
        if event.type() == QEvent.Type.LanguageChange:
            self.choices.say_words()
            self._show()
        super().changeEvent(event)

    def _lay_out(self) -> None:
        middle = QWidget()
        self._stack = QStackedLayout(middle)
        self._stack.addWidget(self.grid)
        self._stack.addWidget(self.empty)
        row = QHBoxLayout()
        row.setSpacing(2 * GRID)
        row.addWidget(middle, 1)
        row.addWidget(self.panel)
        column = QVBoxLayout(self)
        column.setContentsMargins(2 * GRID, 2 * GRID, 2 * GRID, 2 * GRID)
        column.setSpacing(1 * GRID)
        column.addWidget(self.kinds)
        column.addWidget(self.shelves)
        column.addLayout(row, 1)

    def _connect(self) -> None:
        room, session = self.room, self._session
        room.changed.connect(self._show)
        room.busy_changed.connect(self._show_actions)
        room.touched.connect(self._show_touched)
        session.connected.changed.connect(self._show_actions)
        session.states_changed.connect(self._show_actions)
        session.running.changed.connect(self._show_actions)
        session.taught_wanted.connect(self._want)
        self._seen.failed.connect(session.messages.error)
        self.model.queries.failed.connect(session.messages.error)
        self.kinds.chosen.connect(self._give)
        self.kinds.typed.connect(self._give)
        self.shelves.chosen.connect(self._look_at)
        self.shelves.resized.connect(self.grid.resize_tiles)
        self.grid.chosen_changed.connect(self._show_chosen)
        self.panel.measured.connect(room.measure)
        self.choices.watch.triggered.connect(room.lessons.watch)
        self.choices.open.triggered.connect(self._asking.recording)
        self.choices.stop.triggered.connect(room.lessons.stop)
        self.choices.suggest.triggered.connect(room.look_through)
        self.choices.undo.triggered.connect(room.undo)
        self.choices.redo.triggered.connect(room.redo)
        self.choices.clear.triggered.connect(self._clear)
        self.choices.remove.triggered.connect(self._remove)
        self.choices.weigh.triggered.connect(self._ask_densities)
        session.kinds.changed.connect(self._show_chosen)
        self.choices.see_depth.toggled.connect(self.grid.show_depth)
        self.choices.take_labels.triggered.connect(self._asking.labels)
        self.choices.give_labels.triggered.connect(self._asking.where_to_export)
        self._connect_keys()

    def _connect_keys(self) -> None:
        keys: list[tuple[str, Callable[[], object]]] = [(str(n), partial(self._give_by_key, str(n))) for n in range(10)]
        keys += [(f"Ctrl+{number}", partial(self._look_at, Shelf(pile))) for number, pile in enumerate(Pile, start=1)]
        keys += [("+", partial(self._resize, SIZE_STEP)), ("-", partial(self._resize, -SIZE_STEP))]
        keys += [("Ctrl+K", self.kinds.new.setFocus), ("Ctrl+M", self.panel.volume.setFocus)]
        for key, does in keys:
            shortcut = QShortcut(QKeySequence(key), self)
            shortcut.setContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)
            shortcut.activated.connect(does)
        panel = self.panel
        FieldKeys({panel.volume: panel.mass, panel.mass: self.grid, self.kinds.new: None}, self.grid, self)

    # what is shown

    def _show(self) -> None:
        desk = self.room.desk
        self._jump()
        keys = desk.keys(self._shelf)
        lines = desk.lines()
        self.kinds.show_lines(lines, self._tiles.marks)
        counts = {pile: len(keys if Shelf(pile) == self._shelf else desk.keys(Shelf(pile))) for pile in Pile}
        self.shelves.show_counts(counts, lines, self._tiles.marks)
        self.grid.show_keys(keys)
        self._stack.setCurrentWidget(self.grid if keys else self.empty)
        if not keys:
            self.empty.show_words(*nothing_words(desk, self._shelf, in_lesson=self.room.lessons.running))
        self._show_chosen()
        self._show_actions()

    def _show_chosen(self) -> None:
        desk, chosen = self.room.desk, self.grid.chosen()
        current = self.grid.current()
        key = current if current in chosen else (chosen[0] if chosen else None)
        if key is None or key not in desk.fruit:
            self._panel_key = None
            self.panel.show_nothing()
        else:
            one = desk.fruit[key]
            self.panel.show_fruit(one, self._tiles.tile(key), self._densities().get(one.kind or ""), len(chosen))
            if key != self._panel_key:
                self._panel_key = key
                self._seen.ask("fruit", work.looking_at(self._session.store, key), self._show_views)
        for action in (self.choices.clear, self.choices.remove):
            action.setEnabled(bool(chosen))

    def _show_views(self, seen: work.Seen) -> None:
        self.panel.show_views(*seen)

    def _show_touched(self, keys: list[int]) -> None:
        """Bring back into view what undoing changed."""
        rows = [row for row in map(self.model.row, keys) if row >= 0]
        if rows:
            self.grid.choose_row(min(rows))

    def _show_actions(self) -> None:
        room, session = self.room, self._session
        station = session.station is not None
        missing = self._missing()
        running = session.running.running
        self.choices.watch.setEnabled(
            station and session.connected.feed is not None and not running and not room.lessons.running
        )
        self.choices.open.setEnabled(station and not running and not room.lessons.running)
        self.choices.suggest.setEnabled(room.desk.can_look_through and not room.looking)
        self.choices.undo.setEnabled(room.can_undo)
        self.choices.redo.setEnabled(room.can_redo)
        self.choices.weigh.setEnabled(bool(room.desk.order))
        self.choices.take_labels.setEnabled(bool(room.desk.fruit))
        self.choices.give_labels.setEnabled(any(one.kind is not None for one in room.desk.fruit.values()))
        if room.lessons.running:
            self.offer(self.choices.stop, self.choices.suggest)
        else:
            main = self._most_likely(missing)
            to_sensors = (self.way_to(Step.CONNECT),) if station and session.connected.feed is None else ()
            offered = (*to_sensors, self.choices.suggest, self.choices.open, self.choices.watch)
            self.offer(main, *(one for one in offered if one is not main))
        first = "" if missing is None else reason_text(missing)
        connected = session.connected.feed is not None
        self.say(advice(room.desk, self._shelf, first=first, running=running, connected=connected))

    def _missing(self) -> StepState | None:
        """Return what is to be finished before fruit can come in; None where nothing is."""
        states = self._session.states()
        if states[Step.TEACH].state is State.TO_DO:
            return at_root(Step.TEACH, states)
        return at_root(Step.BELT, states) if self._session.station is None else None

    def _most_likely(self, missing: StepState | None) -> QAction:
        """Return what the person most likely wants to do next, beside naming fruit."""
        desk = self.room.desk
        if desk.done:
            return self.way_to(Step.TRAIN)
        if self.choices.suggest.isEnabled() and desk.keys(Shelf()):
            return self.choices.suggest
        if self._session.running.running:
            return self.way_to(Step.LIVE)
        if missing is not None:
            return self.way_to(next(iter(ways_on(missing)), Step.CALIBRATE))
        return self.choices.watch if self.choices.watch.isEnabled() else self.choices.open

    # what is done

    def _give_by_key(self, key: str) -> None:
        line = next((line for line in self.room.desk.lines() if line.key == key), None)
        if line is not None:
            self._give(line.kind)

    def _give(self, kind: str) -> None:
        chosen = self.grid.chosen()
        if chosen:
            self.room.name(chosen, kind)
            self.grid.setFocus()
        else:
            self._session.messages.info(lambda: Told(self.tr("Choose a fruit first; then a key gives it its kind.")))

    def _look_at(self, shelf: Shelf) -> None:
        self._shelf = shelf
        self.shelves.show_shelf(shelf)
        self._show()
        if self.model.keys:
            self.grid.choose_row(0)
        self.grid.setFocus()

    def _want(self, key: int) -> None:
        """Show a fruit that another screen speaks of."""
        self._wanted = key
        self._show()

    def _jump(self) -> None:
        """Choose the fruit that is wanted, once it is on the desk."""
        key, fruit = self._wanted, self.room.desk.fruit
        if key is None or key not in fruit:
            return
        self._wanted = None
        self._shelf = Shelf() if fruit[key].kind is None else Shelf(Pile.NAMED, fruit[key].kind)
        self.shelves.show_shelf(self._shelf)
        self.grid.show_keys(self.room.desk.keys(self._shelf))
        self.grid.choose_row(max(self.model.row(key), 0))

    def _clear(self) -> None:
        self.room.clear(self.grid.chosen())

    def _remove(self) -> None:
        self._asking.remove(self.grid.chosen())

    def _resize(self, by: int) -> None:
        self.shelves.scale.setValue(self.shelves.scale.value() + by)

    def _densities(self) -> dict[str, float]:
        """Return the density of each kind, g/ml: typed, else by its reference fruit."""
        return {**self.room.desk.densities(), **self._session.kinds.densities_g_ml}

    def _ask_densities(self) -> None:
        self._asking.densities(self.room.desk.lines(), self._tiles.marks, self._session.kinds)
