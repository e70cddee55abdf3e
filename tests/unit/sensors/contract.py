"""What every sensor keeps to, whatever its make: `walk` goes through it once."""

from __future__ import annotations

import time

import numpy as np
import pytest

from fruitgui.errors import FruitguiError, WorldError
from fruitgui.frame import Frame
from fruitgui.sensors.sensor import EndOfStreamError, Projector, Sensor, SensorTimeoutError
from fruitgui.station.station_file import SENSOR_ID

LONGEST_S = 30.0
WAIT_S, PATIENCE_S = 0.1, 10.0
"""So long a read waits that gives nothing; and what of it may come late, however busy the machine is."""
NEAREST_MM, FARTHEST_MM = 100, 20_000
"""Whoever gave metres or tenths of millimetres would lie outside of this."""


def walk(sensor: Sensor, frames: int = 6) -> None:
    """Go through the life of a sensor that is there, twice; it gives at least so many frames each time."""
    before = sensor.info
    assert SENSOR_ID.fullmatch(before.sensor)
    assert before.rate_hz > 0
    sensor.stop()
    sensor.close()
    check_gives_nothing(sensor)
    for _ in range(2):
        sensor.open()
        check_gives_nothing(sensor)
        sensor.start()
        came = [next_frame(sensor) for _ in range(frames)]
        assert came[0].sequence >= 0
        check(came, sensor)
        sensor.stop()
        check_gives_nothing(sensor)
        sensor.start()
        check([next_frame(sensor) for _ in range(frames)], sensor)
        if sensor.info.projector is Projector.SWITCHED:
            check_darkness(sensor)
        for _ in range(2):
            sensor.stop()
        for _ in range(2):
            sensor.close()
        check_gives_nothing(sensor)
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


def check_gives_nothing(sensor: Sensor) -> None:
    """See that a sensor that does not run says so, in words, at once or when the time is up."""
    for wait_s in (0.0, WAIT_S):
        began_s = time.monotonic()
        with pytest.raises(FruitguiError) as said:
            sensor.read(wait_s)
        assert time.monotonic() - began_s < wait_s + PATIENCE_S
        assert said.value.code
        assert said.value.remedy


def check_is_refused(sensor: Sensor) -> None:
    """See that a sensor that is not there says so, each time, and is still known by its name."""
    before = sensor.info
    for _ in range(2):
        with pytest.raises(WorldError) as said:
            sensor.open()
        assert said.value.code
        assert said.value.remedy
        check_gives_nothing(sensor)
        for _ in range(2):
            sensor.stop()
            sensor.close()
    assert sensor.info == before


def check_waits(sensor: Sensor) -> None:
    """See that a sensor of which nothing comes keeps its reader waiting for as long as it was told to."""
    began_s = time.monotonic()
    with pytest.raises(SensorTimeoutError) as silence:
        sensor.read(WAIT_S)
    assert WAIT_S * 0.9 < time.monotonic() - began_s < WAIT_S + PATIENCE_S
    assert silence.value.remedy
    with pytest.raises(SensorTimeoutError):
        sensor.read(0.0)


def check_end(sensor: Sensor, frames: int) -> None:
    """See that a sensor that plays so many frames says when it is over, as often as it is asked."""
    sensor.open()
    sensor.start()
    for _ in range(frames):
        next_frame(sensor)
    for _ in range(2):
        with pytest.raises(EndOfStreamError):
            next_frame(sensor)
    sensor.stop()
    sensor.close()
    sensor.open()
    sensor.start()
    next_frame(sensor)
    sensor.stop()
    sensor.close()


def check_darkness(sensor: Sensor) -> None:
    """See that nothing comes in the dark, and that it comes again in the light."""
    sensor.projector(on=False)
    check_waits(sensor)
    sensor.projector(on=True)
    next_frame(sensor)
    sensor.stop()
    sensor.projector(on=False)
    sensor.start()
    check_waits(sensor)
    sensor.projector(on=True)
    next_frame(sensor)
