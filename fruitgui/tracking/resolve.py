"""Deciding what is one fruit: duplicates, ghosts of touching groups, clutter.

A frame shows two fruit as two views, so tracks that are hardly ever shown
together are one fruit, or one of them is the ghost of a group that some frame
did not separate. The majority of frames decides, over all sensors and time.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Protocol

import numpy as np

from fruitgui.frame import F64
from fruitgui.geometry.rig import Rig
from fruitgui.tracking.bodies import built_like_fruit, evidence, one_body
from fruitgui.tracking.settings import TrackerSettings
from fruitgui.tracking.trail import NEIGHBOUR_M, Company, Trail

ALMOST_NEVER = 0.2
SPLINTER = 0.42
"""Fruit on one belt differ less in size than this; so small a part of a group was cut off a body."""

TOUCHING_M = 0.015

TELLING_M = 0.06
"""When the belt has gone so far under a track, what stands still is told from what rides on it."""

OFTEN_ENOUGH = 0.35
"""Share of frames showing two fruit above which there are two: groups are missed more often than fruit are torn."""


class Resolver(Protocol):
    """Decides which finished trails are fruit, each once."""

    def twin(self, trail: Trail, others: Iterable[Trail]) -> Trail | None:
        """Return the trail that is the same fruit as this one and better supported, if there is one."""

    def obvious_twin(self, trail: Trail, others: Iterable[Trail]) -> Trail | None:
        """Return the better supported trail that is beyond doubt the same fruit, while both are followed."""

    def is_part(self, trail: Trail, others: Iterable[Trail], rig: Rig) -> bool:
        """Tell whether a trail that counts shows only a part of a body that another trail stands for."""

    def counts(self, trail: Trail, crossed: bool) -> bool:
        """Tell whether the trail is a fruit to be counted; `crossed`: it left the field whole, by itself."""


class EveryTrail:
    """The source's way: every track is a fruit."""

    def __init__(self, settings: TrackerSettings) -> None:
        self._least = settings.least_views

    def twin(self, trail: Trail, others: Iterable[Trail]) -> Trail | None:  # noqa: ARG002 - the protocol
        """Return none: tracks are not compared."""
        return None

    def obvious_twin(self, trail: Trail, others: Iterable[Trail]) -> Trail | None:  # noqa: ARG002 - the protocol
        """Return none: tracks are not compared."""
        return None

    def is_part(self, trail: Trail, others: Iterable[Trail], rig: Rig) -> bool:  # noqa: ARG002 - the protocol
        """Return False: tracks are not compared."""
        return False

    def counts(self, trail: Trail, crossed: bool) -> bool:
        """Tell whether it was seen often enough."""
        return (trail.views if crossed else trail.whole) >= self._least


class Majority:
    """The majority of frames decides what is one fruit."""

    def __init__(self, settings: TrackerSettings) -> None:
        self._settings = settings

    def twin(self, trail: Trail, others: Iterable[Trail]) -> Trail | None:
        """Return the better supported trail that is the same fruit, if there is one."""
        others = _near(trail, [other for other in others if other is not trail])
        whole = max((other for other in others if _is_piece_of(trail, other)), key=_rank, default=None)
        covered = _pair_under(trail, others)
        if whole is not None or covered is not None:
            return covered if whole is None else whole
        same = [other for other in others if _is_same(trail, other) and _rank(other) > _rank(trail)]
        bodies = [other for other in same if _pair_under(other, [*others, trail]) is None]
        return max(bodies, key=_rank, default=None)

    def is_part(self, trail: Trail, others: Iterable[Trail], rig: Rig) -> bool:
        """Tell whether a trail is part of a body for which another one counts, or was given out already."""
        near = _near(trail, [o for o in others if o is not trail and not built_like_fruit(o)])
        fuller = [o for o in near if not o.entries or (evidence(o) > evidence(trail) and self.counts(o, crossed=False))]
        return any(one_body(trail, other, rig) for other in fuller)

    def obvious_twin(self, trail: Trail, others: Iterable[Trail]) -> Trail | None:
        """Return the better supported trail at the same place with which this one takes turns."""
        turns = {number for number, company in trail.company.items() if company.one >= 8 * max(company.both, 1)}
        if not turns:
            return None
        same = [o for o in others if o.number in turns and _rank(o) > _rank(trail) and _inside(trail, o)]
        return max(same, key=_rank, default=None)

    def counts(self, trail: Trail, crossed: bool) -> bool:
        """Tell whether there is evidence enough for one fruit that rides on the belt."""
        least = self._settings.least_views
        if stands_beside_belt(trail):
            return False
        if trail.whole >= least:
            return trail.views >= 0.15 * trail.expected
        if not crossed:
            return False
        return trail.views >= 0.3 * trail.expected and trail.clear >= least


