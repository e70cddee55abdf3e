"""Which fruit are seen whole: not cut by the picture, by the region, or by another fruit in front of them."""

from __future__ import annotations

import numpy as np

from fruitgui.frame import U8, U16, Bools, Ints
from fruitgui.perception.limits import DepthLimits
from fruitgui.perception.split import Parts

BESIDE_PX = 4
"""How far from an outline what lies beyond it is looked up."""

MARGIN = 0.1
"""Registered depth leaves the picture's margins empty; no sensor's margin is wider than this part of the picture."""

HIDDEN_PART = 0.06
"""Part of an outline along which something must stand in front before a fruit counts as partly hidden."""


def seen_whole(parts: Parts, solid: U8, depth_mm: U16, limits: DepthLimits, jump_m: float) -> Bools:
    """Tell which fruit are seen whole, (N,).

    Args:
        parts: outlines and labels in the crop.
        solid: (h, w) of the crop, non-zero where a reading counts as fruit.
        depth_mm: (height, width) of the whole picture.
        limits: of the sensor.
        jump_m: what lies nearer than the fruit by more than this, hides it.
    """
    counts = np.array([len(contour) for contour in parts.contours])
    owner = np.repeat(np.arange(len(counts)), counts)
    places = np.concatenate(parts.contours)[:, 0, :]
    cut = _at_the_margin(places, depth_mm, limits) | _at_the_region(places, solid, depth_mm, limits)
    hidden = _hidden(places, owner, parts.labels, solid, depth_mm[limits.crop], jump_m)
    cuts = np.bincount(owner, weights=cut)
    return np.asarray((cuts < 3) & (np.bincount(owner, weights=hidden) < HIDDEN_PART * counts))


def _at_the_margin(places: Ints, depth_mm: U16, limits: DepthLimits) -> Bools:
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


def _at_the_region(places: Ints, solid: U8, depth_mm: U16, limits: DepthLimits) -> Bools:
    """Tell which places have their foot on the region's edge, within three pixels' width."""
    if len(limits.edges) == 0:
        return np.zeros(len(places), dtype=bool)
    flat = places[:, 1] * limits.shape[1] + places[:, 0]
    z_m = depth_mm.reshape(-1).take(limits.pixels.take(flat)) * 1e-3
    sound = (solid.reshape(-1).take(flat) != 0) & (z_m > 0)
    points = np.stack([limits.ray_x.take(flat) * z_m, limits.ray_y.take(flat) * z_m, z_m], axis=1)
    return np.asarray(sound & (limits.inside_m(points) < limits.inset_m + 2.0 * limits.belt_z_m / limits.focal_px))


def _hidden(places: Ints, owner: Ints, labels: U8, solid: U8, depth: U16, jump_m: float) -> Bools:
    """Tell at which places something else that stands on the belt lies beyond the outline, and nearer."""
    rows, columns = labels.shape
    here = depth[places[:, 1], places[:, 0]].astype(np.float32)
    hidden = np.zeros(len(places), dtype=bool)
    for du, dv in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        u = np.clip(places[:, 0] + du * BESIDE_PX, 0, columns - 1)
        v = np.clip(places[:, 1] + dv * BESIDE_PX, 0, rows - 1)
        beside = labels[v, u]
        other = (beside > 0) & (beside != owner + 1)
        hidden |= other & (depth[v, u] > 0) & (here - depth[v, u] > 1e3 * jump_m)
    return np.asarray(hidden)
