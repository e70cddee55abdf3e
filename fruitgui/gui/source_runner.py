"""Lets the sensors of the connection's source run: opened and stopped beside the window, never on its thread."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from PySide6.QtCore import QCoreApplication, QObject, QTimer, Signal

from fruitgui.errors import FruitguiError
from fruitgui.gui.connected import Connected
from fruitgui.gui.messages import Messages
from fruitgui.gui.tasks import Job, Task, TaskRunner
from fruitgui.progress import Cancelled, Progress, stop_if
from fruitgui.sensors.feed import Feed
from fruitgui.simulation.ahead import SimulatedRig
from fruitgui.station.connection import Connection, connection_to, named_sensors
from fruitgui.station.found import FoundWatch, Returning
from fruitgui.station.sources import Connected as Found
from fruitgui.station.sources import Source, Sources

LOOK_MS = 1000
"""How often devices that fell away are looked for."""

STOPPING, OPENING = "stopping", "opening"
"""What of connecting is being done."""


@dataclass(frozen=True, slots=True, eq=False)
class Opened:
    """A source that was opened, with the connection to it."""

    found: Found
    connection: Connection


class SourceRunner(QObject):
    """Opens sources one at a time; what is asked for while one is being opened comes after it.

    Attributes:
        opened: a `Connection` whose sensors run from now on.
        changed: it began or ended to open a source.
        found: what can be connected, as far as was asked.
    """

    opened = Signal(object)
    changed = Signal()

    def __init__(
        self,
        sources: Sources,
        connected: Connected,
        tasks: TaskRunner,
        messages: Messages,
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._sources = sources
        self._connected = connected
        self._tasks = tasks
        self._messages = messages
        self._task: Task[Opened] | None = None
        self._next: Callable[[], None] | None = None
        self._failure: FruitguiError | None = None
        self._rig: SimulatedRig | None = None
        self.found = FoundWatch(sources)
        self._returning = Returning(self.found)
        self._look = QTimer(self, interval=LOOK_MS)
        self._look.timeout.connect(self._look_for_lost)
        self._look.start()

    @property
    def sources(self) -> Sources:
        """All makes of sources."""
        return self._sources

    @property
    def opening(self) -> bool:
        """Whether a source is being opened."""
        return self._task is not None

    @property
    def failure(self) -> FruitguiError | None:
        """Why the last source could not be opened; None where it could."""
        return self._failure

    @property
    def rig(self) -> SimulatedRig | None:
        """The simulated rig that runs, which can be asked to show something else; None for any other source."""
        return self._rig

    def choose(self, source: Source) -> None:
        """Connect to another source, with all its sensors as they come."""
        self._open(lambda: source, lambda found: connection_to(source.value(), found.sensors))

    def start(self, connection: Connection) -> None:
        """Let the sensors of a connection run, in the place of those that run now."""
        value = connection.source
        self._open(lambda: self._sources.source_of(value), lambda _found: connection)

    def fresh_feed(self, connection: Connection) -> Feed:
        """Return the connection's sensors in a feed that is not started yet; may be called from any thread.

        Raises:
            FruitguiError: the source cannot be used.
        """
        found = self._sources.source_of(connection.source).connect()
        return Feed(named_sensors(connection, found.sensors))

    def _look_for_lost(self) -> None:
        feed = self._connected.feed
        if feed is not None:
            self._returning.look(feed)

    def _open(self, source: Callable[[], Source], connection: Callable[[Found], Connection]) -> None:
        if self._task is not None:
            self._next = lambda: self._open(source, connection)
            return
        before = self._connected.release()
        self._rig = None
        job = _job(before, source, connection)
        self._task = self._tasks.run(lambda: self.tr("Connecting the sensors"), job, _doing_words)
        self._task.succeeded.connect(self._run)
        self._task.failed.connect(self._fail)
        self._task.ended.connect(self._end)
        self.changed.emit()

    def _run(self, opened: Opened) -> None:
        self._failure = None
        self._rig = opened.found.rig
        self._connected.start(named_sensors(opened.connection, opened.found.sensors))
        self.opened.emit(opened.connection)

    def _fail(self, error: FruitguiError) -> None:
        self._failure = error
        self._messages.error(error)

    def _end(self) -> None:
        self._task = None
        following, self._next = self._next, None
        if following is not None:
            following()
        self.changed.emit()


def _doing_words(doing: str) -> str:
    return {
        STOPPING: QCoreApplication.translate("SourceRunner", "Stopping the sensors that ran before"),
        OPENING: QCoreApplication.translate("SourceRunner", "Opening the source"),
    }.get(doing, doing)


def _job(
    before: Feed | None,
    source: Callable[[], Source],
    connection: Callable[[Found], Connection],
) -> Job[Opened]:
    def opened(progress: Progress, cancelled: Cancelled) -> Opened:
        if before is not None:
            progress(0.1, STOPPING)
            before.stop()
        stop_if(cancelled)
        progress(0.5, OPENING)
        found = source().connect()
        return Opened(found, connection(found))

    return opened
