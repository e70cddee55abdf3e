"""From labelled fruit to the parts of a model: standardising, drawing rows for the perceptron, densities."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.classification.axes import Axes, axes_of
from fruitgui.classification.density import Density, FruitVectors, fit_density, fruit_vectors
from fruitgui.classification.evidence import Evidence, FeatureNames
from fruitgui.classification.model import Core, view_rows
from fruitgui.classification.nature import borne_changes
from fruitgui.classification.network import fit_network
from fruitgui.frame import F64, Ints
from fruitgui.progress import Cancelled, never_cancelled

_EPOCHS = 4
_ROWS = 4096
_JITTER = 0.5
_CUT_SHARE = 0.2
_LEAST_UNIT = 1e-3
_VIEWS = 40
"""Views per fruit that the perceptron is shown; more of one fruit teach nothing new."""


@dataclass(frozen=True, slots=True, eq=False)
class FruitSet:
    """Fruit ready for fitting.

    Attributes:
        names: of the features.
        views: one (n, A) array per fruit, at most 40 rows each; NaN where a neighbour spoils an axis.
        vectors: the fruit as points.
        kinds: (N,) number of each fruit's kind.
        count: how many kinds there are.
    """

    names: FeatureNames
    views: tuple[F64, ...]
    vectors: FruitVectors
    kinds: Ints
    count: int

    @property
    def axes(self) -> Axes:
        """The axes of the views and vectors."""
        return axes_of(self.names)

    def take(self, rows: Ints) -> FruitSet:
        """Return the chosen fruit; the kinds stay numbered as they are."""
        return FruitSet(
            self.names, tuple(self.views[row] for row in rows), self.vectors.take(rows), self.kinds[rows], self.count
        )


def fruit_set(evidence: list[Evidence], kinds: Ints, count: int, names: FeatureNames) -> FruitSet:
    """Return the fruit of `count` kinds, ready for fitting."""
    views = tuple(_thinned(view_rows(one, names)) for one in evidence)
    return FruitSet(names, views, fruit_vectors(evidence, names), kinds, count)


def _thinned(views: F64) -> F64:
    if len(views) <= _VIEWS:
        return views
    return np.asarray(views[np.linspace(0, len(views) - 1, _VIEWS).round().astype(int)])


def fit_densities(fruit: FruitSet) -> Density:
    """Return the densities of the kinds."""
    changes = borne_changes(fruit.axes)
    return fit_density(fruit.vectors, fruit.kinds, fruit.count, changes.T @ changes)


def fit_core(
    fruit: FruitSet,
    strangers: FruitVectors | None,
    random: np.random.Generator,
    cancelled: Cancelled = never_cancelled,
) -> Core:
    """Return the parts of a model, fitted to the fruit. Every kind has at least one.

    Raises:
        CancelledByUserError: `cancelled` said so.
    """
    density = fit_densities(fruit)
    rows = np.concatenate(fruit.views)
    count = np.maximum(np.isfinite(rows).sum(axis=0), 1)
    centre = np.nansum(rows, axis=0) / count
    unit = np.maximum(np.sqrt(np.nansum((rows - centre) ** 2, axis=0) / count), _least_units(fruit.axes))
    drawer = _Drawer(fruit, centre, unit, density)
    network = fit_network(drawer.draw, fruit.count, _EPOCHS, random, cancelled=cancelled)
    return Core(fruit.names, centre, unit, network, density, around(density, strangers))


def around(density: Density, strangers: FruitVectors | None) -> Density | None:
    """Return a density around each stranger, as wide as those of the kinds are on average."""
    if strangers is None or len(strangers.points) == 0:
        return None
    means = np.nan_to_num(strangers.points / density.unit, nan=0.0)
    width = np.broadcast_to(density.covariances.mean(axis=0), (len(means), *density.covariances.shape[1:]))
    return Density(density.unit, means, width, np.ones(len(means)), density.view_spread, density.views)


def _least_units(axes: Axes) -> F64:
    """Return the least unit of each axis of a view: what a change that must be borne may move it."""
    changes = borne_changes(axes)[:, : len(axes.view)]
    return np.asarray(np.maximum(np.linalg.norm(changes, axis=0), _LEAST_UNIT))


class _Drawer:
    """Draws rows for one epoch: kinds alike, fruit of a kind alike, views of a fruit alike.

    A row is a view moved as other fruit of its kind differ from this one (half as far, in both directions): a few
    fruit stand for the many that are to come. A fifth of the rows say nothing that only fruit standing alone show, so
    that the perceptron can do without.
    """

    def __init__(self, fruit: FruitSet, centre: F64, unit: F64, density: Density) -> None:
        self._rows = np.nan_to_num((np.concatenate(fruit.views) - centre) / unit, nan=0.0)
        self._lengths = np.array([len(views) for views in fruit.views])
        self._starts = np.concatenate([[0], np.cumsum(self._lengths)[:-1]])
        self._members = [np.flatnonzero(fruit.kinds == kind) for kind in range(fruit.count)]
        width = len(centre)
        self._lone = fruit.axes.lone[fruit.axes.lone < width]
        scale = _JITTER * density.unit[:width] / unit
        self._moves = [_root(block * np.outer(scale, scale)) for block in density.covariances[:, :width, :width]]

    def draw(self, random: np.random.Generator) -> tuple[F64, Ints]:
        """Return (4096, F) rows and the number of the kind of each."""
        kinds = np.arange(_ROWS) % len(self._members)
        rows = np.empty((_ROWS, self._rows.shape[1]))
        for kind, members in enumerate(self._members):
            at = np.flatnonzero(kinds == kind)
            chosen = random.choice(members, len(at))
            views = self._starts[chosen] + (random.random(len(at)) * self._lengths[chosen]).astype(np.intp)
            rows[at] = self._rows[views] + random.standard_normal((len(at), rows.shape[1])) @ self._moves[kind].T
        cut = np.flatnonzero(random.random(_ROWS) < _CUT_SHARE)
        rows[np.ix_(cut, self._lone)] = 0.0
        order = random.permutation(_ROWS)
        return np.clip(rows[order], -10.0, 10.0), kinds[order]


def _root(covariance: F64) -> F64:
    """Return a matrix whose square is the covariance, negative eigenvalues taken as nought."""
    values, vectors = np.linalg.eigh(covariance)
    return np.asarray(vectors * np.sqrt(np.maximum(values, 0.0)))
