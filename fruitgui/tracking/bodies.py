"""Things that are no fruit: parts that come and go in the pictures, and are one body.

A hand, a leaf, a spread bunch is not convex: a frame cuts it into parts, the next one does not. Fruit are spared by
two properties of bodies, whatever the frames say: a fruit that rests on a belt is about as tall as wide, and seldom
smaller than `SMALLEST_M`. Only where neither of two tracks is built like a fruit may they be parts of one body; smaller
fruit (cherries, small plums) are joined only if they touch and the frames seldom part them. Two slabs of one height
that touch are one body unless hardly any frame shows them joined: the wrist between a hand and its arm is thin. A piece
as big as a fruit belongs to a slab of its own height and colour if most frames that should show it do not.
"""

from __future__ import annotations

import numpy as np

from fruitgui.frame import F64
from fruitgui.geometry.rig import Rig
from fruitgui.tracking.measured import LOOK_STD, distances_m
from fruitgui.tracking.trail import NEIGHBOUR_M, Trail

SMALLEST_M = 0.035
"""Few fruit are smaller, and fingers are not wider."""

FLAT = 0.6
"""A body lower than this share of its outline's diameter is a slab; the longest fruit, lying, is above 0.75."""

LOWEST_M = 0.03
"""The top of a fruit of that size, less what heights err by."""

THIN_M = 0.025
"""What does not rise so far above the belt is a leaf, a twig, a stalk."""

LOW_M = 0.015
"""The smallest fruit that is looked for, 25 mm across, is taller, less what heights err by."""

PARTS_APART_M = 0.12
"""Two thin bits farther apart than this are two things."""

GAP_M = 0.02
"""Parts of a body lie nearer together: what connects them may be lost at the edges of both, two pixels each."""

ONE_COLOR = 3.0
"""Standard deviations, per share of red or green, that parts of one body may differ by."""

TORN = 0.5
"""Share of frames of the sensor that parts best, below which two of no fruit's build are one body: fruit are parted far
oftener."""

SLAB = 0.45
"""A body lower than this share of its width is no heap of fruit either: three in a row that nothing parts have 0.5."""

SLAB_M = 0.045
"""Nor is a slab taller: of fruit so low, four that nothing parts would have to lie together."""

TORN_SLABS = 0.9
"""Share of frames, as above, below which two slabs are one body: some frames must show them joined."""

LEVEL_M = 0.008
"""What the tops of one slab's parts differ by; heights themselves differ from view to view by 5 mm."""

SELDOM = 0.5
"""A fruit that lies in the open, or beside a slab, is shown by more than this share of the frames that should."""

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
    """Tell whether two trails are parts of one body that is no fruit."""
    if not _one_color(first, second):
        return False
    if _bit(first) and _bit(second):
        return float(np.linalg.norm(first.place_m - second.place_m)) < PARTS_APART_M
    if _never_near(first, second):
        return False
    joined = first.parted(second) < _torn_below(first, second)
    return joined and _gap_m(surface_m(first, rig), surface_m(second, rig)) < GAP_M


def _never_near(first: Trail, second: Trail) -> bool:
    """Tell whether two trails, followed at one time, were never so near that they could touch.

    Samples of surfaces do not tell: they are brought together along the belt's way, which may run a little askew.
    """
    together = max(first.first_s, second.first_s) < min(first.last_s, second.last_s)
    reach_m = 0.5 * (first.size_m + second.size_m) + GAP_M
    return together and reach_m < NEIGHBOUR_M and not first.was_near(second)


def _torn_below(first: Trail, second: Trail) -> float:
    """Return the share of frames that may part two trails of one body; 0 where they cannot be of one."""
    level = abs(float(first.looks[0] - second.looks[0])) < LEVEL_M
    like_fruit = [trail for trail in (first, second) if built_like_fruit(trail)]
    if not like_fruit:
        return TORN_SLABS if level and _slab(first) and _slab(second) else TORN
    slabs = [trail for trail in (first, second) if _slab(trail)]
    return TORN if level and slabs and _torn_off(like_fruit[0]) else 0.0


def _slab(trail: Trail) -> bool:
    """Tell whether a body lies as flat as no fruit, nor several that were taken for one."""
    height_m = float(trail.looks[0])
    return height_m < min(SLAB * trail.size_m, SLAB_M)


def _torn_off(trail: Trail) -> bool:
    """Tell whether a trail as big as a fruit is hardly ever shown, and then cut out of a group."""
    return trail.views < SELDOM * trail.expected and trail.shared > 0.7 * trail.views


def evidence(trail: Trail) -> float:
    """Return how much of a body a trail showed, clear views times their area: the part with most stands for it."""
    return trail.clear * trail.size_m**2


def _bit(trail: Trail) -> bool:
    """Tell whether a body is small, thin and flat: the tip of a leaf whose middle lies on the belt; a cherry is not."""
    height_m = float(trail.looks[0])
    return trail.size_m < SMALLEST_M and height_m < min(THIN_M, max(FLAT * trail.size_m, LOW_M))


def _one_color(first: Trail, second: Trail) -> bool:
    share = slice(2, 4)
    return bool((np.abs(first.looks[share] - second.looks[share]) < ONE_COLOR * LOOK_STD[share]).all())


def _gap_m(first_m: F64, second_m: F64) -> float:
    """Return the smallest distance between two samples of points (n, 3), (m, 3)."""
    if not len(first_m) or not len(second_m):
        return float("inf")
    return float(distances_m(first_m, second_m).min())
