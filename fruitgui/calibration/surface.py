"""The belt as one sensor sees it: which plane it is, where exactly, and how far it reaches.

The largest plane need not be the belt: a floor beside a narrow belt, or a wall
behind a table, may hold more pixels. What makes a plane the belt is that things
stand on it, that it is the nearest of parallel planes, and that it is large.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.calibration import planes
from fruitgui.calibration.planes import PlaneFit
from fruitgui.calibration.region import belt_region
from fruitgui.calibration.still import Still
from fruitgui.frame import F64, Bools
from fruitgui.geometry.plane import Plane, Surface

OBJECT_HEIGHTS_M = (0.015, 0.25)
OBJECT_AREAS_M2 = (4e-4, 0.09)
MARGIN_PX = 4.0
"""Edges are fattened by up to two pixels and registered to within one, at 640 pixels across."""

LEAST_STEP_OFF = 1e-3
BENT_RAD, BENT_M = float(np.radians(0.008)), 0.0001
"""What lens and registration bend in a picture and no residual shows."""


@dataclass(frozen=True, slots=True, eq=False)
class Belt:
    """The belt as fitted in one sensor's averaged picture.

    Attributes:
        surface: plane and region, in the optical frame.
        covariance: (3, 3) of the plane in its own frame (`plane.frame()`): turn about x and y (rad), height (m).
        rms_m: spread of the averaged readings about the plane.
        on: (H, W) pixels that lie on it.
        warnings: what a person should look at.
    """

    surface: Surface
    covariance: F64
    rms_m: float
    on: Bools
    warnings: tuple[str, ...]

    @property
    def plane(self) -> Plane:
        """The plane alone."""
        return self.surface.plane


@dataclass(frozen=True, slots=True)
class _Rating:
    """How much a plane looks like the belt (log scale)."""

    score: float
    fraction: float


def fit_belt(still: Still) -> Belt | None:
    """Find the belt in one sensor's averaged picture; None where no plane of any size is in view."""
    found = planes.candidates(still)
    if not found:
        return None
    ratings = [_rate(still, candidate, found) for candidate in found]
    order = sorted(range(len(found)), key=lambda i: -ratings[i].score)
    fit, on = planes.refine(still, found[order[0]], np.ones(still.seen.shape, dtype=bool))
    away = _away_from_objects(still, fit)
    if (on & away).sum() > 0.3 * on.sum():
        fit, on = planes.refine(still, fit.coefficients, away)
    flush = still.seen & (np.abs(still.inverse_depth - planes.rays_of(still) @ fit.coefficients) < planes.ON_PLANE)
    surface = Surface(fit.plane, belt_region(still, fit.plane, flush))
    warnings = _doubts(still.sensor, [ratings[i] for i in order])
    distance_m = float(np.median(1.0 / still.inverse_depth[on]))
    return Belt(surface, _covariance_on_plane(fit), fit.spread * distance_m**2, on, warnings)


def _doubts(sensor: str, ordered: list[_Rating]) -> tuple[str, ...]:
    if len(ordered) > 1 and ordered[0].score - ordered[1].score < 0.5:
        return (
            f"{sensor}: two planes in view could be the belt; the chosen one holds {ordered[0].fraction:.0%} of the "
            f"picture, the other {ordered[1].fraction:.0%}. Check the surface, or put some fruit on the belt.",
        )
    return ()


def _rate(still: Still, candidate: F64, found: list[F64]) -> _Rating:
    """Rate one plane: its share of the picture, what stands on it, and what lies parallel above it."""
    stride = max(1, round(still.intrinsics.width / 320))
    inverse = still.inverse_depth[::stride, ::stride].astype(np.float64)
    rays = planes.rays_of(still, stride)
    residual = inverse - rays @ candidate
    on = (inverse > 0) & (np.abs(residual) < planes.ON_PLANE)
    fraction = float(on.sum() / max((inverse > 0).sum(), 1))
    plane = planes.plane_of(candidate)
    standing = _things_standing(still, plane, inverse, rays, on, stride)
    nearer = any(_lies_under(plane, planes.plane_of(other), still, other) for other in found if other is not candidate)
    upright = float(np.clip(-plane.normal[1], -1.0, 1.0))
    score = np.log(fraction + 1e-9) + 0.6 * min(standing, 6) + 1.0 * upright - 2.5 * nearer
    return _Rating(float(score), fraction)


