"""Several sensors that come out of one stream: whoever waits for a frame draws for all."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Iterable
from typing import Protocol

from fruitgui.errors import WorldError
from fruitgui.frame import Frame
from fruitgui.sensors.sensor import EndOfStreamError, SensorInfo, SensorTimeoutError

MOST_HELD = 16
"""Frames of one sensor that may wait for it while others draw."""


class Stream(Protocol):
    """Frames of several sensors, one after the other. Never called by two threads at a time."""

    def begin(self) -> None:
        """Begin at the beginning. Raises `FruitguiError` where that cannot be."""

    def draw(self, timeout_s: float) -> Frame | None:
        """Return the next frame; None where none is due in time.

        Raises:
            StopIteration: there are no more.
            FruitguiError: it broke.
        """

    def end(self) -> None:
        """Give back what was taken. Any number of times."""


class SharedStream:
    """Gives each sensor its own frames of one stream.

    The stream begins when the first sensor is opened and ends when the last one is closed. Frames for a sensor that
    does not run are let go; one that runs but does not read makes the others wait.
    """

    def __init__(self, stream: Stream, infos: Iterable[SensorInfo]) -> None:
        self._stream = stream
        self._infos = {info.sensor: info for info in infos}
        self._queues: dict[str, deque[Frame]] = {sensor: deque() for sensor in self._infos}
        self._opened: set[str] = set()
        self._running: set[str] = set()
        self._changed = threading.Condition()
        self._drawing = False
        self._pending: Frame | None = None
        self._over = False

    def sensors(self) -> list[SharedSensor]:
        """Return the sensors."""
        return [SharedSensor(self, info) for info in self._infos.values()]

    def open(self, sensor: str) -> None:
        """Begin, if this is the first."""
        with self._changed:
            if not self._opened:
                self._begin()
            self._opened.add(sensor)

    def run(self, sensor: str, on: bool) -> None:
        """Let a sensor take part, or not."""
        with self._changed:
            (self._running.add if on else self._running.discard)(sensor)
            if not on:
                self._queues[sensor].clear()
            self._changed.notify_all()

    def forget(self, sensor: str) -> None:
        """Let go of the frames that wait for a sensor."""
        with self._changed:
            self._queues[sensor].clear()
            if self._pending is not None and self._pending.sensor == sensor:
                self._pending = None
            self._changed.notify_all()

    def close(self, sensor: str) -> None:
        """End, if this was the last."""
        self.run(sensor, False)
        with self._changed:
            last = self._opened == {sensor}
            self._opened.discard(sensor)
            while last and self._drawing:
                self._changed.wait(0.1)
            if last:
                self._stream.end()

    def read(self, sensor: str, timeout_s: float) -> Frame:
        """Return a sensor's next frame, drawing for all where nobody else does."""
        until_s = time.monotonic() + timeout_s
        with self._changed:
            while True:
                self._hand_out()
                if self._queues[sensor] and sensor in self._running:
                    self._changed.notify_all()
                    return self._queues[sensor].popleft()
                self._check(sensor, timeout_s, until_s)
                if self._drawing or self._pending is not None:
                    self._changed.wait(min(0.1, max(until_s - time.monotonic(), 0.0)))
                else:
                    self._draw(until_s - time.monotonic())

    def _begin(self) -> None:
        for queue in self._queues.values():
            queue.clear()
        self._over, self._pending = False, None
        self._stream.begin()

    def _check(self, sensor: str, timeout_s: float, until_s: float) -> None:
        if self._over and self._pending is None:
            raise EndOfStreamError(sensor)
        if sensor not in self._running:
            raise WorldError(
                "sensor_not_started", f"Sensor {sensor} is not running.", "Start it first.", values={"sensor": sensor}
            )
        if time.monotonic() >= until_s:
            raise SensorTimeoutError(sensor, timeout_s)

    def _draw(self, timeout_s: float) -> None:
        """Draw one frame with the lock given back meanwhile."""
        self._drawing = True
        self._changed.release()
        try:
            drawn, over = self._stream.draw(timeout_s), False
        except StopIteration:
            drawn, over = None, True
        finally:
            self._changed.acquire()
            self._drawing = False
            self._changed.notify_all()
        self._over = self._over or over
        self._pending = drawn

    def _hand_out(self) -> None:
        """Give the drawn frame to its sensor, if that one has room or does not take part."""
        frame = self._pending
        if frame is None:
            return
        queue = self._queues[frame.sensor]
        if len(queue) >= MOST_HELD and frame.sensor in self._running:
            return
        if len(queue) >= MOST_HELD:
            queue.popleft()
        queue.append(frame)
        self._pending = None
        self._changed.notify_all()


class SharedSensor:
    """One sensor of a shared stream; follows the `Sensor` protocol."""

    def __init__(self, shared: SharedStream, info: SensorInfo) -> None:
        self._shared = shared
        self._info = info

    @property
    def info(self) -> SensorInfo:
        """Who this is."""
        return self._info

    def open(self) -> None:
        """Begin the stream, if no other sensor did."""
        self._shared.open(self._info.sensor)

    def start(self) -> None:
        """Take part in the stream."""
        self._shared.run(self._info.sensor, True)

    def read(self, timeout_s: float) -> Frame:
        """Return the next frame.

        Raises:
            SensorTimeoutError: none came in time.
            EndOfStreamError: none will come.
            WorldError: it was not started, or the stream broke.
        """
        return self._shared.read(self._info.sensor, timeout_s)

    def projector(self, on: bool) -> None:
        """Do nothing: the frames were lit when they were made."""

    def forget(self) -> None:
        """Let go of the frames that wait to be read."""
        self._shared.forget(self._info.sensor)

    def stop(self) -> None:
        """Take part no longer."""
        self._shared.run(self._info.sensor, False)

    def close(self) -> None:
        """Leave the stream; the last one ends it."""
        self._shared.close(self._info.sensor)
