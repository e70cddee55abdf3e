"""Whether the rig still stands as it was calibrated (pure functions; the running line calls them).

A bump shows twice: the belt's plane moves in the bumped sensor's own view, and
fruit that two sensors see no longer lie at one place. A shift along the belt
leaves the plane where it was, so both are watched.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.calibration import planes
from fruitgui.calibration.still import Still, average
from fruitgui.frame import F64, Bools, Frame
from fruitgui.geometry.plane import Plane, Surface
from fruitgui.geometry.rig import Mount

ALARM_SIGMA = 5.0
PLANE_FLOOR_RAD, PLANE_FLOOR_M = float(np.radians(0.12)), 0.0015
"""Less than this is not worth an alarm: devices warm up and drift by as much."""

ELSEWHERE = 0.05
"""Where no larger share of the readings over the belt lies on it, fruit do not explain that."""

LEAST_SEEN = 0.5
"""Share of the belt's pixels that must have a reading for that; a sensor in the dark or covered tells nothing."""

FRUIT_FLOOR_M = 0.004
"""Centres of one fruit from two sides differ by as much without any bump (shape, hidden undersides)."""


@dataclass(frozen=True, slots=True)
class PlaneDrift:
    """How far a sensor's belt plane is from the station's.

    Attributes:
        tilt_rad: angle between the two planes.
        lift_m: mean distance between them over the region that was seen, signed along the station's normal.
        seen: share of the picture's pixels in the region that carried the belt.
        stale: beyond what noise and warming up explain.
    """

    tilt_rad: float
    lift_m: float
    seen: float
    stale: bool


@dataclass(frozen=True, slots=True)
class FruitDrift:
    """How far fruit that two sensors saw lie apart.

    Attributes:
        offset_m: median over fruit of the difference of centres, (3,) in the reference frame.
        std_m: standard deviation of that median.
        fruit: how many.
        stale: beyond what noise explains.
    """

    offset_m: tuple[float, float, float]
    std_m: float
    fruit: int
    stale: bool


def plane_drift(frames: Sequence[Frame], surface: Surface) -> PlaneDrift | None:
    """Compare the belt in recent frames of one sensor with the station's surface; None where too little is seen.

    Fruit on the belt do not matter: only what lies near the station's plane, or on one plane near it, is fitted.
    """
    still = average(frames)
    near = _near_belt(still, surface.plane)
    if near.sum() < 0.02 * near.size:
        return None
    fit, on = planes.refine(still, _first(still, near), near)
    tilt = float(np.arccos(np.clip(fit.plane.normal @ surface.plane.normal, -1.0, 1.0)))
    points = still.points()[on].astype(np.float64)
    lift = float(np.mean(surface.plane.height_m(points)))
    noise_rad, noise_m = _noise(fit, points)
    stale = tilt > PLANE_FLOOR_RAD + ALARM_SIGMA * noise_rad or abs(lift) > PLANE_FLOOR_M + ALARM_SIGMA * noise_m
    return PlaneDrift(tilt, lift, float(on.mean()), bool(stale))


def belt_elsewhere(frames: Sequence[Frame], mount: Mount) -> bool:
    """Tell whether hardly a reading over the station's belt lies on it in recent frames of one sensor.

    The sensor was turned far away, looks at another belt, or its depth is in another unit. Without a region nothing is
    told: a belt may be small in a picture.
    """
    if mount.surface.region_m is None:
        return False
    still = average(frames)
    over = _over_belt(mount)
    seen = over & still.seen
    if over.sum() < 0.02 * over.size or seen.sum() < LEAST_SEEN * over.sum():
        return False
    return bool(_near_belt(still, mount.surface.plane)[seen].mean() < ELSEWHERE)


def _over_belt(mount: Mount) -> Bools:
    """Return pixels (H, W) that look at the belt inside its region."""
    over = np.zeros((mount.intrinsics.height, mount.intrinsics.width), np.uint8)
    corners_m = mount.footprint_m()
    if len(corners_m):
        cv2.fillConvexPoly(over, np.rint(mount.intrinsics.project(corners_m)).astype(np.int32), 1)
    return over.astype(bool)


def _near_belt(still: Still, plane: Plane) -> Bools:
    """Return pixels within 60 mm of the station's plane: a bumped sensor's belt is still among them."""
    height_m = plane.height_m(still.points())
    return np.asarray(still.seen & (np.abs(height_m) < 0.06))


def _first(still: Still, near: Bools) -> F64:
    """Return a plane most of the near pixels agree with, by least squares repeated on the better half."""
    v, u = np.nonzero(near)
    thin = slice(None, None, max(1, len(v) // 20_000))
    rays = planes.rays_of(still)[v[thin], u[thin]]
    inverse = still.inverse_depth[v[thin], u[thin]].astype(np.float64)
    use: Bools = np.ones(len(inverse), dtype=bool)
    coefficients: F64 = np.zeros(3)
    for _ in range(8):
        coefficients = np.asarray(np.linalg.lstsq(rays[use], inverse[use], rcond=None)[0], dtype=np.float64)
        residual = inverse - rays @ coefficients
        # Fruit rise towards the sensor (larger inverse depth): the lower side is the belt's.
        use = (residual < np.percentile(residual, 60)) & (residual > np.percentile(residual, 2))
    return np.asarray(coefficients)


def _noise(fit: planes.PlaneFit, points_m: F64) -> tuple[float, float]:
    """Return standard deviations of the tilt (rad) and of the mean height (m) of a fitted plane."""
    length = float(np.linalg.norm(fit.coefficients))
    tilt = float(np.sqrt(np.trace(fit.covariance))) / length
    ray = points_m.mean(axis=0) / points_m[:, 2].mean()
    z = float(points_m[:, 2].mean())
    height = z**2 * float(np.sqrt(ray @ fit.covariance @ ray))
    return tilt, height


def fruit_drift(gaps_m: F64, covariances_m2: F64) -> FruitDrift | None:
    """Judge differences of centres (N, 3) of fruit that two sensors saw, both in the reference frame at one time.

    `covariances_m2` (N, 3, 3) are of each difference (both centres and the poses). None for fewer than five fruit.
    """
    if len(gaps_m) < 5:
        return None
    offset = np.median(gaps_m, axis=0)
    expected = np.sqrt(np.trace(covariances_m2, axis1=1, axis2=2).mean() / 3)
    observed = 1.4826 * float(np.median(np.abs(gaps_m - offset)))
    std = 1.2533 * max(float(expected), observed) / np.sqrt(len(gaps_m))
    stale = bool(np.linalg.norm(offset) > FRUIT_FLOOR_M + ALARM_SIGMA * std)
    return FruitDrift((float(offset[0]), float(offset[1]), float(offset[2])), float(std), len(gaps_m), stale)
