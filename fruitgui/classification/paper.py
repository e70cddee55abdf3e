"""The source's way (paper 3.2–3.3), kept as the baseline: a perceptron on one view's vector, the views' mean decides.

It knows no fused size and no `unknown`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fruitgui.classification.account import Training, account
from fruitgui.classification.confusion import Judged
from fruitgui.classification.evidence import UNKNOWN, Evidence, FeatureNames, KindVote, LabelledFruit
from fruitgui.classification.held_out import FOLDS, deal
from fruitgui.classification.model import check_width
from fruitgui.classification.network import Network, fit_network
from fruitgui.classification.training_set import TrainingSet, training_set
from fruitgui.frame import F64, Ints
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress

_EPOCHS = 9
_ROWS = 4096


@dataclass(frozen=True, slots=True, eq=False)
class PaperModel:
    """The source's classifier: every view is judged alone, and the mean of its views is the fruit's.

    Attributes:
        kinds: the trained kinds.
        names: of the features; none of a whole fruit.
        centre: (F,) mean of the features.
        unit: (F,) their spread.
        network: on standardised features.
    """

    kinds: tuple[str, ...]
    names: FeatureNames
    centre: F64
    unit: F64
    network: Network

    def vote(self, evidence: Evidence) -> KindVote:
        """Return the kind of one fruit, never `unknown`.

        Raises:
            InputError: the evidence has other features than the model.
        """
        check_width(evidence, self.names)
        rows = (evidence.view_features.astype(np.float64) - self.centre) / self.unit
        mean = np.exp(self.network.log_probabilities(rows)).mean(axis=0)
        best = int(mean.argmax())
        probabilities = dict(zip(self.kinds, mean.tolist(), strict=True)) | {UNKNOWN: 0.0}
        return KindVote(self.kinds[best], float(mean[best]), probabilities)


def train_paper(
    fruits: Sequence[LabelledFruit],
    names: FeatureNames,
    seed: int = 0,
    progress: Progress = no_progress,
    cancelled: Cancelled = never_cancelled,
) -> Training[PaperModel]:
    """Return the source's classifier, judged on held-out fruit as the product's is; strangers teach it nothing.

    Raises:
        InputError: see `training_set`.
        CancelledByUserError: `cancelled` said so.
    """
    taught = training_set(fruits, names)
    random = np.random.default_rng(seed)
    fold = deal(taught.numbers, taught.pieces, random)
    votes: dict[int, Judged] = {}
    for one in range(FOLDS):
        progress(one / (FOLDS + 1), "Judging fruit that training did not see")
        out = np.flatnonzero(fold == one)
        if len(out):
            model = _fit(taught, np.flatnonzero(fold != one), names, random, cancelled)
            votes |= {int(row): Judged(taught.fruit[row], model.vote(taught.fruit[row].evidence)) for row in out}
    progress(FOLDS / (FOLDS + 1), "Training on all fruit")
    model = _fit(taught, np.arange(len(fold)), names, random, cancelled)
    progress(1.0, "Trained")
    return account(model, taught.kinds, fruits, [votes[row] for row in sorted(votes)], ())


def _fit(
    taught: TrainingSet, chosen: Ints, names: FeatureNames, random: np.random.Generator, cancelled: Cancelled
) -> PaperModel:
    evidence = [taught.fruit[row].evidence for row in chosen]
    views = np.concatenate([one.view_features for one in evidence]).astype(np.float64)
    of_view = np.repeat(taught.numbers[chosen], [one.views for one in evidence])
    centre, unit = views.mean(axis=0), np.maximum(views.std(axis=0), 1e-6)
    rows = (views - centre) / unit

    def draw(source: np.random.Generator) -> tuple[F64, Ints]:
        at = source.integers(len(rows), size=_ROWS)
        return rows[at], of_view[at]

    network = fit_network(draw, len(taught.kinds), _EPOCHS, random, cancelled=cancelled)
    return PaperModel(taught.kinds, names, centre, unit, network)
