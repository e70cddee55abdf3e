"""Letting fruit come in to be named: from the line that runs, or from a recording; one lesson at a time."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from PySide6.QtCore import QCoreApplication, QObject, QTimer, Signal

from fruitgui.gui.health import warning_message
from fruitgui.gui.messages import Message
from fruitgui.gui.session import Session
from fruitgui.gui.steps.teach import work
from fruitgui.gui.tasks import Job, Task
from fruitgui.gui.told import Told, Words
from fruitgui.records.lesson import Lesson

translate = QCoreApplication.translate

COME_IN_MS = 700
"""How often one looks for fruit that came in, while a lesson runs."""


class Lessons(QObject):
    """Starts and stops lessons, and says when to look for what came in.

    Attributes:
        changed: a lesson began or ended.
        came_in: there may be more fruit.
    """

    changed = Signal()
    came_in = Signal()

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._looked_at = False
        self._lesson: Task[Lesson] | None = None
        self._look = QTimer(self, interval=COME_IN_MS)
        self._look.timeout.connect(self.came_in)
        session.running.changed.connect(self._line_changed)

    @property
    def running(self) -> bool:
        """Whether fruit come in."""
        return self._lesson is not None

    def watch(self) -> None:
        """Let fruit come in from the sensors that run."""
        feed, station = self._session.connected.feed, self._session.station
        if feed is not None and station is not None:
            self._teach(
                lambda: translate("Classroom", "Watching the line"), work.watching(self._session.store, feed, station)
            )

    def open(self, path: Path) -> None:
        """Let the fruit of a recording come in."""
        station = self._session.station
        if station is not None:
            self._teach(
                lambda: translate("Classroom", "Watching {name}").format(name=path.name),
                work.opening(self._session.store, path, station),
            )

    def stop(self) -> None:
        """It is enough."""
        if self._lesson is not None:
            self._lesson.cancel()

    def look(self, looked_at: bool) -> None:
        """Look for fruit while somebody looks at them, or rest; a lesson goes on."""
        self._looked_at = looked_at
        self._watch_coming()

    def _watch_coming(self) -> None:
        """Look for fruit while a lesson runs, and while a lot does, which sets unknown ones aside."""
        coming = self._looked_at and (self.running or self._session.running.running)
        if coming and not self._look.isActive():
            self._look.start()
        elif not coming:
            self._look.stop()

    def _teach(self, name: Words, job: Job[Lesson]) -> None:
        if self._lesson is not None:
            return
        self._lesson = self._session.tasks.run(name, job, work.lesson_words)
        self._lesson.succeeded.connect(self._learned)
        self._lesson.failed.connect(self._session.messages.error)
        self._lesson.ended.connect(self._ended)
        self._watch_coming()
        self.changed.emit()

    def _learned(self, lesson: Lesson) -> None:
        messages = self._session.messages
        if lesson.fruit or not lesson.known:
            messages.good(lambda: _came_in(lesson))
        else:
            messages.info(lambda: _known_before(lesson))
        if lesson.warnings:
            messages.warn(partial(_came_all_the_same, warning_message(lesson.warnings[0])))

    def _ended(self) -> None:
        self._lesson = None
        self._watch_coming()
        self.came_in.emit()
        self.changed.emit()

    def _line_changed(self) -> None:
        """A lot goes before a lesson: the line has no time for both."""
        if self._session.running.running:
            self.stop()
        self._watch_coming()


def _came_in(lesson: Lesson) -> Told:
    said = translate("Classroom", "{count} fruit came in from {source}.")
    return Told(said.format(count=lesson.fruit, source=lesson.source))


def _known_before(lesson: Lesson) -> Told:
    said = translate("Classroom", "All {count} fruit of {source} were here already.")
    return Told(said.format(count=lesson.known, source=lesson.source))


def _came_all_the_same(warning: Message) -> Told:
    return Told(warning.what, translate("Classroom", "The fruit that came in can be named all the same."))
