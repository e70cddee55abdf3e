"""A trained model: one fruit's evidence in, its kind out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.classification.decision import Novelty, Scores, Weighing, decide
from fruitgui.classification.density import Density, FruitVectors, fruit_vectors
from fruitgui.classification.evidence import Evidence, FeatureNames, KindVote
from fruitgui.classification.nature import axis_sets, steadied
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
        views = self.network.log_probabilities(standardised(evidence, self.names, self.centre, self.unit))
        vectors = fruit_vectors([evidence], self.names)
        return self._whole(vectors, views.mean(axis=0))

    def _whole(self, vectors: FruitVectors, views: F64) -> Scores:
        point, count = vectors.points[0], float(vectors.views[0])
        sets = axis_sets(self.names)
        judged = [self.density.judge(point, count, axes) for axes in sets]
        stranger = -np.inf
        if self.strangers is not None:
            stranger = float(self.strangers.judge(point, count, sets[0])[1].max())
        return Scores(views, judged[0][1], np.array([distances for distances, _ in judged]), stranger)


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


def standardised(evidence: Evidence, names: FeatureNames, centre: F64, unit: F64) -> F64:
    """Return the view features (n, F) in units of their spread, within ±10: a wild value says no more than that."""
    return np.clip((steadied(evidence.view_features, names) - centre) / unit, -10.0, 10.0)


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
