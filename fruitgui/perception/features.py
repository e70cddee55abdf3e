"""The product's feature vector: what a fruit looks like and how it is shaped, whatever the light and the distance.

`shape_` features have no unit, `size_` features are logarithms of metres.
"""

from __future__ import annotations

import numpy as np

from fruitgui.frame import F32, F64
from fruitgui.perception.colour import COLOUR_NAMES
from fruitgui.perception.limits import DepthLimits
from fruitgui.perception.outline import Ellipses
from fruitgui.perception.pixels import Pixels

SHAPE_NAMES = (
    "shape_width_to_length",
    "shape_height_to_width",
    "shape_height_to_root_area",
    "shape_fill",
    "shape_solidity",
    "shape_ellipse_error",
    "shape_tips",
    "shape_lopsidedness",
    "shape_height_p20",
    "shape_height_p50",
    "shape_height_p80",
    "shape_flat_share",
    "shape_sphere_radius",
    "shape_sphere_residual",
)
SIZE_NAMES = ("size_height", "size_length", "size_width", "size_root_area")

FEATURE_NAMES: tuple[str, ...] = (*COLOUR_NAMES, *SHAPE_NAMES, *SIZE_NAMES)
"""The names of `FruitView.features`, in order."""


def shape_features(pixels: Pixels, ellipses: Ellipses, top_m: F64, away_m: F64, limits: DepthLimits) -> F64:
    """Return shape and size features (N, 18).

    Args:
        pixels: of all fruit.
        ellipses: fitted to their outlines.
        top_m: (N,) height of their tops above the belt.
        away_m: (N,) distance of their centres along z.
        limits: of the sensor.
    """
    scale = away_m / limits.focal_px
    length, width = ellipses.axes_px.T * scale
    root_area = np.sqrt(np.maximum(ellipses.area_px, 1.0)) * scale
    heights = pixels.quantiles(pixels.height_m, pixels.valid, 0.0, 0.256, (0.2, 0.5, 0.8)) / top_m[:, None]
    flat = (pixels.valid * (pixels.height_m > (0.9 * top_m).astype(np.float32).take(pixels.owner))).astype(np.float32)
    flat_sum, seen = pixels.sums(flat, pixels.valid)
    radius, residual = fit_spheres(pixels)
    columns = [
        width / length,
        top_m / width,
        top_m / root_area,
        ellipses.area_px / (np.pi / 4.0 * ellipses.axes_px.prod(axis=1)),
        ellipses.solidity,
        ellipses.error,
        ellipses.tips,
        _lopsidedness(pixels, ellipses, limits),
        *heights.T,
        flat_sum / np.maximum(seen, 1.0),
        np.log(2.0 * radius / top_m),
        np.minimum(residual / top_m, 1.0),
        *np.log(np.stack([top_m, length, width, root_area])),
    ]
    return np.array(columns).T


def _lopsidedness(pixels: Pixels, ellipses: Ellipses, limits: DepthLimits) -> F64:
    """Return how unlike the two ends of the longer axis are: skewness of the silhouette along it, (N,)."""
    row, column = np.divmod(pixels.index, limits.shape[1])
    axis = np.stack([np.cos(ellipses.angle_rad), np.sin(ellipses.angle_rad)]) / ellipses.axes_px[:, 0]
    shift = (axis * ellipses.centre_px.T).sum(axis=0).astype(np.float32)
    u_part, v_part = axis.astype(np.float32)
    along = column.astype(np.float32) * u_part.take(pixels.owner) + row.astype(np.float32) * v_part.take(pixels.owner)
    along -= shift.take(pixels.owner)
    square = along * along
    first, second, third = pixels.sums(along, square, square * along) / np.maximum(pixels.counts, 1)
    variance = np.maximum(second - first**2, 1e-9)
    return np.asarray(np.abs(third - 3.0 * first * second + 2.0 * first**3) / variance**1.5)


def fit_spheres(pixels: Pixels) -> tuple[F64, F64]:
    """Return radius (N,) of the sphere fitted to each fruit's inner points (least squares), and rms distance from it.

    |p|² = 2 c·p + (r² − |c|²) is linear in c and the last term (Coope 1993).
    """
    weight = (pixels.valid * (pixels.edge_px > 2.5)).astype(np.float32)
    few = pixels.sums(weight) < 12
    if few.any():
        weight = np.where(few.take(pixels.owner), pixels.valid, weight)
    x, y, z, total = _centred(pixels, weight)
    square = x * x + y * y + z * z
    wx, wy, wz, ws = weight * x, weight * y, weight * z, weight * square
    xx, xy, xz, yy, yz, zz, sx, sy, sz, ss, s = (
        pixels.sums(wx * x, wx * y, wx * z, wy * y, wy * z, wz * z, ws * x, ws * y, ws * z, ws * square, ws) / total
    )
    matrix = np.array([xx, xy, xz, xy, yy, yz, xz, yz, zz]).T.reshape(-1, 3, 3)
    # Relative to the points' mean the linear terms vanish, so the constant is the mean square.
    right = np.array([sx, sy, sz]).T
    ridge = 1e-4 * (xx + yy + zz)[:, None, None] * np.eye(3) + 1e-12 * np.eye(3)
    centre = 0.5 * np.linalg.solve(matrix + ridge, right[:, :, None])[:, :, 0]
    radius = np.sqrt(np.maximum(s + (centre**2).sum(axis=1), 1e-8))
    left = ss - s**2 - 2.0 * (centre * right).sum(axis=1)
    return np.clip(radius, 1e-3, 0.5), np.sqrt(np.maximum(left, 0.0)) / (2.0 * radius)


def _centred(pixels: Pixels, weight: F32) -> tuple[F32, F32, F32, F64]:
    """Return the points relative to the weighted mean of their fruit's, and each fruit's weight."""
    z = pixels.depth_m
    points = (pixels.ray_x * z, pixels.ray_y * z, z)
    total, *sums = pixels.sums(weight, *(weight * part for part in points))
    total = np.maximum(total, 1.0)
    x, y, z = (
        part - (middle / total).astype(np.float32).take(pixels.owner) for part, middle in zip(points, sums, strict=True)
    )
    return x, y, z, total
