"""What a person sets of the belt: the region where fruit may be, and how the belt moves, for all sensors alike.

The plan of the belt has the axes of the belt's own frame (z up, z = 0 on it), as the reference sensor sees it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from fruitgui.frame import F64, Intrinsics
from fruitgui.geometry.plane import Surface
from fruitgui.geometry.pose import Pose
from fruitgui.station.station import Station, StationSensor

MOST_CORNERS = 8
"""A region that calibrating found is drawn with so few corners that a person can drag them."""

CLOSE_M = 0.05
"""Corners closer than this are hard to tell apart with a finger."""

SMALLEST_M2 = 0.01
FARTHEST_M = 6.0


def belt_pose(station: Station) -> Pose:
    """Return the pose from the reference frame onto the plan."""
    return station.sensors[station.reference].surface.plane.frame()


def onto_plan(station: Station, sensor: str, points_m: F64) -> F64:
    """Return the plan's (N, 2) of points (N, 3) in a sensor's optical frame."""
    return belt_pose(station).apply(station.sensors[sensor].pose.apply(points_m))[:, :2]


def off_plan(station: Station, sensor: str, plan_m: F64) -> F64:
    """Return where points of the plan (N, 2) lie on a sensor's own plane, (N, 3) in its optical frame."""
    flat = np.hstack([plan_m, np.zeros((len(plan_m), 1))])
    one = station.sensors[sensor]
    return one.surface.plane.foot(one.pose.inverse().apply(belt_pose(station).inverse().apply(flat)))


def region_of(station: Station) -> F64:
    """Return the region of all sensors together on the plan, (K, 2): convex, `MOST_CORNERS` at most."""
    import cv2

    regions = [
        onto_plan(station, name, one.surface.region_m)
        for name, one in station.sensors.items()
        if one.surface.region_m is not None
    ]
    if not regions:
        return np.array([[-0.4, -0.25], [0.4, -0.25], [0.4, 0.25], [-0.4, 0.25]])
    hull = cv2.convexHull(np.concatenate(regions).astype(np.float32))
    tolerance_m, corners = 0.002, hull
    while len(corners) > MOST_CORNERS:
        corners = cv2.approxPolyDP(hull, tolerance_m, True)
        tolerance_m *= 1.5
    return _merged(np.asarray(corners.reshape(-1, 2), dtype=np.float64))


def _merged(corners_m: F64) -> F64:
    """Return a convex polygon in which two corners that lie close together are one: where their outer edges meet."""
    count = len(corners_m)
    for i in range(count if count > 3 else 0):
        a, b, c, d = (corners_m[(i + step) % count] for step in (-1, 0, 1, 2))
        if np.hypot(*(c - b)) > CLOSE_M:
            continue
        edges = np.stack([b - a, c - d], axis=1)
        if abs(np.linalg.det(edges)) < 1e-6:
            continue
        met = a + (b - a) * np.linalg.solve(edges, d - a)[0]
        if max(np.hypot(*(met - b)), np.hypot(*(met - c))) < 3.0 * CLOSE_M:
            left = [corners_m[j] for j in range(count) if j != (i + 1) % count]
            left[i if i < count - 1 else i - 1] = met
            return _merged(np.array(left))
    return corners_m


def with_region(station: Station, corners_m: F64) -> Station:
    """Return the station with a region (K, 2) of the plan in every sensor's surface."""
    return replace(station, sensors={
        name: _with_region(station, name, one, corners_m) for name, one in station.sensors.items()
    })  # fmt: skip


def _with_region(station: Station, name: str, one: StationSensor, corners_m: F64) -> StationSensor:
    return replace(one, surface=Surface(one.surface.plane, off_plan(station, name, corners_m)))


def region_problem(corners_m: F64) -> str:
    """Return why corners (K, 2) make no region: `few`, `crossed`, `small`; empty where they do."""
    if len(corners_m) < 3:
        return "few"
    if _crossed(corners_m):
        return "crossed"
    return "small" if area_m2(corners_m) < SMALLEST_M2 else ""


def area_m2(corners_m: F64) -> float:
    """Return the area of a polygon (K, 2)."""
    x, y = corners_m.T
    return float(abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2.0)


def _crossed(corners_m: F64) -> bool:
    count = len(corners_m)
    edges = [(corners_m[i], corners_m[(i + 1) % count]) for i in range(count)]
    apart = [(i, j) for i, j in combinations(range(count), 2) if (j - i) % count not in (1, count - 1)]
    return any(_cross(edges[i], edges[j]) for i, j in apart)


def _cross(first: Sequence[F64], second: Sequence[F64]) -> bool:
    def side(a: F64, b: F64, c: F64) -> float:
        return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))

    (a, b), (c, d) = first, second
    return side(a, b, c) * side(a, b, d) < 0 and side(c, d, a) * side(c, d, b) < 0


@dataclass(frozen=True, slots=True)
class PlanMotion:
    """How the belt moves on the plan: speed, and heading from the plan's x axis towards its y axis."""

    speed_m_s: float
    heading_rad: float


def motion_of(station: Station) -> PlanMotion | None:
    """Return how the belt moves; None where every run is to find that out."""
    if station.velocity_m_s is None:
        return None
    vx, vy, _ = belt_pose(station).turn(station.velocity_m_s)
    return PlanMotion(float(np.hypot(vx, vy)), math.atan2(vy, vx))


def with_motion(station: Station, motion: PlanMotion | None) -> Station:
    """Return the station with the belt's motion; with None every run finds it out."""
    if motion is None:
        return replace(station, velocity_m_s=None)
    heading = np.array([math.cos(motion.heading_rad), math.sin(motion.heading_rad), 0.0])
    return replace(station, velocity_m_s=belt_pose(station).inverse().turn(motion.speed_m_s * heading))


def long_axis_rad(corners_m: F64) -> float:
    """Return the heading of a region's longer side, within ±90° of the plan's x axis."""
    import cv2

    box = cv2.boxPoints(cv2.minAreaRect(corners_m.astype(np.float32)))
    sides = [box[1] - box[0], box[2] - box[1]]
    longer = max(sides, key=lambda one: float(np.hypot(*one)))
    heading = math.atan2(float(longer[1]), float(longer[0]))
    return (heading + math.pi / 2) % math.pi - math.pi / 2


def seen_at(station: Station, sensor: str, camera: Intrinsics, plan_m: F64) -> F64:
    """Return the pixels (N, 2) at which a sensor sees points of the plan (N, 2); not a number behind it."""
    points = off_plan(station, sensor, plan_m)
    pixels = np.full((len(points), 2), np.nan)
    ahead = points[:, 2] > 0.05
    if ahead.any():
        pixels[ahead] = camera.project(points[ahead])
    return pixels


def looked_at(station: Station, sensor: str, camera: Intrinsics, pixels: F64) -> F64:
    """Return the points of the plan (N, 2) at which pixels (N, 2) look; not a number where they miss the belt."""
    import cv2

    lens = np.array(camera.distortion) if camera.distortion else None
    flat = cv2.undistortPoints(np.asarray(pixels, np.float64).reshape(-1, 1, 2), camera.matrix, lens).reshape(-1, 2)
    rays = np.hstack([flat, np.ones((len(flat), 1))])
    plane = station.sensors[sensor].surface.plane
    approach = -(rays @ plane.normal)
    with np.errstate(divide="ignore"):
        z = np.where(approach > 1e-6, plane.offset_m / np.maximum(approach, 1e-6), np.nan)
    z = np.where(z < FARTHEST_M, z, np.nan)
    return onto_plan(station, sensor, rays * z[:, None])
