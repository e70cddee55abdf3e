"""Which sensors' projectors take turns, what rate that leaves to each, and how fast the belt may run then."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations

import numpy as np

from fruitgui.frame import F64, Frame, Intrinsics
from fruitgui.geometry.rig import Rig
from fruitgui.sensors.sensor import Projector, SensorInfo
from fruitgui.sensors.turns import USUAL_HZ, Schedule, Settling, lights_of, turns
from fruitgui.station.station import Station
from fruitgui.tracking.follow import FASTEST_M_S

WHOLE_FRUIT_M = 0.10
"""A fruit so long is to be seen whole: so much of the view is lost at its ends."""

LEAST_OVERLAP_M2 = 1e-4
USUAL_DISTANCE_M = 1.0
"""From sensor to belt, where no picture tells it."""

RIGS_KEPT = 4
"""The window asks for the plan twice a second; who overlaps is found once for each rig."""


@dataclass(frozen=True, slots=True)
class TurnPlan:
    """How projectors take turns.

    Attributes:
        schedule: the slots.
        overlaps_known: calibration told who overlaps; before that every sensor is alone.
        nominal_hz: by sensor, frames per second were it alone.
        rates_hz: by sensor, what its turns leave of them.
        highest_speed_m_s: of the belt, for three views of each fruit by each sensor; none is followed that is faster
            than `FASTEST_M_S`.
        clashes: pairs that see the same place and cannot take turns: one of their projectors cannot be switched.
    """

    schedule: Schedule
    overlaps_known: bool
    nominal_hz: Mapping[str, float]
    rates_hz: Mapping[str, float]
    highest_speed_m_s: float
    clashes: tuple[tuple[str, str], ...] = ()

    @property
    def takes_turns(self) -> bool:
        """Whether any projector has to be dark at times."""
        return len(self.schedule.slots) > 1


def turn_plan(
    infos: Mapping[str, SensorInfo],
    seen_m: Mapping[str, float],
    rig: Rig | None,
    settlings: Mapping[str, Settling] | None = None,
    disturbing: Iterable[tuple[str, str]] = (),
) -> TurnPlan:
    """Return the plan.

    Args:
        infos: of all sensors, in order.
        seen_m: by sensor, way along the belt that it sees; see `seen_length_m`.
        rig: as calibrated with just these sensors; None before that.
        settlings: as measured, by serial.
        disturbing: pairs that were measured to disturb each other.
    """
    overlaps = None if rig is None else overlapping(rig)
    schedule = schedule_of(infos, overlaps, settlings, disturbing)
    nominal_hz = {name: info.rate_hz or USUAL_HZ for name, info in infos.items()}
    speeds_m_s = [
        max(seen_m[name] - WHOLE_FRUIT_M, 0.0) / schedule.longest_wait_s(name, nominal_hz[name]) for name in infos
    ]
    return TurnPlan(
        schedule,
        overlaps is not None,
        nominal_hz,
        {name: schedule.rate_hz(name, nominal_hz[name]) for name in infos},
        min([*speeds_m_s, FASTEST_M_S]) if infos else 0.0,
        tuple(pair for pair in overlaps or () if _clash(*(infos[name].projector for name in pair))),
    )


def schedule_of(
    infos: Mapping[str, SensorInfo],
    overlaps: Iterable[tuple[str, str]] | None,
    settlings: Mapping[str, Settling] | None = None,
    disturbing: Iterable[tuple[str, str]] = (),
) -> Schedule:
    """Return the turns of those sensors that take any.

    Args:
        infos: of all sensors, in order.
        overlaps: pairs that see the same place; None before that is known.
        settlings: as measured, by serial.
        disturbing: pairs that were measured to disturb each other. They take turns wherever calibration says that
            they look; that a pair was not seen to disturb each other never lets it shine together.
    """
    lights = lights_of(infos.values(), settlings)
    among = None if overlaps is None else [pair for pair in (*overlaps, *disturbing) if lights.keys() >= set(pair)]
    return turns(lights, among)


def _clash(first: Projector, second: Projector) -> bool:
    return Projector.HARMLESS not in (first, second) and Projector.FIXED in (first, second)


@lru_cache(maxsize=RIGS_KEPT)
def overlapping(rig: Rig) -> tuple[tuple[str, str], ...]:
    """Return the pairs of sensors that see a common place of the belt."""
    footprints = {sensor: rig.footprint_m(sensor) for sensor in rig.mounts}
    return tuple(
        pair for pair in combinations(footprints, 2) if common_area_m2(*(footprints[one] for one in pair)) > 0.0
    )


def common_area_m2(first_m: F64, second_m: F64) -> float:
    """Return the area that two convex polygons (K, 2) share, m²; 0 where it is next to nothing."""
    import cv2

    if len(first_m) < 3 or len(second_m) < 3:
        return 0.0
    hulls = [cv2.convexHull(one.astype(np.float32)) for one in (first_m, second_m)]
    area_m2, _ = cv2.intersectConvexConvex(*hulls)
    return float(area_m2) if area_m2 > LEAST_OVERLAP_M2 else 0.0


def seen_length_m(camera: Intrinsics, newest: Frame | None) -> float:
    """Return about how much of the belt a sensor sees along its shorter side, from the distances in its picture."""
    distance_m = USUAL_DISTANCE_M
    if newest is not None:
        readings = newest.depth_mm[::8, ::8]
        readings = readings[readings > 0]
        if readings.size:
            distance_m = float(np.median(readings)) / 1000.0
    return distance_m * min(camera.width / camera.fx, camera.height / camera.fy)


def rig_of(station: Station | None, cameras: Mapping[str, Intrinsics]) -> Rig | None:
    """Return the station's rig where it was calibrated with just the sensors that are there; None otherwise.

    It is the same one, for the same station and cameras.
    """
    if station is None or set(station.sensors) != set(cameras):
        return None
    return _rig(station, tuple(cameras.items()))


@lru_cache(maxsize=RIGS_KEPT)
def _rig(station: Station, cameras: tuple[tuple[str, Intrinsics], ...]) -> Rig:
    return station.rig(dict(cameras))
