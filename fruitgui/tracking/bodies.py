"""Things that are no fruit: parts that come and go in the pictures, and are one body.

A hand, a leaf, a spread bunch is not convex: a frame cuts it into parts, the next one does not. Fruit are spared by
two properties of bodies, whatever the frames say: a fruit that rests on a belt is about as tall as wide, and seldom
smaller than `SMALLEST_M`. Only where neither of two tracks is built like a fruit may they be parts of one body; smaller
fruit (cherries, small plums) are joined only if they touch and the frames seldom part them.
"""

from __future__ import annotations

import numpy as np

from fruitgui.frame import F64
from fruitgui.geometry.rig import Rig
from fruitgui.tracking.measured import LOOK_STD, distances_m
from fruitgui.tracking.trail import Trail

SMALLEST_M = 0.035
"""Few fruit are smaller, and fingers are not wider."""

FLAT = 0.6
"""A body lower than this share of its outline's diameter is a slab; the longest fruit, lying, is above 0.75."""

LOWEST_M = 0.03
"""The top of a fruit of that size, less what heights err by."""

THIN_M = 0.025
"""What does not rise so far above the belt is a leaf, a twig, a stalk."""

PARTS_APART_M = 0.12
"""Two thin bits farther apart than this are two things."""

GAP_M = 0.02
"""Parts of a body lie nearer together: what connects them may be lost at the edges of both, two pixels each."""

ONE_COLOR = 3.0
"""Standard deviations, per share of red or green, that parts of one body may differ by."""

TORN = 0.5
"""Share of frames of the sensor that parts best, below which two slabs are one body: fruit are parted far oftener."""

_VIEWS = 10
_POINTS = 30
"""A body of 100 mm is sampled about every 6 mm."""


def built_like_fruit(trail: Trail) -> bool:
    """Tell whether a body is as big, and as tall for its width, as fruit are."""
    height_m = float(trail.looks[0])
    return trail.size_m >= SMALLEST_M and height_m >= max(FLAT * trail.size_m, LOWEST_M)


def surface_m(trail: Trail, rig: Rig) -> F64:
    """Return a sample (n, 3) of the surface that a trail showed, in the belt's frame."""
    if not trail.entries:
        return trail.surface_m
    shown = [entry for entry in trail.entries if not entry.cut] or trail.entries
    pieces = []
    for entry in shown[:: len(shown) // _VIEWS + 1]:
        points = entry.view.points_m
        pose = rig.mounts[entry.view.sensor].pose
        pieces.append(pose.apply(points[:: len(points) // _POINTS + 1].astype(np.float64)) - entry.travelled_m)
    return np.vstack(pieces)


def one_body(first: Trail, second: Trail, rig: Rig) -> bool:
    """Tell whether two trails that are no fruit are parts of one body."""
    if built_like_fruit(first) or built_like_fruit(second) or not _one_color(first, second):
        return False
    if _bit(first) and _bit(second):
        return float(np.linalg.norm(first.place_m - second.place_m)) < PARTS_APART_M
    return first.parted(second) < TORN and _gap_m(surface_m(first, rig), surface_m(second, rig)) < GAP_M


def evidence(trail: Trail) -> float:
    """Return how much of a body a trail showed, clear views times their area: the part with most stands for it."""
    return trail.clear * trail.size_m**2


def _bit(trail: Trail) -> bool:
    """Tell whether a body is small, thin and flat: the tip of a leaf whose middle lies on the belt; a cherry is not."""
    height_m = float(trail.looks[0])
    return trail.size_m < SMALLEST_M and height_m < min(THIN_M, FLAT * trail.size_m)


def _one_color(first: Trail, second: Trail) -> bool:
    share = slice(2, 4)
    return bool((np.abs(first.looks[share] - second.looks[share]) < ONE_COLOR * LOOK_STD[share]).all())


def _gap_m(first_m: F64, second_m: F64) -> float:
    """Return the smallest distance between two samples of points (n, 3), (m, 3)."""
    if not len(first_m) or not len(second_m):
        return float("inf")
    return float(distances_m(first_m, second_m).min())
