"""Which fruit are seen whole: not cut by the picture, by the region, or by another fruit in front of them."""

from __future__ import annotations

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

NEAR_PX = 2
"""An outline so near to the end of the readings is cut there."""

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
    hidden = _hidden(places, owner, outlines.boxes(), labels, depth_mm, limits, jump_m)
    fruit, looked_at = len(outlines.counts), outlines.counts / EVERY
    cuts, hiddens = (np.bincount(owner, weights=found, minlength=fruit) for found in (cut, hidden))
    return np.asarray((cuts < 2) & (hiddens < HIDDEN_PART * looked_at))


def _at_the_margin(places: Places, depth_mm: U16, limits: DepthLimits) -> Bools:
    """Tell which places (M, 2) of the crop lie at the end of the readings of their row or column."""
    rows, columns = limits.crop
    u, v = places[:, 0] + columns.start, places[:, 1] + rows.start
    at_end = np.zeros(len(places), dtype=bool)
    for along, across, picture in ((u, v, depth_mm), (v, u, depth_mm.T)):
        size = picture.shape[1]
        margin = int(MARGIN * size)
        for far, strip in ((along, picture[:, :margin]), (size - 1 - along, picture[:, : size - margin - 1 : -1])):
            # Only what lies within the margin can be at its end: mostly nothing does.
            close = np.flatnonzero(far <= margin + NEAR_PX)
            if len(close):
                at_end[close] |= far[close] <= _empty_run(strip[across[close]]) + NEAR_PX
    return at_end


def _empty_run(strip: U16) -> Ints:
    """Return how many pixels without a reading come first in each row; 0 where there are only such."""
    return np.asarray((strip > 0).argmax(axis=1))


def _at_the_region(places: Places, solid: U8, depth_mm: U16, limits: DepthLimits) -> Bools:
    """Tell which places have their foot on the region's edge, within three pixels' width."""
    if len(limits.edges) == 0:
        return np.zeros(len(places), dtype=bool)
    flat = places[:, 1] * np.intp(limits.shape[1]) + places[:, 0]
    z_m = depth_mm.reshape(-1).take(limits.pixels.take(flat)) * np.float32(1e-3)
    sound = (solid.reshape(-1).take(flat) != 0) & (z_m > 0)
    points = np.empty((3, len(places)))
    np.multiply(limits.ray_x.take(flat), z_m, out=points[0])
    np.multiply(limits.ray_y.take(flat), z_m, out=points[1])
    points[2] = z_m
    return np.asarray(sound & (limits.inside_m(points.T) < limits.inset_m + 2.0 * limits.belt_z_m / limits.focal_px))


def _hidden(
    places: Places, owner: Ints, boxes: Places, labels: U8, depth_mm: U16, limits: DepthLimits, jump_m: float
) -> Bools:
    """Tell at which places something else that stands on the belt lies beyond the outline, and nearer."""
    hidden = np.zeros(len(places), dtype=bool)
    near = np.flatnonzero(_crowded(boxes).take(owner))
    if len(near) == 0:
        return hidden
    rows, columns = limits.shape
    u, v = places[near].T.astype(np.intp)
    flat_labels, flat_depth = labels.reshape(-1), depth_mm.reshape(-1)
    here = flat_depth.take(limits.pixels.take(v * columns + u)) - np.float32(1e3 * jump_m)
    u_beside = np.clip(np.stack([u + BESIDE_PX, u - BESIDE_PX, u, u]), 0, columns - 1)
    v_beside = np.clip(np.stack([v, v, v + BESIDE_PX, v - BESIDE_PX]), 0, rows - 1)
    beside = v_beside * columns + u_beside
    other = flat_labels.take(beside)
    way, place = np.nonzero((other > 0) & (other != owner[near] + 1))
    beyond = flat_depth.take(limits.pixels.take(beside[way, place]))
    hidden[near[place[(beyond > 0) & (beyond < here[place])]]] = True
    return hidden


def _crowded(boxes: Places) -> Bools:
    """Tell which boxes (N, 4) come within reach of another's, (N,)."""
    low, high = boxes[:, :2], boxes[:, 2:] + BESIDE_PX
    meet = (low[:, None, :] <= high[None, :, :]).all(axis=2)
    return np.asarray((meet & meet.T).sum(axis=1) > 1)
