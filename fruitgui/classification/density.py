"""Where the fruit of each kind lie: one broad normal density per kind, over the features of a whole fruit.

It serves twice: its distances say whether a fruit is like any trained kind at all, and its log-density is a second
opinion on the kind beside the perceptron's, which knows the fused size.

A dozen fruit cannot teach a covariance of forty axes. So: correlations are pooled over all kinds and shrunk (Ledoit &
Wolf 2004), and each kind has its own spreads and correlations, drawn towards the pooled ones; fruit of a kind differ as
the faces of one fruit do (a blotched apple's views say which blotches apples can have, and how it looks when it lies
otherwise); the mean of n fruit is itself uncertain by a share 1/n; and a fruit seen in fewer views than usual is less
certain by the spread between views.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.classification.axes import axes_of, fruit_axes, view_axes
from fruitgui.classification.evidence import Evidence, FeatureNames
from fruitgui.classification.nature import borne_beside
from fruitgui.frame import F64, Ints

_STRENGTH = 3.0
"""The weight of the pooled spread in each kind's own, in fruit."""

_LIKENESS = 10.0
"""The weight of the pooled correlations in each kind's own, in fruit: what goes together in a striped apple does not in
a lemon, but takes more fruit to learn than a spread."""

_PRIOR_FRUIT = 3.0
"""The weight of the first guess on the spread within kinds, in fruit."""

_PRIOR_SHARE = 0.3
"""First guess on the spread within kinds, as a share of the spread over all fruit."""

_LEAST_SPREAD = 1e-3
"""Least spread within kinds as a share of the spread over all fruit: no feature decides everything alone."""

_LEAST_SHARE = 0.02
"""Least spread of one kind as a share of the first guess."""

_FACES = 0.5
"""Variance of a fruit by the faces that it happens to show, as a share of that between its views: opposed sensors see
two."""

_USUAL = 0.5
"""Part of the variance that a fruit is granted because others touch it which one in a group usually uses."""

_DISAGREE = 1.5
"""By how many standard deviations of its views their mean is wrong of a fruit that others touch: frames part it now
here, now there, and one way of parting stays for a while."""


@dataclass(frozen=True, slots=True, eq=False)
class FruitVectors:
    """Fruit as points along the axes of `axes.Axes.every`.

    Attributes:
        points: (N, D); NaN where not measured.
        spreads: (N, D, D) covariance of one view about its fruit, zero for axes of the whole fruit.
        views: (N,) number of views.
        borne: (N, D) by how much each may differ besides, as others touch it: standard deviations.
    """

    points: F64
    spreads: F64
    views: F64
    borne: F64

    def take(self, rows: Ints) -> FruitVectors:
        """Return the chosen fruit."""
        return FruitVectors(self.points[rows], self.spreads[rows], self.views[rows], self.borne[rows])


def fruit_vectors(evidence: list[Evidence], names: FeatureNames) -> FruitVectors:
    """Return the fruit as points: the trimmed mean of its views.

    A view or two that a neighbour or the picture's edge spoiled are left out; the median would jump between the two
    faces of a fruit that opposed sensors see.
    """
    axes = axes_of(names)
    width, depth = len(axes.view), len(axes.every)
    points, spreads = np.empty((len(evidence), depth)), np.zeros((len(evidence), depth, depth))
    for row, one in enumerate(evidence):
        views = view_axes(one.view_features, names)
        points[row, :width] = _trimmed_mean(views)
        points[row, width:] = fruit_axes(one.fruit_features, points[row, :width], names)
        points[row, unheard(one, names)] = np.nan
        if len(views) > 1:
            spreads[row, :width, :width] = np.cov(views, rowvar=False).reshape(width, width)
    borne = np.array([borne_beside(one, axes) for one in evidence]).reshape(-1, depth)
    for row, one in enumerate(evidence):
        if not one.alone:
            borne[row] = np.hypot(borne[row], _DISAGREE * np.sqrt(np.diag(spreads[row])))
    return FruitVectors(points, spreads, np.array([one.views for one in evidence], dtype=float), borne)


def unheard(evidence: Evidence, names: FeatureNames) -> Ints:
    """Return which axes of a fruit are not listened to, as its views do not show them."""
    axes = axes_of(names)
    if not evidence.whole:
        return axes.lone
    return np.zeros(0, dtype=np.intp) if evidence.alone else axes.outline


def _trimmed_mean(views: F64) -> F64:
    """Return the mean (F,) of what is left when a fifth of the values is taken off either end."""
    off = len(views) // 5
    return np.asarray(np.sort(views, axis=0)[off : len(views) - off].mean(axis=0))


