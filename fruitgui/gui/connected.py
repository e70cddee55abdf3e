"""The sensors that are connected now: one feed, started and stopped from the window's thread."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QObject, QTimer, Signal

from fruitgui.sensors.feed import Feed, SensorHealth
from fruitgui.sensors.sensor import Sensor

LOOK_MS = 500


class Connected(QObject):
    """Owns the feed; asks it twice a second how its sensors are.

    Attributes:
        changed: other sensors are connected, or none.
        health_changed: the sensors' health was asked for; see `health`.
    """

    changed = Signal()
    health_changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._feed: Feed | None = None
        self._health: dict[str, SensorHealth] = {}
        self._look = QTimer(self, interval=LOOK_MS)
        self._look.timeout.connect(self._ask)

    @property
    def feed(self) -> Feed | None:
        """The feed that runs, or None."""
        return self._feed

    @property
    def health(self) -> dict[str, SensorHealth]:
        """How each sensor was, at most half a second ago."""
        return self._health

    def start(self, sensors: Sequence[Sensor]) -> None:
        """Let these sensors run in the place of those before."""
        before = self._taken()
        if before is not None:
            before.stop()
        if sensors:
            self._feed = Feed(sensors)
            self._feed.start()
            self._look.start()
            self._ask()
        self.changed.emit()

    def adopt(self, feed: Feed) -> None:
        """Take over a feed that runs already, in the place of the one before, which the caller has stopped."""
        if feed is not self._feed:
            self._feed = feed
            self._look.start()
            self._ask()
            self.changed.emit()

    def stop(self) -> tuple[str, ...]:
        """Stop all sensors, within two seconds; return the names of those whose driver hangs."""
        feed = self.release()
        return () if feed is None else feed.stop()

    def release(self) -> Feed | None:
        """Return the feed that runs, for the caller to stop beside the window; from here on none is connected."""
        feed = self._taken()
        self.changed.emit()
        return feed

    def _taken(self) -> Feed | None:
        feed, self._feed = self._feed, None
        self._look.stop()
        self._health = {}
        return feed

    def _ask(self) -> None:
        if self._feed is not None:
            self._health = {sensor: self._feed.health(sensor) for sensor in self._feed.sensors}
            self.health_changed.emit()
