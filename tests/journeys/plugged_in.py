"""`python -m tests.journeys.plugged_in ARGUMENTS`: the command line as where two sensors are plugged in.

They give pictures of noise, which hardly pack, at a size and a rate of real ones; `--` ends the options of this file:
`--rate HZ --frames N -- record …`. The frames of a sensor are numbered in their first depth values.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Mapping

import numpy as np

from fruitgui.cli.program import main
from fruitgui.frame import Frame, Intrinsics
from fruitgui.sensors.sensor import EndOfStreamError, Sensor, SensorInfo, SensorTimeoutError
from fruitgui.station import devices

CAMERA = Intrinsics(640, 480, 525.0, 525.0, 319.5, 239.5)
NAMES = ("kinect_1", "kinect_2")


class NoiseSensor:
    """Gives frames at a rate, as many as it is told."""

    def __init__(self, name: str, rate_hz: float, frames: int) -> None:
        draw = np.random.default_rng(len(name))
        self.info = SensorInfo(name, "Microsoft", "Kinect 1414", f"A0-{name}", CAMERA, rate_hz)
        self._color = draw.integers(0, 256, (480, 640, 3), np.uint8)
        self._depth = draw.integers(500, 4000, (480, 640), np.uint16)
        self._frames = frames
        self._number = 0
        self._began_s = 0.0

    def open(self) -> None: ...

    def start(self) -> None:
        self._began_s = time.monotonic() - self._number / self.info.rate_hz

    def read(self, timeout_s: float) -> Frame:
        if self._number >= self._frames:
            raise EndOfStreamError(self.info.sensor)
        due_s = self._began_s + self._number / self.info.rate_hz - time.monotonic()
        time.sleep(min(max(due_s, 0.0), timeout_s))
        if due_s > timeout_s:
            raise SensorTimeoutError(self.info.sensor, timeout_s)
        depth = self._depth.copy()
        depth[0, :2] = divmod(self._number, 1000)
        depth[0, :2] += 1
        frame = Frame(self.info.sensor, self._number, self._number / self.info.rate_hz, self._color, depth, CAMERA)
        self._number += 1
        return frame

    def projector(self, on: bool) -> None: ...

    def stop(self) -> None: ...

    def close(self) -> None: ...


def number_of(frame: Frame) -> int:
    """Return which of its sensor's frames this was."""
    return int(frame.depth_mm[0, 0] - 1) * 1000 + int(frame.depth_mm[0, 1] - 1)


def plugged_in(arguments: list[str]) -> int:
    ours, theirs = arguments[: arguments.index("--")], arguments[arguments.index("--") + 1 :]
    parser = argparse.ArgumentParser()
    parser.add_argument("--rate", type=float, default=30.0)
    parser.add_argument("--frames", type=int, default=10**9)
    options = parser.parse_args(ours)

    def found(names: Mapping[str, str]) -> list[Sensor]:
        return devices.named_by_serial([NoiseSensor(name, options.rate, options.frames) for name in NAMES], names)

    devices.connected_devices = found  # type: ignore[assignment]
    return main(theirs)


if __name__ == "__main__":
    sys.exit(plugged_in(sys.argv[1:]))
