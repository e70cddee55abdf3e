from __future__ import annotations

import copy
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fruitgui.errors import InputError
from fruitgui.geometry.plane import Plane, Surface
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rotation import rotation_from_vector
from fruitgui.sensors.depth_correction import DepthCorrection
from fruitgui.station.station import Station, StationSensor
from fruitgui.station.station_file import read_station, write_station

REGION = [[-0.3, -0.3, 1.0], [0.3, -0.3, 1.0], [0.0, 0.3, 1.0]]
GOOD: dict[str, Any] = {
    "schema": "fruitgui.station/1",
    "reference_sensor": "a",
    "sensors": {
        name: {
            "serial": "",
            "pose": {"rotation": np.eye(3).tolist(), "translation_m": [x, 0, 0], "covariance": None},
            "surface": {"normal": [0, 0, -1], "offset_m": 1.0, "region": REGION},
            "clock_offset_s": 0.0,
            "depth_correction": None,
            "quality": {},
        }
        for name, x in (("a", 0.0), ("b", 0.5))
    },
    "belt": {"velocity_m_s": None},
    "model": None,
}


def written(tmp_path: Path, value: object) -> Path:
    path = tmp_path / "station.json"
    path.write_text(json.dumps(value))
    return path


def test_a_station_comes_back_as_it_was_written(tmp_path: Path) -> None:
    rotation = rotation_from_vector(np.array([0.3, -2.0, 0.7]))
    pose = Pose(rotation, np.array([0.1, 1.4, 1.1]), np.diag([1e-6, 2e-6, 3e-6, 1e-7, 2e-7, 3e-7]))
    plane = Plane(np.array([0.0, 0.6, -0.8]), 0.9)
    correction = DepthCorrection(1.004, -0.002, 0.001, -0.0005)
    sensors = {
        "left": StationSensor("B1", Pose.exact(), Surface(plane)),
        "right": StationSensor("B2", pose, Surface(plane, plane.foot(np.array(REGION))), 0.25, correction, {"w": 1}),
    }
    path = tmp_path / "s.json"
    write_station(path, Station("left", sensors, np.array([0.1, 0.0, 0.02]), "m.fruit"))
    back = read_station(path)
    right = back.sensors["right"]
    assert (back.reference, back.model, right.serial) == ("left", "m.fruit", "B2")
    assert (right.clock_offset_s, right.depth_correction, right.quality) == (0.25, correction, {"w": 1})
    np.testing.assert_allclose(right.pose.matrix, pose.matrix, atol=1e-12)
    np.testing.assert_allclose(right.pose.covariance, pose.covariance)
    np.testing.assert_allclose(right.surface.region_m, sensors["right"].surface.region_m)
    np.testing.assert_allclose(back.velocity_m_s, [0.1, 0.0, 0.02])


def test_fields_that_may_be_absent_or_unknown_are_no_trouble(tmp_path: Path) -> None:
    value = copy.deepcopy(GOOD)
    for name in ("serial", "clock_offset_s", "depth_correction", "quality"):
        del value["sensors"]["b"][name]
    del value["model"], value["belt"]
    value["later"] = {"x": 1}
    assert read_station(written(tmp_path, value)).sensors["b"].serial == ""


def test_a_plane_written_with_its_normal_away_is_the_same_plane(tmp_path: Path) -> None:
    value = copy.deepcopy(GOOD)
    value["sensors"]["a"]["surface"].update(normal=[0, 0, 1], offset_m=-1.0)
    plane = read_station(written(tmp_path, value)).sensors["a"].surface.plane
    assert plane.offset_m == 1.0
    np.testing.assert_allclose(plane.normal, [0, 0, -1])


def test_a_rotation_within_the_tolerance_is_made_exact(tmp_path: Path) -> None:
    value = copy.deepcopy(GOOD)
    value["sensors"]["b"]["pose"]["rotation"][0][0] = 1.00004
    rotation = read_station(written(tmp_path, value)).sensors["b"].pose.rotation
    np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-12)


def _set(path: str, to: object) -> tuple[str, object]:
    return path, to


