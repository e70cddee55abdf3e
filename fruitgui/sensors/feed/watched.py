"""A sensor whose calls are watched from outside: a driver that does not come back is noticed."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeVar

from fruitgui.frame import Frame
from fruitgui.sensors.sensor import Projector, Sensor, SensorInfo

T = TypeVar("T")

OPENING_S, CALL_S, LATE_CALL_S = 20.0, 2.0, 10.0
"""Longer than this no call takes that comes back: opening and starting may upload firmware, anything else may not. For
one whose light disturbs nobody, as of a recording on a slow disk, nobody waits: it is given longer."""


class WatchedSensor:
    """Another sensor; follows the `Sensor` protocol. `hangs` may be asked from any thread."""

    def __init__(self, sensor: Sensor) -> None:
        self._sensor = sensor
        self._call_s = CALL_S if sensor.info.projector is Projector.SWITCHED else LATE_CALL_S
        self._until_s: float | None = None

    @property
    def hangs(self) -> bool:
        """Whether the present call should have come back long ago."""
        until_s = self._until_s
        return until_s is not None and time.monotonic() > until_s

    @property
    def info(self) -> SensorInfo:
        """Who this is."""
        return self._sensor.info

    def open(self) -> None:
        """Take the device."""
        self._watch(OPENING_S, self._sensor.open)

    def start(self) -> None:
        """Begin to capture."""
        self._watch(OPENING_S, self._sensor.start)

    def read(self, timeout_s: float) -> Frame:
        """Return the next frame. Raises as the sensor does."""
        return self._watch(self._call_s + timeout_s, lambda: self._sensor.read(timeout_s))

    def projector(self, on: bool) -> None:
        """Switch the projector."""
        self._watch(self._call_s, lambda: self._sensor.projector(on))

    def stop(self) -> None:
        """End capturing."""
        self._watch(self._call_s, self._sensor.stop)

    def close(self) -> None:
        """Give the device back."""
        self._watch(self._call_s, self._sensor.close)

    def _watch(self, most_s: float, call: Callable[[], T]) -> T:
        self._until_s = time.monotonic() + most_s
        try:
            return call()
        finally:
            self._until_s = None
