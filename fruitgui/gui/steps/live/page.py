"""The live screen."""

from __future__ import annotations

import time

from PySide6.QtCore import QEvent, Qt, QTimer
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QStackedLayout, QVBoxLayout, QWidget

from fruitgui.gui.lot_words import LotWords
from fruitgui.gui.numbers import count_text
from fruitgui.gui.queries import Queries
from fruitgui.gui.running import Running
from fruitgui.gui.session import Session
from fruitgui.gui.step_words import reason_text
from fruitgui.gui.steps.live import presenter
from fruitgui.gui.steps.live.end_dialog import EndDialog
from fruitgui.gui.steps.live.layout import LiveLayout
from fruitgui.gui.steps.live.lot_dialog import LotDialog
from fruitgui.gui.steps.live.presenter import Marks
from fruitgui.gui.steps.page import StepPage
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.ways import at_root, ways_on
from fruitgui.gui.widgets.cards import EmptyPlace
from fruitgui.gui.widgets.sensor_picture import Overlays
from fruitgui.records.lot import Lot
from fruitgui.sensors.feed import Feed
from fruitgui.station.live.state import Preview
from fruitgui.station.workflow import State, Step

DRAW_MS = 40
"""In so long every picture is drawn, and one other part; each at its own moment, so that none holds up a key."""


