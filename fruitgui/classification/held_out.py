"""Fruit judged by parts that never saw them: what every figure on a model rests on."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from fruitgui.classification.decision import Novelty, Scores, Weighing, fit_novelty, fit_weighing
from fruitgui.classification.density import FruitVectors
from fruitgui.classification.fitting import FruitSet, fit_core, fit_densities
from fruitgui.classification.model import Core
from fruitgui.classification.nature import axis_sets, borne_changes
from fruitgui.frame import F64, Ints
from fruitgui.progress import Cancelled

FOLDS = 5
LIGHTS = 3
"""In how many other lights, or beside how many neighbours, each held-out fruit is judged."""

STRENGTHS = (3.0, 8.0, 24.0, 100.0)
"""Candidates for the strength of the pooled spread: from each kind its own to all alike."""


def deal(kinds: Ints, pieces: Ints, random: np.random.Generator) -> Ints:
    """Return each fruit's fold (N,), −1 for the only piece of a kind, which training cannot spare.

    Every kind is dealt evenly; by piece of fruit, never by view.
    """
    fold = np.full(len(kinds), -1, dtype=np.intp)
    start = 0
    for kind in np.unique(kinds):
        own = random.permutation(np.unique(pieces[kinds == kind]))
        if len(own) > 1:
            for number, piece in enumerate(own):
                fold[(pieces == piece) & (kinds == kind)] = (start + number) % FOLDS
            start += len(own)
    return fold


def choose_strength(fruit: FruitSet, fold: Ints) -> float:
    """Return the candidate under which the held-out fruit are most probable."""
    if not (fold >= 0).any():
        return STRENGTHS[-1]
    totals = [_held_out_density(fruit, fold, strength) for strength in STRENGTHS]
    return STRENGTHS[int(np.argmax(totals))]


def _held_out_density(fruit: FruitSet, fold: Ints, strength: float) -> float:
    total, axes = 0.0, axis_sets(fruit.names)[0]
    for one in np.unique(fold[fold >= 0]):
        density = fit_densities(fruit.take(np.flatnonzero(fold != one)), strength)
        for row in np.flatnonzero(fold == one):
            densities = density.judge(fruit.vectors.points[row], fruit.vectors.views[row], axes)[1]
            total += float(densities[fruit.kinds[row]] - np.log(density.unit[axes]).sum())
    return total


@dataclass(frozen=True, slots=True, eq=False)
class HeldOut:
    """Scores of fruit by parts that never saw them.

    Attributes:
        rows: (M,) which fruit.
        scores: of each.
        moved: of each, as another light, belt or neighbour than training's may have moved it; as often as `LIGHTS`.
        kinds: (M,) what each is.
        fold: (M,) in which fold each was.
        sets: A, how many distances to a kind there are.
    """

    rows: Ints
    scores: tuple[Scores, ...]
    moved: tuple[tuple[Scores, ...], ...]
    kinds: Ints
    fold: Ints
    sets: int

    def fit(self, rows: Ints) -> tuple[Weighing, Novelty]:
        """Return what weighs the parts, fitted to the chosen fruit as they may be met, not only as they were."""
        met = [one for row in rows for one in (self.scores[row], *self.moved[row])]
        kinds = np.repeat(self.kinds[rows], 1 + LIGHTS)
        weighing = fit_weighing(met, kinds)
        logs = [weighing.log_probabilities(one) for one in met]
        doubts = [-log.max() for log, kind in zip(logs, kinds, strict=True) if log.argmax() == kind]
        own = [one.distances[:, self.kinds[row]] for row in rows for one in self.moved[row]]
        distances = np.array(own).reshape(len(rows), LIGHTS, self.sets)
        return weighing, fit_novelty(distances, np.array(doubts))


def hold_out(
    fruit: FruitSet,
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
    moved: list[tuple[Scores, ...]] = []
    still = np.zeros((1, fruit.vectors.points.shape[1]))
    for one in range(FOLDS):
        out = np.flatnonzero(fold == one).tolist()
        if out:
            core = fit_core(fruit.take(np.flatnonzero(fold != one)), strength, strangers, random, cancelled)
            rows += out
            scores += [_judged(core, fruit, row, still)[0] for row in out]
            moved += [_judged(core, fruit, row, _moves(fruit, random)) for row in out]
        done((one + 1) / FOLDS)
    at = np.array(rows, dtype=np.intp)
    sets = len(axis_sets(fruit.names)) + 1
    return HeldOut(at, tuple(scores), tuple(moved), fruit.kinds[at], fold[at], sets)


def _moves(fruit: FruitSet, random: np.random.Generator) -> F64:
    changes = borne_changes(fruit.names)
    return np.asarray(random.uniform(-(3.0**0.5), 3.0**0.5, (LIGHTS, len(changes))) @ changes)


def _judged(core: Core, fruit: FruitSet, row: int, moves: F64) -> tuple[Scores, ...]:
    """Return the scores of one fruit, moved by each row of `moves` (L, D)."""
    views, point, count = fruit.views[row], fruit.vectors.points[row], float(fruit.vectors.views[row])
    width = views.shape[1]
    return tuple(core.judge(views + move[:width], point + move, count) for move in moves)
