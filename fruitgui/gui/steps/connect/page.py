"""The screen on which sensors are connected."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from PySide6.QtCore import QEvent, QTimer
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QFileDialog, QHBoxLayout, QSizePolicy, QStackedWidget, QVBoxLayout, QWidget

from fruitgui.gui.session import Session
from fruitgui.gui.steps.connect.advice import SensorsNow, chooser_advice, sensors_advice
from fruitgui.gui.steps.connect.changes import SensorChanges
from fruitgui.gui.steps.connect.checkup_desk import CheckupDesk
from fruitgui.gui.steps.connect.chooser import SourceChooser
from fruitgui.gui.steps.connect.depth.wizard import DepthWizard
from fruitgui.gui.steps.connect.details import SensorDetails
from fruitgui.gui.steps.connect.presenter import SensorView, sensor_views, summary, while_tried, with_steadiness
from fruitgui.gui.steps.connect.projectors.desk import ProjectorDesk
from fruitgui.gui.steps.connect.record_desk import RecordDesk
from fruitgui.gui.steps.connect.tiles import SensorTiles
from fruitgui.gui.steps.connect.turn_card import TurnCard
from fruitgui.gui.steps.page import StepPage
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.scrolled import Scrolled
from fruitgui.sensors.feed import Running
from fruitgui.station.workflow import State, Step, opening_step

SIDE_WIDTH = 336
LOOK_MS = 500
"""How often devices that were plugged in meanwhile are looked for, while the list is in view."""


class ConnectPage(StepPage):
    """Either the list of what can be connected, or the sensors that are."""

    def __init__(self, session: Session, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session, self._theme = session, theme
        self._chosen = ""
        self._choosing = session.connection is None
        self._in_view = False
        self._stack = QStackedWidget(self)
        self._running = QWidget(self._stack)
        self.chooser, self.tiles = SourceChooser(theme, self._stack), SensorTiles(theme, self._running)
        self.details, self.turns = SensorDetails(theme, self._running), TurnCard(theme, self._running)
        self.changes = SensorChanges(session, self.details, lambda: self._chosen, self._note_chosen)
        self.recording = RecordDesk(session, theme, self)
        self.projectors = ProjectorDesk(session, theme, self)
        self.checkup = CheckupDesk(session, theme, self)
        self._wizard: DepthWizard | None = None
        self._look = QTimer(self, interval=LOOK_MS)
        self.connect_action, self.start_action, self.calibrate_action = QAction(self), QAction(self), QAction(self)
        self.change_action, self.back_action, self.check_action = QAction(self), QAction(self), QAction(self)
        self._lay_out()
        self._say_words()
        self._connect()
        self._show()

    @property
    def depth_wizard(self) -> DepthWizard:
        """Measures how a sensor's depth errs; made when it is first asked for."""
        if self._wizard is None:
            self._wizard = DepthWizard(self._session, self._theme, self._stack)
            self._wizard.changed.connect(self._show_actions)
            self._wizard.left_it.connect(self._show)
            self._stack.addWidget(self._wizard)
        return self._wizard

    @property
    def _measuring(self) -> bool:
        return self._wizard is not None and self._wizard.course is not None

    def complete(self) -> None:
        """Make what measures depth."""
        _ = self.depth_wizard

    def entered(self) -> None:
        """Draw and look for devices."""
        self._in_view = True
        if self._measuring:
            self.depth_wizard.wake()
        self._show()

    def left(self) -> None:
        """Rest."""
        self._in_view = False
        self.tiles.run(False)
        self._look.stop()
        if self._measuring:
            self.depth_wizard.rest()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Take over another language."""
        if event.type() == QEvent.Type.LanguageChange:
            self._say_words()
            self._show()
        super().changeEvent(event)

    def _lay_out(self) -> None:
        side = QWidget(self._running)
        column = QVBoxLayout(side)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2 * GRID)
        for card in (self.recording.card, self.details, self.turns):
            card.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Preferred)
            column.addWidget(card)
        column.addStretch(1)
        scroll = Scrolled(side, self._running)
        scroll.setFixedWidth(SIDE_WIDTH)
        row = QHBoxLayout(self._running)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(2 * GRID)
        row.addWidget(self.tiles, 1)
        row.addWidget(scroll)
        self._stack.addWidget(self.chooser)
        self._stack.addWidget(self._running)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(2 * GRID, 2 * GRID, 2 * GRID, 2 * GRID)
        whole.addWidget(self._stack)

    def _connect(self) -> None:
        session = self._session
        for changed in (
            session.connection_changed, session.station_changed, session.projectors_changed, session.connected.changed,
            session.source.changed, session.running.changed,
        ):  # fmt: skip
            changed.connect(self._show)
        session.connected.health_changed.connect(self._show_health)
        session.source.opened.connect(self._show_connected)
        self.recording.follow(self._show)
        self.chooser.changed.connect(self._show_actions)
        self.chooser.file_wanted.connect(self._ask_for_file)
        self.tiles.chosen.connect(self._choose)
        self.details.identify.connect(self._identify)
        self.details.correct_depth.connect(self._correct_depth)
        self.turns.measure.clicked.connect(self.projectors.ask)
        self._look.timeout.connect(self._look_for_devices)
        self.connect_action.triggered.connect(self._connect_source)
        self.change_action.triggered.connect(self._change_source)
        self.back_action.triggered.connect(self._show_connected)
        self.start_action.triggered.connect(session.start_sensors)
        self.calibrate_action.triggered.connect(partial(self.step_wanted.emit, Step.CALIBRATE))
        self.check_action.triggered.connect(self.checkup.ask)

    def _say_words(self) -> None:
        for action, text, tip, icon, key in (
            (self.connect_action, self.tr("Connect"), self.tr("Connect the sensors of this source"), "connect",
             "Ctrl+Return"),
            (self.calibrate_action, self.tr("Calibrate"), self.tr("Go on to calibrating"), "calibrate", "Ctrl+Return"),
            (self.change_action, self.tr("Other source…"), self.tr("Connect something else"), "connect", "Ctrl+N"),
            (self.start_action, self.tr("Start again"), self.tr("Start the sensors of this source again"), "redo",
             "Ctrl+Return"),
            (self.back_action, self.tr("Back"), self.tr("Stay with the sensors that are connected"), "left",
             "Ctrl+Backspace"),
            (self.check_action, self.tr("Check sensors…"), self.tr("See what is connected and what is wrong"), "search",
             "Ctrl+U"),
        ):  # fmt: skip
            action.setText(text)
            action.setToolTip(tip)
            action.setProperty("drawing", icon)
            action.setShortcut(key)

    # what is shown

    def views(self) -> tuple[SensorView, ...]:
        """Return the sensors as they are shown."""
        connected = self._session.connected
        infos = {} if connected.feed is None else connected.feed.infos
        connection, opening = self._session.connection, self._session.source.opening
        kind = "" if connection is None else str(connection.source.get("kind", ""))
        views = sensor_views(connection, infos, connected.health, opening=opening)
        views = with_steadiness(views, kind, self._session.steadiness.of, self._session.depths)
        return while_tried(views, connected.health) if self.projectors.trying else views

    def _show(self) -> None:
        choosing = self._choosing or self._session.connection is None
        if choosing:
            if not self.chooser.rows:
                self._session.source.found.ask()
                self.chooser.show_found(self._session.source.found.found)
            self.chooser.show_made(self.recording.made())
            if self._measuring:
                self.depth_wizard.end()
        measuring = self._measuring
        self._stack.setCurrentIndex(0 if choosing else 2 if measuring else 1)
        self.tiles.run(self._in_view and not choosing and not measuring)
        (self._look.start if self._in_view and choosing else self._look.stop)()
        if not choosing:
            self._show_sensors()
        self._show_actions()

    def _show_health(self) -> None:
        """Show how the sensors are, twice a second, where somebody looks."""
        if self._in_view:
            self._show()

    def _show_sensors(self) -> None:
        views, feed = self.views(), self._session.connected.feed
        names = tuple(view.name for view in views)
        if self._chosen not in names:
            self._chosen = names[0]
        self.tiles.show_feed(feed)
        self.tiles.show_views(views, self._chosen)
        chosen = next(view for view in views if view.name == self._chosen)
        others = tuple(name for name in names if name != self._chosen)
        busy = self._session.running.running or self.recording.recording
        self.details.show_view(chosen, others, fixed=busy)
        self.turns.show_plan(self.projectors.plan(), () if feed is None else feed.sensors, free=not busy)

    def _show_actions(self) -> None:
        opening = self._session.source.opening
        self.check_action.setEnabled(not opening)
        if self._choosing or self._session.connection is None:
            self.connect_action.setEnabled(self.chooser.source is not None and not opening)
            back = () if self._session.connection is None else (self.back_action,)
            self.offer(self.connect_action, self.check_action, *back)
            self.say(chooser_advice(chosen=self.chooser.source is not None))
            return
        if self._measuring:
            self.offer(*self.depth_wizard.actions_now)
            self.say(self.depth_wizard.hint)
            return
        now = self._now()
        self.calibrate_action.setEnabled(now.running == now.count)
        free = not opening and not self.recording.recording
        self.change_action.setEnabled(free and not now.counting)
        self.recording.action.setEnabled(free and now.running > 0)
        self.offer(self._most_likely(now), self.check_action, self.change_action, self.recording.action)
        self.say(sensors_advice(now))

    def _now(self) -> SensorsNow:
        """Return what goes on with the sensors."""
        session, health = self._session, self._session.connected.health
        return SensorsNow(
            *summary(self.views()),
            opening=session.source.opening,
            failure=session.source.failure,
            still=session.connected.feed is None,
            over=bool(health) and all(one.state is Running.ENDED for one in health.values()),
            counting=session.running.running,
            recording=self.recording.recording,
            trying=self.projectors.trying,
            calibrated=session.states()[Step.CALIBRATE].state is State.DONE,
        )

    def _most_likely(self, now: SensorsNow) -> QAction:
        """Return what the person most likely wants to do next."""
        if now.counting:
            return self.way_to(Step.LIVE)
        if now.stopped:
            return self.start_action
        if now.calibrated and now.running == now.count:
            return self.way_to(opening_step(self._session.states()))
        return self.calibrate_action

    # what is done

    def _look_for_devices(self) -> None:
        self.chooser.update_found(self._session.source.found.found)
        self.chooser.show_made(self.recording.made())
        self._session.source.found.ask()

    def _ask_for_file(self) -> None:
        path, _ = QFileDialog.getOpenFileName(
            self, self.tr("Choose a recording"), "", self.tr("Recordings (*.mcap *.bag);;All files (*)")
        )
        if path:
            self.chooser.take_file(Path(path))

    def _connect_source(self) -> None:
        source = self.chooser.source
        if source is not None:
            self._session.source.choose(source)

    def _change_source(self) -> None:
        self._choosing = True
        self._look_for_devices()
        self._show()

    def _show_connected(self) -> None:
        self._choosing = False
        self._show()

    def _choose(self, name: str) -> None:
        self._note_chosen(name)
        self._show()

    def _note_chosen(self, name: str) -> None:
        self._chosen = name

    def _identify(self) -> None:
        self.tiles.flash(self._chosen)

    def _correct_depth(self) -> None:
        self.depth_wizard.begin(self._chosen)
        self._show()
