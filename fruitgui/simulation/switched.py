"""Simulated sensors whose projectors are switched: what they give depends on who shines at that moment."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import replace

from fruitgui.frame import Frame
from fruitgui.sensors.sensor import SensorInfo
from fruitgui.sensors.shared import SharedSensor, SharedStream, Stream
from fruitgui.simulation.projector import Beams


class SwitchedStream:
    """Another stream's frames, as the projectors that are on light them when they are due; follows `Stream`.

    A sensor whose projector is off gives none.

    Args:
        stream: its frames are lit by each sensor's own steady light.
        beams: of its sensors.
        now_s: the time; the host's monotonic clock unless given.
    """

    def __init__(self, stream: Stream, beams: Beams, now_s: Callable[[], float] = time.monotonic) -> None:
        self._stream = stream
        self._beams = beams
        self._now_s = now_s
        self._lock = threading.Lock()
        self._on_s: dict[str, float] = {}

    def switch(self, sensor: str, on: bool) -> None:
        """Switch a projector. From any thread."""
        with self._lock:
            if on:
                self._on_s.setdefault(sensor, self._now_s())
            else:
                self._on_s.pop(sensor, None)

    def begin(self) -> None:
        """Begin at the beginning. Raises as the stream does."""
        self._stream.begin()

    def draw(self, timeout_s: float) -> Frame | None:
        """Return the next frame; None where none is due in time, or its sensor is dark. Raises as the stream does."""
        frame = self._stream.draw(timeout_s)
        if frame is None:
            return None
        with self._lock:
            now_s = self._now_s()
            on_for_s = {sensor: now_s - since_s for sensor, since_s in self._on_s.items()}
        depth_mm = self._beams.lit(frame.sensor, frame.sequence, frame.depth_mm, on_for_s)
        return None if depth_mm is None else replace(frame, depth_mm=depth_mm)

    def end(self) -> None:
        """Give back what was taken."""
        self._stream.end()


class SwitchedSensor:
    """One sensor of a shared stream, with its projector; follows the `Sensor` protocol."""

    def __init__(self, sensor: SharedSensor, stream: SwitchedStream) -> None:
        self._sensor = sensor
        self._stream = stream
        self._wanted = True
        self._started = False

    @property
    def info(self) -> SensorInfo:
        """Who this is."""
        return self._sensor.info

    def open(self) -> None:
        """Begin the stream, if no other sensor did. Raises as it does."""
        self._sensor.open()
        self._wanted = True

    def start(self) -> None:
        """Take part in the stream."""
        self._sensor.start()
        self._started = True
        self._shine()

    def read(self, timeout_s: float) -> Frame:
        """Return the next frame. Raises as the shared sensor does."""
        return self._sensor.read(timeout_s)

    def projector(self, on: bool) -> None:
        """Switch the projector; no frame of before it comes after it."""
        self._wanted = on
        self._shine()
        self._sensor.forget()

    def stop(self) -> None:
        """Go dark, and take part no longer."""
        self._started = False
        self._shine()
        self._sensor.stop()

    def close(self) -> None:
        """Leave the stream."""
        self.stop()
        self._sensor.close()

    def _shine(self) -> None:
        self._stream.switch(self.info.sensor, self._started and self._wanted)


def switched_sensors(stream: Stream, beams: Beams, infos: Sequence[SensorInfo]) -> list[SwitchedSensor]:
    """Return the sensors of a stream whose projectors are switched."""
    switched = SwitchedStream(stream, beams)
    return [SwitchedSensor(sensor, switched) for sensor in SharedStream(switched, infos).sensors()]
