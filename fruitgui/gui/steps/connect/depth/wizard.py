"""Leads a person through correcting one sensor's depth; what comes of it is kept only when they say so."""

from __future__ import annotations

from datetime import datetime

from PySide6.QtCore import QEvent, QTimer, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QStackedWidget, QVBoxLayout, QWidget

from fruitgui.calibration.warmup import Warmth
from fruitgui.gui.session import Session
from fruitgui.gui.steps.connect.depth.actions import WizardActions
from fruitgui.gui.steps.connect.depth.course import Course, Stage, Typed
from fruitgui.gui.steps.connect.depth.keeping import corrected, keep_depth
from fruitgui.gui.steps.connect.depth.panel import MeasurePanel
from fruitgui.gui.steps.connect.depth.result_view import ResultView
from fruitgui.gui.steps.connect.depth.work import Taken, Worked, taking, taking_words, working_out, working_words
from fruitgui.gui.tasks import Task
from fruitgui.gui.theme.theme import Theme
from fruitgui.simulation.show import SHOWN_BALL_M, SHOWN_BOARD_M, SHOWN_RAISE_M, Showing
from fruitgui.station.depth_watch import Aim, DepthWatch
from fruitgui.station.depths import DeviceDepth, device_depth

DRAW_MS = 100
SHOWN = {
    Stage.BELT: Showing.EMPTY,
    Stage.BOARD: Showing.BOARD,
    Stage.BALL: Showing.BALL,
    Stage.RAISED: Showing.RAISED,
}


