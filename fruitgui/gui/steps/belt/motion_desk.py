"""Has the belt's motion measured by the fruit that pass."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal

from fruitgui.gui.session import Session
from fruitgui.gui.steps.belt.measuring import Motion, measuring, views_text
from fruitgui.gui.tasks import Task
from fruitgui.gui.told import Told
from fruitgui.sensors.feed import Feed
from fruitgui.station.station import Station


class MotionDesk(QObject):
    """Measures, one at a time, and says where no fruit told.

    Attributes:
        found: the motion that fruit showed.
        changed: it began to measure, or ended.
    """

    found = Signal(object)
    changed = Signal()

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._task: Task[Motion] | None = None

    @property
    def busy(self) -> bool:
        """Whether it measures."""
        return self._task is not None

    def measure(self, feed: Feed, station: Station) -> None:
        """Begin, unless it measures already."""
        if self._task is not None:
            return
        job = measuring(feed, station)
        self._task = self._session.tasks.run(lambda: self.tr("Measuring the belt"), job, views_text)
        self._task.succeeded.connect(self._take)
        self._task.failed.connect(self._session.messages.error)
        self._task.ended.connect(self._ended)
        self.changed.emit()

    def _take(self, motion: Motion) -> None:
        if motion.motion is not None:
            self.found.emit(motion.motion)
            return
        self._session.messages.warn(self._nothing_told)

    def _nothing_told(self) -> Told:
        return Told(
            self.tr("No fruit passed from which the speed could be told."),
            self.tr("Let the belt run with single fruit on it, and measure again; or type the speed."),
        )

    def _ended(self) -> None:
        self._task = None
        self.changed.emit()