@dataclass(frozen=True, slots=True, eq=False)
class Density:
    """The fitted densities. Every array is in units of `unit`.

    Attributes:
        unit: (D,) spread of each feature within a kind.
        means: (K, D).
        covariances: (K, D, D) between fruit of a kind.
        counts: (K,) fruit that taught each kind.
        view_spread: (D, D) covariance of one view about its fruit.
        views: views of a usual fruit.
    """

    unit: F64
    means: F64
    covariances: F64
    counts: F64
    view_spread: F64
    views: float

    def judge(self, point: F64, views: float, borne: F64) -> tuple[F64, F64]:
        """Return squared distance per axis (K,) and log-density (K,) of one fruit, over the axes that were measured.

        The distance is squared Mahalanobis divided by the number of axes, about 1 for fruit of the kind; an axis along
        which this fruit may differ besides counts by less than one, or colours would drown in what says little. The
        log-density has the heavy tails of Student's t, as the covariance is only an estimate.

        Args:
            point: (D,); NaN where not measured.
            views: how many there are of the fruit.
            borne: (D,) standard deviations by which this fruit may differ besides, along each axis.
        """
        seen = np.flatnonzero(np.isfinite(point))
        if len(seen) == 0:
            return np.zeros(len(self.means)), np.zeros(len(self.means))
        square = np.ix_(seen, seen)
        besides = (borne[seen] / self.unit[seen]) ** 2
        fewer = max(0.0, views**-0.5 - self.views**-0.5)
        distances, densities = np.empty(len(self.means)), np.empty(len(self.means))
        for kind, (mean, covariance, count) in enumerate(zip(self.means, self.covariances, self.counts, strict=True)):
            spread = covariance[square] * (1.0 + 1.0 / count) + fewer * self.view_spread[square]
            own = np.diag(spread)
            counted = float(np.sum((own + _USUAL * besides) / (own + besides)))
            spread = spread + np.diag(besides)
            factor = np.linalg.cholesky(spread)
            squared = float(np.sum(np.linalg.solve(factor, point[seen] / self.unit[seen] - mean[seen]) ** 2))
            freedom = self.counts.sum() + len(seen)
            distances[kind] = squared / counted
            densities[kind] = -0.5 * (freedom + len(seen)) * np.log1p(squared / freedom) - np.log(np.diag(factor)).sum()
        return distances, densities


def fit_density(fruit: FruitVectors, kinds: Ints, count: int, nuisance: F64) -> Density:
    """Return the densities of `count` kinds, each with at least one fruit.

    Args:
        fruit: the fruit.
        kinds: (N,) number of each fruit's kind.
        count: K.
        nuisance: (D, D) covariance added to every kind's: what the light may change that training did not show.
    """
    points = _filled(fruit.points, kinds, count)
    means = np.array([points[kinds == kind].mean(axis=0) for kind in range(count)])
    counts = np.bincount(kinds, minlength=count).astype(float)
    residuals = points - means[kinds]
    view_spread = fruit.spreads.mean(axis=0)
    guess, variance = _within(points, residuals, len(points) - count, np.diag(view_spread))
    unit, own = np.sqrt(variance), np.empty_like(means)
    for kind in range(count):
        squares = (residuals[kinds == kind] ** 2).sum(axis=0)
        own[kind] = (squares + _STRENGTH * variance) / (_STRENGTH + max(counts[kind] - 1.0, 0.0))
    own = np.sqrt(np.maximum(own, guess * _LEAST_SHARE**2)) / unit
    correlations = _correlations(residuals / unit / own[kinds], kinds, count)
    faces = np.array([_FACES * fruit.spreads[kinds == kind].mean(axis=0) for kind in range(count)])
    covariances = own[:, :, None] * correlations * own[:, None, :] + (faces + nuisance) / np.outer(unit, unit)
    view_spread = view_spread / np.outer(unit, unit)
    return Density(unit, means / unit, covariances, counts, view_spread, float(np.median(fruit.views)))


def _filled(points: F64, kinds: Ints, count: int) -> F64:
    """Return the points with what was not measured replaced by the mean of its kind, of all, or by nought."""
    filled = points.copy()
    for kind in range(count):
        rows = filled[kinds == kind]
        filled[kinds == kind] = np.where(np.isnan(rows), _mean(rows), rows)
    filled = np.where(np.isnan(filled), _mean(filled), filled)
    return np.nan_to_num(filled, nan=0.0)


def _mean(rows: F64) -> F64:
    seen = np.isfinite(rows)
    total = np.where(seen, rows, 0.0).sum(axis=0)
    return np.asarray(np.where(seen.any(axis=0), total / np.maximum(seen.sum(axis=0), 1), np.nan))


def _within(points: F64, residuals: F64, freedom: int, view_variance: F64) -> tuple[F64, F64]:
    """Return the first guess on the variance within kinds (D,), and the pooled variance mixed with it (D,)."""
    least = _LEAST_SPREAD**2 * points.var(axis=0) + 1e-12 * (1.0 + (points**2).mean(axis=0))
    guess = np.maximum(np.maximum(_PRIOR_SHARE**2 * points.var(axis=0), view_variance), least)
    pooled = ((residuals**2).sum(axis=0) + _PRIOR_FRUIT * guess) / (max(freedom, 0) + _PRIOR_FRUIT)
    return guess, np.maximum(pooled, least)


def _correlations(residuals: F64, kinds: Ints, count: int) -> F64:
    """Return the correlations within each kind (K, D, D): drawn towards the pooled ones, which are drawn towards none.

    Args:
        residuals: (N, D) from the mean of the kind, in its spreads.
        kinds: (N,) number of each fruit's kind.
        count: K.
    """
    pooled = _pooled_correlation(residuals, len(residuals) - count)
    own = [residuals[kinds == kind] for kind in range(count)]
    return np.array([_scaled(rows.T @ rows + _LIKENESS * pooled) for rows in own])


def _pooled_correlation(residuals: F64, freedom: int) -> F64:
    if freedom < 1:
        return np.eye(residuals.shape[1])
    from sklearn.covariance import ledoit_wolf

    shrunk, _ = ledoit_wolf(residuals, assume_centered=True)
    return _scaled(freedom * shrunk / (np.trace(shrunk) / len(shrunk)) + _PRIOR_FRUIT * np.eye(len(shrunk)))


def _scaled(covariance: F64) -> F64:
    """Return the covariance (D, D) as correlations."""
    scale = np.sqrt(np.diag(covariance))
    return np.asarray(covariance / np.outer(scale, scale))
