"""A sensor whose exposure and white balance are held once they have found the light."""

from __future__ import annotations

from dataclasses import replace
from typing import Protocol, runtime_checkable

from fruitgui.errors import FruitguiError
from fruitgui.frame import Frame
from fruitgui.sensors.sensor import ColorLock, Sensor, SensorInfo

SETTLE_S = 5.0
"""By then automatic exposure and white balance have found the light; what changes later is the light's own change."""


@runtime_checkable
class LockableSensor(Sensor, Protocol):
    """A sensor that can hold its exposure and its white balance."""

    def lock_color(self, on: bool) -> bool:
        """Hold both as they are, or let them follow the light; tell whether it could be done.

        Raises:
            WorldError: the device is not open, or does not answer.
        """


class HeldColor:
    """Another sensor; follows the `Sensor` protocol. Each time it is started it finds the light anew."""

    def __init__(self, sensor: LockableSensor) -> None:
        self._sensor = sensor
        self._lock = ColorLock.LOCKABLE
        self._first_s: float | None = None

    @property
    def info(self) -> SensorInfo:
        """Who this is, and whether its colours are held now."""
        return replace(self._sensor.info, color_lock=self._lock)

    def open(self) -> None:
        """Take the device."""
        self._sensor.open()

    def start(self) -> None:
        """Begin to capture, and to find the light."""
        if self._lock is ColorLock.LOCKED:
            self._try(on=False)
        self._lock, self._first_s = ColorLock.LOCKABLE, None
        self._sensor.start()

    def read(self, timeout_s: float) -> Frame:
        """Return the next frame. Raises as the sensor does."""
        frame = self._sensor.read(timeout_s)
        if self._first_s is None:
            self._first_s = frame.time_s
        if self._lock is ColorLock.LOCKABLE and frame.time_s - self._first_s >= SETTLE_S:
            self._lock = ColorLock.LOCKED if self._try(on=True) else ColorLock.AUTOMATIC
        return frame

    def projector(self, on: bool) -> None:
        """Switch the projector."""
        self._sensor.projector(on)

    def stop(self) -> None:
        """End capturing."""
        self._sensor.stop()

    def close(self) -> None:
        """Give the device back."""
        self._sensor.close()

    def _try(self, *, on: bool) -> bool:
        """Hold, or let go; a device that does not answer to that may still give frames."""
        try:
            return self._sensor.lock_color(on)
        except FruitguiError:
            return False


def held(sensor: Sensor) -> Sensor:
    """Return a sensor whose colours are held, where it can hold them."""
    return HeldColor(sensor) if isinstance(sensor, LockableSensor) else sensor
