"""What a fruit looks like, as numbers that light and distance do not change.

Colours come from the fruit's own pixels, away from its edge, where neither the
belt nor a widened edge mixes in. Brightness is compared with the belt's in the
same picture; hue, saturation and chromaticity do not depend on it. Geometry is in
metres. All fruit of a frame are worked out together.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.frame import F32, F64, U8
from fruitgui.perception.limits import DepthLimits
from fruitgui.perception.outline import Ellipses
from fruitgui.perception.pixels import Pixels

HUE_BINS, SATURATION_BINS, VALUE_BINS = 16, 8, 8

COLOUR_NAMES = (
    *(f"hue_{i}" for i in range(HUE_BINS)),
    *(f"saturation_{i}" for i in range(SATURATION_BINS)),
    *(f"relative_value_{i}" for i in range(VALUE_BINS)),
    "red_share",
    "green_share",
    "red_share_std",
    "green_share_std",
    "hue_cosine",
    "hue_sine",
    "hue_strength",
    "saturation_mean",
    "saturation_std",
    "log_value_to_belt",
    "log_red_to_belt",
    "log_green_to_belt",
    "log_blue_to_belt",
    "value_contrast",
    "value_texture",
)

SHAPE_NAMES = (
    "height_m",
    "length_m",
    "width_m",
    "area_m2",
    "volume_m3",
    "width_to_length",
    "height_to_width",
    "fill",
    "solidity",
    "ellipse_error",
    "lopsidedness",
    "height_p20",
    "height_p50",
    "height_p80",
    "sphere_radius_m",
    "sphere_residual",
)

FEATURE_NAMES: tuple[str, ...] = (*COLOUR_NAMES, *SHAPE_NAMES)
"""The names of `FruitView.features`, in order."""


@dataclass(frozen=True, slots=True, eq=False)
class BeltColour:
    """Mean linear RGB of the belt in the picture, (3,), at least 1."""

    rgb: F64


def belt_colour(color: U8, labels: U8, crop: tuple[slice, slice], every: int = 8) -> BeltColour:
    """Return the belt's colour: the median of the pixels of the crop that are no fruit, on a coarse grid."""
    grid = color[crop][::every, ::every]
    bare = grid[labels[::every, ::every] == 0]
    if len(bare) < 16:
        bare = grid.reshape(-1, 3)
    return BeltColour(np.maximum(np.median(bare, axis=0), 1.0))


def shape_features(
    pixels: Pixels, ellipses: Ellipses, top_m: F64, centre_m: F64, limits: DepthLimits
) -> tuple[F64, F64]:
    """Return the shape features (N, 16), and the length (N,) in metres."""
    scale = centre_m[:, 2] / limits.focal_px
    length, width = ellipses.axes_px.T * scale
    area = ellipses.area_px * scale**2
    heights = pixels.quantiles(pixels.height_m, pixels.valid, 0.0, 0.256, (0.2, 0.5, 0.8)) / top_m[:, None]
    radius, residual = _spheres(pixels, top_m)
    columns = [
        top_m,
        length,
        width,
        area,
        np.pi / 6.0 * top_m * length * width,
        width / length,
        top_m / width,
        ellipses.area_px / (np.pi / 4.0 * ellipses.axes_px.prod(axis=1)),
        ellipses.solidity,
        ellipses.error,
        _lopsidedness(pixels, ellipses, limits),
        *heights.T,
        radius,
        residual,
    ]
    return np.stack(columns, axis=1), length


