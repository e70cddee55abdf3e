"""Where the middle of a fruit is, of which one sensor sees one half (method 4.2).

A body that is symmetric about its centre has its centre behind the middle of its
silhouette, whatever its shape and from wherever it is seen, and half as high as
its top when it lies on a plane. Neither needs a model of the fruit, and both hold
for opposed sensors alike: the mean of the seen points lies two thirds of a radius
towards each of them. Pixels are weighted with their distance from the edge, which
makes the silhouette's middle the centre of volume of a body of revolution (a disc
of radius ρ weighs ρ², its silhouette only ρ) and takes the weight off the edges,
that structured light moves by up to two pixels.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F64, Bools
from fruitgui.perception.limits import DepthLimits
from fruitgui.perception.pixels import Pixels
from fruitgui.perception.settings import PerceptionSettings

ASYMMETRY = 0.03
"""How far the middle of a real fruit's silhouette is from its centre of volume, as a part of its length (std)."""

TOP_PART = 0.95
"""Quantile of the heights that stands for the top; a sphere reaches 2.5 % of its radius higher."""


@dataclass(frozen=True, slots=True, eq=False)
class Centres:
    """Centres of volume and means of the seen points, in the sensor's optical frame; N fruit.

    Attributes:
        centre_m, mean_m: (N, 3).
        centre_covariance_m2, mean_covariance_m2: (N, 3, 3).
        top_m: (N,) height above the belt.
    """

    centre_m: F64
    centre_covariance_m2: F64
    mean_m: F64
    mean_covariance_m2: F64
    top_m: F64


def find_centres(
    pixels: Pixels, length_m: F64, whole: Bools, limits: DepthLimits, settings: PerceptionSettings
) -> Centres:
    """Return where the fruit are.

    Args:
        pixels: of all fruit.
        length_m: (N,) rough length of each, for the spread of what is not symmetric.
        whole: (N,) seen whole; what is cut or hidden gets the uncertainty that it deserves.
        limits: of the sensor.
        settings: noise of the sensor.
    """
    top_m = _tops(pixels)
    ray = _weighted_rays(pixels)
    slope = -(ray @ limits.turn[2, :2] + limits.turn[2, 2])
    z_m = (limits.offset_m - 0.5 * top_m) / np.maximum(slope, 1e-3)
    centre = np.column_stack([ray * z_m[:, None], z_m])
    mean, mean_covariance = _means(pixels, limits, settings)
    covariance = _covariances(centre, slope, length_m, whole, limits, settings)
    return Centres(centre, covariance, mean, mean_covariance, top_m)


def _tops(pixels: Pixels) -> F64:
    """Return the height of the highest points of each fruit above the belt, (N,)."""
    inner = pixels.valid * (pixels.edge_px > 1.5)
    high = pixels.quantiles(pixels.height_m, inner, 0.0, 0.256, (TOP_PART,))[:, 0]
    return high * (1.0 + 0.25 * (1.0 - TOP_PART))


def _weighted_rays(pixels: Pixels) -> F64:
    weight = pixels.edge_px
    total = np.maximum(pixels.sums(weight), 1e-9)
    u, v = pixels.sums(weight * pixels.rays[:, 0]), pixels.sums(weight * pixels.rays[:, 1])
    return np.stack([u / total, v / total], axis=1)


def _means(pixels: Pixels, limits: DepthLimits, settings: PerceptionSettings) -> tuple[F64, F64]:
    """Return the mean of the seen points and its covariance: neighbouring errors are one error (method 1.2)."""
    seen = np.maximum(pixels.sums(pixels.valid), 1.0)
    x = pixels.sums(pixels.rays[:, 0] * pixels.depth_m) / seen
    y = pixels.sums(pixels.rays[:, 1] * pixels.depth_m) / seen
    z = pixels.sums(pixels.depth_m) / seen
    mean = np.stack([x, y, z], axis=1)
    patches = np.maximum(seen / 50.0, 1.0)
    along = settings.noise_at_m(z) ** 2 / patches + settings.step_at_m(z) ** 2 / 12.0 / patches + (0.5e-3 * z) ** 2
    across = (0.5 * z / limits.focal_px) ** 2
    return mean, _about_ray(mean, along, across)


def _covariances(
    centre: F64, slope: F64, length_m: F64, whole: Bools, limits: DepthLimits, settings: PerceptionSettings
) -> F64:
    z = centre[:, 2]
    distance = np.linalg.norm(centre, axis=1)
    edge_m = 0.7 * z / limits.focal_px
    sideways = edge_m**2 + (ASYMMETRY * length_m) ** 2
    half_top = 0.5 * np.sqrt(
        settings.noise_at_m(z) ** 2 + settings.step_at_m(z) ** 2 / 4.0 + 0.0015**2 + (ASYMMETRY * length_m) ** 2
    )
    sine = np.maximum(slope * z / distance, 0.2)
    along = (half_top / sine) ** 2
    hidden = np.where(whole, 0.0, (0.25 * length_m) ** 2)
    return _about_ray(centre, along + hidden, sideways + hidden)


def _about_ray(points: F64, along: F64, across: F64) -> F64:
    """Return covariances (N, 3, 3) with variance `along` the line of sight and `across` at right angles to it."""
    direction = points / np.maximum(np.linalg.norm(points, axis=1), 1e-9)[:, None]
    outer = direction[:, :, None] * direction[:, None, :]
    return np.asarray(across[:, None, None] * np.eye(3) + (along - across)[:, None, None] * outer)
