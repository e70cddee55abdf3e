"""Long jobs beside the window: one runner, progress, cancel, and every error told."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from typing import Generic, Protocol, TypeVar

from PySide6.QtCore import QObject, Qt, QTimer, Signal

from fruitgui.errors import CancelledByUserError, FruitguiError, WorldError
from fruitgui.gui.told import Words
from fruitgui.progress import Cancelled, Progress

T = TypeVar("T")
T_co = TypeVar("T_co", covariant=True)

LOOK_MS = 50
END_S = 5.0

log = logging.getLogger(__name__)


def as_said(doing: str) -> str:
    """Return what a job says of its progress as it is: a name, which is the same in every language."""
    return doing


class Job(Protocol[T_co]):
    """A plain function of the core."""

    def __call__(self, progress: Progress, cancelled: Cancelled) -> T_co:
        """Do it. Raises `FruitguiError` for what a person can do something about."""


class Task(QObject, Generic[T]):
    """One job on a thread of its own; all signals come on the window's thread.

    Attributes:
        name: what is being done, in the language in force.
        progressed: share done (0–1) and what is being done, worded, when either changed.
        succeeded: the result.
        failed: a `FruitguiError`.
        cancelled: the person stopped it.
        ended: after any of these three.
    """

    progressed = Signal(float, str)
    succeeded = Signal(object)
    failed = Signal(object)
    cancelled = Signal()
    ended = Signal()

    def __init__(
        self, name: Words, job: Job[T], parent: QObject | None = None, worded: Callable[[str], str] = as_said
    ) -> None:
        super().__init__(parent)
        self.name = name
        self._job = job
        self._worded = worded
        self._stop = threading.Event()
        self._told: tuple[float, str] = (0.0, "")
        self._shown: tuple[float, str] = (0.0, "")
        self._outcome: Callable[[], None] | None = None
        self._over = self._abandoned = False
        self._thread = threading.Thread(target=self._work, name=f"task {name()}", daemon=True)
        self._look = QTimer(self, interval=LOOK_MS, timerType=Qt.TimerType.CoarseTimer)
        self._look.timeout.connect(self._watch)

    @property
    def running(self) -> bool:
        """Whether it has not ended yet."""
        return self._look.isActive()

    @property
    def share(self) -> float:
        """How far it is, 0–1."""
        return self._shown[0]

    @property
    def doing(self) -> str:
        """What of it is being done, in the language in force."""
        return self._worded(self._shown[1])

    @property
    def over(self) -> bool:
        """Whether it has ended, and everything was told."""
        return self._over

    @property
    def stopping(self) -> bool:
        """Whether it was asked to stop."""
        return self._stop.is_set()

    def start(self) -> None:
        """Begin, unless it was abandoned meanwhile."""
        if not self._abandoned:
            self._look.start()
            self._thread.start()

    def abandon(self) -> None:
        """Ask the job to stop, and tell nobody of it any more: who would be told is about to go."""
        self._abandoned = True
        self._stop.set()
        self._look.stop()

    def cancel(self) -> None:
        """Ask the job to stop; it ends at its next step."""
        self._stop.set()

    def wait(self, timeout_s: float = END_S) -> bool:
        """Wait for the thread to end; tell whether it did."""
        if self._thread.ident is not None:
            self._thread.join(timeout_s)
        return not self._thread.is_alive()

    def _work(self) -> None:
        try:
            result = self._job(self._progress, self._stop.is_set)
        except CancelledByUserError:
            self._outcome = self.cancelled.emit
        except FruitguiError as error:
            told = error
            self._outcome = lambda: self.failed.emit(told)
        except Exception as error:  # the edge of a thread: whatever went wrong is told, and the window lives on
            log.exception("task %s", self.name())
            unexpected = unexpected_error(self.name, error)
            self._outcome = lambda: self.failed.emit(unexpected)
        else:
            self._outcome = lambda: self.succeeded.emit(result)

    def _progress(self, fraction: float, doing: str) -> None:
        self._told = (min(max(fraction, 0.0), 1.0), doing)

    def _watch(self) -> None:
        if self._told != self._shown:
            self._shown = self._told
            self.progressed.emit(self._shown[0], self.doing)
        if self._outcome is None or self._thread.is_alive():
            return
        self._look.stop()
        outcome, self._outcome = self._outcome, None
        outcome()
        self._over = True
        self.ended.emit()


def unexpected_error(doing: Words, error: BaseException) -> WorldError:
    """Return what to tell of an error that nobody foresaw; what was being done is worded when the error is."""
    return WorldError(
        "unexpected",
        f"Something went wrong in “{doing()}” that this program did not foresee ({type(error).__name__}: {error}).",
        "Nothing that was saved is lost. Try again; if it happens again, send the log file (Help, Show log).",
        values={"doing": doing},
    )


class TaskRunner(QObject):
    """Starts tasks and holds them until they end.

    Attributes:
        changed: a task began or ended.
    """

    changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._tasks: list[Task[object]] = []
        self._closed = False

    @property
    def running(self) -> tuple[Task[object], ...]:
        """The tasks that have not ended."""
        return tuple(self._tasks)

    def run(self, name: Words, job: Job[T], worded: Callable[[str], str] = as_said) -> Task[T]:
        """Make a task and start it as soon as the caller has connected to it.

        Args:
            name: what is being done; asked for on any thread, and as long as the task lives, so it should hold no
                object that goes before.
            job: does it.
            worded: puts what the job says of its progress into the language in force.
        """
        task: Task[T] = Task(name, job, self, worded)
        if self._closed:
            task.abandon()
            return task
        self._tasks.append(task)  # type: ignore[arg-type]  # held only to be ended
        task.ended.connect(self._forget_ended)
        QTimer.singleShot(0, task, task.start)
        self.changed.emit()
        return task

    def close(self, timeout_s: float = END_S) -> bool:
        """Stop all, for good: nothing begins after it, and nobody is told anything; tell whether all ended in time."""
        self._closed = True
        tasks, self._tasks = self._tasks, []
        for task in tasks:
            task.abandon()
        ended = [task.wait(timeout_s) for task in tasks]
        self.changed.emit()
        return all(ended)

    def _forget_ended(self) -> None:
        ended = [task for task in self._tasks if task.over]
        self._tasks = [task for task in self._tasks if not task.over]
        for task in ended:
            task.deleteLater()
        self.changed.emit()
