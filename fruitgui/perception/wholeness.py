"""Which fruit are seen whole: not cut by the picture, by the region, or by another fruit in front of them."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from fruitgui.frame import U8, U16, Bools, Ints
from fruitgui.perception.limits import DepthLimits
from fruitgui.perception.outline import Outlines

Places = NDArray[np.int32]
"""(M, 2) pixels of the crop, u and v."""

EVERY = 2
"""Every second place of an outline is looked at."""

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
    places, owner = outlines.places[::EVERY], outlines.owner[::EVERY]
    cut = _at_the_margin(places, depth_mm, limits) | _at_the_region(places, solid, depth_mm, limits)
    hidden = _hidden(places, owner, outlines.boxes(), labels, depth_mm[limits.crop], jump_m)
    fruit, looked_at = len(outlines.counts), outlines.counts / EVERY
    cuts, hiddens = (np.bincount(owner, weights=found, minlength=fruit) for found in (cut, hidden))
    return np.asarray((cuts < 2) & (hiddens < HIDDEN_PART * looked_at))


def _at_the_margin(places: Places, depth_mm: U16, limits: DepthLimits) -> Bools:
    """Tell which places (M, 2) of the crop lie at the end of the readings of their row or column."""
    rows, columns = limits.crop
    u, v = places[:, 0] + columns.start, places[:, 1] + rows.start
    height, width = depth_mm.shape
    across, down = int(MARGIN * width), int(MARGIN * height)
    left = _empty_run(depth_mm[:, :across], axis=1)
    right = _empty_run(depth_mm[:, : width - across - 1 : -1], axis=1)
    top = _empty_run(depth_mm[:down], axis=0)
    bottom = _empty_run(depth_mm[: height - down - 1 : -1], axis=0)
    near = 2
    sideways = (u <= left[v] + near) | (u >= width - 1 - right[v] - near)
    return np.asarray(sideways | (v <= top[u] + near) | (v >= height - 1 - bottom[u] - near))


def _empty_run(strip: U16, axis: int) -> Ints:
    """Return how many pixels without a reading come first along an axis; 0 where there are only such."""
    return np.asarray(cv2.compare(np.ascontiguousarray(strip), 0, cv2.CMP_GT).argmax(axis=axis))


def _at_the_region(places: Places, solid: U8, depth_mm: U16, limits: DepthLimits) -> Bools:
    """Tell which places have their foot on the region's edge, within three pixels' width."""
    if len(limits.edges) == 0:
        return np.zeros(len(places), dtype=bool)
    flat = places[:, 1] * limits.shape[1] + places[:, 0]
    z_m = depth_mm.reshape(-1).take(limits.pixels.take(flat)) * 1e-3
    sound = (solid.reshape(-1).take(flat) != 0) & (z_m > 0)
    points = np.stack([limits.ray_x.take(flat) * z_m, limits.ray_y.take(flat) * z_m, z_m], axis=1)
    return np.asarray(sound & (limits.inside_m(points) < limits.inset_m + 2.0 * limits.belt_z_m / limits.focal_px))


def _hidden(places: Places, owner: Ints, boxes: Places, labels: U8, depth: U16, jump_m: float) -> Bools:
    """Tell at which places something else that stands on the belt lies beyond the outline, and nearer."""
    hidden = np.zeros(len(places), dtype=bool)
    near = np.flatnonzero(_crowded(boxes).take(owner))
    if len(near) == 0:
        return hidden
    (u, v), mine = places[near].T, owner[near] + 1
    here = depth[v, u].astype(np.float32) - np.float32(1e3 * jump_m)
    last_row, last_column = labels.shape[0] - 1, labels.shape[1] - 1
    for du, dv in ((BESIDE_PX, 0), (-BESIDE_PX, 0), (0, BESIDE_PX), (0, -BESIDE_PX)):
        beside = np.clip(v + dv, 0, last_row), np.clip(u + du, 0, last_column)
        other, beyond = labels[beside], depth[beside]
        hidden[near] |= (other > 0) & (other != mine) & (beyond > 0) & (beyond < here)
    return hidden


def _crowded(boxes: Places) -> Bools:
    """Tell which boxes (N, 4) come within reach of another's, (N,)."""
    low, high = boxes[:, :2], boxes[:, 2:] + BESIDE_PX
    meet = (low[:, None, :] <= high[None, :, :]).all(axis=2)
    return np.asarray((meet & meet.T).sum(axis=1) > 1)
