from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fruitgui.geometry.pose import Pose
from fruitgui.simulation.scenes import still_scene
from fruitgui.station.fingerprint import calibration_fingerprint
from fruitgui.station.station import Station, StationSensor
from fruitgui.station.station_file import read_station, write_station


def _station(seed: int) -> Station:
    simulation = still_scene(seed, "opposed", fruit=2)
    rig = simulation.rig()
    sensors = {name: StationSensor("A1", mount.pose, mount.surface) for name, mount in rig.mounts.items()}
    return Station(rig.reference, sensors)


@pytest.mark.parametrize("seed", range(8))
def test_a_calibration_that_was_written_and_read_is_still_the_same(seed: int, tmp_path: Path) -> None:
    station = _station(seed)
    write_station(tmp_path / "once.json", station)
    once = read_station(tmp_path / "once.json")
    write_station(tmp_path / "twice.json", once)
    assert calibration_fingerprint(once) == calibration_fingerprint(station)
    assert calibration_fingerprint(read_station(tmp_path / "twice.json")) == calibration_fingerprint(station)


def test_a_sensor_that_stands_elsewhere_is_another_calibration() -> None:
    station = _station(1)
    name, sensor = list(station.sensors.items())[1]
    moved = Pose(sensor.pose.rotation, sensor.pose.translation_m + np.array([1e-6, 0.0, 0.0]), sensor.pose.covariance)
    other = replace(station, sensors={**station.sensors, name: replace(sensor, pose=moved)})
    assert calibration_fingerprint(other) != calibration_fingerprint(station)


def test_belt_speed_and_model_are_no_part_of_it() -> None:
    station = _station(1)
    other = replace(station, velocity_m_s=np.array([0.1, 0.0, 0.0]), model="models/model-0001.fruit")
    assert calibration_fingerprint(other) == calibration_fingerprint(station)
