"""Drivers and sensors of a checkup that do what a test says."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence

from fruitgui.errors import WorldError
from fruitgui.frame import Frame
from fruitgui.sensors.drivers import PluggedDevice
from fruitgui.sensors.sensor import Sensor, SensorInfo, SensorTimeoutError
from tests.unit.sensors.scripted import CAMERA, small_frame


class RunningSensor:
    """Gives a frame every `period_s`, leaving numbers out as `lose` says; or none, or cannot be opened, or hangs.

    Once it is `over` it falls silent, or fails with its `last`.
    """

    def __init__(self, serial: str, *, period_s: float = 0.02, promised_hz: float = 30.0) -> None:
        self._serial = serial
        self._period_s = period_s
        self._promised_hz = promised_hz
        self._sequence = 0
        self.lose = 0
        self.silent = False
        self.over = threading.Event()
        self.last: Exception | None = None
        self.error: Exception | None = None
        self.hangs = threading.Event()
        self.let_go = threading.Event()
        self.opened = self.closed = 0

    @property
    def info(self) -> SensorInfo:
        return SensorInfo(self._serial, "kinect", "made", self._serial, CAMERA, self._promised_hz)

    def open(self) -> None:
        self.opened += 1
        if self.hangs.is_set():
            self.let_go.wait(60.0)
        if self.error is not None:
            raise self.error

    def start(self) -> None:
        pass

    def read(self, timeout_s: float) -> Frame:
        if self.over.is_set():
            self.silent, self.error = self.last is None, self.last
        if self.error is not None:
            raise self.error
        if self.silent:
            time.sleep(timeout_s)
            raise SensorTimeoutError(self._serial, timeout_s)
        time.sleep(self._period_s)
        self._sequence += 1 + self.lose
        return small_frame(self._serial, self._sequence)

    def projector(self, on: bool) -> None:
        pass

    def stop(self) -> None:
        pass

    def close(self) -> None:
        self.closed += 1


class MadeDriver:
    """Lists the devices that a test plugs in; `before` is called whenever it is asked."""

    def __init__(
        self, make: str = "kinect", devices: Sequence[PluggedDevice] = (), before: Callable[[], None] = lambda: None
    ) -> None:
        self.make = make
        self.sensors = {device.serial: RunningSensor(device.serial) for device in devices}
        self.missing: WorldError | None = None
        self.asked = self.slow_looks = 0
        self._devices = list(devices)
        self._before = before

    def problem(self) -> WorldError | None:
        self.asked += 1
        self._before()
        return self.missing

    def devices(self) -> Sequence[PluggedDevice]:
        if self.slow_looks:
            self.slow_looks -= 1
            time.sleep(0.5)
            return []
        return self._devices

    def sensor(self, serial: str) -> Sensor:
        return self.sensors[serial]


def kinects(*serials: str) -> MadeDriver:
    """Return a driver that lists Kinects by their serials and tells nothing of where they hang."""
    return MadeDriver("kinect", [PluggedDevice("kinect", "Kinect 1414", serial) for serial in serials])
