"""The devices that are plugged in, under the names that a person gave them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from fruitgui.errors import InputError
from fruitgui.sensors.named import NamedSensor
from fruitgui.sensors.sensor import Sensor
from fruitgui.station.connection import Connection
from fruitgui.station.sources import DEVICES, Make
from fruitgui.station.station_file import read_station
from fruitgui.station.workspace import Workspace, default_folder
from fruitgui.station.written import read_written


def connected_devices(names: Mapping[str, str], make: Make = DEVICES) -> list[Sensor]:
    """Return a sensor for everything that is plugged in, closed.

    Args:
        names: by serial; a device that is not among them keeps the name that its driver gives, unless it is taken.
        make: finds them.
    """
    found = [sensor for source in make.find() for sensor in source.connect().sensors]
    return named_by_serial(found, names)


def named_by_serial(found: Sequence[Sensor], names: Mapping[str, str]) -> list[Sensor]:
    """Return sensors under the names that their serials have; no two are named alike."""
    left = dict(names)
    given = [left.pop(sensor.info.serial, None) for sensor in found]  # a serial that two claim names the first
    taken = {name for name in given if name is not None}
    sensors: list[Sensor] = []
    for sensor, wanted in zip(found, given, strict=True):
        own = sensor.info.sensor
        name = _free(own, taken) if wanted is None else wanted
        taken.add(name)
        sensors.append(sensor if name == own else NamedSensor(sensor, name))
    return sensors


def _free(name: str, taken: set[str]) -> str:
    stem, _, end = name.rpartition("_")
    stem = stem if end.isdigit() else name
    number = 1
    while name in taken:
        number += 1
        name = f"{stem}_{number}"
    return name


def only(sensors: Sequence[Sensor], wanted: Sequence[str]) -> list[Sensor]:
    """Return the sensors of these names, or all where none is named.

    Raises:
        InputError: one is not there.
    """
    known = {sensor.info.sensor: sensor for sensor in sensors}
    missing = [name for name in wanted if name not in known]
    if missing:
        raise InputError(
            "no_such_sensor", f"No sensor {missing[0]!r} is connected; there are {', '.join(known)}.",
            "Name some of these, or plug that one in.", where="--sensors",
        )  # fmt: skip
    return [known[name] for name in wanted] if wanted else list(sensors)


def names_of_station(path: Path) -> dict[str, str]:
    """Return the name of each serial in a station's file. Raises `InputError` where it cannot be used."""
    return {sensor.serial: name for name, sensor in read_station(path).sensors.items() if sensor.serial}


def names_of_workspace(folder: Path | None = None) -> tuple[dict[str, str], list[str]]:
    """Return the name of each serial that the window is connected to, and what is wrong with the file that says so.

    Args:
        folder: of the line; the usual one unless given. It need not be there.
    """
    file = Workspace(default_folder() if folder is None else folder).connection
    if not file.path.exists():
        return {}, []
    try:
        connection = read_written(file.path, Connection)
    except InputError as error:
        return {}, [f"{error.what} The sensors are named as their drivers do."]
    return {sensor.serial: sensor.name for sensor in connection.sensors if sensor.serial}, []
