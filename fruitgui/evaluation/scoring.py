"""A report held against the truth: what was lost, counted twice, taken for something else, or measured wrong."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from fruitgui.frame import F64
from fruitgui.simulation.simulation import TrueFruit, Truth

SAME_FRUIT_M = 0.05
"""A path farther than this from a fruit's true path is another fruit's: fruit are wider than that."""


@dataclass(frozen=True, slots=True)
class Pair:
    """A fruit as reported beside the fruit that it was."""

    reported: Mapping[str, Any]
    true: TrueFruit


@dataclass(frozen=True, slots=True)
class Score:
    """A report, sorted out.

    Attributes:
        pairs: reported fruit with the true ones.
        lost: true things that no report matches.
        double: reported fruit that are a true one already matched.
        phantom: reported fruit that are nothing.
    """

    pairs: tuple[Pair, ...]
    lost: tuple[TrueFruit, ...]
    double: tuple[Mapping[str, Any], ...]
    phantom: tuple[Mapping[str, Any], ...]


def score(fruit: Sequence[Mapping[str, Any]], truth: Truth) -> Score:
    """Match a report's fruit with the true ones by their paths (optimal assignment)."""
    from scipy.optimize import linear_sum_assignment

    true = truth.fruit
    if not fruit or not true:
        return Score((), true, (), tuple(fruit))
    apart_m = np.array([[_apart_m(one, thing, truth) for thing in true] for one in fruit])
    rows, columns = linear_sum_assignment(np.minimum(apart_m, 10 * SAME_FRUIT_M))
    matched = [(r, c) for r, c in zip(rows, columns, strict=True) if apart_m[r, c] <= SAME_FRUIT_M]
    left_over = sorted(set(range(len(fruit))) - {r for r, _ in matched})
    found = {c for _, c in matched}
    return Score(
        tuple(Pair(fruit[r], true[c]) for r, c in matched),
        tuple(thing for c, thing in enumerate(true) if c not in found),
        tuple(fruit[r] for r in left_over if apart_m[r].min() <= SAME_FRUIT_M),
        tuple(fruit[r] for r in left_over if apart_m[r].min() > SAME_FRUIT_M),
    )


def _apart_m(reported: Mapping[str, Any], thing: TrueFruit, truth: Truth) -> float:
    """Return the median distance between a reported path and a true one, at up to nine of its times."""
    path = reported["path"]
    chosen = [path[at] for at in np.unique(np.linspace(0, len(path) - 1, 9).astype(int))]
    apart = [
        np.linalg.norm(point["position_m"] - truth.position_m(thing.fruit_id, point["time_s"])) for point in chosen
    ]
    return float(np.median(apart))


def relative_errors(pairs: Sequence[Pair]) -> F64:
    """Return (estimate − truth) / truth of the volumes of known fruit."""
    return np.array([one.reported["volume_ml"] / (one.true.volume_m3 * 1e6) - 1.0 for one in pairs])


def covered(pairs: Sequence[Pair]) -> int:
    """Return how many true volumes lie in their 95 % interval."""
    return sum(
        abs(one.reported["volume_ml"] - one.true.volume_m3 * 1e6) <= 1.96 * one.reported["volume_std_ml"]
        for one in pairs
    )


def size_errors_mm(pairs: Sequence[Pair], name: str) -> F64:
    """Return estimate − truth of `length`, `diameter` or `perimeter`, mm, of the fruit whose report has it."""
    return np.array(
        [
            one.reported[f"{name}_mm"] - getattr(one.true, f"{name}_m") * 1e3
            for one in pairs
            if f"{name}_mm" in one.reported
        ]
    )
