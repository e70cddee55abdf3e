"""Recording the sensors that run, beside whatever else takes their frames: one recording at a time."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QCoreApplication, QObject, QTimer, QUrl, Signal
from PySide6.QtGui import QDesktopServices

from fruitgui.errors import FruitguiError, WorldError
from fruitgui.gui.connected import Connected
from fruitgui.gui.messages import Level, Message, Messages
from fruitgui.gui.recorder_words import recorded_message
from fruitgui.gui.tasks import Job, Task, TaskRunner
from fruitgui.gui.told import Told
from fruitgui.progress import Cancelled, Progress
from fruitgui.sensors.feed import Feed
from fruitgui.sensors.recordings import Split
from fruitgui.station.record_job import record_feed
from fruitgui.station.record_state import Recorded, RecordPlan, RecordState
from fruitgui.station.recordings_made import recording_path

LOOK_MS = 250
MOST_PART_BYTES = 4_000_000_000
"""Sticks and older disks take no larger file."""


class Recorder(QObject):
    """Starts and stops a recording, and says what came of it. What was recorded is kept, however it ends.

    Attributes:
        changed: a recording began or ended.
        ticked: `state` is newer.
    """

    changed = Signal()
    ticked = Signal()

    def __init__(self, folder: Path, connected: Connected, messages: Messages, parent: QObject | None = None) -> None:
        """Prepare.

        Args:
            folder: of the recordings; made when there is one.
            connected: the sensors that run.
            messages: is told how a recording ended.
        """
        super().__init__(parent)
        self.folder = folder
        self._connected = connected
        self._messages = messages
        self._tasks = TaskRunner(self)  # its own: the action bar goes on to show the screen's jobs
        self._task: Task[Recorded] | None = None
        self._plan: RecordPlan | None = None
        self._newest: RecordState | None = None
        self._look = QTimer(self, interval=LOOK_MS)
        self._look.timeout.connect(self.ticked)

    @property
    def plan(self) -> RecordPlan | None:
        """What is being recorded; None while nothing is."""
        return self._plan

    @property
    def state(self) -> RecordState | None:
        """How far it is; None before that is known."""
        return self._newest

    @property
    def stopping(self) -> bool:
        """Whether it was asked to end, and has not yet."""
        return self._task is not None and self._task.stopping

    def start(self, name: str, seconds: float | None) -> None:
        """Record the sensors that run, from now on; nothing where none runs, or one is being made.

        Args:
            name: that a person gave it.
            seconds: how long; None until it is stopped.
        """
        feed = self._connected.feed
        if feed is None or self._task is not None:
            return
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            what = f"The folder {self.folder} cannot be made: {error.strerror}."
            self._messages.error(WorldError("cannot_write", what, "Free this name.", file=self.folder))
            return
        plan = RecordPlan(recording_path(self.folder, name), seconds, Split(most_bytes=MOST_PART_BYTES))
        self._plan, self._newest = plan, None
        self._task = self._tasks.run(_doing, self._job(feed, plan))
        self._task.succeeded.connect(self._tell)
        self._task.failed.connect(self._fail)
        self._task.cancelled.connect(self._tell_nothing)
        self._task.ended.connect(self._end)
        self._look.start()
        self.changed.emit()

    def stop(self) -> None:
        """End the recording; what was recorded is kept."""
        if self._task is not None:
            self._task.cancel()
            self.ticked.emit()

    def close(self) -> bool:
        """End the recording with the window, for good; tell whether it ended in time."""
        self._look.stop()
        return self._tasks.close()

    def _job(self, feed: Feed, plan: RecordPlan) -> Job[Recorded]:
        def note(state: RecordState) -> None:
            self._newest = state

        def job(progress: Progress, cancelled: Cancelled) -> Recorded:  # noqa: ARG001 - it tells more than a share
            return record_feed(feed, plan, note, cancelled)

        return job

    def _tell(self, done: Recorded) -> None:
        def told() -> Told:
            what, remedy, _ = recorded_message(done)
            return Told(what, remedy, self.tr("Show the folder"))

        def look() -> None:
            QDesktopServices.openUrl(QUrl.fromLocalFile(str(self.folder)))

        _, _, good = recorded_message(done)
        self._messages.say(Message(Level.GOOD if good else Level.WARN, told, look, stays=not good))

    def _fail(self, error: FruitguiError) -> None:
        self._messages.error(error)

    def _tell_nothing(self) -> None:
        self._messages.info(lambda: Told(self.tr("Nothing was recorded: the sensors had given nothing yet.")))

    def _end(self) -> None:
        self._look.stop()
        self._task = self._plan = self._newest = None
        self.changed.emit()


def _doing() -> str:
    """Return what is being done."""
    return QCoreApplication.translate("Recorder", "Recording")
