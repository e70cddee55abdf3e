"""What a line is connected to: the chosen source, and its sensors with their names, in order."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Annotated, Any

from pydantic import Field, model_validator

from fruitgui.sensors.named import NamedSensor
from fruitgui.sensors.sensor import Sensor
from fruitgui.station.station_file import SENSOR_ID
from fruitgui.station.written import Written


class ConnectedSensor(Written):
    """One sensor as a person named it.

    Attributes:
        device: its id in the source.
        serial: of the device; empty where unknown.
        name: the id that its frames carry from then on, letters, digits and _.
    """

    device: str
    serial: str = ""
    name: str


class Connection(Written):
    """A chosen source with its sensors.

    Attributes:
        source: the source's own value, see `sources.source_of`.
        sensors: in the order that a person gave.
        reference: name of the reference sensor; the first where None.
    """

    source: dict[str, Any]
    sensors: Annotated[tuple[ConnectedSensor, ...], Field(min_length=1, max_length=64)]
    reference: str | None = None

    @model_validator(mode="after")
    def _check(self) -> Connection:
        names = [sensor.name for sensor in self.sensors]
        for name in names:
            if not SENSOR_ID.fullmatch(name):
                raise ValueError(f"the name {name[:80]!r} is not letters, digits and _ beginning with a letter")
        if len(set(names)) != len(names):
            raise ValueError("two sensors have the same name")
        if self.reference is not None and self.reference not in names:
            raise ValueError(f"the reference {self.reference[:80]!r} is not among the sensors")
        return self

    @property
    def reference_name(self) -> str:
        """The reference sensor's name."""
        return self.reference or self.sensors[0].name

    def serials(self) -> dict[str, str]:
        """Return the serial of each sensor, by name."""
        return {sensor.name: sensor.serial for sensor in self.sensors}


def connection_to(source: dict[str, Any], sensors: Iterable[Sensor]) -> Connection:
    """Return a connection to a source's sensors as they come, under the names that they have."""
    infos = [sensor.info for sensor in sensors]
    connected = tuple(ConnectedSensor(device=one.sensor, serial=one.serial, name=one.sensor) for one in infos)
    return Connection(source=source, sensors=connected)


def named_sensors(connection: Connection, found: Sequence[Sensor]) -> list[Sensor]:
    """Return the connection's sensors among those found, named and in order; one that is not there is left out.

    A sensor is known by its serial; without one, by its id in the source.
    """
    sensors: list[Sensor] = []
    for wanted in connection.sensors:
        sensor = next((one for one in found if _is(one, wanted)), None)
        if sensor is not None:
            sensors.append(sensor if sensor.info.sensor == wanted.name else NamedSensor(sensor, wanted.name))
    return sensors


def _is(sensor: Sensor, wanted: ConnectedSensor) -> bool:
    info = sensor.info
    if wanted.serial and info.serial:
        return info.serial == wanted.serial
    return info.sensor == wanted.device