def _lopsidedness(pixels: Pixels, ellipses: Ellipses, limits: DepthLimits) -> F64:
    """Return how unlike the two ends of the longer axis are: skewness of the silhouette along it, (N,)."""
    columns = limits.shape[1]
    u = (pixels.index % columns) - ellipses.centre_px[pixels.owner, 0]
    v = (pixels.index // columns) - ellipses.centre_px[pixels.owner, 1]
    along = u * np.cos(ellipses.angle_rad)[pixels.owner] + v * np.sin(ellipses.angle_rad)[pixels.owner]
    along -= (pixels.sums(along) / pixels.counts)[pixels.owner]
    second, third = pixels.sums(along**2) / pixels.counts, pixels.sums(along**3) / pixels.counts
    return np.asarray(np.abs(third) / np.maximum(second, 1e-9) ** 1.5)


def _spheres(pixels: Pixels, top_m: F64) -> tuple[F64, F64]:
    """Return radius (N,) of the sphere fitted to each fruit's inner points, and rms distance from it / height."""
    weight = pixels.valid * (pixels.edge_px > 2.5)
    weight = np.where(pixels.sums(weight)[pixels.owner] < 12, pixels.valid, weight).astype(np.float64)
    points = np.concatenate([pixels.rays * pixels.depth_m[:, None], pixels.depth_m[:, None]], axis=1).astype(np.float64)
    total = np.maximum(pixels.sums(weight), 1.0)
    middle = np.stack([pixels.sums(points[:, k] * weight) / total for k in range(3)], axis=1)
    points -= middle[pixels.owner]
    square = (points**2).sum(axis=1)
    design = np.column_stack([2.0 * points, np.ones(len(points)), square]) * np.sqrt(weight)[:, None]
    gram = np.add.reduceat(design[:, :, None] * design[:, None, :], pixels.starts, axis=0)
    normal = gram[:, :4, :4] + 1e-9 * np.eye(4)
    solution = np.linalg.solve(normal, gram[:, :4, 4:])[:, :, 0]
    radius = np.sqrt(np.maximum(solution[:, 3] + (solution[:, :3] ** 2).sum(axis=1), 1e-8))
    left = gram[:, 4, 4] - (solution * gram[:, :4, 4]).sum(axis=1)
    rms = np.sqrt(np.maximum(left, 0.0) / total) / (2.0 * radius)
    return np.minimum(radius, 0.5), np.minimum(rms / top_m, 1.0)


def colour_features(pixels: Pixels, color: U8, belt: BeltColour, limits: DepthLimits) -> F64:
    """Return the colour features (N, 47) from the inner pixels of each fruit."""
    deepest = np.maximum.reduceat(pixels.edge_px, pixels.starts)
    inner = np.flatnonzero(pixels.edge_px > np.minimum(3.0, 0.4 * deepest)[pixels.owner])
    owner, fruit = pixels.owner[inner], pixels.fruit
    rgb = color.reshape(-1, 3).take(limits.pixels.take(pixels.index.take(inner)), axis=0)
    hsv = cv2.cvtColor(rgb[None], cv2.COLOR_RGB2HSV_FULL)[0]
    return _Colours(owner, fruit, rgb.astype(np.float32), hsv, belt.rgb).features()


class _Colours:
    """Colour statistics of all fruit at once."""

    def __init__(self, owner: np.ndarray, fruit: int, rgb: F32, hsv: U8, belt_rgb: F64) -> None:
        self._owner, self._fruit, self._rgb, self._hsv, self._belt = owner, fruit, rgb, hsv, belt_rgb
        self._count = np.maximum(np.bincount(owner, minlength=fruit), 1.0)

    def _mean(self, values: np.ndarray) -> F64:
        return np.asarray(np.bincount(self._owner, weights=values, minlength=self._fruit) / self._count)

    def _histogram(self, bins: np.ndarray, count: int, weights: np.ndarray | None = None) -> F64:
        flat = np.bincount(self._owner * count + bins, weights=weights, minlength=self._fruit * count)
        table = flat.reshape(self._fruit, count).astype(np.float64)
        return np.asarray(table / np.maximum(table.sum(axis=1, keepdims=True), 1e-9))

    def features(self) -> F64:
        hue, saturation, value = (self._hsv[:, k].astype(np.intp) for k in range(3))
        mean_value = np.maximum(self._mean(value), 1.0)
        relative = np.clip(value * (VALUE_BINS / 2.0) / mean_value[self._owner], 0, VALUE_BINS - 1).astype(np.intp)
        # A grey pixel has no hue: every pixel votes with its chroma.
        chroma = (saturation * value).astype(np.float64) + 1e-3
        return np.column_stack(
            [
                self._histogram(hue * HUE_BINS // 256, HUE_BINS, chroma),
                self._histogram(saturation * SATURATION_BINS // 256, SATURATION_BINS),
                self._histogram(relative, VALUE_BINS),
                *self._chromaticity(),
                *self._hue_moments(hue, chroma),
                *self._moments(saturation / 255.0),
                *self._against_belt(mean_value),
                self._moments(value.astype(np.float64))[1] / mean_value,
                self._texture(value) / mean_value,
            ]
        )

    def _moments(self, values: np.ndarray) -> tuple[F64, F64]:
        mean = self._mean(values)
        return mean, np.sqrt(np.maximum(self._mean(values**2) - mean**2, 0.0))

    def _chromaticity(self) -> tuple[F64, ...]:
        total = self._rgb.sum(axis=1) + 1.0
        red, green = self._moments(self._rgb[:, 0] / total), self._moments(self._rgb[:, 1] / total)
        return red[0], green[0], red[1], green[1]

    def _hue_moments(self, hue: np.ndarray, chroma: F64) -> tuple[F64, ...]:
        angle = hue * (2.0 * np.pi / 256.0)
        total = np.maximum(self._mean(chroma), 1e-9)
        cosine, sine = self._mean(np.cos(angle) * chroma) / total, self._mean(np.sin(angle) * chroma) / total
        strength = np.hypot(cosine, sine)
        return cosine, sine, strength

    def _against_belt(self, mean_value: F64) -> tuple[F64, ...]:
        means = [np.maximum(self._mean(self._rgb[:, k]), 1.0) for k in range(3)]
        return (
            np.log(mean_value / self._belt.max()),
            *(np.log(mean / belt) for mean, belt in zip(means, self._belt, strict=True)),
        )

    def _texture(self, value: np.ndarray) -> F64:
        """Return the mean step of brightness between neighbouring pixels of a fruit."""
        step = np.abs(np.diff(value, prepend=value[:1])).astype(np.float64)
        return self._mean(np.minimum(step, 40.0))
