"""Sensors that give rendered frames over and over, at a rate of real ones: they cost next to nothing while they run."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace

from fruitgui.frame import Frame
from fruitgui.sensors.sensor import SensorInfo, SensorTimeoutError


class LoopedSensor:
    """Gives its frames round after round; follows the `Sensor` protocol. Stamps and numbers go on.

    Args:
        info: who it is; its rate is that at which frames come.
        frames: one round, at least one. Their pictures are handed out as they are.
    """

    def __init__(self, info: SensorInfo, frames: Sequence[Frame]) -> None:
        self._info = info
        self._frames = tuple(frames)
        self._number = 0
        self._began_s = 0.0

    @property
    def info(self) -> SensorInfo:
        """Who this is."""
        return self._info

    def open(self) -> None:
        """Do nothing: there is no device."""

    def start(self) -> None:
        """Let the next frame be due at once."""
        self._began_s = time.monotonic() - self._number / self._info.rate_hz

    def read(self, timeout_s: float) -> Frame:
        """Return the next frame once its time has come."""
        due_s = self._began_s + self._number / self._info.rate_hz - time.monotonic()
        time.sleep(min(max(due_s, 0.0), timeout_s))
        if due_s > timeout_s:
            raise SensorTimeoutError(self._info.sensor, timeout_s)
        frame = self._frames[self._number % len(self._frames)]
        now = replace(frame, sequence=self._number, time_s=self._number / self._info.rate_hz)
        self._number += 1
        return now

    def projector(self, on: bool) -> None:
        """Do nothing: there is no light."""

    def stop(self) -> None:
        """Do nothing."""

    def close(self) -> None:
        """Do nothing."""
