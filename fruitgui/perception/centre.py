"""Where the middle of a fruit is, of which one sensor sees one half (method 4.2).

A body that is symmetric about its centre has its centre behind the middle of its
silhouette, whatever its shape and from wherever it is seen. That gives the line
of sight. The height follows from the body lying on the belt: for a ball of radius
c the seen points, weighted with their distance s from the edge, are on average

    ∫(c − s) √(c² − s²) s ds / ∫(c − s) s ds = (2 − 3π/8) c = 0.822 c

nearer to the sensor than the centre, so their mean height is c + 0.822 c sin e
at elevation e of the line of sight, and c follows. The same holds for an ellipsoid
seen along an axis. The weights make the silhouette's middle the centre of volume
of a body of revolution too (a disc of radius ρ weighs ρ², in its silhouette only
ρ), and take the weight off the edges, which structured light moves by up to two
pixels. The mean of the seen points lies two thirds of a radius towards each
sensor; this estimate is the same from opposed sides.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from fruitgui.frame import F64, Bools
from fruitgui.perception.limits import DepthLimits
from fruitgui.perception.pixels import Binned, Pixels
from fruitgui.perception.settings import PerceptionSettings

TOWARDS_SENSOR = 2.0 - 3.0 * np.pi / 8.0
"""How far the seen points of a ball lie towards the sensor in the mean, in radii, weighted as above."""

ASYMMETRY = 0.012
"""How far the middle of a fruit's silhouette is from its centre of volume, as a part of its length (std)."""

TOP_PART = 0.95
"""Quantile of the heights that stands for the top; a ball reaches 2.5 % of its radius higher."""

HIGHEST_M = 0.256
"""Heights are told apart up to here."""


@dataclass(frozen=True, slots=True, eq=False)
class Centres:
    """Centres of volume and means of the seen points, in the sensor's optical frame; N fruit.

    Attributes:
        centre_m, mean_m: (N, 3).
        centre_covariance_m2, mean_covariance_m2: (N, 3, 3).
        seen: (N,) sampled pixels with a sound reading.
    """

    centre_m: F64
    centre_covariance_m2: F64
    mean_m: F64
    mean_covariance_m2: F64
    seen: F64


@dataclass(frozen=True, slots=True, eq=False)
class Heights:
    """How high N fruit are seen above the belt.

    Attributes:
        top_m: (N,) of the highest points, at least 1 mm.
        spread_m: (N, 3) a fifth, half and four fifths of the points are not higher.
    """

    top_m: F64
    spread_m: F64


def find_heights(pixels: Pixels) -> Heights:
    """Return the heights of all fruit."""
    valid = pixels.valid > 0
    inner = valid & (pixels.edge_px > 1.5)
    bins = Binned.of(pixels.height_m, 0.0, HIGHEST_M)
    rows = [replace(bins, counted=counted) for counted in (inner, valid)]
    high, spread = pixels.runs.quantiles(rows, (0.2, 0.5, 0.8, TOP_PART))
    return Heights(np.maximum(high[:, 3] * (1.0 + 0.25 * (1.0 - TOP_PART)), 1e-3), spread[:, :3])


def find_centres(
    pixels: Pixels, top_m: F64, length_m: F64, whole: Bools, limits: DepthLimits, settings: PerceptionSettings
) -> Centres:
    """Return where the fruit are.

    Args:
        pixels: of all fruit.
        top_m: (N,) height of their tops above the belt.
        length_m: (N,) rough length of each, for the spread of what is not symmetric.
        whole: (N,) seen whole; what is cut or hidden gets the uncertainty that it deserves.
        limits: of the sensor.
        settings: noise of the sensor.
    """
    weight = pixels.edge_px
    sound = weight * pixels.valid
    total, x, y, weighed, height, *means = pixels.runs.sums(
        weight, weight * pixels.ray_x, weight * pixels.ray_y, sound, sound * pixels.height_m,
        pixels.valid, pixels.x_m, pixels.y_m, pixels.depth_m,
    )  # fmt: skip
    total = np.maximum(total, 1e-9)
    ray = np.stack([x / total, y / total, np.ones_like(x)], axis=1)
    slope = np.maximum(-(ray @ limits.turn[2]), 1e-3)
    sine = slope / np.sqrt((ray * ray).sum(axis=1))
    middle_m = height / np.maximum(weighed, 1e-9) / (1.0 + TOWARDS_SENSOR * sine)
    middle_m = np.minimum(np.maximum(middle_m, 0.35 * top_m), 0.55 * top_m)
    centre = ray * ((limits.offset_m - middle_m) / slope)[:, None]
    mean, mean_covariance = _means(np.array(means), pixels.every, limits, settings)
    covariance = _covariances(centre, sine, length_m, whole, limits, settings)
    return Centres(centre, covariance, mean, mean_covariance, means[0])


def _means(sums: F64, every: int, limits: DepthLimits, settings: PerceptionSettings) -> tuple[F64, F64]:
    """Return the mean of the seen points and its covariance: neighbouring errors are one error (method 1.2).

    `sums` (4, N): how many points, and the sums of their x, y and z.
    """
    seen = np.maximum(sums[0], 1.0)
    mean = (sums[1:] / seen).T
    patches = np.maximum(seen * every / 50.0, 1.0)
    away = mean[:, 2]
    along = (settings.noise_at_m(away) ** 2 + settings.step_at_m(away) ** 2 / 12.0) / patches + (0.5e-3 * away) ** 2
    across = (0.5 * away / limits.focal_px) ** 2
    return mean, _about_ray(mean, along, across)


def _covariances(
    centre: F64, sine: F64, length_m: F64, whole: Bools, limits: DepthLimits, settings: PerceptionSettings
) -> F64:
    z = centre[:, 2]
    shape = (ASYMMETRY * length_m) ** 2
    sideways = (0.5 * z / limits.focal_px) ** 2 + shape
    height = (0.3 * settings.noise_at_m(z)) ** 2 + (0.25 * settings.step_at_m(z)) ** 2 + 0.0005**2 + shape
    along = height / np.maximum(sine, 0.2) ** 2
    hidden = np.where(whole, 0.0, (0.12 * length_m) ** 2)
    return _about_ray(centre, along + hidden, sideways + hidden)


def _about_ray(points: F64, along: F64, across: F64) -> F64:
    """Return covariances (N, 3, 3) with variance `along` the line of sight and `across` at right angles to it."""
    square = np.maximum((points * points).sum(axis=1), 1e-18)
    covariance = points[:, :, None] * (points * ((along - across) / square)[:, None])[:, None, :]
    covariance.reshape(-1, 9)[:, ::4] += across[:, None]
    return np.asarray(covariance)
