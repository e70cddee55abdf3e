"""A recording that behaves like its sensors."""

from __future__ import annotations

import threading
import time
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from fruitgui.frame import Frame
from fruitgui.sensors.feed import Feed, WaitForRoom
from fruitgui.sensors.named import NamedSensor
from fruitgui.sensors.player import AtSpeed, FlatOut, Pace, recorded_sensors
from fruitgui.sensors.recordings import RecordingWriter, open_recording
from tests.unit.sensors.contract import check_gives_nothing, next_frame
from tests.unit.sensors.scripted import ScriptedSensor, small_frame, until

pytestmark = pytest.mark.usefixtures("no_leaked_threads")


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("player") / "two.mcap"
    infos = [ScriptedSensor(name).info for name in ("left", "right")]
    with RecordingWriter(path, infos) as writer:
        for n in range(20):
            writer.write(small_frame("left", n, 5.0 + 0.1 * n))
            writer.write(small_frame("right", n, 5.05 + 0.1 * n))
    return path


def played(path: Path, pace: Pace, most: int = 1000, *, looped: bool = False) -> tuple[list[Frame], float]:
    feed = Feed(recorded_sensors(path, pace, looped=looped))
    queue = feed.subscribe(WaitForRoom(8))
    began_s = time.monotonic()
    feed.start()
    frames: list[Frame] = []
    while not queue.over and len(frames) < most:
        arrival = queue.take(1.0)
        if arrival is not None:
            frames.append(arrival.frame)
    took_s = time.monotonic() - began_s
    assert feed.stop() == ()
    return frames, took_s


def test_flat_out_every_frame_comes_once(recording: Path) -> None:
    frames, took_s = played(recording, FlatOut())
    for sensor in ("left", "right"):
        assert [one.sequence for one in frames if one.sensor == sensor] == list(range(20))
    assert took_s < 1.9


def test_at_its_own_pace_it_lasts_as_long_as_it_did(recording: Path) -> None:
    frames, took_s = played(recording, AtSpeed(2.0))
    assert len(frames) == 40
    assert 0.9 < took_s < 3.0


def test_looped_it_goes_on_with_growing_stamps_and_numbers(recording: Path) -> None:
    frames, _ = played(recording, FlatOut(), most=130, looped=True)
    for sensor in ("left", "right"):
        own = [one for one in frames if one.sensor == sensor]
        assert [one.sequence for one in own] == list(range(len(own)))
        steps = [later.time_s - earlier.time_s for earlier, later in pairwise(own)]
        assert np.allclose(steps, 0.1, atol=1e-6)


def test_one_thread_reads_all_rounds(recording: Path) -> None:
    (left, _) = sensors = recorded_sensors(recording, FlatOut(), looped=True)
    for sensor in sensors:
        sensor.open()
    left.start()
    readers = set[threading.Thread]()
    while left.read(5.0).sequence < 70:
        readers |= {thread for thread in threading.enumerate() if thread.name == "read-ahead"}
    for sensor in sensors:
        sensor.close()
    assert len(readers) == 1


def test_a_sensor_that_nobody_runs_holds_nobody(recording: Path) -> None:
    left, _ = recorded_sensors(recording, FlatOut())
    feed = Feed([left])
    queue = feed.subscribe(WaitForRoom(8))
    feed.start()
    taken = []
    while not queue.over:
        arrival = queue.take(1.0)
        if arrival is not None:
            taken.append(arrival.frame.sequence)
    feed.stop()
    assert taken == list(range(20))


def test_it_can_be_opened_again_and_begins_anew(recording: Path) -> None:
    left, right = recorded_sensors(recording, FlatOut())
    for _ in range(3):
        for sensor in (left, right):
            sensor.open()
            sensor.start()
        assert [sensor.read(1.0).sequence for sensor in (left, right)] == [0, 0]
        for sensor in (left, right):
            sensor.stop()
            sensor.close()


def test_one_that_does_not_run_gives_nothing_that_another_ones_reading_drew(recording: Path) -> None:
    left, right = recorded_sensors(recording, FlatOut())
    for sensor in (left, right):
        sensor.open()
    left.start()
    for _ in range(2):
        assert [next_frame(left).sensor for _ in range(4)] == ["left"] * 4
        check_gives_nothing(right)
        right.start()
        assert next_frame(right).sensor == "right"
        right.stop()
    for sensor in (left, right):
        sensor.close()


def test_its_sensors_are_those_of_the_recording(recording: Path) -> None:
    assert {one.info.sensor for one in recorded_sensors(recording)} == set(open_recording(recording).sensors)


def test_a_name_that_a_person_gave_is_carried_by_the_frames(recording: Path) -> None:
    feed = Feed([NamedSensor(sensor, f"my_{sensor.info.sensor}") for sensor in recorded_sensors(recording, FlatOut())])
    feed.start()
    until(lambda: feed.ended)
    newest = feed.newest("my_left")
    assert newest is not None
    assert newest.sensor == "my_left"
    feed.stop()


def test_a_pace_that_cannot_be_held_slips() -> None:
    pace = AtSpeed()
    pace.begin()
    assert pace.wait(0.0, 0.0)
    assert not pace.wait(5.0, 0.01)