class DepthWizard(QWidget):
    """Belt, box, ball, belt from higher, result; at home in the screen where sensors are connected.

    Attributes:
        changed: other actions or another hint are to be shown.
        left_it: the person goes back to the sensors.
    """

    changed = Signal()
    left_it = Signal()

    def __init__(self, session: Session, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._course: Course | None = None
        self._watch: DepthWatch | None = None
        self._task: Task[Taken] | Task[Worked] | None = None
        self._showing: Showing | None = None
        self._ready = False
        self._stack = QStackedWidget(self)
        self.panel, self.result = MeasurePanel(theme, self._stack), ResultView(theme, self._stack)
        self._draw = QTimer(self, interval=DRAW_MS)
        self.choices = WizardActions(self)
        self._lay_out()
        self._connect()

    @property
    def course(self) -> Course | None:
        """How far it is; None while nothing is measured."""
        return self._course

    @property
    def actions_now(self) -> tuple[QAction, ...]:
        """The main action, then the others."""
        course = self._course
        return () if course is None else self.choices.at(course, corrected=corrected(self._session, course.sensor))

    @property
    def hint(self) -> str:
        """What to do next."""
        course = self._course
        if self._task is not None:
            return self.tr("Keep hands away; it takes some seconds.")
        if course is None or course.stage is not Stage.RESULT:
            return self.tr("Do as the picture shows, then press Take.")
        if course.fit is not None and course.raised:
            return self.tr("Keep it, put the sensor back, and calibrate again: every length that it measures changes.")
        if course.fit is not None:
            return self.tr("Keep it, and calibrate again: every length that this sensor measures changes with it.")
        return self.tr("Do what is said, and measure again.")

    def begin(self, sensor: str) -> None:
        """Begin to measure a sensor."""
        self._end_watch()
        self._course = Course(sensor)
        rig = self._session.source.rig
        if rig is not None:
            self._showing = rig.showing
            self.panel.show_typed(Typed(0.0, 1e3 * SHOWN_BOARD_M[2], 1e3 * SHOWN_BALL_M, 1e3 * SHOWN_RAISE_M))
        self.panel.preview.begin(self.tr("Depth of {sensor}").format(sensor=sensor))
        self._show()

    def rest(self) -> None:
        """Draw and look at nothing: it is out of view."""
        self._draw.stop()
        self._end_watch()

    def wake(self) -> None:
        """Come into view."""
        if self._course is not None:
            self._show()

    def end(self) -> None:
        """Let go of everything that was measured."""
        self.rest()
        self._course = None
        rig = self._session.source.rig
        if rig is not None and self._showing is not None:
            rig.show(self._showing)
        self._showing = None
        self.left_it.emit()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Take over another language."""
        if event.type() == QEvent.Type.LanguageChange:
            self.choices.say_words()
            self.result.draw()
            if self._course is not None and self._course.stage is not Stage.RESULT:
                self.panel.show_stage(self._course)
            self.changed.emit()
        super().changeEvent(event)

    def _lay_out(self) -> None:
        self._stack.addWidget(self.panel)
        self._stack.addWidget(self.result)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self._stack)

    def _connect(self) -> None:
        self._draw.timeout.connect(self._look)
        self.panel.typed_changed.connect(self._aim)
        self.choices.take.triggered.connect(self._take)
        self.choices.skip.triggered.connect(self._skip)
        self.choices.more.triggered.connect(lambda: self._go_to(Stage.BOARD))
        self.choices.higher.triggered.connect(lambda: self._go_to(Stage.RAISED))
        self.choices.undo.triggered.connect(self._undo)
        self.choices.again.triggered.connect(self._begin_again)
        self.choices.keep.triggered.connect(self._keep)
        self.choices.remove.triggered.connect(self._remove)
        self.choices.back.triggered.connect(self.end)

    # what is shown

    def _show(self) -> None:
        course = self._course
        if course is None:
            return
        measuring = course.stage is not Stage.RESULT
        self._stack.setCurrentWidget(self.panel if measuring else self.result)
        if measuring:
            self.panel.show_stage(course)
            self._show_what_is_needed(course.stage)
            self._start_watch(course)
        else:
            self.rest()
            if course.outcome is not None:
                self.result.show_outcome(course.sensor, course.outcome)
        self.changed.emit()

    def _show_what_is_needed(self, stage: Stage) -> None:
        rig = self._session.source.rig
        if rig is not None and rig.showing is not SHOWN[stage]:
            rig.show(SHOWN[stage])

    def _look(self) -> None:
        course, feed = self._course, self._session.connected.feed
        if course is None or feed is None or course.sensor not in feed.infos:
            self._ready = False
            self.choices.take.setEnabled(False)
            return
        self.panel.show_frame(feed.newest(course.sensor))
        told = self.panel.show_sight(None if self._watch is None else self._watch.newest)
        self._ready = told.health == "good"
        self.choices.take.setEnabled(self._ready and self._task is None)
        warm = self._session.steadiness.of(course.sensor).warmup.state
        self.panel.show_caution(
            self.tr("This sensor still warms up: measured later it is measured better.")
            if warm is Warmth.DRIFTING
            else ""
        )

    # the look at the sensor

    def _aim_of(self, course: Course) -> Aim:
        return course.aim(self.panel.typed)

    def _start_watch(self, course: Course) -> None:
        feed = self._session.connected.feed
        self._end_watch()
        if feed is not None and course.sensor in feed.infos and self._task is None:
            self._watch = DepthWatch(feed, course.sensor, self._aim_of(course))
            self._watch.start()
        self._look()
        self._draw.start()

    def _end_watch(self) -> None:
        if self._watch is not None:
            self._watch.stop()
            self._watch = None

    def _aim(self) -> None:
        if self._course is not None and self._watch is not None:
            self._watch.aim = self._aim_of(self._course)

    # what is done

    def _take(self) -> None:
        course, feed = self._course, self._session.connected.feed
        if course is None or feed is None or self._task is not None or not self._ready:
            return
        job = taking(feed, course.sensor, bare=course.stage is Stage.BELT)
        task = self._session.tasks.run(lambda: self.tr("Measuring depth"), job, taking_words)
        self._task = task
        task.succeeded.connect(self._took)
        self._follow(task)

    def _follow(self, task: Task[Taken] | Task[Worked]) -> None:
        task.failed.connect(self._session.messages.error)
        task.ended.connect(self._ended)
        self._end_watch()
        self.choices.take.setEnabled(False)
        self.changed.emit()

    def _took(self, taken: Taken) -> None:
        if self._course is not None:
            self._course = self._course.taken(taken.still, taken.belt, self.panel.typed)

    def _ended(self) -> None:
        self._task = None
        course = self._course
        if course is not None and course.stage is Stage.RESULT and course.outcome is None:
            self._work_out(course)
        else:
            self._show()

    def _work_out(self, course: Course) -> None:
        measured = course.measurements()
        if measured is not None:
            job = working_out(measured)
            task = self._session.tasks.run(lambda: self.tr("Working out the correction"), job, working_words)
            self._task = task
            task.succeeded.connect(self._worked)
            task.cancelled.connect(self._step_back)
            task.failed.connect(self._step_back)
            self._follow(task)

    def _worked(self, worked: Worked) -> None:
        if self._course is not None:
            self._course = self._course.came_to(worked.outcome)

    def _step_back(self) -> None:
        course = self._course
        if course is not None and course.before is not None:
            self._course = course.before

    def _undo(self) -> None:
        if self._task is None:
            self._step_back()
            self._show()

    def _skip(self) -> None:
        course = self._course
        if course is not None and self._task is None and course.can_pass:
            self._course = course.passed()
            self._ended()

    def _go_to(self, stage: Stage) -> None:
        if self._course is not None and self._task is None:
            self._course = self._course.at(stage)
            self._show()

    def _begin_again(self) -> None:
        if self._course is not None and self._task is None:
            self._course = Course(self._course.sensor, before=self._course)
            self._show()

    # what is kept

    def _keep(self) -> None:
        course = self._course
        if course is not None and course.fit is not None:
            keep_depth(self._session, course.sensor, device_depth(course.fit, datetime.now().astimezone()))
            self.end()

    def _remove(self) -> None:
        course = self._course
        if course is not None:
            keep_depth(self._session, course.sensor, DeviceDepth())
            self.end()
