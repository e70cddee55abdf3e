"""A device's depth correction: kept by serial, applied once, and what it makes to be done again."""

from __future__ import annotations

import json
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest

from fruitgui.calibration.depth.measured import DepthFit, Figure
from fruitgui.calibration.watch import plane_drift
from fruitgui.errors import InputError
from fruitgui.frame import Frame
from fruitgui.geometry.plane import Plane, Surface
from fruitgui.geometry.pose import Pose
from fruitgui.sensors.depth_correction import DepthCorrection
from fruitgui.sensors.recordings import open_recording
from fruitgui.sensors.recordings.writer import RecordingWriter
from fruitgui.sensors.sensor import SensorInfo
from fruitgui.simulation.depth_bench import depth_bench
from fruitgui.simulation.kinect import DepthModel
from fruitgui.simulation.simulated import sensor_info
from fruitgui.station.calibrate_job import calibrate_again, calibrate_recording
from fruitgui.station.connection import ConnectedSensor, Connection
from fruitgui.station.depths import DeviceDepth, DeviceDepths, corrections_of, device_depth, outdated
from fruitgui.station.facts import facts_of
from fruitgui.station.observing import Watching
from fruitgui.station.source import RecordingSource
from fruitgui.station.station import Station, StationSensor
from fruitgui.station.timing import Stopwatch
from fruitgui.station.workflow import State, Step, step_states
from fruitgui.station.workspace import open_workspace

CORRECTION = DepthCorrection(1.01, -0.004, 0.002, 0.0)
FIT = DepthFit(
    CORRECTION, ("scale", "offset_m", "radial_2"), np.diag([1e-6, 1e-5, 1e-6, 1e-3]), 1.02, 0.029, 0.0026,
    (Figure("height", 0.2, 0.198, 0.2001, 0.0003),), (), {},
)  # fmt: skip
WHEN = datetime(2026, 3, 4, 5, 6, 7, tzinfo=UTC)
MEASURED = device_depth(FIT, WHEN)


def _station(name: str = "left", serial: str = "A1", correction: DepthCorrection | None = None) -> Station:
    surface = Surface(Plane(np.array([0.0, 0.0, -1.0]), 1.0))
    sensor = StationSensor(serial, Pose.exact(), surface, clock_offset_s=0.25, depth_correction=correction)
    return Station(name, {name: sensor}, model="models/model-0001.fruit")


def test_a_measurement_is_kept_and_read_again(tmp_path: Path) -> None:
    workspace = open_workspace(tmp_path)
    workspace.depths.save(DeviceDepths().with_device("A1", "left", MEASURED))
    kept = workspace.depths.load().value
    assert kept is not None
    known = kept.of("A1", "anything")
    assert known == MEASURED
    assert known.depth_correction() == CORRECTION
    assert known.measured_at == WHEN
    assert known.figures[0].after_m == pytest.approx(0.2001)


@pytest.mark.parametrize(("where", "bad"), [("scale", 3.0), ("offset_m", float("nan")), ("radial_2", "0.1")])
def test_a_correction_that_cannot_be_is_refused_and_the_file_set_aside(tmp_path: Path, where: str, bad: object) -> None:
    workspace = open_workspace(tmp_path)
    workspace.depths.save(DeviceDepths().with_device("A1", "left", MEASURED))
    value = json.loads(workspace.depths.path.read_text())
    value["devices"]["serial A1"]["correction"][where] = bad
    workspace.depths.path.write_text(json.dumps(value))
    kept = workspace.depths.load()
    assert kept.value is None
    assert kept.damage is not None
    assert isinstance(kept.damage.error, InputError)


def test_a_correction_goes_with_the_serial_not_with_the_name() -> None:
    depths = DeviceDepths().with_device("A1", "left", MEASURED)
    assert corrections_of({"right": "A1", "left": "B2"}, depths, None) == {"right": CORRECTION}
    assert corrections_of({"right": "A1"}, None, _station(correction=CORRECTION)) == {"right": CORRECTION}


def test_without_a_serial_it_goes_with_the_name() -> None:
    depths = DeviceDepths().with_device("", "left", MEASURED)
    assert corrections_of({"left": "", "right": ""}, depths, None) == {"left": CORRECTION}


