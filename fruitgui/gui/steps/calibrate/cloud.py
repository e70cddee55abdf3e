"""Clouds of points as pictures: from above and from the side, a layer for each sensor, in its colour."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import cache

import numpy as np
from PySide6.QtGui import QColor

from fruitgui.frame import F32, F64, U8
from fruitgui.gui.theme.kinds import OKABE_ITO
from fruitgui.station.fused_cloud import SensorCloud

HIGHER = 2.5
"""Heights are drawn so many times as large from the side: fruit are low against the length of a belt."""

DEEPEST_M, HIGHEST_M = -0.02, 0.12
"""Heights between which colours go from dark to bright."""

MARGIN = 0.04
REACH_M = 3.2
"""Points are sorted by how near they are, within so much of the belt."""


class Side(StrEnum):
    """From where a cloud is looked at."""

    FREE = "free"
    TOP = "top"
    SIDE = "side"


@dataclass(frozen=True, slots=True)
class Extent:
    """What of the belt's frame is shown, metres: x from left to right, y and z upwards."""

    low_m: tuple[float, float, float]
    high_m: tuple[float, float, float]


def extent_of(clouds: Sequence[SensorCloud]) -> Extent:
    """Return an extent that holds the clouds before and after, but for a few stray points."""
    points = [one for cloud in clouds for one in (cloud.before_m[::7], cloud.after_m[::7]) if len(one)]
    if not points:
        return Extent((-0.5, -0.5, -0.05), (0.5, 0.5, 0.2))
    low, high = np.percentile(np.concatenate(points), (0.5, 99.5), axis=0)
    return Extent((float(low[0]), float(low[1]), -0.06), (float(high[0]), float(high[1]), 0.2))


@dataclass(frozen=True, slots=True)
class Fit:
    """The way from metres of the belt's frame to pixels of a picture.

    Attributes:
        side: from where. scale: pixels per metre. upwards: pixels per metre of the vertical axis.
        left_m, bottom_m: at the picture's lower left corner.
        width, height: of the picture.
    """

    side: Side
    scale: float
    upwards: float
    left_m: float
    bottom_m: float
    width: int
    height: int

    def pixels(self, points_m: F32) -> F64:
        """Return (N, 2) pixels, v down, of points (N, 3)."""
        upward = points_m[:, 1] if self.side is Side.TOP else points_m[:, 2]
        u = (points_m[:, 0] - self.left_m) * self.scale
        v = self.height - (upward - self.bottom_m) * self.upwards
        return np.stack([u, v], axis=1).astype(np.float64)


def fitted(extent: Extent, side: Side, width: int, height: int) -> Fit:
    """Return the fit that shows an extent as large as it can be, in the middle."""
    axis, stretch = (1, 1.0) if side is Side.TOP else (2, HIGHER)
    span = np.array([extent.high_m[0] - extent.low_m[0], extent.high_m[axis] - extent.low_m[axis]]) * (1 + 2 * MARGIN)
    scale = min(width / max(span[0], 1e-3), height / max(span[1] * stretch, 1e-3))
    middle = ((extent.high_m[0] + extent.low_m[0]) / 2, (extent.high_m[axis] + extent.low_m[axis]) / 2)
    left, bottom = middle[0] - width / 2 / scale, middle[1] - height / 2 / (scale * stretch)
    return Fit(side, scale, scale * stretch, left, bottom, width, height)


def layer(points_m: F32, rgb: U8, fit: Fit) -> U8:
    """Return a picture (height, width, 4) RGBA of points (N, 3) in their colours: the nearest to the eye win."""
    nearness = points_m[:, 2] if fit.side is Side.TOP else -points_m[:, 1]
    steps = np.clip((nearness + REACH_M) * (65535.0 / 2.0 / REACH_M), 0.0, 65535.0).astype(np.uint16)
    order = np.argsort(steps, kind="stable")  # whole numbers of two bytes are sorted without comparing
    pixels = np.floor(fit.pixels(points_m[order])).astype(np.int32)
    inside = (pixels >= 0).all(axis=1) & (pixels[:, 0] < fit.width) & (pixels[:, 1] < fit.height)
    u, v = pixels[inside].T
    picture = np.zeros((fit.height, fit.width, 4), np.uint8)
    picture[v, u, :3] = rgb[order[inside]]
    picture[v, u, 3] = 255
    return _filled(picture)


def _filled(picture: U8) -> U8:
    """Let each point also take the empty pixels to its right and below: a point is two pixels wide."""
    for shift in ((slice(None), slice(1, None)), (slice(1, None), slice(None))):
        back = tuple(slice(None, -1) if one.start else slice(None) for one in shift)
        empty = picture[shift][..., 3] == 0
        picture[shift] = np.where(empty[..., None], picture[back], picture[shift])
    return picture


def coloured(points_m: F32, number: int) -> U8:
    """Return a sensor's colour (N, 3) for points (N, 3): higher is brighter."""
    bright = (points_m[:, 2] - DEEPEST_M) * (255.0 / (HIGHEST_M - DEEPEST_M))
    return np.asarray(shades(sensor_colour(number))[np.clip(bright, 0.0, 255.0).astype(np.uint8)])


@cache
def shades(colour: str) -> U8:
    """Return 256 shades (256, 3) of a colour: dark at first, as it is in the middle, nearly white at last."""
    named = QColor(colour)
    full = np.array([named.red(), named.green(), named.blue()], dtype=np.float64)
    share = np.linspace(0.0, 1.0, 256)[:, None]
    low, high = full * (0.45 + 1.1 * share), full + (255.0 - full) * 0.75 * (2.0 * share - 1.0)
    return np.where(share < 0.5, low, high).astype(np.uint8)


def sensor_colour(number: int) -> str:
    """Return the colour in which a sensor's points are drawn."""
    return OKABE_ITO[number % len(OKABE_ITO)]


def weights(count: int, at: float | None) -> list[float]:
    """Return how strongly each of `count` sensors is drawn.

    Args:
        at: where the slider is, 0 (the first alone) to count − 1 (the last alone); between two sensors both are
            drawn in full. None draws all in full.
    """
    if at is None or count < 2:
        return [1.0] * count
    return [float(np.clip(2.0 - 2.0 * abs(at - number), 0.0, 1.0)) for number in range(count)]
