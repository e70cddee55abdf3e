"""Per pixel, the depths at which something is fruit: one comparison per pixel replaces a point cloud per frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F32, F64, U16, Bools, Intrinsics, Ints
from fruitgui.geometry.plane import Plane, Surface
from fruitgui.perception.settings import PerceptionSettings

FARTHEST_MM = 9_999
"""Depth beyond which nothing is looked at."""


@dataclass(frozen=True, slots=True, eq=False)
class DepthLimits:
    """What one sensor needs of its geometry, worked out once. Arrays cover the `crop` of the picture only.

    Attributes:
        crop: rows and columns of the picture that can hold fruit.
        nearest_mm, farthest_mm: (h, w) uint16; a reading within them is above the belt, inside the region.
        slope: (h, w) float32; height above the belt is offset_m − slope · depth_m.
        offset_m: height of the sensor above the belt.
        ray_x, ray_y: float32, x/z and y/z: of every pixel (h, w); without a lens's distortion of every column (1, w)
            and of every row (h, 1). A table that is small stays near the processor.
        belt_z_m: median distance of the belt along z inside the crop.
        focal_px: geometric mean of the focal lengths.
        turn: (3, 3) rotation from the optical frame to the belt's (z up).
        edges: (E, 3) half-planes m·(x, y, 1) ≥ 0 of the region in the belt frame; E = 0 without a region.
        inset_m: how far inside the region's edge fruit are looked for.
        edge_m: nearer to the region's edge than this, a fruit may be cut by it.
        near_edge: (h·w,) whether anything that stands on the belt can be so near, seen by a pixel.
    """

    crop: tuple[slice, slice]
    nearest_mm: U16
    farthest_mm: U16
    slope: F32
    offset_m: float
    ray_x: F32
    ray_y: F32
    belt_z_m: float
    focal_px: float
    turn: F64
    edges: F64
    inset_m: float
    edge_m: float
    near_edge: Bools

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of the crop."""
        return (int(self.nearest_mm.shape[0]), int(self.nearest_mm.shape[1]))

    def inside_m(self, points_m: F64) -> F64:
        """Return how far points (N, 3) of the optical frame are inside the region's edge, (N,); inf without one."""
        return _inside_m(points_m, self.turn, self.edges)

    def rays_at(self, row: Ints, column: Ints) -> tuple[F32, F32]:
        """Return x/z and y/z (K,) of pixels of the crop."""
        if len(self.ray_x) == 1:
            return self.ray_x.reshape(-1).take(column), self.ray_y.reshape(-1).take(row)
        index = row * self.shape[1] + column
        return self.ray_x.reshape(-1).take(index), self.ray_y.reshape(-1).take(index)

    def pixels_of(self, length_m: float, z_m: float) -> float:
        """Return how many pixels a length at distance z spans."""
        return length_m * self.focal_px / z_m


def depth_limits(intrinsics: Intrinsics, surface: Surface, settings: PerceptionSettings) -> DepthLimits:
    """Return the depth limits of a sensor that looks at `surface`."""
    rays = intrinsics.rays().astype(np.float64)
    plane = surface.plane.facing(np.zeros(3))
    slope = -(rays @ plane.normal[:2] + plane.normal[2])
    nearest, farthest = _height_limits(slope, float(plane.offset_m), settings)
    edges = _region_edges(surface.region_m, plane)
    inset_m = _inset_m(intrinsics, plane, settings)
    nearest, farthest = _within_region(nearest, farthest, rays, plane, edges - [0.0, 0.0, inset_m])
    usable = (farthest > nearest) & (slope > 1e-3)
    nearest_mm = np.where(usable, np.clip(np.ceil(nearest * 1e3), 1, FARTHEST_MM), 1).astype(np.uint16)
    farthest_mm = np.where(usable, np.clip(np.floor(farthest * 1e3), 0, FARTHEST_MM), 0).astype(np.uint16)
    crop = _bounding(farthest_mm >= nearest_mm)
    inside = (farthest_mm >= nearest_mm)[crop]
    belt_z = plane.offset_m / np.maximum(slope[crop], 1e-3)
    belt_z_m = float(np.median(belt_z[inside])) if inside.any() else float(plane.offset_m)
    focal_px = float(np.sqrt(intrinsics.fx * intrinsics.fy))
    bent = bool(intrinsics.distortion)
    edge_m = inset_m + 2.0 * belt_z_m / focal_px
    return DepthLimits(
        crop=crop,
        nearest_mm=np.ascontiguousarray(nearest_mm[crop]),
        farthest_mm=np.ascontiguousarray(farthest_mm[crop]),
        slope=np.ascontiguousarray(slope[crop], dtype=np.float32),
        offset_m=float(plane.offset_m),
        ray_x=rays[(crop[0] if bent else slice(crop[0].start, crop[0].start + 1), crop[1])][..., 0].astype(np.float32),
        ray_y=rays[(crop[0], crop[1] if bent else slice(crop[1].start, crop[1].start + 1))][..., 1].astype(np.float32),
        belt_z_m=belt_z_m,
        focal_px=focal_px,
        turn=plane.frame().rotation,
        edges=edges,
        inset_m=inset_m,
        edge_m=edge_m,
        near_edge=_near_edge(rays[crop], nearest_mm[crop], farthest_mm[crop], plane.frame().rotation, edges, edge_m),
    )


