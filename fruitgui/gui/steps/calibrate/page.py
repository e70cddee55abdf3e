"""The screen on which the sensors find each other and the belt."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QEvent
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QStackedWidget, QVBoxLayout, QWidget

from fruitgui.gui.messages import Level, Message
from fruitgui.gui.session import Session
from fruitgui.gui.steps.calibrate.advice import prepare_advice
from fruitgui.gui.steps.calibrate.core_words import in_words
from fruitgui.gui.steps.calibrate.outlook_look import OutlookLook
from fruitgui.gui.steps.calibrate.prepare_panel import PreparePanel
from fruitgui.gui.steps.calibrate.prospect import prospect_of
from fruitgui.gui.steps.calibrate.reasons import told
from fruitgui.gui.steps.calibrate.refused_panel import RefusedPanel
from fruitgui.gui.steps.calibrate.result_panel import ResultPanel
from fruitgui.gui.steps.calibrate.verdict import outcome_graph, station_graph, verdict_of, verdict_of_station
from fruitgui.gui.steps.calibrate.work import Calibrated, calibrating, drawing
from fruitgui.gui.steps.page import StepPage
from fruitgui.gui.tasks import Task
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.told import Told
from fruitgui.gui.widgets.cards import EmptyPlace
from fruitgui.sensors.feed import Feed, Running
from fruitgui.station.fused_cloud import SensorCloud
from fruitgui.station.workflow import State, Step


class CalibratePage(StepPage):
    """Prepare, calibrate, look, keep or discard."""

    def __init__(self, session: Session, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._result: Calibrated | None = None
        self._again = False
        self._in_view = False
        self._task: Task[Calibrated] | None = None
        self._drawing: Task[tuple[SensorCloud, ...]] | None = None
        self._drawn_for: object = None
        self.nothing = EmptyPlace(theme, "connect")
        self.prepare, self.result = PreparePanel(session, theme), ResultPanel(theme)
        self.refused = RefusedPanel(theme)
        self._stack = QStackedWidget()
        self.outlook = OutlookLook(self)
        self.calibrate_action, self.keep_action = QAction(self), QAction(self)
        self.discard_action, self.again_action = QAction(self), QAction(self)
        self.back_action = QAction(self)
        self._lay_out()
        self._say_words()
        self._connect()
        self._show()

    def entered(self) -> None:
        """Look at the sensors."""
        self._in_view = True
        self.prepare.switch.follow()
        self._show()

    def left(self) -> None:
        """Rest."""
        self._in_view = False
        self.outlook.end()
        self._again = False

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Take over another language."""
        if event.type() == QEvent.Type.LanguageChange:
            self._say_words()
            self._show()
        super().changeEvent(event)

    def _lay_out(self) -> None:
        for one in (self.nothing, self.prepare, self.result, self.refused):
            self._stack.addWidget(one)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(2 * GRID, 2 * GRID, 2 * GRID, 2 * GRID)
        whole.addWidget(self._stack)

    def _connect(self) -> None:
        session = self._session
        session.connected.changed.connect(self._feed_changed)
        session.connected.health_changed.connect(self._show_actions)
        session.station_changed.connect(self._show)
        session.connection_changed.connect(self._show)
        session.running.changed.connect(self._show_actions)
        self.outlook.looked.connect(self._show_prospect)
        self.calibrate_action.triggered.connect(self._calibrate)
        self.keep_action.triggered.connect(self._keep)
        self.discard_action.triggered.connect(self._discard)
        self.again_action.triggered.connect(self._begin_again)
        self.back_action.triggered.connect(self._go_back)

    def _say_words(self) -> None:
        for action, text, tip, icon, key in (
            (self.calibrate_action, self.tr("Calibrate"), self.tr("Let the sensors find each other"), "calibrate",
             "Ctrl+Return"),
            (self.keep_action, self.tr("Keep"), self.tr("Work with this calibration from now on"), "save",
             "Ctrl+Return"),
            (self.discard_action, self.tr("Discard"), self.tr("Stay with what was before"), "delete", "Ctrl+Backspace"),
            (self.again_action, self.tr("Calibrate again"), self.tr("Begin anew; the calibration in use stays until "
             "another is kept"), "redo", "Ctrl+N"),
            (self.back_action, self.tr("Back"), self.tr("Stay with what was before"), "left", "Ctrl+Backspace"),
        ):  # fmt: skip
            action.setText(text)
            action.setToolTip(tip)
            action.setProperty("drawing", icon)
            action.setShortcut(key)
        self.nothing.show_words(
            self.tr("No sensors run"),
            self.tr("Connect them first; then they find each other and the belt here, from fruit that lie on it."),
        )

    # what is shown

    def _calibrated(self) -> bool:
        return self._session.station is not None and self._session.states()[Step.CALIBRATE].state is State.DONE

    def _shown(self) -> QWidget:
        if self._result is not None:
            return self.result if self._result.outcome.accepted else self.refused
        if self._calibrated() and not self._again:
            return self.result
        return self.prepare if self._session.connected.feed is not None else self.nothing

    def _show(self) -> None:
        shown = self._shown()
        self._stack.setCurrentWidget(shown)
        if self._result is not None:
            self._show_outcome(self._result)
        elif shown is self.result:
            self._show_station()
        self._look(wanted=self._in_view and shown is self.prepare and self._task is None)
        if shown is self.prepare:
            self._show_prospect()
        self._show_actions()

    def _show_outcome(self, made: Calibrated) -> None:
        outcome = made.outcome
        nodes, links = outcome_graph(outcome, self._session.connection)
        if not outcome.accepted:
            self.refused.show_reasons(told(outcome.reasons, outcome.pairs, outcome.sensors), nodes, links)
            return
        warnings = [in_words(text) for text in outcome.warnings]
        self.result.show_verdict(verdict_of(outcome), nodes, links, warnings)
        if self._drawn_for is not made:
            self._drawn_for = made
            self.result.show_clouds(made.clouds, compared=True)

    def _show_station(self) -> None:
        station, feed = self._session.station, self._session.connected.feed
        if station is None:
            return
        self.result.show_verdict(verdict_of_station(station), *station_graph(station), [])
        if self._drawn_for is not station and self._drawing is None:
            self.result.show_clouds((), compared=False)
            if self._in_view and feed is not None:
                self._draw()

    def _show_prospect(self) -> None:
        connection, watch = self._session.connection, self.outlook.watch
        if connection is None:
            return
        names = [one.name for one in connection.sensors]
        seen = None if watch is None else watch.newest
        self.prepare.show_prospect(prospect_of(names, connection.reference_name, seen))

    def _show_actions(self) -> None:
        shown, busy = self._shown(), self._task is not None
        state = self._session.states()[Step.CALIBRATE]
        ready, running = self._ready(), self._session.running.running
        self.calibrate_action.setEnabled(ready and not busy)
        self.again_action.setEnabled(ready and not busy)
        if self._result is not None and self._result.outcome.accepted:
            self.offer(self.keep_action, self.again_action, self.discard_action)
            self.say(self.tr("Look at the cloud: where views overlap, nothing should appear twice. Then keep it."))
        elif self._result is not None:
            self.offer(self.calibrate_action, *self._ways_on(ready), self.back_action)
            changed = self.tr("Change what the pictures show, then calibrate once more.")
            self.say(changed if ready else prepare_advice(state, ready=ready, running=running))
        elif shown is self.result:
            self.offer(self.way_to(Step.BELT), self.again_action)
            self.say(self.tr("The sensors are calibrated."))
        elif shown is self.nothing:
            self.offer(self.way_to(Step.CONNECT))
            self.say(self.tr("Connect the sensors first."))
        else:
            back = (self.back_action,) if self._calibrated() else ()
            self.offer(self.calibrate_action, *self._ways_on(ready), *back)
            self.say(prepare_advice(state, ready=ready, running=running))

    def _ways_on(self, ready: bool) -> tuple[QAction, ...]:
        """Return where that is mended for which one cannot calibrate now."""
        if ready:
            return ()
        return (self.way_to(Step.LIVE if self._session.running.running else Step.CONNECT),)

    def _ready(self) -> bool:
        """Whether all of the connection's sensors give pictures, and no lot runs before them."""
        feed, connection = self._session.connected.feed, self._session.connection
        if feed is None or connection is None or self._session.running.running:
            return False
        return all(self._gives_pictures(feed, one.name) for one in connection.sensors)

    def _gives_pictures(self, feed: Feed, sensor: str) -> bool:
        """Tell whether a sensor gave pictures, and is not known to give none any more."""
        health = self._session.connected.health.get(sensor)
        over = health is not None and health.state in (Running.FAILED, Running.ENDED)
        return sensor in feed.infos and feed.newest(sensor) is not None and not over

    # what is done

    def _look(self, *, wanted: bool) -> None:
        feed = self._session.connected.feed
        if not wanted:
            self.outlook.end()
        elif feed is not None:
            self.outlook.begin(feed)

    def _feed_changed(self) -> None:
        self.outlook.end()
        self._drawn_for = None if self._result is None else self._drawn_for
        self._show()

    def _calibrate(self) -> None:
        feed, connection = self._session.connected.feed, self._session.connection
        if feed is None or connection is None or self._task is not None:
            return
        job = calibrating(feed, connection.reference_name, self._session.station, self._session.depths)
        self._task = self._session.tasks.run(lambda: self.tr("Calibrating"), job, in_words)
        self._task.succeeded.connect(self._take)
        self._task.failed.connect(self._session.messages.error)
        self._task.cancelled.connect(self._stopped)
        self._task.ended.connect(self._ended)
        self._show()

    def _take(self, made: Calibrated) -> None:
        self._result = made

    def _stopped(self) -> None:
        self._session.messages.info(lambda: Told(self.tr("Calibrating was stopped; nothing was changed.")))

    def _ended(self) -> None:
        self._task = None
        self._show()

    def _draw(self) -> None:
        feed, station = self._session.connected.feed, self._session.station
        if feed is not None and station is not None and set(feed.infos) <= set(station.sensors):
            self._drawn_for = station
            job = drawing(feed, station)
            self._drawing = self._session.tasks.run(lambda: self.tr("Looking at the belt"), job, in_words)
            self._drawing.succeeded.connect(self._show_drawn)
            self._drawing.ended.connect(self._drawn)

    def _show_drawn(self, clouds: tuple[SensorCloud, ...]) -> None:
        if self._result is None:
            self.result.show_clouds(clouds, compared=False)

    def _drawn(self) -> None:
        self._drawing = None

    def _keep(self) -> None:
        made = self._result
        if made is None or made.outcome.station is None:
            return
        had = self._session.station is not None
        self._result, self._again = None, False
        self._drawn_for = made.outcome.station
        self._session.save_station(made.outcome.station)
        self._show()

        def told() -> Told:
            return Told(self.tr("The calibration is kept."), action=self.tr("Undo") if had else "")

        said = Message(Level.GOOD, told, self._undo if had else None)
        self._session.when_saved(partial(self._session.messages.say, said))

    def _undo(self) -> None:
        self._drawn_for = None
        self._session.take_back_station()

    def _discard(self) -> None:
        self._result = None
        self._drawn_for = None
        self._show()

    def _begin_again(self) -> None:
        self._result, self._again = None, True
        self._drawn_for = None
        self._show()

    def _go_back(self) -> None:
        self._result, self._again = None, False
        self._show()
