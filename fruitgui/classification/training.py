"""From labelled fruit to a model, and an honest word on how good it is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from fruitgui.classification.account import CurvePoint, Training, account
from fruitgui.classification.confusion import Judged
from fruitgui.classification.decision import decide
from fruitgui.classification.density import FruitVectors, fruit_vectors
from fruitgui.classification.evidence import FeatureNames, LabelledFruit
from fruitgui.classification.fitting import FruitSet, around, fit_core, fruit_set
from fruitgui.classification.held_out import FOLDS, HeldOut, deal, hold_out
from fruitgui.classification.intervals import rate
from fruitgui.classification.model import KindModel
from fruitgui.classification.training_set import TrainingSet, training_set
from fruitgui.frame import Ints
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress

_CURVE_SHARES = (0.25, 0.5)
_CURVE_FOLDS = 2
_MOST_STRANGERS = 200


def train(
    fruits: Sequence[LabelledFruit],
    names: FeatureNames,
    seed: int = 0,
    progress: Progress = no_progress,
    cancelled: Cancelled = never_cancelled,
) -> Training[KindModel]:
    """Return a model of the kinds, with what is known about it. The same input and seed give the same model.

    Raises:
        InputError: see `training_set`.
        CancelledByUserError: `cancelled` said so.
    """
    taught = training_set(fruits, names)
    random = np.random.default_rng(seed)
    evidence = [one.evidence for one in taught.fruit]
    fruit = fruit_set(evidence, taught.numbers, len(taught.kinds), names)
    strangers = _strangers(taught, names)
    fold = deal(taught.numbers, taught.pieces, random)

    def told(share: float) -> None:
        progress(0.6 * share, "Judging fruit that training did not see")

    told(0.0)
    held = hold_out(fruit, fold, strangers, random, cancelled, told)
    progress(0.6, "Training on all fruit")
    core = fit_core(fruit, strangers, random, cancelled)
    model = KindModel(taught.kinds, core, *held.fit(np.arange(len(held.rows))))
    progress(0.7, "Finding out whether more fruit would help")
    curve = _curve(fruit, taught, fold, model, random, cancelled)
    progress(1.0, "Trained")
    judged = [*_judged(taught, held), *_strangers_judged(taught, model, strangers)]
    return account(model, taught.kinds, fruits, judged, curve)


def _strangers(taught: TrainingSet, names: FeatureNames) -> FruitVectors | None:
    """Return the first two hundred strangers as points; more would slow every vote."""
    if not taught.strangers:
        return None
    return fruit_vectors([one.evidence for one in taught.strangers[:_MOST_STRANGERS]], names)


def _judged(taught: TrainingSet, held: HeldOut) -> list[Judged]:
    """Return the held-out fruit with their votes, in the order given; each fold weighed by the other folds."""
    votes: dict[int, Judged] = {}
    for fold in range(FOLDS):
        rows = np.flatnonzero(held.fold == fold)
        weighing, novelty = held.fit(np.flatnonzero(held.fold != fold))
        for row in rows:
            vote = decide(taught.kinds, held.scores[row], weighing, novelty)
            votes[int(held.rows[row])] = Judged(taught.fruit[held.rows[row]], vote)
    return [votes[row] for row in sorted(votes)]


def _strangers_judged(taught: TrainingSet, model: KindModel, strangers: FruitVectors | None) -> list[Judged]:
    """Return the strangers with the votes of a model that knows only the other folds' strangers."""
    if strangers is None:
        return []
    judged: list[Judged] = []
    for number, one in enumerate(taught.strangers[: len(strangers.points)]):
        others = strangers.take(np.flatnonzero(np.arange(len(strangers.points)) % FOLDS != number % FOLDS))
        core = replace(model.core, strangers=around(model.core.density, others))
        judged.append(Judged(one, replace(model, core=core).vote(one.evidence)))
    return judged


def _curve(
    fruit: FruitSet,
    taught: TrainingSet,
    fold: Ints,
    model: KindModel,
    random: np.random.Generator,
    cancelled: Cancelled,
) -> list[CurvePoint]:
    """Return how many held-out fruit get their kind when training has a share of the others."""
    points: list[CurvePoint] = []
    for share in _CURVE_SHARES:
        right = trials = size = 0
        for one in range(_CURVE_FOLDS):
            kept = _share(taught.numbers, np.flatnonzero(fold != one), share)
            core = fit_core(fruit.take(kept), None, random, cancelled)
            smaller = KindModel(model.kinds, core, model.weighing, model.novelty)
            out = [taught.fruit[row] for row in np.flatnonzero(fold == one)]
            right += sum(smaller.vote(each.evidence).kind == each.kind for each in out)
            trials, size = trials + len(out), max(size, len(kept))
        points.append(CurvePoint(size, rate(right, trials)))
    return points


def _share(numbers: Ints, rows: Ints, share: float) -> Ints:
    """Return the first `share` of each kind's rows, at least one of each."""
    kept = [
        rows[numbers[rows] == kind][: max(1, round(share * int((numbers[rows] == kind).sum())))]
        for kind in np.unique(numbers[rows])
    ]
    return np.sort(np.concatenate(kept))
