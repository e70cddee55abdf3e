"""A trained model: one fruit's evidence in, its kind out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.classification.decision import Novelty, Scores, Weighing, decide
from fruitgui.classification.density import Density, fruit_vectors
from fruitgui.classification.evidence import Evidence, FeatureNames, KindVote
from fruitgui.classification.nature import axis_sets, shape_axes, steadied
from fruitgui.classification.network import Network
from fruitgui.errors import InputError
from fruitgui.frame import F64


@dataclass(frozen=True, slots=True, eq=False)
class Core:
    """The parts that are fitted to fruit; what weighs them is fitted to fruit that they did not see.

    Attributes:
        names: of the features.
        centre: (F,) mean of the view features, sizes as logarithms.
        unit: (F,) their spread.
        network: on standardised view features.
        density: on whole fruit.
        strangers: density around each fruit labelled unknown, if any.
    """

    names: FeatureNames
    centre: F64
    unit: F64
    network: Network
    density: Density
    strangers: Density | None

    def scores(self, evidence: Evidence) -> Scores:
        """Return what the parts say of one fruit.

        Raises:
            InputError: the evidence has other features than the model.
        """
        check_width(evidence, self.names)
        vectors = fruit_vectors([evidence], self.names)
        steady = steadied(evidence.view_features, self.names)
        if not evidence.alone:
            steady[:, shape_axes(self.names)] = np.nan
        return self.judge(steady, vectors.points[0], float(vectors.views[0]))

    def judge(self, steady: F64, point: F64, views: float) -> Scores:
        """Return what the parts say of steadied views (n, F) and of the fruit as a point (D,); NaN is not known."""
        # A value beyond ten times the spread says no more than that it is wild; the mean says nothing.
        rows = np.nan_to_num(np.clip((steady - self.centre) / self.unit, -10.0, 10.0), nan=0.0)
        sets = axis_sets(self.names)
        fruit = self.density.judge(point, views, sets[0])[1]
        stranger = -np.inf
        if self.strangers is not None:
            stranger = float(self.strangers.judge(point, views, sets[0])[1].max())
        mean = self.network.log_probabilities(rows).mean(axis=0)
        return Scores(mean, fruit, self.density.distances(point, views, sets), stranger)


@dataclass(frozen=True, slots=True, eq=False)
class KindModel:
    """What the product decides kinds with."""

    kinds: tuple[str, ...]
    core: Core
    weighing: Weighing
    novelty: Novelty

    def vote(self, evidence: Evidence) -> KindVote:
        """Return the kind of one fruit.

        Raises:
            InputError: the evidence has other features than the model.
        """
        return decide(self.kinds, self.core.scores(evidence), self.weighing, self.novelty)


def check_width(evidence: Evidence, names: FeatureNames) -> None:
    """Raise `InputError` if the evidence has another number of features than the names."""
    have = (evidence.view_features.shape[1], len(evidence.fruit_features))
    want = (len(names.view), len(names.fruit))
    if have != want:
        raise InputError(
            "other_features",
            f"The model wants {want[0]} features of a view and {want[1]} of a fruit, not {have[0]} and {have[1]}.",
            "Train again with this version.",
        )
