"""What every sensor keeps to, whatever its make: `walk` goes through it once."""

from __future__ import annotations

import time

import numpy as np
import pytest

from fruitgui.errors import FruitguiError
from fruitgui.frame import Frame
from fruitgui.sensors.sensor import EndOfStreamError, Projector, Sensor, SensorTimeoutError
from fruitgui.station.station_file import SENSOR_ID

LONGEST_S = 30.0
NEAREST_MM, FARTHEST_MM = 100, 20_000
"""Whoever gave metres or tenths of millimetres would lie outside of this."""


def walk(sensor: Sensor, frames: int = 6) -> None:
    """Go through the life of a sensor that is there, twice; it gives at least so many frames each time."""
    before = sensor.info
    assert SENSOR_ID.fullmatch(before.sensor)
    assert before.rate_hz > 0
    sensor.stop()
    sensor.close()
    with pytest.raises(FruitguiError):
        sensor.read(0.05)
    for _ in range(2):
        sensor.open()
        sensor.start()
        came = [next_frame(sensor) for _ in range(frames)]
        check(came, sensor)
        sensor.stop()
        sensor.start()
        check([next_frame(sensor) for _ in range(frames)], sensor)
        if sensor.info.projector is Projector.SWITCHED:
            check_darkness(sensor)
        for _ in range(2):
            sensor.stop()
        for _ in range(2):
            sensor.close()
        with pytest.raises(FruitguiError):
            sensor.read(0.05)
    after = sensor.info
    assert (after.sensor, after.make, after.serial, after.rate_hz) == (
        before.sensor, before.make, before.serial, before.rate_hz,
    )  # fmt: skip


def next_frame(sensor: Sensor) -> Frame:
    """Return a sensor's next frame, however often it is asked in vain."""
    until_s = time.monotonic() + LONGEST_S
    while True:
        try:
            return sensor.read(0.01)
        except EndOfStreamError:
            raise
        except SensorTimeoutError:
            if time.monotonic() > until_s:
                raise


def check(frames: list[Frame], sensor: Sensor) -> None:
    """See that frames are what they should be, and stay what they were."""
    kept = [(frame.color.copy(), frame.depth_mm.copy()) for frame in frames]
    assert (np.diff([frame.sequence for frame in frames]) > 0).all()
    assert (np.diff([frame.time_s for frame in frames]) > 0).all()
    for frame in frames:
        shape = (frame.intrinsics.height, frame.intrinsics.width)
        assert frame.sensor == sensor.info.sensor
        assert (frame.color.dtype, frame.color.shape) == (np.uint8, (*shape, 3))
        assert (frame.depth_mm.dtype, frame.depth_mm.shape) == (np.uint16, shape)
        assert frame.intrinsics == sensor.info.intrinsics
        seen = frame.depth_mm[frame.depth_mm > 0]
        assert len(seen)
        assert NEAREST_MM < np.median(seen) < FARTHEST_MM
    next_frame(sensor)
    assert all(
        (frame.color == color).all() and (frame.depth_mm == depth).all()
        for frame, (color, depth) in zip(frames, kept, strict=True)
    )


def check_darkness(sensor: Sensor) -> None:
    """See that nothing comes in the dark, and that it comes again in the light."""
    sensor.projector(on=False)
    with pytest.raises(SensorTimeoutError):
        sensor.read(0.3)
    sensor.projector(on=True)
    next_frame(sensor)
    sensor.stop()
    sensor.projector(on=False)
    sensor.start()
    with pytest.raises(SensorTimeoutError):
        sensor.read(0.3)
    sensor.projector(on=True)
    next_frame(sensor)