def _inside_m(points_m: F64, turn: F64, edges: F64) -> F64:
    if len(edges) == 0:
        return np.full(len(points_m), np.inf)
    return np.asarray((points_m @ (edges[:, :2] @ turn[:2]).T + edges[:, 2]).min(axis=1))


def _height_limits(slope: F64, offset_m: float, settings: PerceptionSettings) -> tuple[F64, F64]:
    """Return the depths (h, w) of the tallest and the lowest height looked at, along every ray."""
    safe = np.maximum(slope, 1e-3)
    belt_z = offset_m / safe
    noise = (3.0 * settings.noise_at_m(belt_z) + 0.5 * settings.step_at_m(belt_z)) * safe
    lowest = np.maximum(settings.lowest_m, noise + 1e-3 * belt_z * safe)
    return (offset_m - settings.tallest_m) / safe, (offset_m - np.minimum(lowest, 0.5 * settings.tallest_m)) / safe


def _region_edges(region_m: F64 | None, plane: Plane) -> F64:
    """Return half-planes (E, 3) of the region's convex hull in the belt frame, unit normals inwards."""
    if region_m is None or len(region_m) < 3:
        return np.zeros((0, 3))
    import cv2

    flat = plane.frame().apply(region_m)[:, :2].astype(np.float32)
    hull = cv2.convexHull(flat).reshape(-1, 2).astype(np.float64)
    along = np.roll(hull, -1, axis=0) - hull
    length = np.linalg.norm(along, axis=1)
    hull, along = hull[length > 1e-6], along[length > 1e-6] / length[length > 1e-6, None]
    inward = np.stack([-along[:, 1], along[:, 0]], axis=1)
    inward *= np.sign(np.sum(inward * (hull.mean(axis=0) - hull), axis=1))[:, None]
    return np.hstack([inward, -np.sum(inward * hull, axis=1)[:, None]])


def _inset_m(intrinsics: Intrinsics, plane: Plane, settings: PerceptionSettings) -> float:
    """Return how far inside the region's edge fruit are looked for: noise and widened edges carry rails over it."""
    noise_m = float(settings.noise_at_m(np.array(plane.offset_m)))
    return noise_m + settings.fattening_px * plane.offset_m / intrinsics.fx


def _within_region(nearest: F64, farthest: F64, rays: F64, plane: Plane, edges: F64) -> tuple[F64, F64]:
    """Narrow the limits to depths whose foot on the belt lies inside the region.

    A half-plane of the region, swept along the belt's normal, is linear in depth
    along a ray, so the limits are exact and cost nothing while running.
    """
    turn = plane.frame().rotation
    for edge in edges:
        normal = edge[:2] @ turn[:2]
        rate = rays @ normal[:2] + normal[2]
        with np.errstate(divide="ignore", invalid="ignore"):
            crossing = -edge[2] / rate
        nearest = np.where(rate > 0, np.maximum(nearest, crossing), nearest)
        farthest = np.where(rate < 0, np.minimum(farthest, crossing), farthest)
        farthest = np.where((rate == 0) & (edge[2] < 0), 0.0, farthest)
    return nearest, farthest


def _near_edge(rays: F64, nearest_mm: U16, farthest_mm: U16, turn: F64, edges: F64, edge_m: float) -> Bools:
    """Tell which pixels (h·w,) may see something within `edge_m` of the region's edge.

    How far inside a point is, is concave along a ray: least at either end of what is looked at.
    """
    near = np.zeros(rays.shape[:2], dtype=bool)
    for edge in edges:
        normal = edge[:2] @ turn[:2] * 1e-3
        rate_m = rays @ normal[:2] + normal[2]
        least_m = edge_m - edge[2]
        near |= (rate_m * nearest_mm < least_m) | (rate_m * farthest_mm < least_m)
    return near.reshape(-1)


def half_of(rows: int, columns: int) -> tuple[int, int]:
    """Return rows and columns of a picture at half its size."""
    return max(rows // 2, 1), max(columns // 2, 1)


def _bounding(usable: Bools) -> tuple[slice, slice]:
    """Return the rows and columns around the usable pixels, an even number of each where the picture allows."""
    rows, columns = np.flatnonzero(usable.any(axis=1)), np.flatnonzero(usable.any(axis=0))
    if len(rows) == 0:
        return slice(0, 2), slice(0, 2)
    return _even(rows, usable.shape[0]), _even(columns, usable.shape[1])


def _even(inside: Ints, size: int) -> slice:
    first, last = int(inside[0]), int(inside[-1]) + 1
    odd = (last - first) % 2
    return slice(first, last + odd) if last + odd <= size else slice(max(first - odd, 0), last)
