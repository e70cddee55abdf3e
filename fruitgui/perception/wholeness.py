"""Which fruit are seen whole: not cut by the picture, by the region, or by another fruit in front of them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fruitgui.frame import U16, Bools, Ints
from fruitgui.perception.limits import DepthLimits
from fruitgui.perception.outline import Outlines
from fruitgui.perception.parts import Parts

Places = NDArray[np.int32]
"""(2, M) pixels of the crop, u and v."""

EVERY = 2
"""Every second place of an outline is looked at."""

BESIDE_PX = 4
"""How far from an outline what lies beyond it is looked up."""

MARGIN = 0.1
"""Registered depth leaves the picture's margins empty; no sensor's margin is wider than this part of the picture."""

NEAR_PX = 2
"""An outline so near to the end of the readings is cut there."""

_RIGHT = np.array([[BESIDE_PX], [-BESIDE_PX], [0], [0]])
_DOWN = np.array([[0], [0], [BESIDE_PX], [-BESIDE_PX]])

HIDDEN_PART = 0.06
"""Part of an outline along which something must stand in front before a fruit counts as partly hidden."""


def seen_whole(
    outlines: Outlines, parts: Parts, standing_mm: U16, depth_mm: U16, limits: DepthLimits, jump_m: float
) -> tuple[Bools, Bools]:
    """Tell which fruit are seen whole, (N,), and beyond which places of the outlines lies bare belt, (M,).

    Args:
        outlines: of the fruit.
        parts: the fruit.
        standing_mm: (h, w) of the crop, depth readings that count as fruit, 0 elsewhere.
        depth_mm: (height, width) of the whole picture.
        limits: of the sensor.
        jump_m: what lies nearer than the fruit by more than this, hides it.
    """
    places, owner = np.ascontiguousarray(outlines.places[::EVERY].T), outlines.owner[::EVERY]
    cut = np.zeros(len(owner), dtype=bool)
    cut[_at_the_margin(places, depth_mm, limits)] = True
    cut[_at_the_region(places, standing_mm, limits)] = True
    beside, hidden = _others(places, owner, parts, depth_mm, limits, jump_m)
    fruit, looked_at = len(outlines.counts), outlines.counts / EVERY
    cuts, hiddens = (np.bincount(owner[found], minlength=fruit) for found in (cut, hidden))
    cut[beside] = True
    free = np.repeat(~cut, EVERY)[: len(outlines.places)]
    # The first place of an outline may lie between one looked at and the last of the outline before.
    free[outlines.starts] = free[outlines.starts + 1]
    return np.asarray((cuts < 2) & (hiddens < HIDDEN_PART * looked_at)), free


def _at_the_margin(places: Places, depth_mm: U16, limits: DepthLimits) -> Ints:
    """Return which places (2, M) of the crop lie at the end of the readings of their row or column."""
    rows, columns = limits.crop
    u, v = places[0] + columns.start, places[1] + rows.start
    at_end = [np.zeros(0, dtype=np.intp)]
    for along, across, picture in ((u, v, depth_mm), (v, u, depth_mm.T)):
        size = picture.shape[1]
        margin = int(MARGIN * size)
        for far, strip in ((along, picture[:, :margin]), (size - 1 - along, picture[:, : size - margin - 1 : -1])):
            # Only what lies within the margin can be at its end: mostly nothing does.
            close = np.flatnonzero(far <= margin + NEAR_PX)
            if len(close):
                at_end.append(close[far[close] <= _empty_run(strip[across[close]]) + NEAR_PX])
    return np.concatenate(at_end)


def _empty_run(strip: U16) -> Ints:
    """Return how many pixels without a reading come first in each row; 0 where there are only such."""
    return np.asarray((strip > 0).argmax(axis=1))


def _at_the_region(places: Places, standing_mm: U16, limits: DepthLimits) -> Ints:
    """Return which places have their foot on the region's edge, within three pixels' width."""
    column, row = places.astype(np.intp)
    flat = row * limits.shape[1] + column
    near = np.flatnonzero(limits.near_edge.take(flat))
    if len(near) == 0:
        return near
    flat = flat[near]
    z_m = standing_mm.reshape(-1).take(flat) * np.float32(1e-3)
    ray_x, ray_y = limits.rays_at(row[near], column[near])
    points = np.stack([ray_x * z_m, ray_y * z_m, z_m], axis=1)
    return np.asarray(near[(z_m > 0) & (limits.inside_m(points) < limits.edge_m)])


def _others(
    places: Places, owner: Ints, parts: Parts, depth_mm: U16, limits: DepthLimits, jump_m: float
) -> tuple[Ints, Ints]:
    """Return at which places something else stands on the belt beyond the outline, and where that hides the fruit."""
    boxes = np.array([*parts.boxes, *(rail.box for rail in parts.rails)])
    near = np.flatnonzero(_crowded(boxes).take(owner))
    if len(near) == 0:
        return near, near
    rows, columns = limits.shape
    depth = depth_mm[limits.crop].ravel()
    u, v = places.take(near, axis=1).astype(np.intp)
    here = depth.take(v * columns + u) - np.float32(1e3 * jump_m)
    place = np.minimum(np.maximum(v + _DOWN, 0), rows - 1) * columns
    place += np.minimum(np.maximum(u + _RIGHT, 0), columns - 1)
    label, beyond = parts.labels.reshape(-1).take(place), depth.take(place)
    other = (label != 0) & (label != owner.take(near) + 1)
    hidden = other & (beyond > 0) & (beyond < here)
    return near[other.any(axis=0)], near[hidden.any(axis=0)]


def _crowded(boxes: Ints) -> Bools:
    """Tell which boxes (N, 4: left, top, width, height) come within reach of another's, (N,)."""
    low = boxes[:, :2]
    high = low + boxes[:, 2:] - 1 + BESIDE_PX
    meet = (low[:, None, 0] <= high[None, :, 0]) & (low[:, None, 1] <= high[None, :, 1])
    return np.asarray((meet & meet.T).sum(axis=1) > 1)