def _pair_under(trail: Trail, others: list[Trail]) -> Trail | None:
    """Return the better of two neighbours whose unseparated group this trail is, if the frames say so."""
    apart = [other for other in others if _sees_as_one(trail, other) and _together(trail, other) <= ALMOST_NEVER]
    for i, first in enumerate(apart):
        for second in apart[i + 1 :]:
            both = _company(first, second).both
            if both >= OFTEN_ENOUGH * (both + trail.clear) and both > 0:
                return max(first, second, key=_rank)
    return None


def _rank(trail: Trail) -> tuple[int, int, int]:
    return trail.clear, trail.views, -trail.number


def _near(trail: Trail, others: list[Trail]) -> list[Trail]:
    """Return those of the others that could have to do with a trail."""
    if not others:
        return []
    apart = np.linalg.norm(np.array([other.place_m for other in others]) - trail.place_m, axis=1)
    return [others[i] for i in np.flatnonzero(apart < 2.0 * NEIGHBOUR_M).tolist()]


def distance_m(first: Trail, second: Trail) -> float:
    """Return how far apart two trails lie on the belt."""
    return math.dist(first.place_m, second.place_m)


def _company(first: Trail, second: Trail) -> Company:
    """Return the fuller of the two records: one of them may have taken over another's."""
    records = (first.company.get(second.number, Company()), second.company.get(first.number, Company()))
    return max(records, key=lambda record: record.both + record.one)


def _together(first: Trail, second: Trail) -> float:
    """Return the share of telling frames that showed both as views of their own."""
    company = _company(first, second)
    telling = company.both + company.one
    return company.both / telling if telling else 0.0


def _sees_as_one(first: Trail, second: Trail) -> bool:
    return first is not second and distance_m(first, second) < 0.8 * max(first.size_m, second.size_m)


def _inside(first: Trail, second: Trail) -> bool:
    alike = 0.8 < first.size_m / max(second.size_m, 1e-3) < 1.25
    return alike and distance_m(first, second) < 0.35 * min(first.size_m, second.size_m)


def _is_same(first: Trail, second: Trail) -> bool:
    """Tell whether two trails are one fruit, by how close they lie and how seldom frames show both."""
    separation = distance_m(first, second) / max(0.5 * (first.size_m + second.size_m), 0.02)
    together = _together(first, second)
    if separation < 0.45:
        return together < 0.6
    return separation < 0.75 and together < OFTEN_ENOUGH


def _is_piece_of(trail: Trail, other: Trail) -> bool:
    """Tell whether a trail is a splinter cut off a much larger body that it touches (a finger, a leaf's tip)."""
    touching = distance_m(trail, other) < 0.5 * (trail.size_m + other.size_m) + TOUCHING_M
    return touching and trail.shared > 0.7 * trail.views and trail.size_m < SPLINTER * other.size_m


def stands_beside_belt(trail: Trail) -> bool:
    """Tell whether the belt went on under this trail: a part of the machine, not a fruit."""
    if len(trail.entries) < 2:
        return False
    first, last = trail.entries[0], trail.entries[-1]
    belt: F64 = last.travelled_m - first.travelled_m
    travelled = float(np.linalg.norm(belt))
    if travelled < TELLING_M:
        return False
    return float((last.position_m - first.position_m) @ belt) / travelled < 0.3 * travelled
