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

log = logging.getLogger(__name__)


@dataclass(slots=True, eq=False)
class _Asked:
    """One question; `name` is empty for changes, which are never dropped."""

    name: str
    question: Callable[[], Any]
    answer: Callable[[Any], None]
    result: Any = None
    error: FruitguiError | None = None


class Queries(QObject):
    """Does one thing at a time: changes first, then questions in order, then those that can wait.

    Answers come on the window's thread.

    A thread lives while there is something to ask. Of questions under one name only the newest is answered: a list
    that was scrolled on, a search that was typed further. Changes are all made, even when the window closes.

    Attributes:
        failed: a `FruitguiError`, of a question or a change.
    """

    failed = Signal(object)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._lock = threading.Lock()
        self._changes: deque[_Asked] = deque()
        self._questions: deque[_Asked] = deque()
        self._patient: deque[_Asked] = deque()
        self._done: deque[_Asked] = deque()
        self._newest: dict[str, _Asked] = {}
        self._working = False
        self._look = QTimer(self, interval=LOOK_MS, timerType=Qt.TimerType.PreciseTimer)
        self._look.timeout.connect(self._tell)

    @property
    def busy(self) -> bool:
        """Whether something was asked and not answered yet."""
        with self._lock:
            return self._working or bool(self._changes or self._questions or self._patient or self._done)

    def ask(self, name: str, question: Callable[[], T], answer: Callable[[T], None]) -> None:
        """Ask for what `question` returns; an older one of the same name is forgotten."""
        self._ask(self._questions, _Asked(name, question, answer))

    def ask_later(self, name: str, question: Callable[[], T], answer: Callable[[T], None]) -> None:
        """Ask for what takes longer, when nothing else is to be done; see `ask`."""
        self._ask(self._patient, _Asked(name, question, answer))

    def change(self, change: Callable[[], T], done: Callable[[T], None]) -> None:
        """Do what changes the store, before any question that waits; it is never dropped."""
        self._put(self._changes, _Asked("", change, done))

    def rest(self) -> None:
        """Forget all questions; changes are made nonetheless."""
        self._newest.clear()
        with self._lock:
            self._questions.clear()
            self._patient.clear()

    def _ask(self, queue: deque[_Asked], asked: _Asked) -> None:
        before = self._newest.get(asked.name)
        self._newest[asked.name] = asked
        with self._lock:
            if before is not None and before in queue:
                queue.remove(before)
        self._put(queue, asked)

    def _put(self, queue: deque[_Asked], asked: _Asked) -> None:
        with self._lock:
            queue.append(asked)
            start, self._working = not self._working, True
        if start:
            threading.Thread(target=self._work, name="queries").start()
        self._look.start()

    def _work(self) -> None:
        while True:
            with self._lock:
                queue = self._changes or self._questions or self._patient
                if not queue:
                    self._working = False
                    return
                asked = queue.popleft()
            _answer(asked)
            with self._lock:
                self._done.append(asked)
            del asked  # its answer belongs to a widget, which must not be freed on this thread

    def _tell(self) -> None:
        while True:
            with self._lock:
                if not self._done:
                    if not self._working:
                        self._look.stop()
                    return
                asked = self._done.popleft()
            if asked.name and self._newest.get(asked.name) is not asked:
                continue
            if asked.error is not None:
                self.failed.emit(asked.error)
            else:
                asked.answer(asked.result)


def _answer(asked: _Asked) -> None:
    try:
        asked.result = asked.question()
    except FruitguiError as error:
        asked.error = error
    except Exception as error:  # the edge of a thread: whatever went wrong is told, and the window lives on
        log.exception("question %s", asked.name)
        asked.error = unexpected_error(asked.name, error)
