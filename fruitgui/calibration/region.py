"""How far the belt reaches: the convex polygon of plane that a sensor sees as belt, rails left out.

A straight belt cut by a picture's edges is convex, so the hull of what lies on
the plane is right also behind fruit. A rail between sensor and belt hides a
strip of belt beside it; fruit standing there rise above the rail, so the region
is widened to the rail's foot.
"""

from __future__ import annotations

import cv2
import numpy as np

from fruitgui.calibration.still import Still
from fruitgui.frame import F64, Bools
from fruitgui.geometry.plane import Plane

CELL_M = 0.008
WIDEN_AT_MOST_M = 0.08
BRIDGED_M = 0.06
"""Rows of fruit and their shadows may part the belt that is seen; gaps up to this are belt all the same."""

RAIL_HEIGHTS_M = (0.012, 0.3)
FARTHEST_M = 4.0


def belt_region(still: Still, plane: Plane, on: Bools) -> F64 | None:
    """Return the region as (K, 3) points on the plane, in the optical frame; None where too little is seen."""
    frame = plane.frame()
    points = frame.apply(still.points()[on])[:, :2]
    points = points[np.abs(points).max(axis=1) < FARTHEST_M]
    if len(points) < 50:
        return None
    hull = _hull_of_belt(points, _cell_m(still, on))
    if hull is None:
        return None
    high = _high_points(still, plane)
    wide = _widened(hull, frame.apply(high)[:, :2]) if len(high) else hull
    flat = np.hstack([wide, np.zeros((len(wide), 1))])
    return np.asarray(frame.inverse().apply(flat))


def _cell_m(still: Still, on: Bools) -> float:
    """Return a cell large enough that the far end of the belt is not full of gaps."""
    far_m = float(np.percentile(1.0 / still.inverse_depth[on], 90))
    return max(CELL_M, 3.0 * far_m / still.intrinsics.fx)


def _hull_of_belt(points: F64, cell_m: float) -> F64 | None:
    """Return the hull (K, 2) of the largest connected patch of plane, strips thinner than three cells left out."""
    low = points.min(axis=0) - 4 * cell_m
    index = ((points - low) / cell_m).astype(int)
    raster = np.zeros(tuple(index.max(axis=0)[::-1] + 5), np.uint8)
    np.add.at(raster, (index[:, 1], index[:, 0]), 1)
    seen = cv2.morphologyEx((raster > 0).astype(np.uint8), cv2.MORPH_CLOSE, np.ones((3, 3), np.uint8))
    solid = cv2.morphologyEx(seen, cv2.MORPH_OPEN, np.ones((3, 3), np.uint8))
    reach = 2 * round(BRIDGED_M / 2 / cell_m) + 1
    bridged = cv2.dilate(solid, np.ones((reach, reach), np.uint8))
    count, names, stats, _ = cv2.connectedComponentsWithStats(bridged, connectivity=8)
    if count < 2:
        return None
    largest = 1 + int(stats[1:, cv2.CC_STAT_AREA].argmax())
    v, u = np.nonzero((names == largest) & (solid > 0))
    cells = np.stack([u, v], axis=1).astype(np.float32)
    hull = cv2.convexHull(cells)
    hull = cv2.approxPolyDP(hull, 1.0, closed=True).reshape(-1, 2).astype(np.float64)
    return (hull + 0.5) * cell_m + low if len(hull) >= 3 else None


def _high_points(still: Still, plane: Plane) -> F64:
    points = still.points()[::2, ::2]
    height_m = plane.height_m(points)
    chosen = (points[..., 2] > 0) & (height_m > RAIL_HEIGHTS_M[0]) & (height_m < RAIL_HEIGHTS_M[1])
    return np.asarray(points[chosen], dtype=np.float64)


def _widened(hull: F64, high: F64) -> F64:
    """Push every long edge of the hull out to the rail that runs along it, where one does.

    An edge with something high along more than half of its length is pushed to the tenth percentile
    of the distances at which it begins.
    """
    centre = hull.mean(axis=0)
    normals, offsets = [], []
    for start, end in zip(hull, np.roll(hull, -1, axis=0), strict=True):
        along = end - start
        length = float(np.linalg.norm(along))
        normal = np.array([along[1], -along[0]]) / max(length, 1e-9)
        normal = normal if normal @ (start - centre) > 0 else -normal
        normals.append(normal)
        offsets.append(normal @ start + _rail_distance_m(start, along / max(length, 1e-9), length, normal, high))
    return _intersection(np.array(normals), np.array(offsets), hull)


def _rail_distance_m(start: F64, along: F64, length: float, normal: F64, high: F64) -> float:
    bins = int(length / 0.03)
    if bins < 4:
        return 0.0
    from_edge = (high - start) @ normal
    place = ((high - start) @ along / length * bins).astype(int)
    near = (from_edge > 0) & (from_edge < WIDEN_AT_MOST_M) & (place >= 0) & (place < bins)
    first = np.full(bins, np.inf)
    np.minimum.at(first, place[near], from_edge[near])
    found = np.isfinite(first)
    return float(np.percentile(first[found], 10)) if found.mean() > 0.5 else 0.0


def _intersection(normals: F64, offsets: F64, hull: F64) -> F64:
    """Return the polygon of points p with normals·p ≤ offsets, started from a box far around the hull."""
    low, high = hull.min(axis=0) - 1.0, hull.max(axis=0) + 1.0
    polygon = np.array([[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]])
    for normal, offset in zip(normals, offsets, strict=True):
        polygon = _clipped(polygon, normal, offset)
        if len(polygon) < 3:
            return hull
    return polygon


def _clipped(polygon: F64, normal: F64, offset: float) -> F64:
    inside = polygon @ normal - offset
    kept: list[F64] = []
    for i, (a, b) in enumerate(zip(inside, np.roll(inside, -1), strict=True)):
        start, end = polygon[i], polygon[(i + 1) % len(polygon)]
        if a <= 0:
            kept.append(start)
        if a * b < 0:
            kept.append(start + (end - start) * (a / (a - b)))
    return np.array(kept).reshape(-1, 2)
