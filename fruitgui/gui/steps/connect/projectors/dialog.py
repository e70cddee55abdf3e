"""Measuring the projectors in the window: what it is for, the measuring itself, and what it came to."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QCoreApplication, Qt, Signal
from PySide6.QtWidgets import QDialog, QHBoxLayout, QPushButton, QScrollArea, QVBoxLayout, QWidget

from fruitgui.errors import FruitguiError
from fruitgui.gui import error_words
from fruitgui.gui.steps.connect.projectors.result import result_cards
from fruitgui.gui.tasks import Job, Task, TaskRunner
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import EmptyPlace, label, set_role
from fruitgui.gui.widgets.reach import reach
from fruitgui.gui.widgets.worded import Worded
from fruitgui.gui.widgets.working import Working
from fruitgui.station.projectors import Projectors
from fruitgui.station.tried import Tried
from fruitgui.station.turn_plan import TurnPlan

Plan = Callable[[Projectors | None], TurnPlan | None]
"""Gives the turns by what is kept now, or as they would be with what was measured, too."""


class ProjectorsDialog(Worded, QDialog):
    """Measures when asked to; what it found is kept only when that is asked for, too.

    Args:
        measure: does it.
        minutes: that it takes, about.
        plan: what it changes.
        tasks: runs it beside the window.

    Attributes:
        kept: what was measured is to be kept.
    """

    kept = Signal(object)

    def __init__(
        self, measure: Job[Tried], minutes: int, plan: Plan, tasks: TaskRunner, theme: Theme,
        parent: QWidget | None = None,
    ) -> None:  # fmt: skip
        super().__init__(parent)
        self._measure, self._minutes, self._plan, self._tasks, self._theme = measure, minutes, plan, tasks, theme
        self._task: Task[Tried] | None = None
        self._tried: Tried | None = None
        self._failure: FruitguiError | None = None
        self._stopped = False
        self._share, self._trying = 0.0, ""
        self._title, self._note = label("", "page"), label("", "dim")
        self.working, self._scroll = Working(), QScrollArea()
        self.stop = self.working.stop
        self.begin, self.keep, self.leave = QPushButton(), QPushButton(), QPushButton()
        self._lay_out()
        self._connect()
        self._say_words()

    @property
    def tried(self) -> Tried | None:
        """What was found last; None before that."""
        return self._tried

    @property
    def busy(self) -> bool:
        """Whether it measures."""
        return self._task is not None

    def done(self, result: int) -> None:
        """Stop what runs, then close."""
        if self._task is not None:
            self._task.cancel()
        super().done(result)

    def _lay_out(self) -> None:
        self._note.setWordWrap(True)
        self._scroll.setWidgetResizable(True)
        reach(self._scroll)
        self._scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        buttons = QHBoxLayout()
        buttons.setSpacing(GRID)
        buttons.addStretch()
        for button in (self.begin, self.leave, self.keep):
            buttons.addWidget(button)
        column = QVBoxLayout(self)
        column.setContentsMargins(3 * GRID, 3 * GRID, 3 * GRID, 3 * GRID)
        column.setSpacing(2 * GRID)
        for widget in (self._title, self._note, self.working):
            column.addWidget(widget)
        column.addWidget(self._scroll, 1)
        column.addLayout(buttons)
        self.resize(860, 620)

    def _connect(self) -> None:
        self.begin.clicked.connect(self._begin)
        self.stop.clicked.connect(self._stop)
        self.keep.clicked.connect(self._keep)
        self.leave.clicked.connect(self.reject)
        for button in (self.begin, self.keep, self.leave):
            button.setAutoDefault(False)

    def _say_words(self) -> None:
        self.setWindowTitle(self.tr("Measure the projectors"))
        self._title.setText(self.tr("Measure the projectors"))
        found = self._tried is not None
        for button, text, tip in (
            (
                self.begin,
                self.tr("Measure again") if found else self.tr("Measure"),
                self.tr("Switch the projectors on and off"),
            ),
            (self.stop, self.tr("Stop"), self.tr("Stop measuring; nothing is changed")),
            (self.keep, self.tr("Keep"), self.tr("Take turns by what was measured from now on")),
            (
                self.leave,
                self.tr("Discard") if found else self.tr("Close"),
                self.tr("Go back; nothing is changed"),
            ),
        ):
            button.setText(text)
            button.setToolTip(tip)
            button.setAccessibleName(text)
        self._show()

    # what is shown

    def _show(self) -> None:
        self._say_doing()
        self._note.setText(self._note_text())
        self._note.setVisible(bool(self._note.text()))
        self.working.setVisible(self.busy)
        self.begin.setEnabled(not self.busy)
        worth_it = self._tried is not None and bool(self._tried.projectors.settlings)
        self.keep.setEnabled(worth_it and not self.busy)
        self.keep.setVisible(self._tried is not None)
        set_role(self.keep, "main" if worth_it else "plain")
        set_role(self.begin, "plain" if worth_it else "main")
        (self.keep if worth_it else self.begin).setDefault(True)
        before = self._scroll.takeWidget()
        self._scroll.setWidget(self._contents())
        if before is not None:
            before.deleteLater()

    def _note_text(self) -> str:
        if self.busy:
            return self.tr("Let the belt stand still, and nobody pass below the sensors.")
        if self._failure is not None:
            told = error_words.told(self._failure)
            return f"{told.what} {told.remedy}"
        return self.tr("Measuring was stopped; nothing is changed.") if self._stopped else ""

    def _contents(self) -> QWidget:
        if self._tried is not None and not self.busy:
            return result_cards(self._tried, self._plan(None), self._plan(self._tried.projectors))
        what = self.tr("How long does each light take to become steady, and who blinds whom?")
        how = self.tr(
            "Let the belt stand with a few fruit on it, warm the sensors up for ten minutes, then measure. Each "
            "projector is switched on and off, alone and two at a time; it takes about {minutes} min. Until it was "
            "measured, careful guesses are used, which cost pictures."
        ).format(minutes=self._minutes)
        return EmptyPlace(self._theme, "connect", what, how)

    def _show_progress(self, share: float, doing: str) -> None:
        self._share, self._trying = share, doing
        self._say_doing()

    def _say_doing(self) -> None:
        text = self.tr("Stopping …") if self._task is not None and self._task.stopping else self.tr("Trying {sensors}")
        self.working.show_progress(self._share, text.format(sensors=self._trying) if self._trying else "")

    # what is done

    def _begin(self) -> None:
        if self.busy:
            return
        self._failure, self._stopped = None, False
        self._task = self._tasks.run(_measuring, self._measure)
        self._task.progressed.connect(self._show_progress)
        self._task.succeeded.connect(self._found)
        self._task.failed.connect(self._failed)
        self._task.cancelled.connect(self._was_stopped)
        self._task.ended.connect(self._ended)
        self._show()

    def _found(self, tried: Tried) -> None:
        self._tried = tried

    def _failed(self, error: FruitguiError) -> None:
        self._failure = error

    def _was_stopped(self) -> None:
        self._stopped = True

    def _ended(self) -> None:
        self._task = None
        self._share, self._trying = 0.0, ""
        self._say_words()

    def _stop(self) -> None:
        if self._task is not None:
            self._task.cancel()
            self._say_doing()

    def _keep(self) -> None:
        if self._tried is not None:
            self.kept.emit(self._tried.projectors)
            self.accept()


def _measuring() -> str:
    """Return the job's name, which may outlive the dialog."""
    return QCoreApplication.translate("ProjectorsDialog", "Measuring the projectors")
