"""Sensors that do what a test says."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable, Iterable

import numpy as np

from fruitgui.errors import WorldError
from fruitgui.frame import Frame, Intrinsics
from fruitgui.sensors.sensor import EndOfStreamError, SensorInfo, SensorTimeoutError

CAMERA = Intrinsics(8, 6, 8.0, 8.0, 3.5, 2.5)
COLOR = np.zeros((6, 8, 3), np.uint8)
DEPTH = np.zeros((6, 8), np.uint16)


def small_frame(sensor: str, sequence: int, time_s: float | None = None) -> Frame:
    return Frame(sensor, sequence, 0.1 * sequence if time_s is None else time_s, COLOR, DEPTH, CAMERA)


class ScriptedSensor:
    """Gives frames as a test hands them in; raises what it is told to."""

    def __init__(self, name: str, frames: Iterable[Frame] = (), *, rate_hz: float = 10.0) -> None:
        self._name = name
        self._rate_hz = rate_hz
        self._changed = threading.Condition()
        self._waiting: deque[Frame | Exception] = deque(frames)
        self.opened = 0
        self.closed = 0
        self.hung = threading.Event()
        self.let_go = threading.Event()

    @property
    def info(self) -> SensorInfo:
        return SensorInfo(self._name, "test", "scripted", f"S-{self._name}", CAMERA, self._rate_hz)

    def give(self, *what: Frame | Exception) -> None:
        with self._changed:
            self._waiting.extend(what)
            self._changed.notify_all()

    def end(self) -> None:
        self.give(EndOfStreamError(self._name))

    def open(self) -> None:
        self.opened += 1

    def start(self) -> None:
        pass

    def read(self, timeout_s: float) -> Frame:
        until_s = time.monotonic() + timeout_s
        with self._changed:
            while not self._waiting:
                left_s = until_s - time.monotonic()
                if left_s <= 0:
                    raise SensorTimeoutError(self._name, timeout_s)
                self._changed.wait(left_s)
            what = self._waiting.popleft()
        if isinstance(what, Hang):
            self.hung.set()
            self.let_go.wait(60.0)
            return small_frame(self._name, 10**6)
        if isinstance(what, Exception):
            raise what
        return what

    def projector(self, on: bool) -> None:
        pass

    def stop(self) -> None:
        pass

    def close(self) -> None:
        self.closed += 1


class Hang(Exception):  # noqa: N818 - it is an order, not an error
    """Tells a scripted sensor to hang in its read."""


def gone(sensor: str) -> WorldError:
    return WorldError("sensor_gone", f"Sensor {sensor} is gone.", "Plug it in.")


def until(true: Callable[[], bool], within_s: float = 10.0) -> None:
    """Wait for a condition; fail where it does not come."""
    end_s = time.monotonic() + within_s
    while not true():
        assert time.monotonic() < end_s, "it did not happen in time"
        threading.Event().wait(0.005)