def test_a_correction_that_was_taken_away_wins_over_the_station() -> None:
    station = _station(correction=CORRECTION)
    taken = DeviceDepths().with_device("A1", "left", DeviceDepth())
    assert corrections_of({"left": "A1"}, taken, station) == {}
    assert outdated(taken, station) == ("left",)
    assert outdated(DeviceDepths(), station) == (), "nothing is known against it"


def test_another_correction_than_it_was_made_with_makes_calibrating_to_be_done_again() -> None:
    depths = DeviceDepths().with_device("A1", "left", MEASURED)
    connection = Connection(source={"kind": "x"}, sensors=(ConnectedSensor(device="d", serial="A1", name="left"),))
    states = step_states(facts_of(connection, _station(), None, depths=depths))
    assert states[Step.CALIBRATE].state is State.REDO
    reason = states[Step.CALIBRATE].reason
    assert reason is not None
    assert (reason.code, reason.data["sensors"]) == ("depth_changed", ("left",))
    assert states[Step.LIVE].state is State.TO_DO
    done = step_states(facts_of(connection, _station(correction=CORRECTION), None, depths=depths))
    assert done[Step.CALIBRATE].state is State.DONE


RIG = 8
BIASED = DepthModel(scale_error=0.015, offset_m=0.006)
RIGHT = DepthCorrection(1.0 / 1.015, -0.006 / 1.015)


def _frames(count: int) -> tuple[list[Frame], SensorInfo, Plane]:
    scene = depth_bench(3, RIG, BIASED, ball_m=0.08, captures=count)
    return list(scene.frames()), sensor_info(scene, "kinect_1"), scene.rig().mounts["kinect_1"].surface.plane


def test_calibrating_again_keeps_what_is_known_of_a_renamed_device_and_applies_it_once() -> None:
    frames, info, true = _frames(6)
    before = _station("old_name", info.serial, RIGHT)
    named = [replace(frame, sensor="new_name") for frame in frames]
    made = calibrate_again({"new_name": named}, "new_name", {"new_name": info.serial}, before).station
    assert made is not None
    sensor = made.sensors["new_name"]
    assert (sensor.depth_correction, sensor.clock_offset_s, made.model) == (RIGHT, 0.25, before.model)
    assert sensor.surface.plane.offset_m == pytest.approx(true.offset_m, abs=0.0015)
    raw = calibrate_again({"new_name": named}, "new_name", {"new_name": info.serial}, None).station
    assert raw is not None
    assert abs(raw.sensors["new_name"].surface.plane.offset_m - true.offset_m) > 0.01


def test_a_recording_stays_uncorrected_and_is_corrected_once_where_it_is_read(tmp_path: Path) -> None:
    frames, info, true = _frames(6)
    path = tmp_path / "r.mcap"
    with RecordingWriter(path, [info]) as writer:
        for frame in frames:
            writer.write(frame)
    kept = [frame for _, frame in open_recording(path).frames()]
    assert all(np.array_equal(one.depth_mm, frame.depth_mm) for one, frame in zip(kept, frames, strict=True))
    depths = DeviceDepths().with_device(info.serial, "any", replace_correction(RIGHT))
    out = tmp_path / "station.json"
    made = calibrate_recording(RecordingSource(path), None, out, depths=depths).station
    assert made is not None
    assert made.sensors["kinect_1"].depth_correction == RIGHT
    assert made.sensors["kinect_1"].surface.plane.offset_m == pytest.approx(true.offset_m, abs=0.0015)
    watching = Watching(RecordingSource(path), made)
    perceived = list(watching.seen(Stopwatch()))
    assert len(perceived) == len(frames)
    heights = [view.centre_m @ true.normal + true.offset_m for one in perceived for view in one.observation.views]
    assert np.median(heights) == pytest.approx(0.04, abs=0.004), "the ball's middle is where it is"
    drift = plane_drift([RIGHT.corrected(frame) for frame in frames], made.sensors["kinect_1"].surface)
    assert drift is not None
    assert not drift.stale


def replace_correction(correction: DepthCorrection) -> DeviceDepth:
    return device_depth(replace(FIT, correction=correction), WHEN)
