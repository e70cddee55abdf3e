"""What all fruit did in common: robust voting over every pair that could be one fruit."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F64, Bools, Ints

ALIKE = 0.02
"""Least likeness of two views of one fruit."""


@dataclass(frozen=True, slots=True, eq=False)
class CommonShift:
    """One displacement that carries tracks onto views.

    Attributes:
        shift_m: (2,) on the belt.
        tracks, views: (k,) which track each agreeing view belongs to.
        std_m: standard deviation of the shift per axis, as the pairs' own errors make it.
        votes: their summed likeness.
    """

    shift_m: F64
    tracks: Ints
    views: Ints
    std_m: float
    votes: float


def common_shift(
    residual_m: F64, std_m: F64, likeness: F64, admissible: Bools, bonus: Callable[[F64], F64] | None = None
) -> CommonShift | None:
    """Return the shift on which most views agree, each with one track; None where no pair is admissible.

    Args:
        residual_m: (n, m, 2) view minus track on the belt.
        likeness: (n, m), 0-1, how much alike track and view look.
        admissible: (n, m), pairs that could be the same fruit.
        std_m: (n, m) how far view and track of one fruit differ, one standard deviation per axis.
        bonus: prior votes (k,) for residuals (k, 2) as the shift; none where left out.
    """
    track, view = np.nonzero(admissible & (likeness > ALIKE))
    if not len(track):
        return None
    order = np.argsort(view, kind="stable")
    track, view = track[order], view[order]
    candidates, weight, sigma = residual_m[track, view], likeness[track, view], std_m[track, view]
    apart = (candidates[:, None, 0] - candidates[:, 0]) ** 2 + (candidates[:, None, 1] - candidates[:, 1]) ** 2
    agree = np.exp(apart / (-2.0 * sigma**2)) * weight
    starts = np.flatnonzero(np.concatenate([[True], view[1:] != view[:-1]]))
    score = np.maximum.reduceat(agree, starts, axis=1).sum(axis=1)
    if bonus is not None:
        score += bonus(candidates)
    best = int(np.argmax(score))
    apart_best = np.sqrt(apart[best]) / sigma
    pick = _one_each(track, view, apart_best**2 - 2.0 * np.log(weight), apart_best < 3.0)
    precision = 1.0 / sigma[pick] ** 2
    shift = (precision[:, None] * candidates[pick]).sum(axis=0) / precision.sum()
    return CommonShift(shift, track[pick], view[pick], float(precision.sum() ** -0.5), float(weight[pick].sum()))


def _one_each(track: Ints, view: Ints, cost: F64, allowed: Bools) -> Ints:
    """Return the numbers of allowed pairs, cheapest first, no track and no view twice."""
    taken_tracks: set[int] = set()
    taken_views: set[int] = set()
    chosen: list[int] = []
    order = np.argsort(cost)
    order = order[allowed[order]]
    for i, one, other in zip(order.tolist(), track[order].tolist(), view[order].tolist(), strict=True):
        if one not in taken_tracks and other not in taken_views:
            taken_tracks.add(one)
            taken_views.add(other)
            chosen.append(i)
    return np.array(chosen, dtype=np.intp)
