"""Which view is which track: two ways, made alike so that either can be put in."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from fruitgui.frame import F64, Bools, Ints

SAME_BODY = 0.6
"""A view nearer to a track than this share of its size is that body: two solid ones are about one size apart."""


@dataclass(frozen=True, slots=True, eq=False)
class Pairs:
    """Candidate pairs of track and view, k of them.

    Attributes:
        tracks, views: (k,) which.
        squared: (k,) squared Mahalanobis distances.
        unlike: (k,) squared distances of the looks.
        apart: (k,) distances in units of the body's size: two solid bodies are about one apart, or more.
    """

    tracks: Ints
    views: Ints
    squared: F64
    unlike: F64
    apart: F64


class Association(Protocol):
    """A way of pairing tracks with views."""

    def match(self, pairs: Pairs) -> Bools:
        """Return which of the candidate pairs are taken, (k,), no track and no view twice."""


class OptimalAssignment:
    """The pairing of least total cost over all fruit of a frame (Munkres 1957); looks break ties."""

    def __init__(self, gate: float, look_weight: float = 0.4, most_unlike: float = 12.0) -> None:
        self._gate = gate
        self._look_weight = look_weight
        self._most_unlike = most_unlike

    def match(self, pairs: Pairs) -> Bools:
        """Return which pairs are taken; a pair beyond the gate, or as far apart as two bodies, never is."""
        taken = np.zeros(len(pairs.tracks), dtype=bool)
        near = np.flatnonzero((pairs.squared <= self._gate) & (pairs.apart <= SAME_BODY))
        if not len(near):
            return taken
        if _one_each(pairs.tracks[near]) and _one_each(pairs.views[near]):
            taken[near] = True
            return taken
        row_of, rows = np.unique(pairs.tracks[near], return_inverse=True)
        column_of, columns = np.unique(pairs.views[near], return_inverse=True)
        cost = pairs.squared[near] + self._look_weight * np.minimum(pairs.unlike[near], self._most_unlike)
        alone = self._gate + self._look_weight * self._most_unlike + 1.0
        table = np.full((len(row_of), len(column_of)), alone)
        table[rows, columns] = cost
        row, column = _assigned(table)
        chosen = np.zeros(table.shape, dtype=bool)
        chosen[row, column] = table[row, column] < alone
        taken[near] = chosen[rows, columns]
        return taken


def _one_each(numbers: Ints) -> bool:
    return len(set(numbers.tolist())) == len(numbers)


def _assigned(table: F64) -> tuple[Ints, Ints]:
    from scipy.optimize import linear_sum_assignment

    row, column = linear_sum_assignment(table)
    return np.asarray(row, dtype=np.intp), np.asarray(column, dtype=np.intp)


class ClosestPair:
    """The source's way: the closest pair wins, then the next; above the gate it is a new fruit."""

    def __init__(self, gate: float) -> None:
        self._gate = gate

    def match(self, pairs: Pairs) -> Bools:
        """Return which pairs are taken, by Mahalanobis distance alone."""
        taken = np.zeros(len(pairs.tracks), dtype=bool)
        used_tracks: set[int] = set()
        used_views: set[int] = set()
        for i in np.argsort(pairs.squared, kind="stable"):
            track, view = int(pairs.tracks[i]), int(pairs.views[i])
            if pairs.squared[i] > self._gate:
                break
            if track not in used_tracks and view not in used_views:
                taken[i] = True
                used_tracks.add(track)
                used_views.add(view)
        return taken
