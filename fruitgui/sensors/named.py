"""A sensor under the name that a person gave it."""

from __future__ import annotations

from dataclasses import replace

from fruitgui.frame import Frame
from fruitgui.sensors.sensor import Sensor, SensorInfo


class NamedSensor:
    """Another sensor whose frames carry another id; follows the `Sensor` protocol."""

    def __init__(self, sensor: Sensor, name: str) -> None:
        self._sensor = sensor
        self._name = name

    @property
    def info(self) -> SensorInfo:
        """Who this is."""
        return replace(self._sensor.info, sensor=self._name)

    def open(self) -> None:
        """Take the device."""
        self._sensor.open()

    def start(self) -> None:
        """Begin to capture."""
        self._sensor.start()

    def read(self, timeout_s: float) -> Frame:
        """Return the next frame. Raises as the sensor does."""
        return replace(self._sensor.read(timeout_s), sensor=self._name)

    def projector(self, on: bool) -> None:
        """Switch the projector."""
        self._sensor.projector(on)

    def stop(self) -> None:
        """End capturing."""
        self._sensor.stop()

    def close(self) -> None:
        """Give the device back."""
        self._sensor.close()
