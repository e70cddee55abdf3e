"""Which sensors' projectors take turns, what rate that leaves to each, and how fast the belt may run then."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from fruitgui.frame import F64, Frame, Intrinsics
from fruitgui.geometry.rig import Rig
from fruitgui.sensors.turns import Schedule, turns
from fruitgui.station.station import Station

WHOLE_FRUIT_M = 0.10
"""A fruit so long is to be seen whole: so much of the view is lost at its ends."""

LEAST_OVERLAP_M2 = 1e-4
USUAL_DISTANCE_M = 1.0
"""From sensor to belt, where no picture tells it."""


@dataclass(frozen=True, slots=True)
class TurnPlan:
    """How projectors take turns.

    Attributes:
        schedule: the slots.
        overlaps_known: calibration told who overlaps; before that every sensor is alone.
        nominal_hz: of a sensor that never waits.
        highest_speed_m_s: of the belt, for three views of each fruit by each sensor.
    """

    schedule: Schedule
    overlaps_known: bool
    nominal_hz: float
    highest_speed_m_s: float

    @property
    def rate_hz(self) -> float:
        """Captures per second that are left to each sensor."""
        return self.schedule.rate_hz


def turn_plan(sensors: Sequence[str], nominal_hz: float, seen_m: Mapping[str, float], rig: Rig | None) -> TurnPlan:
    """Return the plan.

    Args:
        sensors: names, in order.
        nominal_hz: of a sensor that never waits, > 0.
        seen_m: by sensor, way along the belt that it sees; see `seen_length_m`.
        rig: as calibrated with just these sensors; None before that.
    """
    overlaps = None if rig is None else overlapping(rig)
    schedule = turns(sensors, overlaps, 1.0 / nominal_hz)
    shortest_m = min((seen_m[sensor] for sensor in sensors), default=0.0) - WHOLE_FRUIT_M
    speed_m_s = schedule.highest_belt_speed_m_s(shortest_m)
    return TurnPlan(schedule, overlaps is not None, nominal_hz, speed_m_s)


def overlapping(rig: Rig) -> list[tuple[str, str]]:
    """Return the pairs of sensors that see a common place of the belt."""
    footprints = {sensor: rig.footprint_m(sensor) for sensor in rig.mounts}
    return [pair for pair in combinations(footprints, 2) if common_area_m2(*(footprints[one] for one in pair)) > 0.0]


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
    """Return the station's rig where it was calibrated with just the sensors that are there; None otherwise."""
    if station is None or set(station.sensors) != set(cameras):
        return None
    return station.rig(cameras)
