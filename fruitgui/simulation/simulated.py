"""A simulated sensor: plays its captures of a scene through the same protocol as a real one."""

from __future__ import annotations

import time
from dataclasses import replace
from typing import Protocol

import numpy as np

from fruitgui.errors import WorldError
from fruitgui.frame import Frame
from fruitgui.sensors.sensor import ColorLock, EndOfStreamError, SensorInfo, SensorTimeoutError
from fruitgui.simulation.simulation import Simulation


class Clock(Protocol):
    """What time it is in the scene."""

    def wait_until(self, scene_s: float, timeout_s: float) -> bool:
        """Wait until a time of the scene, at most `timeout_s`; tell whether it has come."""


class FreeClock:
    """Time that never keeps anyone waiting: as fast as frames can be made."""

    def wait_until(self, scene_s: float, timeout_s: float) -> bool:  # noqa: ARG002 - it is always time
        """Tell that the time has come."""
        return True


class PacedClock:
    """Time as on the wall; it begins at the first question and is shared by the sensors of a scene."""

    def __init__(self, speed: float = 1.0) -> None:
        """Make a clock that runs `speed` times as fast as the wall's."""
        self._speed = speed
        self._start_s: float | None = None

    def wait_until(self, scene_s: float, timeout_s: float) -> bool:
        """Wait until a time of the scene, at most `timeout_s`; tell whether it has come."""
        now_s = time.monotonic()
        if self._start_s is None:
            self._start_s = now_s
        due_s = self._start_s + scene_s / self._speed
        time.sleep(max(min(due_s - now_s, timeout_s), 0.0))
        return due_s <= now_s + timeout_s


class SimulatedSensor:
    """One sensor of a scene. Several may play one scene, each on a thread of its own."""

    def __init__(self, sim: Simulation, sensor: str, clock: Clock) -> None:
        """Prepare; nothing is rendered and no thread started."""
        self._sim = sim
        self._numbers = [n for n, capture in enumerate(sim.captures) if capture.sensor == sensor]
        self._clock = clock
        self._info = sensor_info(sim, sensor)
        self._next = 0
        self._open = False
        self._running = False
        self._projector = True

    @property
    def info(self) -> SensorInfo:
        """Who this is."""
        return self._info

    def open(self) -> None:
        """Take the device."""
        self._open = True

    def start(self) -> None:
        """Begin to capture, from the scene's first frame.

        Raises:
            WorldError: it is not open.
        """
        if not self._open:
            raise WorldError(
                "sensor_not_open",
                f"Sensor {self._info.sensor} is not open.",
                "Open it first.",
                values={"sensor": self._info.sensor},
            )
        self._next = 0
        self._running = True

    def read(self, timeout_s: float) -> Frame:
        """Return the next frame; without the projector it has no depth.

        Raises:
            WorldError: it was not started.
            SensorTimeoutError: none came in time.
            EndOfStreamError: the scene is over.
        """
        if not self._running:
            raise WorldError(
                "sensor_not_started",
                f"Sensor {self._info.sensor} is not running.",
                "Start it first.",
                values={"sensor": self._info.sensor},
            )
        if self._next >= len(self._numbers):
            raise EndOfStreamError(self._info.sensor)
        number = self._numbers[self._next]
        if not self._clock.wait_until(self._sim.captures[number].time_s, timeout_s):
            raise SensorTimeoutError(self._info.sensor, timeout_s)
        self._next += 1
        frame = self._sim.frame(number)
        return frame if self._projector else replace(frame, depth_mm=np.zeros_like(frame.depth_mm))

    def projector(self, on: bool) -> None:
        """Switch the projector."""
        self._projector = on

    def stop(self) -> None:
        """End capturing."""
        self._running = False

    def close(self) -> None:
        """Give the device back."""
        self._running = False
        self._open = False


def sensor_info(sim: Simulation, sensor: str) -> SensorInfo:
    """Return who a sensor of a scene is."""
    device = sim.device(sensor)
    times_s = [capture.time_s for capture in sim.captures if capture.sensor == sensor]
    rate_hz = 1.0 / float(np.median(np.diff(times_s))) if len(times_s) > 1 else 0.0
    return SensorInfo(
        sensor,
        "fruitgui",
        "simulated Kinect v1",
        device.serial,
        device.color_camera,
        round(rate_hz, 1),
        color_lock=ColorLock.LOCKED,
    )
