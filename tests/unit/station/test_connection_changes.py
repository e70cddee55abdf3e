from __future__ import annotations

import pytest

from fruitgui.station.connection import ConnectedSensor, Connection
from fruitgui.station.connection_changes import moved, referred_to, renamed, without


@pytest.fixture
def three() -> Connection:
    sensors = tuple(ConnectedSensor(device=f"d{n}", serial=f"S{n}", name=f"kinect_{n}") for n in (1, 2, 3))
    return Connection(source={"kind": "test"}, sensors=sensors)


def _names(connection: Connection) -> list[str]:
    return [one.name for one in connection.sensors]


def test_a_reference_keeps_its_role_under_another_name(three: Connection) -> None:
    named = renamed(referred_to(three, "kinect_2"), "kinect_2", "left")
    assert _names(named) == ["kinect_1", "left", "kinect_3"]
    assert named.reference == "left"
    assert named.sensors[1].serial == "S2"


@pytest.mark.parametrize("name", ["kinect_1", "links vorne", ""])
def test_a_name_that_is_taken_or_none_is_refused(three: Connection, name: str) -> None:
    with pytest.raises(ValueError, match="name"):
        renamed(three, "kinect_2", name)


def test_moving_changes_the_order_and_not_the_reference(three: Connection) -> None:
    after = moved(three, "kinect_1", 1)
    assert _names(after) == ["kinect_2", "kinect_1", "kinect_3"]
    assert after.reference_name == "kinect_1"
    assert _names(moved(after, "kinect_3", 5)) == _names(after)
    assert _names(moved(after, "kinect_3", -9)) == ["kinect_3", "kinect_2", "kinect_1"]


def test_leaving_out_the_reference_makes_the_first_of_the_others_it(three: Connection) -> None:
    assert without(three, "kinect_1").reference_name == "kinect_2"
    assert without(referred_to(three, "kinect_3"), "kinect_1").reference_name == "kinect_3"


def test_the_last_sensor_cannot_be_left_out(three: Connection) -> None:
    alone = without(without(three, "kinect_1"), "kinect_2")
    with pytest.raises(ValueError, match="sensors"):
        without(alone, "kinect_3")
