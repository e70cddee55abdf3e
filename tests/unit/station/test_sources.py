"""The one list of what can be connected."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from fruitgui.errors import InputError, WorldError
from fruitgui.sensors.drivers import PluggedDevice
from fruitgui.sensors.sensor import Sensor
from fruitgui.simulation.supply import LineOptions
from fruitgui.station.connection import ConnectedSensor, Connection, connection_to, named_sensors
from fruitgui.station.sources import (
    PRESETS,
    DeviceId,
    DevicesSource,
    Make,
    RecordedSource,
    SimulatedSource,
    Source,
    Sources,
    devices_of,
    is_plugged,
)
from tests.unit.sensors.scripted import ScriptedSensor


def test_every_preset_is_listed_and_can_be_written_and_read() -> None:
    sources = Sources()
    listed = {source.name: source for source in sources.found()}
    assert set(listed) == set(PRESETS)
    for source in listed.values():
        assert sources.source_of(json.loads(json.dumps(source.value()))) == source


def test_a_recording_can_be_written_and_read() -> None:
    source = RecordedSource(Path("a.mcap"), speed=0.0, looped=True)
    assert Sources().source_of(json.loads(json.dumps(source.value()))) == source


def test_a_source_of_its_own_make_is_listed_with_the_others() -> None:
    device: Source = RecordedSource(Path("device"))
    sources = Sources((*Sources().makes, Make("kinect", lambda: [device], lambda _value: device)))
    assert device in sources.found()
    assert sources.source_of({"kind": "kinect"}) is device


@pytest.mark.parametrize(
    "value",
    [
        {},
        {"kind": "of tomorrow"},
        {"kind": "recording"},
        {"kind": "simulated", "name": "x", "flat_out": False, "options": {"kinds": [], "unheard_of": 1}},
    ],
)
def test_a_source_that_cannot_be_is_refused(value: dict[str, Any]) -> None:
    with pytest.raises(InputError):
        Sources().source_of(value)


def test_a_layout_that_is_none_is_refused() -> None:
    value = SimulatedSource(LineOptions(layout="nowhere")).value()
    with pytest.raises(InputError):
        Sources().source_of(value)


def test_connecting_starts_nothing_and_names_the_sensors(no_leaked_threads: None) -> None:  # noqa: ARG001
    connected = SimulatedSource(PRESETS["chain"]).connect()
    assert [one.info.sensor for one in connected.sensors] == ["kinect_1", "kinect_2", "kinect_3"]
    assert connected.rig is not None


def test_a_missing_recording_is_said(tmp_path: Path) -> None:
    with pytest.raises(InputError):
        RecordedSource(tmp_path / "none.mcap").connect()


def test_sensors_come_back_under_their_names_in_order_whatever_their_ids() -> None:
    found = [ScriptedSensor("b"), ScriptedSensor("a"), ScriptedSensor("c")]
    plain = connection_to({}, found)
    assert [one.info.sensor for one in named_sensors(plain, found)] == ["b", "a", "c"]
    chosen = Connection(
        source={},
        sensors=(
            ConnectedSensor(device="elsewhere", serial="S-a", name="left"),
            ConnectedSensor(device="b", name="right"),
            ConnectedSensor(device="gone", serial="S-x", name="third"),
        ),
        reference="right",
    )
    named = named_sensors(chosen, found)
    assert [one.info.sensor for one in named] == ["left", "right"]
    assert named[0].info.serial == "S-a"
    assert chosen.reference_name == "right"


class PluggedIn:
    """A driver of scripted sensors that are plugged in as a test says."""

    make = "kinect"

    def __init__(self, *serials: str) -> None:
        self.serials = list(serials)

    def problem(self) -> WorldError | None:
        return None

    def devices(self) -> list[PluggedDevice]:
        return [PluggedDevice(self.make, "Kinect 1414", serial) for serial in self.serials]

    def sensor(self, serial: str) -> Sensor:
        return ScriptedSensor(serial)


def test_all_devices_that_are_plugged_in_are_one_source() -> None:
    driver = PluggedIn()
    sources = Sources((devices_of(lambda: [driver]),))
    assert sources.found() == []
    driver.serials += ["A1", "B2"]
    (source,) = sources.found()
    assert source.name == "2 kinect"
    assert source.value() == {
        "kind": "devices",
        "devices": [{"make": "kinect", "serial": "A1"}, {"make": "kinect", "serial": "B2"}],
    }
    assert sources.source_of(json.loads(json.dumps(source.value()))) == source


def test_only_devices_give_frames_however_busy_this_computer_is() -> None:
    assert is_plugged(DevicesSource((DeviceId("kinect", "A1"),)).value())
    assert not is_plugged(SimulatedSource(PRESETS["chain"]).value())


def test_a_device_that_is_away_still_has_its_sensor() -> None:
    source = DevicesSource((DeviceId("kinect", "A1"), DeviceId("kinect", "B2")), lambda: [PluggedIn("B2")])
    infos = [sensor.info for sensor in source.connect().sensors]
    assert [(info.sensor, info.serial) for info in infos] == [("kinect_1", "S-A1"), ("kinect_2", "S-B2")]


def test_a_device_of_a_make_without_a_driver_is_refused() -> None:
    source = Sources().source_of({"kind": "devices", "devices": [{"make": "of tomorrow", "serial": "1"}]})
    with pytest.raises(InputError, match="of tomorrow"):
        source.connect()


@pytest.mark.parametrize("devices", [[], None, [{}], ["A1"], [{"make": "kinect", "serial": "A1"}] * 2])
def test_devices_that_cannot_be_are_refused(devices: object) -> None:
    with pytest.raises(InputError):
        Sources().source_of({"kind": "devices", "devices": devices})