class LivePage(StepPage):
    """Shows the line, and starts, pauses and ends lots."""

    def __init__(self, session: Session, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._running: Running = session.running
        self._marks = Marks(session.looks)
        self._drawn: dict[str, object] = {}
        self._turn = self._part = 0
        self._parts = (self._draw_belt, self._draw_counts, self._draw_belt, self._draw_last, self._draw_histogram)
        self._dialog: LotDialog | None = None
        self._question: EndDialog | None = None
        self._queries = Queries(self)
        self._queries.failed.connect(session.messages.error)
        self.body = LiveLayout(theme, self)
        self.empty = EmptyPlace(theme, "live", parent=self)
        self._make_actions()
        self._lay_out()
        self._draw = QTimer(self, interval=DRAW_MS)
        self._draw.timeout.connect(self._draw_next)
        self._running.changed.connect(self._follow)
        session.states_changed.connect(self._follow)
        self._say_words()
        self._follow()

    def entered(self) -> None:
        """Draw while in view."""
        self._draw.start()
        self._follow()

    def left(self) -> None:
        """Draw no more; the line goes on."""
        self._draw.stop()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Take over another language."""
        if event.type() == QEvent.Type.LanguageChange:
            self._say_words()
            self._follow()
            self._draw_pictures()
        super().changeEvent(event)

    def _make_actions(self) -> None:
        self.start, self.take_up = QAction(self), QAction(self)
        self.pause, self.resume, self.end = QAction(self), QAction(self), QAction(self)
        self.name = QAction(self)
        for action, name, key, does in (
            (self.start, "play", "Ctrl+Return", self._ask),
            (self.take_up, "play", "Ctrl+Return", self._take_up),
            (self.pause, "pause", "Ctrl+Space", self._running.pause),
            (self.resume, "play", "Ctrl+Space", self._running.resume),
            (self.end, "stop", "Ctrl+E", self._ask_end),
            (self.name, "teach", "N", self._name_unknown),
        ):
            action.setProperty("drawing", name)
            action.setShortcut(QKeySequence(key))
            action.setShortcutContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)
            action.triggered.connect(does)
        self.overlays = {name: QAction(self, checkable=True, checked=True) for name in Overlays.__dataclass_fields__}
        for number, action in enumerate(self.overlays.values(), start=1):
            action.setShortcut(QKeySequence(f"F{number + 4}"))
            action.setShortcutContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)
            action.toggled.connect(self._show_overlays)
            self.addAction(action)

    def _lay_out(self) -> None:
        self._stack = QStackedLayout()
        self._stack.addWidget(self.empty)
        self._stack.addWidget(self.body)
        column = QVBoxLayout(self)
        column.setContentsMargins(2 * GRID, 2 * GRID, 2 * GRID, 2 * GRID)
        column.addLayout(self._stack)
        self.body.show_overlay_actions(tuple(self.overlays.values()))

    def _say_words(self) -> None:
        self.start.setText(self.tr("Start lot"))
        self.take_up.setText(self.tr("Go on with the lot"))
        self.pause.setText(self.tr("Pause"))
        self.resume.setText(self.tr("Go on"))
        self.end.setText(self.tr("End lot"))
        self.end.setToolTip(self.tr("Stop the line, count what is in view, end the lot"))
        self.name.setToolTip(self.tr("Give the fruit that were set aside as unknown their kinds; the line goes on"))
        self._say_unnamed()
        for name, text in (
            ("outlines", self.tr("Outlines")),
            ("labels", self.tr("Labels")),
            ("ellipses", self.tr("± of places")),
            ("trails", self.tr("Trails")),
        ):
            self.overlays[name].setText(text)

    def _follow(self) -> None:
        """Show what can be done now."""
        state = at_root(Step.LIVE, self._session.states())
        ready = state.state is not State.TO_DO or self._running.running
        self._stack.setCurrentWidget(self.body if ready else self.empty)
        self.empty.show_words(self.tr("Nothing can be counted yet"), reason_text(state))
        lot, running = self._running.lot, self._running.running
        still = not running and self._session.connected.feed is None
        for action in (self.start, self.take_up):
            action.setEnabled(ready and not still)
        ways = tuple(map(self.way_to, ways_on(state)))
        if lot is not None and self._running.stopped:
            self.offer(self.end)
            self.say(self._left_open(lot))
        elif not ready and ways:
            self.offer(ways[0], *((self.end,) if lot is not None else ()))
            self.say(reason_text(state) if lot is None else f"{self._left_open(lot)} {reason_text(state)}")
        elif still:
            ends = (self.end,) if lot is not None else ()
            self.offer(self.start if lot is None else self.take_up, self.way_to(Step.CONNECT), *ends)
            opening, stopped = self.tr("The sensors are being started."), self.tr("No sensor runs: start them again.")
            self.say(opening if self._session.source.opening else stopped)
        elif lot is None:
            self.offer(self.start, *ways)
            self.say(" ".join(filter(None, (reason_text(state), self.tr("Start a lot to count fruit.")))))
        elif not running:
            self.offer(self.take_up, *ways, self.end)
            self.say(self._left_open(lot))
        elif lot.paused:
            self.offer(self.resume, self.name, self.end)
            self.say(self.tr("Lot {name} is paused: fruit pass uncounted.").format(name=lot.name))
        else:
            self.offer(self.end, self.name, self.pause)
            self.say(self.tr("Lot {name} is running.").format(name=lot.name))
        self._say_standing()
        self._show_sensors()
        self._draw_parts()

    def _left_open(self, lot: Lot) -> str:
        return self.tr("Lot {name} is still open; every fruit that was counted is kept.").format(name=lot.name)

    def _say_standing(self) -> None:
        """Say in large where a lot is open and nothing is counted."""
        lot, running = self._running.lot, self._running.running and not self._running.stopped
        if lot is None or (running and not lot.paused):
            self.body.standing.show_words("", "")
            return
        why = self.tr("Lot {name} is paused.") if running else self.tr("Lot {name} is open; the line stands still.")
        self.body.standing.show_words(self.tr("Nothing is counted"), why.format(name=lot.name))

    def _say_unnamed(self) -> None:
        count = self._running.unnamed
        self.name.setText(self.tr("Name unknown fruit: {count}").format(count=count_text(count)))
        self.name.setVisible(count > 0)

    def _name_unknown(self) -> None:
        self.step_wanted.emit(Step.TEACH)

    def _show_sensors(self) -> None:
        feed = self._session.connected.feed
        self.body.pictures.show_sensors(() if feed is None else feed.sensors)
        self._drawn = {}
        self._draw.setInterval(DRAW_MS // (len(self.body.pictures.pictures) + 1))
        self._show_overlays()

    def _show_overlays(self) -> None:
        chosen = Overlays(**{name: action.isChecked() for name, action in self.overlays.items()})
        for picture in self.body.pictures.pictures.values():
            picture.show_overlays(chosen)

    def _draw_next(self) -> None:
        """Draw the next sensor's picture, or after the last the next part; old pictures give their turn away."""
        feed, names = self._session.connected.feed, list(self.body.pictures.pictures)
        self._turn = (self._turn + 1) % (len(names) + 1)
        if self._turn < len(names) and feed is not None:
            any(self._draw_picture(feed, sensor) for sensor in (*names[self._turn :], *names[: self._turn]))
        elif self._running.running:
            self._part = (self._part + 1) % len(self._parts)
            self._parts[self._part]()

    def _draw_pictures(self) -> None:
        """Draw all pictures at once."""
        feed = self._session.connected.feed
        if feed is not None:
            for sensor in self.body.pictures.pictures:
                self._draw_picture(feed, sensor)

    def _draw_picture(self, feed: Feed, sensor: str) -> bool:
        """Draw a sensor's newest picture, with what the line saw in it where it runs; return whether it is new."""
        preview = self._running.previews.get(sensor) or plain_preview(feed, sensor)
        well = self._session.connected.health.get(sensor)
        if preview is None or self._drawn.get(sensor) == (preview.sequence, preview.fruit, well):
            return False
        self._drawn[sensor] = (preview.sequence, preview.fruit, well)
        self.body.pictures.pictures[sensor].show_picture(presenter.drawn_picture(preview, self._marks, well))
        return True

    def _draw_parts(self) -> None:
        """Draw everything but the pictures, at once."""
        for part in dict.fromkeys(self._parts):
            part()

    def _draw_counts(self) -> None:
        tally, kinds = self._running.tally, self._running.kinds
        for kind in kinds:
            self._marks.of(kind)
        self.body.show_counts(presenter.kind_lines(tally, kinds, self._marks, time.monotonic()))
        if self._question is not None:
            self._question.show_fruit(tally.count_all)
        self._say_unnamed()

    def _draw_belt(self) -> None:
        state = self._running.state
        if state is not None:
            self.body.belt.show_map(presenter.belt_map(state, self._marks))

    def _draw_last(self) -> None:
        state = self._running.state
        if state is not None:
            self.body.last.show_fruit(presenter.last_fruit(state.last, self._marks))

    def _draw_histogram(self) -> None:
        histogram = self._running.tally.histogram()
        low, high = (0.0, 1.0) if histogram is None else (histogram.low_ml, histogram.high_ml)
        self.body.histogram.show_bars(presenter.bars(histogram, self._marks), low, high)

    def _ask(self) -> None:
        """Ask for the lot's name, once what to propose is read."""
        if self._dialog is None and not self._running.busy:
            self._queries.ask("words", self._session.lot_words, self._open_dialog)

    def _open_dialog(self, words: LotWords) -> None:
        self._dialog = LotDialog(words.name, words.growers, words.recipes, self)
        self._dialog.finished.connect(self._asked)
        self._dialog.open()

    def _asked(self, result: int) -> None:
        dialog, self._dialog = self._dialog, None
        if dialog is None:
            return
        if result == LotDialog.DialogCode.Accepted:
            self._session.start_lot(dialog.plan())
        dialog.deleteLater()

    def _ask_end(self) -> None:
        """Ask whether the lot shall end: what is ended cannot be taken up again."""
        lot = self._running.lot
        if lot is not None and self._question is None and not self._running.busy:
            self._question = EndDialog(lot, self._running.tally.count_all, running=self._running.running, parent=self)
            self._question.finished.connect(self._asked_end)
            self._question.open()

    def _asked_end(self, result: int) -> None:
        question, self._question = self._question, None
        if question is None:
            return
        question.deleteLater()
        if result == EndDialog.DialogCode.Accepted:
            self._running.end_lot()

    def _take_up(self) -> None:
        self._session.take_up_lot()


def plain_preview(feed: Feed, sensor: str) -> Preview | None:
    """Return a sensor's newest picture as it is, for when no line runs."""
    frame = feed.newest(sensor)
    if frame is None:
        return None
    return Preview(sensor, sensor, frame.sequence, frame.time_s, frame.color, (), 0.0)
