from __future__ import annotations

import numpy as np
import pytest

from fruitgui.errors import InputError
from fruitgui.frame import Intrinsics
from fruitgui.geometry.plane import Plane, Surface
from fruitgui.geometry.pose import Pose
from fruitgui.sensors.sensor import SensorInfo
from fruitgui.station.matching import match_sensors
from fruitgui.station.station import Station, StationSensor

CAMERA = Intrinsics(640, 480, 525.0, 525.0, 319.5, 239.5)
SURFACE = Surface(Plane(np.array([0.0, 0.0, -1.0]), 1.0))


def station(**serials: str) -> Station:
    sensors = {name: StationSensor(serial, Pose.exact(), SURFACE) for name, serial in serials.items()}
    return Station(next(iter(serials)), sensors)


def seen(**serials: str) -> list[SensorInfo]:
    return [SensorInfo(name, "", "", serial, CAMERA, 30.0) for name, serial in serials.items()]


def test_a_serial_says_more_than_a_name() -> None:
    matching = match_sensors(station(left="1", right="2"), seen(right="1", left="2"))
    assert matching.station_id == {"right": "left", "left": "right"}
    assert matching.warnings == ()


def test_names_serve_where_a_side_has_no_serial() -> None:
    assert match_sensors(station(left="1", right=""), seen(left="", right="9")).station_id == {
        "left": "left",
        "right": "right",
    }


def test_another_device_under_the_same_name_is_not_the_same_sensor() -> None:
    matching = match_sensors(station(left="1", right="2"), seen(left="1", right="3"))
    assert matching.station_id == {"left": "left"}
    assert len(matching.warnings) == 2


def test_what_either_side_lacks_is_said() -> None:
    matching = match_sensors(station(a="", b=""), seen(b="", c=""))
    assert "c is not part of the station" in matching.warnings[0]
    assert "a of the station is not in the recording" in matching.warnings[1]


def test_nothing_in_common_is_an_error() -> None:
    with pytest.raises(InputError):
        match_sensors(station(a=""), seen(b=""))
