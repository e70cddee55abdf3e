"""The teaching screen."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QAction, QKeySequence, QShortcut
from PySide6.QtWidgets import QFileDialog, QHBoxLayout, QInputDialog, QMessageBox, QStackedLayout, QVBoxLayout, QWidget

from fruitgui.gui.queries import Queries
from fruitgui.gui.session import Session
from fruitgui.gui.steps.page import StepPage
from fruitgui.gui.steps.teach.classroom import Classroom
from fruitgui.gui.steps.teach.densities import DensitiesDialog
from fruitgui.gui.steps.teach.desk import Pile, Shelf
from fruitgui.gui.steps.teach.fruit_model import FruitModel
from fruitgui.gui.steps.teach.grid import FruitGrid
from fruitgui.gui.steps.teach.kind_keys import KindKeys
from fruitgui.gui.steps.teach.shelves import Shelves
from fruitgui.gui.steps.teach.side_panel import SidePanel
from fruitgui.gui.steps.teach.tile import Tiles
from fruitgui.gui.theme.kinds import UNKNOWN
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.view_pictures import ViewPictures, view_pictures
from fruitgui.gui.widgets.cards import EmptyPlace
from fruitgui.measurement.fruit import Size
from fruitgui.station.workflow import Step

SIZE_STEP = 32
Seen = tuple[int, tuple[ViewPictures, ...], Size]


class TeachPage(StepPage):
    """Fruit come in, a person says what they are."""

    def __init__(self, session: Session, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.room = Classroom(session, self)
        self._tiles = Tiles(self.room.desk, session.looks)
        self._seen = Queries(self)
        self._panel_key: int | None = None
        self._shelf = Shelf()
        self._wanted: int | None = None
        self._make_actions()
        self.model = FruitModel(session.store.crops, self._tiles.described, self)
        self.kinds, self.grid = KindKeys(theme), FruitGrid(self.model, self._tiles, theme)
        tools = (self.undo, self.redo, self.see_depth, self.clear, self.remove, self.weigh, self.take_labels,
                 self.give_labels)  # fmt: skip
        self.shelves = Shelves(theme, tools)
        self.shelves.addActions(tools)
        self.panel, self.empty = SidePanel(theme), EmptyPlace(theme, "teach")
        self._lay_out()
        self._say_words()
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
            self._say_words()
            self._show()
        super().changeEvent(event)

    def _make_actions(self) -> None:
        self.watch, self.open, self.stop = self._action("eye"), self._action("folder"), self._action("stop")
        self.suggest, self.train = self._action("search"), self._action("train")
        self.undo, self.redo, self.clear = self._action("undo"), self._action("redo"), self._action("close")
        self.remove, self.see_depth = self._action("delete"), self._action("layers")
        self.take_labels, self.give_labels = self._action("import"), self._action("export")
        self.weigh = self._action("scale")
        self.see_depth.setCheckable(True)

    def _action(self, icon: str) -> QAction:
        action = QAction(self)
        action.setProperty("drawing", icon)
        return action

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
        session.station_changed.connect(self._show_actions)
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
        self.watch.triggered.connect(room.watch)
        self.open.triggered.connect(self._ask_for_recording)
        self.stop.triggered.connect(room.stop_lesson)
        self.suggest.triggered.connect(room.look_through)
        self.train.triggered.connect(partial(self.step_wanted.emit, Step.TRAIN))
        self.undo.triggered.connect(room.undo)
        self.redo.triggered.connect(room.redo)
        self.clear.triggered.connect(self._clear)
        self.remove.triggered.connect(self._ask_to_remove)
        self.weigh.triggered.connect(self._ask_densities)
        session.kinds.changed.connect(self._show_chosen)
        self.see_depth.toggled.connect(self.grid.show_depth)
        self.take_labels.triggered.connect(self._ask_for_labels)
        self.give_labels.triggered.connect(self._ask_where_to_export)
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
        for field in (self.panel.volume, self.panel.mass, self.kinds.new):
            field.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        """Go back to the fruit with Escape, or once a measure is entered, so that keys name fruit again."""
        if event.type() == QEvent.Type.KeyPress:
            key = event.key()  # type: ignore[attr-defined]
            enter = key in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and watched is self.panel.mass
            if key == Qt.Key.Key_Escape or enter:
                self.grid.setFocus()
                return True
            if key in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and watched is self.panel.volume:
                self.panel.mass.setFocus()
                return True
        return super().eventFilter(watched, event)

    def _say_words(self) -> None:
        for action, text, tip, key in (
            (self.watch, self.tr("Watch the line"), self.tr("Let fruit pass; nothing is counted"), "Ctrl+L"),
            (self.open, self.tr("Open a recording"), self.tr("Let the fruit of a recording come in"), "Ctrl+O"),
            (self.stop, self.tr("Enough"), self.tr("Stop watching; the fruit that came in stay"), "Ctrl+Return"),
            (self.suggest, self.tr("Suggest"), self.tr("Learn from what is named so far: suggest kinds, put first what "
             "would teach most, find likely mistakes"), "Ctrl+F"),
            (self.train, self.tr("Train"), self.tr("Go on to training"), "Ctrl+Return"),
            (self.undo, self.tr("Undo"), "", "Ctrl+Z"),
            (self.redo, self.tr("Do again"), "", "Ctrl+Y"),
            (self.see_depth, self.tr("Show depth"), "", "D"),
            (self.clear, self.tr("Let it wait: no kind"), "", "Backspace"),
            (self.remove, self.tr("Remove for good"), "", "Del"),
            (self.weigh, self.tr("Density of each kind"), "", "Ctrl+D"),
            (self.take_labels, self.tr("Read a labels file"), "", "Ctrl+Shift+O"),
            (self.give_labels, self.tr("Write a labels file"), "", "Ctrl+Shift+S"),
        ):  # fmt: skip
            action.setText(text)
            action.setToolTip(tip or text)
            action.setShortcut(QKeySequence(key))

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
            self.empty.show_words(*self._nothing())
        self._show_chosen()
        self._show_actions()

    def _nothing(self) -> tuple[str, str]:
        if self._shelf.pile is Pile.NAMED:
            return self.tr("Nothing is named yet"), self.tr("Fruit that were given a kind can be looked over here.")
        if self._shelf.pile is Pile.DOUBTFUL:
            return self._no_doubts()
        if self.room.in_lesson:
            return self.tr("Fruit will appear here"), self.tr("Each one comes in once it has left the belt.")
        if self.room.desk.fruit:
            return self.tr("Every fruit has a kind"), self.tr("Let more fruit pass, or go on to training.")
        return (
            self.tr("No fruit yet"),
            self.tr("Watch the line while fruit of each kind pass, or open a recording; each fruit appears here with "
                    "its picture, and a key says what it is."),
        )  # fmt: skip

    def _no_doubts(self) -> tuple[str, str]:
        if self.room.desk.insight.guesses or self.room.desk.insight.mistakes:
            return self.tr("No likely mistakes"), self.tr("A model that never saw them agrees with every kind given.")
        return (
            self.tr("Nobody looked for mistakes yet"),
            self.tr("Press “Suggest” once some fruit of two kinds are named: each is then judged by a model that "
                    "never saw it."),
        )  # fmt: skip

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
                self._seen.ask("fruit", partial(_look, self._session, key), self._show_views)
        for action in (self.clear, self.remove):
            action.setEnabled(bool(chosen))

    def _show_views(self, seen: Seen | None) -> None:
        if seen is not None:
            self.panel.show_views(*seen)

    def _show_touched(self, keys: list[int]) -> None:
        """Bring back into view what undoing changed."""
        rows = [row for row in map(self.model.row, keys) if row >= 0]
        if rows:
            self.grid.choose_row(min(rows))

    def _show_actions(self) -> None:
        room, session = self.room, self._session
        station = session.station is not None
        running = session.running.running
        self.watch.setEnabled(station and session.connected.feed is not None and not running and not room.in_lesson)
        self.open.setEnabled(station and not running and not room.in_lesson)
        self.suggest.setEnabled(room.desk.can_look_through and not room.looking)
        self.undo.setEnabled(room.can_undo)
        self.redo.setEnabled(room.can_redo)
        self.weigh.setEnabled(bool(room.desk.order))
        self.take_labels.setEnabled(bool(room.desk.fruit))
        self.give_labels.setEnabled(any(one.kind is not None for one in room.desk.fruit.values()))
        if room.in_lesson:
            self.offer(self.stop, self.suggest)
        else:
            main = self._most_likely()
            self.offer(main, *(one for one in (self.suggest, self.open, self.watch) if one is not main))
        self.say(self._advice())

    def _most_likely(self) -> QAction:
        """Return what the person most likely wants to do next, beside naming fruit."""
        desk = self.room.desk
        if desk.done:
            return self.train
        if self.suggest.isEnabled() and desk.keys(Shelf()):
            return self.suggest
        return self.watch if self.watch.isEnabled() else self.open

    def _advice(self) -> str:
        room, session = self.room, self._session
        if session.station is None:
            return self.tr("Calibrate the sensors first; then fruit can come in.")
        if session.running.running:
            return self.tr("A lot is running; fruit can be named meanwhile, but none come in until it is ended.")
        waiting = len(room.desk.keys(Shelf()))
        if self._shelf.pile is Pile.DOUBTFUL and room.desk.keys(self._shelf):
            return self.tr("Look closely: a key keeps or changes the kind.")
        if waiting and not room.desk.order:
            return self.tr("Type the name of the first kind at the top; the chosen fruit get it.")
        if waiting:
            return self.tr("Press the key of a kind, and go on to the next fruit.")
        if room.desk.done:
            return self.tr("Enough is taught; go on to training.")
        return self.tr("Let fruit of every kind come in.")

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
            self._session.messages.info(self.tr("Choose a fruit first; then a key gives it its kind."))

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

    def _resize(self, by: int) -> None:
        self.shelves.scale.setValue(self.shelves.scale.value() + by)

    def _ask_to_remove(self) -> None:
        chosen = self.grid.chosen()
        box = QMessageBox(QMessageBox.Icon.Question, self.tr("Remove for good"),
                          self.tr("Remove {count} fruit with their pictures? This cannot be undone.").format(
                              count=len(chosen)), parent=self)  # fmt: skip
        keep = box.addButton(self.tr("Keep"), QMessageBox.ButtonRole.RejectRole)
        remove = box.addButton(self.tr("Remove"), QMessageBox.ButtonRole.DestructiveRole)
        remove.clicked.connect(partial(self.room.remove, chosen))
        box.setDefaultButton(keep)
        box.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        box.open()

    def _densities(self) -> dict[str, float]:
        """Return the density of each kind, g/ml: typed, else by its reference fruit."""
        return {**self.room.desk.densities(), **self._session.kinds.densities_g_ml}

    def _ask_densities(self) -> None:
        lines = [line for line in self.room.desk.lines() if line.kind != UNKNOWN]
        dialog = DensitiesDialog(lines, self._tiles.marks, self._session.kinds.densities_g_ml, self)
        dialog.accepted.connect(partial(self._type_densities, dialog))
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.open()

    def _type_densities(self, dialog: DensitiesDialog) -> None:
        self._session.kinds.type_densities(dialog.typed)

    def _ask_for_recording(self) -> None:
        kinds = self.tr("Recordings (*.mcap *.bag);;All files (*)")
        path, _ = QFileDialog.getOpenFileName(self, self.tr("Choose a recording"), "", kinds)
        if path:
            self.room.open(Path(path))

    def _ask_for_labels(self) -> None:
        source = self._ask_source(self.room.sources(named=False), self.tr("For which fruit are the labels?"))
        if source:
            path, _ = QFileDialog.getOpenFileName(self, self.tr("Choose a labels file"), "", self.tr("Labels (*.csv)"))
            if path:
                self.room.import_labels(source, Path(path))

    def _ask_where_to_export(self) -> None:
        source = self._ask_source(self.room.sources(named=True), self.tr("The labels of which fruit?"))
        if source:
            name = f"{Path(source).stem.replace(':', '.')}.csv"
            path, _ = QFileDialog.getSaveFileName(self, self.tr("Write labels"), name, self.tr("Labels (*.csv)"))
            if path:
                self.room.export(source, Path(path))

    def _ask_source(self, sources: list[str], question: str) -> str:
        """Return the one source, or the one that a person chooses among several; empty for none."""
        if len(sources) < 2:
            return sources[0] if sources else ""
        chosen, good = QInputDialog.getItem(self, self.tr("Labels"), question, sources, 0, False)
        return chosen if good else ""


def _look(session: Session, key: int) -> Seen:
    """Return all views of a fruit with its size; any thread may call."""
    views = view_pictures(session.store.crops.of("taught", key))
    return key, views, session.store.teaching.get(key).fruit.size
