"""A trained model: one fruit's evidence in, its kind out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.classification.axes import axes_of, view_axes
from fruitgui.classification.decision import Novelty, Scores, Weighing, decide
from fruitgui.classification.density import Density, FruitVectors, fruit_vectors
from fruitgui.classification.evidence import Evidence, FeatureNames, KindVote
from fruitgui.classification.network import Network
from fruitgui.errors import InputError
from fruitgui.frame import F64


@dataclass(frozen=True, slots=True, eq=False)
class Core:
    """The parts that are fitted to fruit; what weighs them is fitted to fruit that they did not see.

    Attributes:
        names: of the features.
        centre: (A,) mean of the views' axes.
        unit: (A,) their spread.
        network: on standardised views.
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
        return self.judge(view_rows(evidence, self.names), vectors, 0)

    def judge(self, rows: F64, vectors: FruitVectors, at: int) -> Scores:
        """Return what the parts say of one of several fruit, of which `rows` (n, A) are the views; NaN is not known."""
        point, views, borne = vectors.points[at], float(vectors.views[at]), vectors.borne[at]
        # A value beyond ten times the spread says no more than that it is wild; the mean says nothing.
        standard = np.nan_to_num(np.clip((rows - self.centre) / self.unit, -10.0, 10.0), nan=0.0)
        distances, densities = self.density.judge(point, views, borne)
        stranger = -np.inf
        if self.strangers is not None:
            stranger = float(np.logaddexp.reduce(self.strangers.judge(point, views, borne)[1]))
        logs = self.network.log_probabilities(standard).mean(axis=0)
        return Scores(logs, densities, distances, float(np.isfinite(point).mean()), stranger)


def view_rows(evidence: Evidence, names: FeatureNames) -> F64:
    """Return the views of a fruit as axes (n, A) for the perceptron; NaN where others or the picture's edge spoil them.

    The density grants such a fruit wider spreads. A perceptron can allow for nothing, so it hears nothing of what only
    a fruit that stands alone shows, which it was trained to do without.
    """
    rows = view_axes(evidence.view_features, names)
    if not (evidence.alone and evidence.whole):
        lone = axes_of(names).lone
        rows[:, lone[lone < rows.shape[1]]] = np.nan
    return rows


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
