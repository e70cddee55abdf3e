"""The product's feature vector: what a fruit looks like and how it is shaped, whatever the light and the distance.

`shape_` features have no unit, `size_` features are logarithms of metres.
"""

from __future__ import annotations

import numpy as np

from fruitgui.frame import F32, F64
from fruitgui.perception.centre import Heights
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

INNER_PX = 2.5
"""Points nearer to the edge than this are not fitted: structured light widens edges."""

FEATURE_NAMES: tuple[str, ...] = (*COLOUR_NAMES, *SHAPE_NAMES, *SIZE_NAMES)
"""The names of `FruitView.features`, in order."""


def shape_features(pixels: Pixels, ellipses: Ellipses, heights: Heights, centre_m: F64, limits: DepthLimits) -> F64:
    """Return shape and size features (N, 18).

    Args:
        pixels: of all fruit.
        ellipses: fitted to their outlines.
        heights: of all fruit.
        centre_m: (N, 3) their centres.
        limits: of the sensor.
    """
    top_m = heights.top_m
    scale = centre_m[:, 2] / limits.focal_px
    length, width = ellipses.axes_px.T * scale
    root_area = np.sqrt(np.maximum(ellipses.area_px, 1.0)) * scale
    flat = pixels.valid * (pixels.height_m > pixels.runs.spread(0.9 * top_m))
    inner = pixels.valid * (pixels.edge_px > INNER_PX)
    flat_sum, seen, inner_sum = pixels.runs.sums(flat, pixels.valid, inner)
    few = inner_sum < 12
    if few.any():
        inner = np.where(few.repeat(pixels.runs.counts), pixels.valid, inner)
    radius, residual = fit_spheres(pixels, inner)
    columns = [
        width / length,
        top_m / width,
        top_m / root_area,
        ellipses.area_px / (np.pi / 4.0 * ellipses.axes_px[:, 0] * ellipses.axes_px[:, 1]),
        ellipses.solidity,
        ellipses.error,
        ellipses.tips,
        _lopsidedness(pixels, ellipses, centre_m, limits),
        *(heights.spread_m / top_m[:, None]).T,
        flat_sum / np.maximum(seen, 1.0),
        np.log(2.0 * radius / top_m),
        np.minimum(residual / top_m, 1.0),
        *np.log(np.stack([top_m, length, width, root_area])),
    ]
    return np.array(columns).T


def _lopsidedness(pixels: Pixels, ellipses: Ellipses, centre_m: F64, limits: DepthLimits) -> F64:
    """Return how unlike the two ends of the longer axis are: skewness of the silhouette along it, (N,)."""
    runs, scale = pixels.runs, limits.focal_px / ellipses.axes_px[:, 0]
    cosine, sine = np.cos(ellipses.angle_rad) * scale, np.sin(ellipses.angle_rad) * scale
    along = pixels.ray_x * runs.spread(cosine)
    along += pixels.ray_y * runs.spread(sine)
    along -= runs.spread((cosine * centre_m[:, 0] + sine * centre_m[:, 1]) / centre_m[:, 2])
    square = along * along
    first, second, third = runs.sums(along, square, square * along) / np.maximum(runs.counts, 1)
    variance = np.maximum(second - first**2, 1e-9)
    return np.asarray(np.abs(third - 3.0 * first * second + 2.0 * first**3) / (variance * np.sqrt(variance)))


def fit_spheres(pixels: Pixels, weight: F32) -> tuple[F64, F64]:
    """Return radius (N,) of the sphere fitted to each fruit's points (least squares), and rms distance from it.

    |p|² = 2 c·p + (r² − |c|²) is linear in c and the last term (Coope 1993).
    `weight` (P,) of each point is 0 or 1.
    """
    runs = pixels.runs
    total, *sums = runs.sums(weight, weight * pixels.x_m, weight * pixels.y_m, weight * pixels.depth_m)
    total = np.maximum(total, 1.0)
    x, y, z = (
        (part - runs.spread(middle / total)) * weight
        for part, middle in zip((pixels.x_m, pixels.y_m, pixels.depth_m), sums, strict=True)
    )
    xx, yy, zz = x * x, y * y, z * z
    square = xx + yy + zz
    xx, xy, xz, yy, yz, zz, sx, sy, sz, ss = (
        runs.sums(xx, x * y, x * z, yy, y * z, zz, square * x, square * y, square * z, square * square) / total
    )
    s = xx + yy + zz
    little = 1e-4 * s + 1e-12
    matrix = np.array([xx + little, xy, xz, xy, yy + little, yz, xz, yz, zz + little]).T.reshape(-1, 3, 3)
    # Relative to the points' mean the linear terms vanish, so the constant is the mean square.
    right = np.array([sx, sy, sz]).T
    centre = 0.5 * np.linalg.solve(matrix, right[:, :, None])[:, :, 0]
    radius = np.sqrt(np.maximum(s + (centre**2).sum(axis=1), 1e-8))
    left = ss - s**2 - 2.0 * (centre * right).sum(axis=1)
    return np.minimum(np.maximum(radius, 1e-3), 0.5), np.sqrt(np.maximum(left, 0.0)) / (2.0 * radius)
