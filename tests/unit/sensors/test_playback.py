from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fruitgui.errors import InputError
from fruitgui.frame import Intrinsics
from fruitgui.sensors.ahead import ReadAhead
from fruitgui.sensors.depth_correction import DepthCorrection
from fruitgui.sensors.playback import PlaybackSensor, playback_sensors
from fruitgui.sensors.recordings import open_recording
from fruitgui.sensors.sensor import EndOfStreamError, Sensor
from tests.unit.sensors import ros_files as ros

CAMERA = Intrinsics(64, 48, 60.0, 61.0, 31.5, 23.5)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    messages = [m for n in range(5) for sensor in ("k1", "k2") for m in ros.frameset(sensor, 1.0 + n / 10)]
    return ros.write_mcap(tmp_path / "r.mcap", messages)


def test_plays_one_sensor_as_often_as_it_is_started(path: Path) -> None:
    sensor: Sensor = PlaybackSensor(path, "k2", name="left")
    assert sensor.info.sensor == "left"
    sensor.open()
    for _ in range(2):
        sensor.start()
        sensor.projector(True)
        frames = [sensor.read(1.0) for _ in range(5)]
        assert [frame.time_s for frame in frames] == pytest.approx([1.0, 1.1, 1.2, 1.3, 1.4])
        assert {frame.sensor for frame in frames} == {"left"}
        for _ in range(2):
            with pytest.raises(EndOfStreamError):
                sensor.read(1.0)
    sensor.stop()
    sensor.close()
    with pytest.raises(EndOfStreamError):
        sensor.read(1.0)


def test_every_sensor_of_a_recording(path: Path) -> None:
    assert [sensor.info.sensor for sensor in playback_sensors(path)] == ["k1", "k2"]
    with pytest.raises(InputError):
        PlaybackSensor(path, "k3")


def test_depth_is_corrected_once_where_it_is_read(path: Path) -> None:
    correction = DepthCorrection(scale=1.01, offset_m=-0.004)
    recording = open_recording(path)
    plain = [frame for _, frame in recording.frames() if frame.sensor == "k1"]
    corrected = [frame for _, frame in recording.frames(corrections={"k1": correction}) if frame.sensor == "k1"]
    for before, after in zip(plain, corrected, strict=True):
        np.testing.assert_array_equal(after.depth_mm, correction.apply(before.depth_mm, CAMERA))
        assert not np.array_equal(after.depth_mm, before.depth_mm)
    others = [frame for _, frame in recording.frames(corrections={"k1": correction}) if frame.sensor == "k2"]
    np.testing.assert_array_equal(others[0].depth_mm, ros.depth(1.0))


@given(
    scale=st.floats(0.9, 1.1), offset_m=st.floats(-0.05, 0.05), radial_2=st.sampled_from([0.0, 0.02, -0.01]),
    radial_4=st.sampled_from([0.0, 0.01]),
)  # fmt: skip
def test_correction_is_the_formula_to_half_a_millimetre(
    scale: float, offset_m: float, radial_2: float, radial_4: float
) -> None:
    mm = ros.depth(1.0)
    got = DepthCorrection(scale, offset_m, radial_2, radial_4).apply(mm, CAMERA)
    r2 = (CAMERA.rays().astype(np.float64) ** 2).sum(axis=-1)
    true = (scale + radial_2 * r2 + radial_4 * r2**2) * mm + offset_m * 1e3
    assert (got[mm == 0] == 0).all()
    assert np.abs(got - true)[mm > 0].max() <= 0.5 + 1e-3


def test_correction_beyond_what_depth_can_say_is_no_reading() -> None:
    mm = np.array([[0, 1, 40, 60000, 65535]], np.uint16)
    camera = Intrinsics(5, 1, 1.0, 1.0, 2.0, 0.0)
    assert DepthCorrection(1.2, -0.05).apply(mm, camera).tolist() == [[0, 0, 0, 0, 0]]
    assert DepthCorrection().apply(mm, camera) is mm


def numbers(count: int, ended: threading.Event) -> Iterator[int]:
    try:
        yield from range(count)
    finally:
        ended.set()


def test_reading_ahead_gives_the_same_in_order() -> None:
    ended = threading.Event()
    with ReadAhead(numbers(100, ended), 3) as ahead:
        assert list(ahead) == list(range(100))
        assert list(ahead) == []
    assert ended.wait(1.0)


def test_no_more_is_drawn_ahead_than_asked() -> None:
    taken, drawn = [0], [0]
    farthest = [0]
    full = threading.Event()

    def source() -> Iterator[int]:
        for number in range(100):
            drawn[0] = number + 1
            farthest[0] = max(farthest[0], drawn[0] - taken[0])
            if farthest[0] >= 4:
                full.set()
            yield number

    with ReadAhead(source(), 4) as ahead:
        next(ahead)
        taken[0] += 1
        assert full.wait(5.0)
        for _ in ahead:
            taken[0] += 1
    # Four wait, one is in the thread's hand and one in ours.
    assert 4 <= farthest[0] <= 6
    assert drawn == [100]


def test_closing_in_the_middle_ends_the_thread_at_once_and_the_source_with_it() -> None:
    ended = threading.Event()
    ahead = ReadAhead(numbers(10**9, ended), 2)
    next(iter(ahead))
    began = time.monotonic()
    ahead.close()
    ahead.close()
    assert time.monotonic() - began < 2.0
    assert ended.is_set()
    assert "read-ahead" not in {thread.name for thread in threading.enumerate()}
    assert list(ahead) == []


def test_an_error_comes_where_its_item_would_have() -> None:
    def source() -> Iterator[int]:
        yield 1
        raise InputError("x", "broken", "mend it")

    with ReadAhead(source()) as ahead:
        assert next(ahead) == 1
        with pytest.raises(InputError, match="broken"):
            next(ahead)
        assert list(ahead) == []


def test_a_recording_read_ahead_is_the_same_recording(path: Path) -> None:
    recording = open_recording(path)
    plain = [(time_s, frame.sensor, frame.sequence) for time_s, frame in recording.frames()]
    assert [(time_s, frame.sensor, frame.sequence) for time_s, frame in recording.frames(ahead=3)] == plain
    assert recording.tally.frames == {"k1": 5, "k2": 5}
    frames = recording.frames(ahead=3)
    next(frames)
    frames.close()
    assert "read-ahead" not in {thread.name for thread in threading.enumerate()}
