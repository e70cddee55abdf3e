"""Fruit judged by parts that never saw them: what every figure on a model rests on."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from fruitgui.classification.decision import Novelty, Scores, Weighing, fit_novelty, fit_weighing
from fruitgui.classification.density import FruitVectors
from fruitgui.classification.evidence import Evidence
from fruitgui.classification.fitting import FruitSet, fit_core, fit_densities
from fruitgui.classification.model import axis_sets
from fruitgui.frame import F64, Ints
from fruitgui.progress import Cancelled

FOLDS = 5
STRENGTHS = (4.0, 12.0, 40.0, 150.0)
"""Candidates for the strength of the pooled covariance: from each kind its own to all alike."""


def deal(kinds: Ints, random: np.random.Generator) -> Ints:
    """Return each fruit's fold (N,), −1 for the only fruit of a kind, which training cannot spare.

    Every kind is dealt evenly; by fruit, never by view.
    """
    fold = np.full(len(kinds), -1, dtype=np.intp)
    start = 0
    for kind in np.unique(kinds):
        members = random.permutation(np.flatnonzero(kinds == kind))
        if len(members) > 1:
            fold[members] = (start + np.arange(len(members))) % FOLDS
            start += len(members)
    return fold


def choose_strength(fruit: FruitSet, fold: Ints) -> float:
    """Return the candidate under which the held-out fruit are most probable."""
    if not (fold >= 0).any():
        return STRENGTHS[-1]
    totals = [_held_out_density(fruit, fold, strength) for strength in STRENGTHS]
    return STRENGTHS[int(np.argmax(totals))]


def _held_out_density(fruit: FruitSet, fold: Ints, strength: float) -> float:
    total, axes = 0.0, np.arange(fruit.vectors.points.shape[1])
    for one in np.unique(fold[fold >= 0]):
        density = fit_densities(fruit.take(np.flatnonzero(fold != one)), strength)
        axes = np.arange(len(density.unit))
        for row in np.flatnonzero(fold == one):
            densities = density.judge(fruit.vectors.points[row], fruit.vectors.views[row], axes)[1]
            total += float(densities[fruit.kinds[row]] - np.log(density.unit).sum())
    return total


@dataclass(frozen=True, slots=True)
class HeldOut:
    """Scores of fruit by parts that never saw them.

    Attributes:
        rows: (M,) which fruit.
        scores: of each.
        kinds: (M,) what each is.
        fold: (M,) in which fold each was.
        foreign: (S, A) distances of strangers to the nearest kind.
    """

    rows: Ints
    scores: tuple[Scores, ...]
    kinds: Ints
    fold: Ints
    foreign: F64

    def fit(self, rows: Ints) -> tuple[Weighing, Novelty]:
        """Return what weighs the parts, fitted to the chosen fruit."""
        scores = [self.scores[row] for row in rows]
        own = [self.scores[row].distances[:, self.kinds[row]] for row in rows]
        sets = self.foreign.shape[1]
        return (
            fit_weighing(scores, self.kinds[rows]),
            fit_novelty(np.array(own).reshape(-1, sets), self.foreign),
        )


def hold_out(
    fruit: FruitSet,
    evidence: list[Evidence],
    fold: Ints,
    strength: float,
    strangers: FruitVectors | None,
    random: np.random.Generator,
    cancelled: Cancelled,
    done: Callable[[float], None],
) -> HeldOut:
    """Return the scores of all fruit that can be held out, each by parts fitted to the other folds.

    Raises:
        CancelledByUserError: `cancelled` said so.
    """
    rows: list[int] = []
    scores: list[Scores] = []
    for one in range(FOLDS):
        out = np.flatnonzero(fold == one)
        if len(out):
            core = fit_core(fruit.take(np.flatnonzero(fold != one)), strength, strangers, random, cancelled)
            rows += out.tolist()
            scores += [core.scores(evidence[row]) for row in out]
        done((one + 1) / FOLDS)
    at = np.array(rows, dtype=np.intp)
    return HeldOut(at, tuple(scores), fruit.kinds[at], fold[at], foreign_distances(fruit, strength, strangers))


def foreign_distances(fruit: FruitSet, strength: float, strangers: FruitVectors | None) -> F64:
    """Return the distances (S, A) of strangers to the nearest kind: of each kind with that kind left out."""
    sets = axis_sets(fruit.names)
    found: list[F64] = []
    for kind in range(fruit.count):
        if fruit.count > 1:
            members = np.flatnonzero(fruit.kinds == kind)
            found += _nearest(fruit.without(kind), strength, fruit.vectors.take(members), sets)
    if strangers is not None:
        found += _nearest(fruit, strength, strangers, sets)
    return np.array(found).reshape(-1, len(sets))


def _nearest(fruit: FruitSet, strength: float, judged: FruitVectors, sets: tuple[Ints, ...]) -> list[F64]:
    """Return each fruit's distances (A,) to the kind that is nearest in all axes together."""
    density = fit_densities(fruit, strength)
    nearest: list[F64] = []
    for point, views in zip(judged.points, judged.views, strict=True):
        distances = np.array([density.judge(point, float(views), axes)[0] for axes in sets])
        nearest.append(distances[:, int(distances[0].argmin())])
    return nearest
