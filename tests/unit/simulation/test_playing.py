"""A scene played as sensors, labelled as by an operator, and its truth written down."""

from __future__ import annotations

import csv
import json
import threading
import time
from pathlib import Path

import numpy as np
import pytest

from fruitgui.errors import WorldError
from fruitgui.frame import Frame, Intrinsics
from fruitgui.sensors.sensor import EndOfStreamError, SensorTimeoutError
from fruitgui.simulation import scenes
from fruitgui.simulation.benchmark import render_speed
from fruitgui.simulation.labels import truth_labels, write_labels, write_poses, write_truth
from fruitgui.simulation.simulated import FreeClock, PacedClock, SimulatedSensor
from fruitgui.simulation.simulation import Simulation

SMALL = Intrinsics(320, 240, 262.5, 262.5, 159.5, 119.5)
QUICK = scenes.Conditions(camera=SMALL)


@pytest.fixture(scope="module")
def still() -> Simulation:
    return scenes.still_scene(2, fruit=5, captures=3, conditions=QUICK)


def opened(sim: Simulation, sensor: str = "kinect_1") -> SimulatedSensor:
    player = SimulatedSensor(sim, sensor, FreeClock())
    player.open()
    player.start()
    return player


def test_a_sensor_plays_its_own_frames_and_ends(still: Simulation) -> None:
    player = opened(still, "kinect_2")
    frames = [player.read(1.0) for _ in range(3)]
    assert [frame.sequence for frame in frames] == [0, 1, 2]
    assert {frame.sensor for frame in frames} == {"kinect_2"}
    np.testing.assert_array_equal(frames[0].depth_mm, still.frame(1).depth_mm)
    with pytest.raises(EndOfStreamError):
        player.read(1.0)
    player.start()
    assert player.read(1.0).sequence == 0
    assert player.info.intrinsics == SMALL
    assert player.info.rate_hz == pytest.approx(5.0, abs=0.5)
    assert player.info.serial.startswith("SIM")


def test_without_its_projector_a_sensor_is_blind(still: Simulation) -> None:
    player = opened(still)
    player.projector(False)
    blind = player.read(1.0)
    assert not blind.depth_mm.any()
    assert blind.color.any()
    player.projector(True)
    assert player.read(1.0).depth_mm.any()


def test_order_of_calls(still: Simulation) -> None:
    player = SimulatedSensor(still, "kinect_1", FreeClock())
    with pytest.raises(WorldError):
        player.start()
    with pytest.raises(WorldError):
        player.read(0.1)
    player.open()
    player.start()
    for _ in range(2):
        player.stop()
        player.close()
    with pytest.raises(WorldError):
        player.read(0.1)


def test_a_paced_sensor_keeps_its_time(still: Simulation) -> None:
    player = SimulatedSensor(still, "kinect_1", PacedClock(speed=2.0))
    player.open()
    player.start()
    start_s = time.monotonic()
    with pytest.raises(SensorTimeoutError):
        player.read(0.001)
    assert player.read(1.0).sequence == 0
    assert time.monotonic() - start_s >= still.captures[0].time_s / 2 - 1e-3


def test_sensors_play_side_by_side(still: Simulation) -> None:
    got: dict[str, list[Frame]] = {sensor: [] for sensor in still.sensors}

    def play(sensor: str) -> None:
        player = opened(still, sensor)
        got[sensor] = [player.read(5.0) for _ in range(3)]

    threads = [threading.Thread(target=play, args=(sensor,)) for sensor in still.sensors]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(30)
    alone = scenes.still_scene(2, fruit=5, captures=3, conditions=QUICK)
    for number, capture in enumerate(alone.captures):
        frame = got[capture.sensor][number // 2]
        np.testing.assert_array_equal(frame.depth_mm, alone.frame(number).depth_mm)
        np.testing.assert_array_equal(frame.color, alone.frame(number).color)


def test_labels_point_at_the_fruit_they_name(tmp_path: Path) -> None:
    sim = scenes.line_scene(4, 6, foreign=2, speed_m_s=0.3, conditions=QUICK)
    rows = truth_labels(sim, per_fruit=2, volume_share=0.5, seed=1)
    truth = {f"f{thing.fruit_id:04d}": thing for thing in sim.truth.fruit}
    assert {row.fruit for row in rows} <= {name for name, thing in truth.items() if not thing.foreign}
    assert len({row.fruit for row in rows}) >= 5
    stamps = {(c.sensor, c.time_s - sim.device(c.sensor).clock_offset_s): c for c in sim.captures}
    for row in rows:
        capture = stamps[row.sensor, row.time_s]
        bodies = sim.in_sight(capture)
        seen = sim.eye(capture.sensor).who(bodies)[round(row.v_px), round(row.u_px)]
        assert f"f{bodies[seen].body.fruit_id:04d}" == row.fruit
        assert row.kind == truth[row.fruit].kind
        assert row.volume_ml in (None, pytest.approx(truth[row.fruit].volume_m3 * 1e6))
    assert 0 < len({row.fruit for row in rows if row.volume_ml is not None}) < 6 or len(rows) < 4
    assert rows == truth_labels(sim, per_fruit=2, volume_share=0.5, seed=1)
    path = tmp_path / "labels.csv"
    write_labels(path, rows)
    with path.open(encoding="utf-8") as file:
        read = list(csv.DictReader(file))
    assert len(read) == len(rows)
    assert [float(line["time_s"]) for line in read] == pytest.approx([row.time_s for row in rows], abs=1e-8)


def test_truth_is_written(still: Simulation, tmp_path: Path) -> None:
    path = tmp_path / "truth.json"
    write_truth(path, still)
    value = json.loads(path.read_text(encoding="utf-8"))
    assert value["schema"] == "fruitgui.truth/1"
    assert len(value["fruit"]) == len(still.truth.fruit)
    assert value["fruit"][0]["path"][0]["position_m"] == pytest.approx(still.truth.position_m(1, 0.0).tolist())
    assert set(value["sensors"]) == set(still.sensors)


def test_poses_are_written(still: Simulation, tmp_path: Path) -> None:
    from scipy.spatial.transform import Rotation

    path = tmp_path / "poses.csv"
    write_poses(path, still)
    with path.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(still.captures)
    for row, capture in zip(rows, still.captures, strict=True):
        pose = still.device(capture.sensor).pose
        assert row["sensor"] == capture.sensor
        assert [float(row[name]) for name in ("x_m", "y_m", "z_m")] == pytest.approx(pose.translation_m.tolist())
        turn = Rotation.from_quat([float(row[name]) for name in ("qx", "qy", "qz", "qw")]).as_matrix()
        np.testing.assert_allclose(turn, pose.rotation, atol=1e-7)


def test_speed_is_told() -> None:
    speed = render_speed(seed=3, fruit=4, frames=2)
    assert speed.frames == 2
    assert 1 <= speed.fruit_in_view <= 8
    assert speed.frames_per_cpu_s > 1
