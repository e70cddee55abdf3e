"""Measuring a device's depth from a feed: pictures taken, what is seen meanwhile, and a correction from the command."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest

from fruitgui.calibration.depth.measured import BareBelt, DepthFit, Measurements, RaisedBoard
from fruitgui.calibration.depth.seeing import see_belt
from fruitgui.calibration.still import average
from fruitgui.cli import main
from fruitgui.errors import CancelledByUserError, InputError
from fruitgui.sensors.feed import Feed
from fruitgui.sensors.recordings.writer import RecordingWriter
from fruitgui.simulation.depth_bench import depth_bench
from fruitgui.simulation.kinect import DepthModel
from fruitgui.simulation.looped import LoopedSensor
from fruitgui.simulation.simulated import sensor_info
from fruitgui.station.depth_job import FRAMES, measure_depth, take_still
from fruitgui.station.depth_watch import Aim, DepthWatch, Looked, share_seen, sight_of
from fruitgui.station.depths import DeviceDepths, device_depth
from fruitgui.station.lineup import line_up
from fruitgui.station.station import Station, StationSensor
from fruitgui.station.written import write_written
from tests.unit.sensors.scripted import until

RIG, HEIGHT_M = 8, 0.25
BIASED = DepthModel(scale_error=-0.015, offset_m=0.008)

pytestmark = pytest.mark.usefixtures("no_leaked_threads")


@pytest.fixture
def feed() -> Iterator[Feed]:
    scene = depth_bench(1, RIG, BIASED, captures=6)
    info = replace(sensor_info(scene, "kinect_1"), rate_hz=30.0)
    made = Feed([LoopedSensor(info, list(scene.frames()))])
    yield made
    made.stop()


def _fit() -> DepthFit:
    belt = average(list(depth_bench(1, RIG, BIASED, captures=6).frames()))
    lid = average(list(depth_bench(2, RIG, BIASED, board_height_m=HEIGHT_M, captures=6).frames()))
    plane = depth_bench(1, RIG, BIASED).rig().mounts["kinect_1"].surface.plane
    distance_m = -plane.offset_m / float(plane.normal[2])
    told: list[float] = []
    made = measure_depth(
        Measurements(BareBelt(belt, distance_m), (RaisedBoard(lid, HEIGHT_M),)), lambda share, _: told.append(share)
    )
    assert isinstance(made, DepthFit)
    assert told
    return made


def test_a_still_is_taken_of_one_sensor(feed: Feed) -> None:
    feed.start()
    still = take_still(feed, "kinect_1")
    assert (still.sensor, still.captures) == ("kinect_1", FRAMES)
    with pytest.raises(InputError, match="nobody"):
        take_still(feed, "nobody")


def test_taking_can_be_stopped(feed: Feed) -> None:
    feed.start()
    with pytest.raises(CancelledByUserError):
        take_still(feed, "kinect_1", cancelled=lambda: True)


def test_the_watch_sees_what_it_is_told_to_look_for_and_ends(feed: Feed) -> None:
    watch = DepthWatch(feed, "kinect_1", Aim(Looked.BELT))
    feed.start()
    watch.start()
    try:
        until(lambda: watch.newest is not None, 60.0)
    finally:
        watch.stop()
        assert watch.wait(30.0)
    assert watch.newest is not None
    assert share_seen(watch.newest) > 0.2
    assert 0.5 < watch.newest.length_m < 2.0


def test_a_sight_tells_board_from_belt() -> None:
    bare = average(list(depth_bench(1, RIG, BIASED, captures=3).frames()))
    lid = average(list(depth_bench(2, RIG, BIASED, board_height_m=HEIGHT_M, captures=3).frames()))
    belt = see_belt(bare)
    aim = Aim(Looked.BOARD, HEIGHT_M, belt)
    assert sight_of(lid, aim).length_m == pytest.approx(HEIGHT_M, abs=0.02)
    assert sight_of(bare, aim).length_m < 0.8 * HEIGHT_M
    assert sight_of(bare, Aim(Looked.BALL, 0.2, belt)).on is None
    shaken = replace(bare, moved=np.ones_like(bare.moved))
    assert sight_of(shaken, aim).moving


def test_frames_are_put_right_for_whoever_lines_up_with_a_station() -> None:
    scene, correction = depth_bench(1, RIG, BIASED, captures=2), _fit().correction
    mount, info = scene.rig().mounts["kinect_1"], sensor_info(scene, "kinect_1")
    station = Station("k", {"k": StationSensor(info.serial, mount.pose, mount.surface, depth_correction=correction)})
    lineup = line_up(station, [info])
    frame = next(scene.frames())
    put_right = lineup.corrected(frame)
    assert np.array_equal(put_right.depth_mm, correction.apply(frame.depth_mm, frame.intrinsics))
    assert not np.array_equal(put_right.depth_mm, frame.depth_mm)
    stranger = replace(frame, sensor="another")
    assert lineup.corrected(stranger) is stranger


def test_the_command_takes_corrections_from_a_line_s_folder(tmp_path: Path) -> None:
    scene = depth_bench(3, RIG, BIASED, ball_m=0.08, captures=6)
    info, plane = sensor_info(scene, "kinect_1"), scene.rig().mounts["kinect_1"].surface.plane
    with RecordingWriter(tmp_path / "r.mcap", [info]) as writer:
        for frame in scene.frames():
            writer.write(frame)
    kept = DeviceDepths().with_device(info.serial, "", device_depth(_fit(), datetime(2026, 1, 2, tzinfo=UTC)))
    write_written(tmp_path / "depths.json", kept)
    out, depths = tmp_path / "station.json", str(tmp_path / "depths.json")
    assert main(["calibrate", str(tmp_path / "r.mcap"), "--station", str(out), "--depths", depths]) == 0
    made = json.loads(out.read_text())["sensors"]["kinect_1"]
    assert made["depth_correction"]["scale"] == pytest.approx(1.0 / (1 - 0.015), abs=0.01)
    assert made["surface"]["offset_m"] == pytest.approx(plane.offset_m, abs=0.006)
    (tmp_path / "depths.json").write_text("{")
    assert main(["calibrate", str(tmp_path / "r.mcap"), "--station", str(out), "--depths", depths]) == 2
