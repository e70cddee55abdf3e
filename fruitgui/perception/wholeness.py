"""Which fruit are seen whole: not cut by the picture, by the region, or by another fruit in front of them."""

from __future__ import annotations

from collections.abc import Iterator

import cv2
import numpy as np
from numpy.typing import NDArray

from fruitgui.frame import U8, U16, Bools, Ints
from fruitgui.perception.limits import DepthLimits
from fruitgui.perception.outline import Outlines

BESIDE_PX = 4
"""How far from an outline what lies beyond it is looked up."""

MARGIN = 0.1
"""Registered depth leaves the picture's margins empty; no sensor's margin is wider than this part of the picture."""

HIDDEN_PART = 0.06
"""Part of an outline along which something must stand in front before a fruit counts as partly hidden."""


def seen_whole(outlines: Outlines, labels: U8, solid: U8, depth_mm: U16, limits: DepthLimits, jump_m: float) -> Bools:
    """Tell which fruit are seen whole, (N,).

    Args:
        outlines: of the fruit.
        labels: (h, w) of the crop, fruit i carries i + 1.
        solid: (h, w) of the crop, non-zero where a reading counts as fruit.
        depth_mm: (height, width) of the whole picture.
        limits: of the sensor.
        jump_m: what lies nearer than the fruit by more than this, hides it.
    """
    places, owner = outlines.places, outlines.owner
    cut = _at_the_margin(places, depth_mm, limits) | _at_the_region(places, solid, depth_mm, limits)
    hidden = _hidden(places, owner, labels, solid, depth_mm[limits.crop], jump_m)
    return np.asarray((outlines.sums(cut) < 3) & (outlines.sums(hidden) < HIDDEN_PART * outlines.counts))


def _at_the_margin(places: NDArray[np.int32], depth_mm: U16, limits: DepthLimits) -> Bools:
    """Tell which places (M, 2) of the crop lie at the end of the readings of their row or column."""
    rows, columns = limits.crop
    u, v = places[:, 0] + columns.start, places[:, 1] + rows.start
    height, width = depth_mm.shape
    across, down = int(MARGIN * width), int(MARGIN * height)
    left = _empty_run(depth_mm[:, :across])
    right = _empty_run(depth_mm[:, : width - across - 1 : -1])
    top = _empty_run(depth_mm[:down].T)
    bottom = _empty_run(depth_mm[: height - down - 1 : -1].T)
    near = 2
    return np.asarray(
        (u <= left[v] + near) | (u >= width - 1 - right[v] - near) | (v <= top[u] + near) | (v >= height - 1 - bottom[u] - near)
    )


def _empty_run(strip: U16) -> Ints:
    """Return how many pixels without a reading each row (L, M) begins with; 0 where the strip is empty throughout."""
    return np.asarray((strip > 0).argmax(axis=1))


def _at_the_region(places: NDArray[np.int32], solid: U8, depth_mm: U16, limits: DepthLimits) -> Bools:
    """Tell which places have their foot on the region's edge, within three pixels' width."""
    if len(limits.edges) == 0:
        return np.zeros(len(places), dtype=bool)
    flat = places[:, 1] * limits.shape[1] + places[:, 0]
    z_m = depth_mm.reshape(-1).take(limits.pixels.take(flat)) * 1e-3
    sound = (solid.reshape(-1).take(flat) != 0) & (z_m > 0)
    points = np.stack([limits.ray_x.take(flat) * z_m, limits.ray_y.take(flat) * z_m, z_m], axis=1)
    return np.asarray(sound & (limits.inside_m(points) < limits.inset_m + 2.0 * limits.belt_z_m / limits.focal_px))


def _hidden(places: NDArray[np.int32], owner: Ints, labels: U8, solid: U8, depth: U16, jump_m: float) -> Bools:
    """Tell at which places something else that stands on the belt lies beyond the outline, and nearer."""
    hidden = np.zeros(len(places), dtype=bool)
    near = _beside_another(places, owner, labels)
    if len(near):
        u, v, mine = places[near, 0], places[near, 1], owner[near] + 1
        here = depth[v, u].astype(np.float32) - np.float32(1e3 * jump_m)
        for beside_v, beside_u in _beside(u, v, labels.shape):
            other, beyond = labels[beside_v, beside_u], depth[beside_v, beside_u]
            hidden[near] |= (other > 0) & (other != mine) & (beyond > 0) & (beyond < here)
    return hidden


def _beside_another(places: NDArray[np.int32], owner: Ints, labels: U8) -> Ints:
    """Return which places have another fruit within reach: its label shows in the widest look around."""
    reach = np.ones((2 * BESIDE_PX + 1, 2 * BESIDE_PX + 1), np.uint8)
    flat = places[:, 1] * labels.shape[1] + places[:, 0]
    highest = cv2.dilate(labels, reach).reshape(-1).take(flat)
    lowest = cv2.erode(np.where(labels == 0, np.uint8(255), labels), reach).reshape(-1).take(flat)
    return np.flatnonzero((highest != owner + 1) | (lowest != owner + 1))


def _beside(u: Ints, v: Ints, shape: tuple[int, ...]) -> Iterator[tuple[Ints, Ints]]:
    """Yield rows and columns of the places left, right, above and below."""
    for du, dv in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        yield np.clip(v + dv * BESIDE_PX, 0, shape[0] - 1), np.clip(u + du * BESIDE_PX, 0, shape[1] - 1)
