"""Where the fruit of each kind lie: one broad normal density per kind, over the features of a whole fruit.

It serves twice: its distances say whether a fruit is like any trained kind at all, and its log-density is a second
opinion on the kind beside the perceptron's, which knows the fused size.

A dozen fruit cannot teach a covariance of fifty features. So: the correlations are pooled over all kinds and shrunk
(Ledoit & Wolf 2004); each kind has its own spread in each feature, drawn towards the pooled one as if that had been
seen on `strength` fruit; the mean of n fruit is itself uncertain by a share 1/n; and a fruit seen in fewer views than
usual is less certain by the spread between views.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fruitgui.classification.evidence import Evidence, FeatureNames
from fruitgui.classification.nature import by_ratio, shape_axes, sizes, steadied
from fruitgui.frame import F64, Ints

_PRIOR_FRUIT = 3.0
"""The weight of the first guess on the spread within kinds, in fruit."""

_PRIOR_SHARE = 0.3
"""First guess on the spread within kinds, as a share of the spread over all fruit."""

_LEAST_SPREAD = 1e-3
"""Least spread within kinds as a share of the spread over all fruit: no feature decides everything alone."""

_LEAST_SHARE = 0.02
"""Least spread of one kind as a share of the first guess."""


@dataclass(frozen=True, slots=True, eq=False)
class FruitVectors:
    """Fruit as points: its views' features, then its fused features.

    Attributes:
        points: (N, D) features, by ratio (sizes as logarithms); NaN where not measured.
        spreads: (N, D, D) covariance of one view about its fruit, zero for fused features.
        views: (N,) number of views.
    """

    points: F64
    spreads: F64
    views: F64

    def take(self, rows: Ints) -> FruitVectors:
        """Return the chosen fruit."""
        return FruitVectors(self.points[rows], self.spreads[rows], self.views[rows])


def fruit_vectors(evidence: list[Evidence], names: FeatureNames) -> FruitVectors:
    """Return the fruit as points: the trimmed mean of its views.

    A view or two that a neighbour or the picture's edge spoiled are left out; the median would jump between the two
    faces of a fruit that opposed sensors see.
    """
    fruit_sizes, shapes = sizes(names.fruit), shape_axes(names)
    width, depth = len(names.view), len(names.view) + len(names.fruit)
    points, spreads = np.empty((len(evidence), depth)), np.zeros((len(evidence), depth, depth))
    for row, one in enumerate(evidence):
        views = steadied(one.view_features, names)
        points[row, :width] = _trimmed_mean(views)
        points[row, width:] = by_ratio(one.fruit_features, fruit_sizes)
        if not one.alone:
            points[row, shapes] = np.nan
            points[row, width:] = np.nan
        if len(views) > 1:
            spreads[row, :width, :width] = np.cov(views, rowvar=False).reshape(width, width)
    return FruitVectors(points, spreads, np.array([one.views for one in evidence], dtype=float))


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
        strength: fruit that the pooled spread counts for in each kind's own.
    """

    unit: F64
    means: F64
    covariances: F64
    counts: F64
    view_spread: F64
    views: float
    strength: float

    def judge(self, point: F64, views: float, axes: Ints) -> tuple[F64, F64]:
        """Return squared distance per axis (K,) and log-density (K,) of one fruit, over `axes` that were measured.

        The distance is squared Mahalanobis divided by the number of axes, about 1 for fruit of the kind. The
        log-density has the heavy tails of Student's t, as the covariance is only an estimate.
        """
        seen = axes[np.isfinite(point[axes])]
        if len(seen) == 0:
            return np.zeros(len(self.means)), np.zeros(len(self.means))
        square = np.ix_(seen, seen)
        fewer = max(0.0, views**-0.5 - self.views**-0.5)
        distances, densities = np.empty(len(self.means)), np.empty(len(self.means))
        for kind, (mean, covariance, count) in enumerate(zip(self.means, self.covariances, self.counts, strict=True)):
            spread = covariance[square] * (1.0 + 1.0 / count) + fewer * self.view_spread[square]
            factor = np.linalg.cholesky(spread)
            squared = float(np.sum(np.linalg.solve(factor, point[seen] / self.unit[seen] - mean[seen]) ** 2))
            freedom = self.counts.sum() + len(seen)
            distances[kind] = _as_of_all(squared / len(seen), len(seen), len(axes))
            densities[kind] = -0.5 * (freedom + len(seen)) * np.log1p(squared / freedom) - np.log(np.diag(factor)).sum()
        return distances, densities

    def worst_axis(self, point: F64, views: float) -> F64:
        """Return the squared distance (K,) of one fruit along the axis that fits worst, in that axis's own spread.

        A mean over fifty axes hides what lies far off in two or three of them.
        """
        seen = np.flatnonzero(np.isfinite(point))
        if len(seen) == 0:
            return np.zeros(len(self.means))
        fewer = max(0.0, views**-0.5 - self.views**-0.5)
        own = np.diagonal(self.covariances, axis1=1, axis2=2) * (1.0 + 1.0 / self.counts)[:, None]
        spread = own + fewer * np.diagonal(self.view_spread)
        return np.asarray(((point / self.unit - self.means) ** 2 / spread)[:, seen].max(axis=1))

    def distances(self, point: F64, views: float, sets: Sequence[Ints]) -> F64:
        """Return the squared distances (A + 1, K) of one fruit over each set of axes, then along its worst axis."""
        return np.array([*(self.judge(point, views, axes)[0] for axes in sets), self.worst_axis(point, views)])


def fit_density(fruit: FruitVectors, kinds: Ints, count: int, strength: float, nuisance: F64) -> Density:
    """Return the densities of `count` kinds, each with at least one fruit.

    Args:
        fruit: the fruit.
        kinds: (N,) number of each fruit's kind.
        count: K.
        strength: see `Density`.
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
        own[kind] = (squares + strength * variance) / (strength + max(counts[kind] - 1.0, 0.0))
    own = np.sqrt(np.maximum(own, guess * _LEAST_SHARE**2)) / unit
    correlation = _correlation(residuals / unit / own[kinds], len(points) - count)
    changed = nuisance / np.outer(unit, unit)
    covariances = own[:, :, None] * correlation * own[:, None, :] + changed
    view_spread = view_spread / np.outer(unit, unit)
    return Density(unit, means / unit, covariances, counts, view_spread, float(np.median(fruit.views)), strength)


def _as_of_all(distance: float, seen: int, axes: int) -> float:
    """Return the squared distance per axis over all axes that is as rare as this one over those seen.

    A mean over few axes scatters more; by Wilson & Hilferty (1931) its cube root is normal about 1 − 2/9n, with the
    variance 2/9n.
    """
    few, all_of_them = 2.0 / (9.0 * seen), 2.0 / (9.0 * axes)
    rarity = (float(np.cbrt(distance)) - 1.0 + few) / np.sqrt(few)
    return float(max(1.0 - all_of_them + rarity * np.sqrt(all_of_them), 0.0) ** 3)


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


def _correlation(residuals: F64, freedom: int) -> F64:
    """Return the correlation within kinds (D, D), shrunk towards none."""
    if freedom < 1:
        return np.eye(residuals.shape[1])
    from sklearn.covariance import ledoit_wolf

    shrunk, _ = ledoit_wolf(residuals, assume_centered=True)
    mixed = freedom * shrunk / (np.trace(shrunk) / len(shrunk)) + _PRIOR_FRUIT * np.eye(len(shrunk))
    scale = np.sqrt(np.diag(mixed))
    return np.asarray(mixed / np.outer(scale, scale))
