"""Fruit judged by parts that never saw them: what every figure on a model rests on."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from fruitgui.classification.decision import Novelty, Scores, Weighing, fit_novelty, fit_weighing
from fruitgui.classification.density import FruitVectors
from fruitgui.classification.fitting import FruitSet, fit_core
from fruitgui.frame import Ints
from fruitgui.progress import Cancelled

FOLDS = 5


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


@dataclass(frozen=True, slots=True, eq=False)
class HeldOut:
    """Scores of fruit by parts that never saw them.

    Attributes:
        rows: (M,) which fruit.
        scores: of each.
        kinds: (M,) what each is.
        fold: (M,) in which fold each was.
        count: how many kinds there are.
    """

    rows: Ints
    scores: tuple[Scores, ...]
    kinds: Ints
    fold: Ints
    count: int

    def fit(self, rows: Ints) -> tuple[Weighing, Novelty]:
        """Return what weighs the parts, fitted to the chosen fruit."""
        kinds, scores = self.kinds[rows], [self.scores[row] for row in rows]
        own = [one.distances[kind] for one, kind in zip(scores, kinds, strict=True)]
        return fit_weighing(scores, kinds), fit_novelty(np.array(own), kinds, self.count)


def hold_out(
    fruit: FruitSet,
    fold: Ints,
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
    vectors = fruit.vectors
    for one in range(FOLDS):
        out = np.flatnonzero(fold == one).tolist()
        if out:
            core = fit_core(fruit.take(np.flatnonzero(fold != one)), strangers, random, cancelled)
            rows += out
            scores += [core.judge(fruit.views[row], vectors, row) for row in out]
        done((one + 1) / FOLDS)
    at = np.array(rows, dtype=np.intp)
    return HeldOut(at, tuple(scores), fruit.kinds[at], fold[at], fruit.count)
