"""Short questions to the store, asked beside the window so that it never waits for the disk."""

from __future__ import annotations

import logging
import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

from PySide6.QtCore import QObject, Qt, QTimer, Signal

from fruitgui.errors import FruitguiError
from fruitgui.gui.tasks import unexpected_error

T = TypeVar("T")

LOOK_MS = 10
END_S = 5.0
LINGER_S = 0.3
"""A thread with nothing to do waits so long for more: to begin one costs the window more than most questions do."""

log = logging.getLogger(__name__)


@dataclass(slots=True, eq=False)
class _Asked:
    """One question; `name` is empty for changes, which are never dropped."""

    name: str
    question: Callable[[], Any]
    answer: Callable[[Any], None]
    result: Any = None
    error: FruitguiError | None = None


class _Work:
    """What is asked and what is answered, and the thread between them; knows no window."""

    def __init__(self, linger_s: float) -> None:
        self._linger_s = linger_s
        self._more = threading.Condition()
        self.changes: deque[_Asked] = deque()
        self.questions: deque[_Asked] = deque()
        self.patient: deque[_Asked] = deque()
        self._done: deque[_Asked] = deque()
        self._running = self._in_hand = self._finished = False

    @property
    def open(self) -> bool:
        """Whether something was put here and not taken away answered."""
        with self._more:
            return self._in_hand or bool(self._waiting() or self._done)

    def put(self, queue: deque[_Asked], asked: _Asked, instead_of: _Asked | None = None) -> None:
        """Put something into one of the queues, in the place of what waits there still."""
        with self._more:
            if instead_of is not None and instead_of in queue:
                queue.remove(instead_of)
            queue.append(asked)
            start, self._running = not self._running, True
            self._more.notify_all()
        if start:
            threading.Thread(target=self._run, name="queries").start()

    def forget_questions(self) -> None:
        """Let go of all that are not asked yet."""
        with self._more:
            self.questions.clear()
            self.patient.clear()

    def finish(self) -> None:
        """Let no thread wait for more any longer."""
        with self._more:
            self._finished = True
            self._more.notify_all()

    def wait_for_changes(self, timeout_s: float) -> bool:
        """Wait until all changes are made; tell whether they were, in that time."""
        with self._more:
            return self._more.wait_for(lambda: not (self._in_hand or self.changes), timeout_s)

    def take_answered(self) -> _Asked | None:
        """Return the next that is answered; None where there is none."""
        with self._more:
            return self._done.popleft() if self._done else None

    def _waiting(self) -> deque[_Asked]:
        return self.changes or self.questions or self.patient

    def _run(self) -> None:
        while (asked := self._next()) is not None:
            _answer(asked)
            with self._more:
                self._in_hand = False
                self._done.append(asked)
                self._more.notify_all()
            del asked  # its answer belongs to a widget, which must not be freed on this thread

    def _next(self) -> _Asked | None:
        with self._more:
            self._more.wait_for(lambda: self._waiting() or self._finished, self._linger_s)
            if not self._waiting():
                self._running = False
                return None
            self._in_hand = True
            return self._waiting().popleft()


class Queries(QObject):
    """Does one thing at a time: changes first, then questions in order, then those that can wait.

    Answers come on the window's thread.

    A thread lives while there is something to ask, and a while longer. Of questions under one name only the newest is
    answered: a list that was scrolled on, a search that was typed further. Changes are all made, even when the window
    closes.

    Args:
        linger_s: how long; for what is asked again and again, longer than from once to the next. The window waits until
            a thread has begun, which takes up to 90 ms on a busy machine.

    Attributes:
        failed: a `FruitguiError`, of a question or a change.
    """

    failed = Signal(object)

    def __init__(self, parent: QObject | None = None, linger_s: float = LINGER_S) -> None:
        super().__init__(parent)
        self._work = _Work(linger_s)
        self._newest: dict[str, _Asked] = {}
        self._look = QTimer(self, interval=LOOK_MS, timerType=Qt.TimerType.PreciseTimer)
        self._look.timeout.connect(self._tell)

    @property
    def busy(self) -> bool:
        """Whether something was asked and not answered yet."""
        return self._work.open

    def ask(self, name: str, question: Callable[[], T], answer: Callable[[T], None]) -> None:
        """Ask for what `question` returns; an older one of the same name is forgotten."""
        self._ask(self._work.questions, _Asked(name, question, answer))

    def ask_later(self, name: str, question: Callable[[], T], answer: Callable[[T], None]) -> None:
        """Ask for what takes longer, when nothing else is to be done; see `ask`."""
        self._ask(self._work.patient, _Asked(name, question, answer))

    def change(self, change: Callable[[], T], done: Callable[[T], None]) -> None:
        """Do what changes the store, before any question that waits; it is never dropped."""
        self._put(self._work.changes, _Asked("", change, done))

    def rest(self) -> None:
        """Forget all questions; changes are made nonetheless."""
        self._newest.clear()
        self._work.forget_questions()

    def finish(self, timeout_s: float = END_S) -> bool:
        """Forget all questions, and wait until all changes are made and told; tell whether they were, in that time."""
        self.rest()
        made = self._work.wait_for_changes(timeout_s)
        self._work.finish()
        self._tell()
        return made

    def wait_for_changes(self) -> None:
        """Wait until all changes are made; for jobs on threads of their own, never for the window."""
        self._work.wait_for_changes(END_S)

    def _ask(self, queue: deque[_Asked], asked: _Asked) -> None:
        before = self._newest.get(asked.name)
        self._newest[asked.name] = asked
        self._put(queue, asked, before)

    def _put(self, queue: deque[_Asked], asked: _Asked, before: _Asked | None = None) -> None:
        self._work.put(queue, asked, before)
        self._look.start()

    def _tell(self) -> None:
        while (asked := self._work.take_answered()) is not None:
            if asked.name and self._newest.get(asked.name) is not asked:
                continue
            if asked.error is not None:
                self.failed.emit(asked.error)
            else:
                asked.answer(asked.result)
        if not self._work.open:
            self._look.stop()


def _answer(asked: _Asked) -> None:
    try:
        asked.result = asked.question()
    except FruitguiError as error:
        asked.error = error
    except Exception as error:  # the edge of a thread: whatever went wrong is told, and the window lives on
        log.exception("question %s", asked.name)
        asked.error = unexpected_error(lambda: asked.name, error)
