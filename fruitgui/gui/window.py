"""The window's frame: steps at the left, health at the top, one step in the middle, its actions at the bottom."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from PySide6.QtCore import Qt
from PySide6.QtGui import QCloseEvent, QKeySequence, QShortcut
from PySide6.QtWidgets import QHBoxLayout, QMainWindow, QStackedWidget, QVBoxLayout, QWidget

from fruitgui.gui.action_bar import ActionBar
from fruitgui.gui.messages import Messages
from fruitgui.gui.rail import Rail
from fruitgui.gui.steps.page import StepPage
from fruitgui.gui.tasks import TaskRunner
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.top_bar import TopBar
from fruitgui.station.workflow import Step, StepState

SMALLEST = (1100, 680)
USUAL = (1280, 720)


class MainWindow(QMainWindow):
    """Puts the parts together; what they show is decided elsewhere.

    Args:
        theme, messages, tasks: shared by all screens.
        pages: one for every step; each is asked for when it is first wanted.
        closing: called when the window is closed; false keeps it open.
    """

    def __init__(
        self,
        theme: Theme,
        messages: Messages,
        tasks: TaskRunner,
        pages: Mapping[Step, StepPage],
        closing: Callable[[], bool] = lambda: True,
    ) -> None:
        super().__init__()
        self._pages = pages
        self._closing = closing
        self._step: Step | None = None
        self.rail, self.top_bar, self.action_bar = Rail(theme), TopBar(theme), ActionBar(theme)
        self._stack = QStackedWidget()
        self._lay_out()
        self.rail.chosen.connect(self.go_to)
        messages.said.connect(self.action_bar.say)
        messages.standing_changed.connect(self.action_bar.stand)
        messages.step_wanted.connect(self.go_to)
        self.action_bar.stand(messages.standing)
        tasks.changed.connect(lambda: self._follow_tasks(tasks))
        for key, step in (("Ctrl+PgUp", -1), ("Ctrl+PgDown", 1)):
            QShortcut(QKeySequence(key), self, lambda step=step: self._walk(step))
        self.setWindowTitle("fruitgui")
        self.setMinimumSize(*SMALLEST)
        self.resize(*USUAL)

    @property
    def step(self) -> Step | None:
        """The step on the screen."""
        return self._step

    def page(self, step: Step) -> StepPage:
        """Return the screen of a step."""
        page = self._pages[step]
        if self._stack.indexOf(page) < 0:
            self._stack.addWidget(page)
            page.step_wanted.connect(self.go_to)
            self.action_bar.prepare(page)
        return page

    def go_to(self, step: Step) -> None:
        """Bring a step to the screen."""
        if step is self._step:
            return
        if self._step is not None:
            self.page(self._step).left()
        self._step = step
        page = self.page(step)
        self._stack.setCurrentWidget(page)
        self.rail.show_step(step)
        self.action_bar.follow(page)
        page.setFocus(Qt.FocusReason.OtherFocusReason)
        page.entered()

    def show_states(self, states: Mapping[Step, StepState]) -> None:
        """Show how far each step is."""
        self.rail.show_states(states)

    def closeEvent(self, event: QCloseEvent) -> None:  # noqa: N802 - Qt's name
        """End the page in view, which may have something to save; then ask whoever owns what runs."""
        page = None if self._step is None else self.page(self._step)
        if page is not None:
            page.left()
        if self._closing():
            self._step = None
            event.accept()
            return
        event.ignore()
        if page is not None:
            page.entered()

    def _lay_out(self) -> None:
        right = QVBoxLayout()
        right.setContentsMargins(0, 0, 0, 0)
        right.setSpacing(0)
        right.addWidget(self.top_bar)
        right.addWidget(self._stack, 1)
        right.addWidget(self.action_bar)
        whole = QWidget()
        row = QHBoxLayout(whole)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(0)
        row.addWidget(self.rail)
        row.addLayout(right, 1)
        self.setCentralWidget(whole)

    def _walk(self, by: int) -> None:
        steps = list(Step)
        at = 0 if self._step is None else steps.index(self._step)
        self.go_to(steps[(at + by) % len(steps)])

    def _follow_tasks(self, tasks: TaskRunner) -> None:
        if tasks.running:
            self.action_bar.show_task(tasks.running[-1])
