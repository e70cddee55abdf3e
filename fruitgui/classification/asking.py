"""Which fruit to ask a person about first: those that would teach most."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from fruitgui.classification.evidence import KindVote
from fruitgui.frame import F64

NEIGHBOURS = 0.5
"""Two fruit are alike where they lie nearer than this part of the median distance."""


def uncertainty(vote: KindVote) -> float:
    """Return how little is known of a fruit's kind: 0 where it is sure, 1 where every kind is as likely.

    The entropy of the probabilities, as a share of the largest that so many kinds can have.
    """
    shares = [share for share in vote.probabilities.values() if share > 0.0]
    if len(vote.probabilities) < 2:
        return 0.0
    return -sum(share * math.log(share) for share in shares) / math.log(len(vote.probabilities))


def most_telling(uncertain: Sequence[float], points: F64, most: int) -> list[int]:
    """Return the rows of the fruit to ask about, the most telling first.

    Uncertainty first, then diversity (after Settles 2009, "Active learning literature survey", 5.2): once one fruit is
    chosen, those that look like it would teach the same again, and count for less.

    Args:
        uncertain: (N,) of each fruit.
        points: (N, D) what each looks like; NaN where it was not measured.
        most: rows to return.
    """
    worth = np.array(uncertain, dtype=np.float64) + 1e-3
    looks = _standard(points)
    typical = _typical_distance(looks)
    order: list[int] = []
    for _ in range(min(most, len(worth))):
        best = int(worth.argmax())
        order.append(best)
        distance = np.linalg.norm(looks - looks[best], axis=1) / (NEIGHBOURS * typical)
        worth *= 1.0 - np.exp(-(distance**2))
        worth[best] = -1.0
    return order


def _standard(points: F64) -> F64:
    """Return points (N, D) about their mean in units of their spread; what was not measured lies in the middle."""
    known = np.isfinite(points)
    count = np.maximum(known.sum(axis=0), 1)
    centred = np.where(known, points - np.where(known, points, 0.0).sum(axis=0) / count, 0.0)
    spread = np.sqrt((centred**2).sum(axis=0) / count)
    return np.asarray(centred / np.where(spread > 0, spread, 1.0))


def _typical_distance(looks: F64) -> float:
    """Return the median distance from the middle, by root 2: between two fruit."""
    far = np.linalg.norm(looks - np.median(looks, axis=0), axis=1) if len(looks) else np.zeros(1)
    return max(math.sqrt(2.0) * float(np.median(far)), 1e-9)