def _things_standing(still: Still, plane: Plane, inverse: F64, rays: F64, on: Bools, stride: int) -> int:
    """Count compact things that stand on the plane, seen whole and surrounded by it."""
    z = np.divide(1.0, inverse, out=np.zeros_like(inverse), where=inverse > 0)
    height_m = plane.height_m(rays * z[..., None])
    low, high = OBJECT_HEIGHTS_M
    above = (inverse > 0) & (height_m > low + 2 * planes.ON_PLANE * z**2) & (height_m < high)
    count, names, stats, _ = cv2.connectedComponentsWithStats(above.astype(np.uint8), connectivity=4)
    pixel_m2 = z**2 * stride**2 / (still.intrinsics.fx * still.intrinsics.fy)
    areas = np.bincount(names.ravel(), pixel_m2.ravel(), count)
    around = cv2.dilate(on.astype(np.uint8), np.ones((9, 9), np.uint8)).astype(bool)
    rims = above & ~cv2.erode(above.astype(np.uint8), np.ones((3, 3), np.uint8)).astype(bool)
    rim_total = np.bincount(names[rims], minlength=count)
    rim_near = np.bincount(names[rims & around], minlength=count)
    heights, widths = above.shape
    left, top, width, height = stats[:, 0], stats[:, 1], stats[:, 2], stats[:, 3]
    inside = (left > 0) & (top > 0) & (left + width < widths) & (top + height < heights)
    good = inside & (areas > OBJECT_AREAS_M2[0]) & (areas < OBJECT_AREAS_M2[1]) & (rim_near > 0.5 * rim_total)
    good[0] = False
    return int(good.sum())


def _lies_under(plane: Plane, other: Plane, still: Still, other_coefficients: F64) -> bool:
    """Tell whether a parallel plane that runs out of the picture lies between this one and the sensor."""
    if plane.normal @ other.normal < np.cos(np.radians(8.0)) or other.offset_m > plane.offset_m - 0.02:
        return False
    stride = max(1, round(still.intrinsics.width / 160))
    inverse = still.inverse_depth[::stride, ::stride]
    on = (inverse > 0) & (np.abs(inverse - planes.rays_of(still, stride) @ other_coefficients) < planes.ON_PLANE)
    if on.sum() < 0.1 * (inverse > 0).sum():
        return False
    sides = (on[:4].any(axis=0), on[-4:].any(axis=0), on[:, :4].any(axis=1), on[:, -4:].any(axis=1))
    return sum(int(side.sum()) > 8 for side in sides) >= 2


def _away_from_objects(still: Still, fit: PlaneFit) -> Bools:
    """Return pixels not beside anything that leaves the plane, low rails too: fattened edges pull on the fit there."""
    off = still.inverse_depth - planes.rays_of(still) @ fit.coefficients
    leaves = still.seen & (np.abs(off) > max(4.0 * fit.spread, LEAST_STEP_OFF))
    patches = cv2.morphologyEx(leaves.astype(np.uint8), cv2.MORPH_OPEN, np.ones((3, 3), np.uint8))
    margin = 2 * max(2, round(MARGIN_PX * still.intrinsics.width / 640)) + 1
    return np.asarray(cv2.dilate(patches, np.ones((margin, margin), np.uint8)) == 0)


def _covariance_on_plane(fit: PlaneFit) -> F64:
    """Return the covariance of (turn about x, turn about y, height) in the plane's own frame, first order.

    The turns and the lift are what would have to be done to the plane as fitted to bring it onto the
    true one, about the foot of the sensor.
    """
    a = fit.coefficients
    length = float(np.linalg.norm(a))
    into_plane = fit.plane.frame().rotation
    n = -a / length
    d_normal = -(np.eye(3) - np.outer(n, n)) / length  # dn/da
    d_offset = -a / length**3  # d(1/|a|)/da
    # On the plane's frame n = (0, 0, 1): a turn (ωx, ωy) moves it by (ωy, −ωx, 0); a lift moves the offset by −h.
    turned = into_plane @ d_normal
    J = np.stack([-turned[1], turned[0], -d_offset])
    return np.asarray(J @ fit.covariance @ J.T + np.diag([BENT_RAD**2, BENT_RAD**2, BENT_M**2]))