MIRROR = [[1, 0, 0], [0, 1, 0], [0, 0, -1]]
NEGATIVE = (-np.eye(6)).tolist()
LOPSIDED = (np.eye(6) + np.eye(6, k=1)).tolist()


@pytest.mark.parametrize(
    ("where", "to"),
    [
        _set("schema", "fruitgui.station/2"),
        _set("schema", None),
        _set("reference_sensor", "c"),
        _set("reference_sensor", 7),
        _set("sensors", {}),
        _set("sensors", []),
        _set("sensors.b", None),
        _set("sensors.bad id!", GOOD["sensors"]["b"]),
        _set("sensors.b.pose", {}),
        _set("sensors.a.pose.translation_m", [0.5, 0, 0]),
        _set("sensors.b.pose.translation_m", [float("nan"), 0, 0]),
        _set("sensors.b.pose.translation_m", [float("inf"), 0, 0]),
        _set("sensors.b.pose.translation_m", [1e6, 0, 0]),
        _set("sensors.b.pose.translation_m", [0, -850.0, 220.0]),
        _set("sensors.b.pose.translation_m", [0, 0]),
        _set("sensors.b.pose.translation_m", "here"),
        _set("sensors.b.pose.rotation", MIRROR),
        _set("sensors.b.pose.rotation", np.zeros((3, 3)).tolist()),
        _set("sensors.b.pose.rotation", (1.01 * np.eye(3)).tolist()),
        _set("sensors.b.pose.rotation", [[float("nan")] * 3] * 3),
        _set("sensors.b.pose.rotation", np.eye(4).tolist()),
        _set("sensors.b.pose.covariance", NEGATIVE),
        _set("sensors.b.pose.covariance", LOPSIDED),
        _set("sensors.b.pose.covariance", np.eye(3).tolist()),
        _set("sensors.b.surface.normal", [0, 0, -2]),
        _set("sensors.b.surface.normal", [0, 0, 0]),
        _set("sensors.b.surface.offset_m", 0.0),
        _set("sensors.b.surface.offset_m", float("nan")),
        _set("sensors.b.surface.offset_m", 950.0),
        _set("sensors.b.surface.region", [[0, 0, 1]]),
        _set("sensors.b.surface.region", [[0, 0]] * 4),
        _set("sensors.b.surface.region", [[0, 0, 1]] * 4),
        _set("sensors.b.surface.region", [[-0.3, 0, 1], [0, 0, 1], [0.3, 0, 1]]),
        _set("sensors.b.clock_offset_s", "soon"),
        _set("sensors.b.clock_offset_s", "1.0"),
        _set("sensors.b.clock_offset_s", True),
        _set("sensors.b.clock_offset_s", 1e18),
        _set("sensors.b.depth_correction", {"scale": -1}),
        _set("belt", {"velocity_m_s": [0.1]}),
        _set("belt", {"velocity_m_s": [0, -300, 0]}),
        _set("model", 3),
    ],
)
def test_what_cannot_be_is_named_and_refused(tmp_path: Path, where: str, to: object) -> None:
    value = copy.deepcopy(GOOD)
    part = value
    *steps, last = where.split(".")
    for step in steps:
        part = part[step]
    part[last] = to
    path = written(tmp_path, value)
    with pytest.raises(InputError) as caught:
        read_station(path)
    assert caught.value.exit_code == 2
    assert caught.value.file == str(path)
    assert caught.value.where
    assert caught.value.remedy


@pytest.mark.parametrize(
    "data",
    [b"", b"{", b"[1]", b"null", b"\xff\xfe\x00", b"PK\x03\x04", b"[" * 100_000, b'{"schema": 1e999}', b"NaN",
     b'{"schema": ' + b"9" * 5000 + b"}"],
)  # fmt: skip
def test_a_file_that_is_no_station_is_refused(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "station.json"
    path.write_bytes(data)
    with pytest.raises(InputError):
        read_station(path)


def test_a_missing_file_and_a_folder_are_refused(tmp_path: Path) -> None:
    for path in (tmp_path / "none.json", tmp_path):
        with pytest.raises(InputError):
            read_station(path)
