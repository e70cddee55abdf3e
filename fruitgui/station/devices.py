"""The devices that are plugged in, under the names that a person gave them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import TypeVar

from fruitgui.errors import InputError
from fruitgui.sensors.drivers import known_drivers
from fruitgui.sensors.named import NamedSensor
from fruitgui.sensors.sensor import Sensor
from fruitgui.sensors.turns import Schedule
from fruitgui.sensors.usb.problems import Problem, problem
from fruitgui.station.checkup.asking import all_devices
from fruitgui.station.connection import Connection
from fruitgui.station.projectors import Projectors
from fruitgui.station.sources import devices_of
from fruitgui.station.station import Station
from fruitgui.station.station_file import read_station
from fruitgui.station.turn_plan import overlapping, rig_of, schedule_of
from fruitgui.station.workspace import Workspace, default_folder
from fruitgui.station.written import read_written

T = TypeVar("T")


def connected_devices(names: Mapping[str, str]) -> list[Sensor]:
    """Return a sensor for everything that is plugged in, closed.

    Args:
        names: by serial; a device that is not among them keeps the name that its driver gives, unless it is taken.
    """
    for driver in known_drivers():
        all_devices(driver)  # one whose bus is slow has nothing to say at first
    found = [sensor for source in devices_of(known_drivers).find() for sensor in source.connect().sensors]
    return named_by_serial(found, names)


def unusable_devices() -> list[tuple[str, Problem]]:
    """Return what is plugged in and cannot be opened: its model, and why."""
    devices = [device for driver in known_drivers() for device in all_devices(driver)]
    return [(one.model, problem(one.hindrance or "closed")) for one in devices if not one.serial]


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


@dataclass(frozen=True, slots=True)
class Known:
    """What is known of the devices of a line.

    Attributes:
        names: by serial.
        station: where they are, None where nobody calibrated them.
        projectors: what was measured of them.
        trouble: files that could not be used, in words.
    """

    names: Mapping[str, str] = field(default_factory=dict)
    station: Station | None = None
    projectors: Projectors = field(default_factory=Projectors)
    trouble: tuple[str, ...] = ()

    def schedule(self, sensors: Iterable[Sensor]) -> Schedule:
        """Return how the projectors of sensors take turns: only those that are known not to overlap share one."""
        infos = {sensor.info.sensor: sensor.info for sensor in sensors}
        rig = rig_of(self.station, {name: info.intrinsics for name, info in infos.items()})
        return schedule_of(
            infos, None if rig is None else overlapping(rig), self.projectors.known(),
            self.projectors.disturbing(infos.values()),
        )  # fmt: skip


def known_by_station(path: Path) -> Known:
    """Return what a station's file says. Raises `InputError` where it cannot be used."""
    station = read_station(path)
    return Known({one.serial: name for name, one in station.sensors.items() if one.serial}, station)


def known_by_workspace(folder: Path | None = None) -> Known:
    """Return what the window knows.

    Args:
        folder: of the line; the usual one unless given. It need not be there.
    """
    files = Workspace(default_folder() if folder is None else folder)
    trouble: list[str] = []
    connection = _read(files.connection.path, partial(read_written, of=Connection), trouble)
    projectors = _read(files.projectors.path, partial(read_written, of=Projectors), trouble)
    return Known(
        names={one.serial: one.name for one in connection.sensors if one.serial} if connection else {},
        station=_read(files.station.path, read_station, trouble),
        projectors=projectors or Projectors(),
        trouble=tuple(trouble),
    )


def _read(path: Path, read: Callable[[Path], T], trouble: list[str]) -> T | None:
    """Return what a file holds; None where it is not there, or cannot be used, which is noted."""
    if not path.exists():
        return None
    try:
        return read(path)
    except InputError as error:
        trouble.append(f"{error.what} It is left aside.")
        return None
