"""A station brought together with the sensors that are there: who is who, how their clocks and depths are put right."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from fruitgui.frame import Frame
from fruitgui.geometry.rig import Rig
from fruitgui.perception.settings import PerceptionSettings
from fruitgui.sensors.depth_correction import DepthCorrection
from fruitgui.sensors.sensor import SensorInfo
from fruitgui.station.crew import Eye
from fruitgui.station.matching import match_sensors
from fruitgui.station.station import Station

TALLER = 1.3
"""So many times the tallest fruit expected is still looked at: fruit stand up, ride on others, and grow."""


@dataclass(frozen=True, slots=True, eq=False)
class Lineup:
    """Sensors of a station that are there; all by the id that their frames carry, but the rig.

    Attributes:
        station_id: the station's own id.
        offsets_s: added to a sensor's stamps gives the reference clock.
        corrections: of depth, where the station has one.
        eyes: what perceives each sensor's frames.
        rig: of these sensors, by the station's ids.
        warnings: sensors that one side lacks.
    """

    station_id: Mapping[str, str]
    offsets_s: Mapping[str, float]
    corrections: Mapping[str, DepthCorrection]
    eyes: Mapping[str, Eye]
    rig: Rig
    warnings: tuple[str, ...]

    def corrected(self, frame: Frame) -> Frame:
        """Return a device's own frame with its depth put right; once, where frames are read."""
        correction = self.corrections.get(frame.sensor)
        return frame if correction is None else correction.corrected(frame)


def limits_of(station: Station) -> PerceptionSettings:
    """Return inside which limits something on a station's belt is looked at as fruit.

    What is smaller than the shortest fruit is seen all the same, as far as it usually is: whatever crosses is counted.
    """
    usual = PerceptionSettings()
    if station.fruit_heights_m is None:
        return usual
    shortest_m, tallest_m = station.fruit_heights_m
    return replace(usual, smallest_m=min(shortest_m, usual.smallest_m), tallest_m=TALLER * tallest_m)


def unheard(given_s: Iterable[str], sensors: Iterable[str]) -> list[str]:
    """Return a warning for each clock offset that is given for a sensor that there is not."""
    known = set(sensors)
    return [
        f"A clock offset is given for {name}, but there is no such sensor." for name in given_s if name not in known
    ]


def line_up(station: Station, sensors: Iterable[SensorInfo], given_s: Mapping[str, float] | None = None) -> Lineup:
    """Return who of the sensors is who of the station.

    Args:
        station: the station.
        sensors: that are there.
        given_s: clock offsets that a person gave, by either of a sensor's ids; they win over the station's.

    Raises:
        InputError: the station has none of the sensors.
    """
    infos = {info.sensor: info for info in sensors}
    matching = match_sensors(station, infos.values())
    names = matching.station_id
    given = given_s or {}
    rig = station.rig({name: infos[sensor].intrinsics for sensor, name in names.items()})
    return Lineup(
        station_id=names,
        offsets_s={
            sensor: given.get(sensor, given.get(name, station.sensors[name].clock_offset_s))
            for sensor, name in names.items()
        },
        corrections={
            sensor: correction
            for sensor, name in names.items()
            if (correction := station.sensors[name].depth_correction) is not None
        },
        eyes={
            sensor: Eye(name, infos[sensor].intrinsics, rig.mounts[name].surface, limits_of(station))
            for sensor, name in names.items()
        },
        rig=rig,
        warnings=(*matching.warnings, *unheard(given, [*infos, *station.sensors])),
    )
