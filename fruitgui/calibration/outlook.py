"""What calibrating would have to work with, judged cheaply before it is begun.

Each sensor's things are found on its own belt. What two sensors have in common is counted as calibrating itself would
begin: how many things of one come to lie on things of the other that look alike, under the best shift and heading.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fruitgui.calibration.relief import Relief, relief
from fruitgui.calibration.still import average
from fruitgui.calibration.surface import fit_belt
from fruitgui.frame import F64, Bools, Frame

LEAST_COMMON = 5
ENOUGH_COMMON = 10
"""Things that two sensors should have in common: with fewer than the first it seldom works."""

LEAST_MOVED_PX = 150
"""So many changed pixels at 640 across are no noise, though only a few captures are compared."""

_SPREAD = np.array([0.006, 0.20, 14.0, 14.0, 20.0])
"""How much one thing's look differs from sensor to sensor: height (m), log area, a and b of CIE Lab, lightness."""

ALIKE = 4.0
"""Things whose looks are farther apart than so many spreads are not the same one."""

TOGETHER_M, SHORTEST_M = 0.02, 0.06
"""Middles of one thing seen from two sides differ by up to the first; things nearer than the second tell no heading."""

MOST_HYPOTHESES = 2000


@dataclass(frozen=True, slots=True, eq=False)
class Outlook:
    """What one sensor has to offer.

    Attributes:
        sensor: its name.
        belt: whether it sees a belt.
        places_m: (K, 2) of the things on it, in the belt's own frame.
        looks: (K, 5) of the things, in the units of how much looks differ.
        moved: whether something moves.
    """

    sensor: str
    belt: bool
    places_m: F64
    looks: F64
    moved: bool

    @property
    def things(self) -> int:
        """How many things it sees."""
        return len(self.looks)


def outlook(frames: Sequence[Frame]) -> Outlook:
    """Return what one sensor has to offer, from a few of its newest frames."""
    still = average(frames)
    belt = fit_belt(still)
    if belt is None:
        return Outlook(still.sensor, False, np.zeros((0, 2)), np.zeros((0, 5)), False)
    seen = relief(still, belt)
    height_m = belt.plane.height_m(still.points())
    changed = int((still.moved & (np.abs(height_m) < 0.4)).sum())
    moved = changed > LEAST_MOVED_PX * (still.intrinsics.width / 640) ** 2
    return Outlook(still.sensor, True, _places_m(seen), _looks(seen), moved)


def in_common(first: Outlook, second: Outlook) -> int:
    """Return how many things of two sensors come to lie on each other under the best shift and heading."""
    if not first.things or not second.things:
        return 0
    apart = np.linalg.norm(first.looks[:, None] - second.looks[None], axis=2)
    like = apart < ALIKE
    if not like.any():
        return 0
    turns, shifts_m = _hypotheses(first.places_m, second.places_m, like)
    if not len(turns):
        return 1
    c, s = np.cos(turns), np.sin(turns)
    R = np.stack([np.stack([c, -s], -1), np.stack([s, c], -1)], -2)
    laid_m = np.einsum("hij,kj->hki", R, first.places_m) + shifts_m[:, None]
    gaps_m = np.linalg.norm(laid_m[:, :, None] - second.places_m[None, None], axis=3)
    met = (gaps_m < TOGETHER_M) & like
    # A thing meets one thing only: count on the side where fewer met.
    return int(np.minimum(met.any(axis=2).sum(axis=1), met.any(axis=1).sum(axis=1)).max())


def _hypotheses(first_m: F64, second_m: F64, like: Bools) -> tuple[F64, F64]:
    """Return headings (H,) and shifts (H, 2) that lay two things of one sensor on two alike of the other."""
    i, a = np.nonzero(like)
    one, other = np.triu_indices(len(i), 1)
    from_m, to_m = first_m[i[other]] - first_m[i[one]], second_m[a[other]] - second_m[a[one]]
    lengths_m = np.linalg.norm(from_m, axis=1)
    fits = (np.abs(lengths_m - np.linalg.norm(to_m, axis=1)) < TOGETHER_M) & (lengths_m > SHORTEST_M)
    chosen = np.nonzero(fits)[0]
    chosen = chosen[np.argsort(-lengths_m[chosen], kind="stable")[:MOST_HYPOTHESES]]
    turns = np.arctan2(to_m[chosen, 1], to_m[chosen, 0]) - np.arctan2(from_m[chosen, 1], from_m[chosen, 0])
    c, s = np.cos(turns), np.sin(turns)
    middle_m = (first_m[i[one]] + first_m[i[other]])[chosen] / 2.0
    turned_m = np.stack([c * middle_m[:, 0] - s * middle_m[:, 1], s * middle_m[:, 0] + c * middle_m[:, 1]], axis=1)
    return turns, (second_m[a[one]] + second_m[a[other]])[chosen] / 2.0 - turned_m


def _places_m(seen: Relief) -> F64:
    places = [seen.points_m[seen.thing == thing][:, :2] for thing in range(seen.things)]
    return np.array([(one.min(axis=0) + one.max(axis=0)) / 2.0 for one in places]).reshape(-1, 2)


def _looks(seen: Relief) -> F64:
    import cv2

    rows = []
    for thing in range(seen.things):
        mine = seen.thing == thing
        points = seen.points_m[mine]
        top_m = float(np.percentile(points[:, 2], 95))
        hull = cv2.convexHull(points[:, :2].astype(np.float32))
        area_m2 = max(float(cv2.contourArea(hull)), 1e-5)
        lab = cv2.cvtColor(np.median(seen.colors[mine], axis=0).astype(np.uint8).reshape(1, 1, 3), cv2.COLOR_RGB2LAB)
        lightness, a, b = (float(one) for one in lab[0, 0])
        rows.append([top_m, np.log(area_m2), a, b, lightness])
    return np.asarray(np.array(rows, dtype=np.float64).reshape(-1, 5) / _SPREAD)
