"""Which sensor of a recording is which of the station: by serial where both have one, else by name."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from fruitgui.errors import InputError
from fruitgui.sensors.sensor import SensorInfo
from fruitgui.station.station import Station


@dataclass(frozen=True, slots=True)
class Matching:
    """Recording and station, brought together.

    Attributes:
        station_id: by the recording's id; sensors that the station lacks are absent.
        warnings: sensors that one side lacks.
    """

    station_id: Mapping[str, str]
    warnings: tuple[str, ...]


def match_sensors(station: Station, sensors: Iterable[SensorInfo]) -> Matching:
    """Return which sensor is which.

    Raises:
        InputError: the recording and the station have no sensor in common.
    """
    present = tuple(sensors)
    found = {
        info.sensor: name for info in present if (name := same_sensor(station, info.sensor, info.serial)) is not None
    }
    if not found:
        raise InputError(
            "no_sensor_in_common",
            f"The recording has the sensors {_names(info.sensor for info in present)}, "
            f"the station has {_names(station.sensors)}: none is the same.",
            "Name the station that was made for this rig, or calibrate again.",
        )
    lacking = [
        f"Sensor {info.sensor} is not part of the station; its frames are left out."
        for info in present
        if info.sensor not in found
    ]
    silent = [
        f"Sensor {name} of the station is not in the recording."
        for name in station.sensors
        if name not in found.values()
    ]
    return Matching(found, (*lacking, *silent))


def same_sensor(station: Station, name: str, serial: str) -> str | None:
    """Return the station's name of a sensor; None where it has none that is the same device."""
    if serial:
        for known, sensor in station.sensors.items():
            if sensor.serial == serial:
                return known
    named = station.sensors.get(name)
    if named is None or (named.serial and serial):
        return None  # absent, or another device under the same name
    return name


def _names(names: Iterable[str]) -> str:
    return ", ".join(sorted(names)[:16]) or "none"
