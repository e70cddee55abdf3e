"""From the scores of one fruit to its kind, or to `unknown`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fruitgui.classification.evidence import UNKNOWN, KindVote
from fruitgui.classification.network import log_softmax
from fruitgui.frame import F64, Ints

_PROMISE = 0.005
"""Share of trained fruit that the threshold may reject by the distribution of their held-out distances: half of the
one in a hundred that may come out unknown, as doubt rejects some too."""

_UNTESTED = 6.0
"""The threshold where no fruit could be held out."""

_DOUBT = -math.log(0.65)
"""A fruit whose best kind is less probable than this is unknown, unless trained fruit are often as doubtful."""

_STEEPNESS = 1.5
_VIEW_WEIGHTS = np.geomspace(0.05, 8.0, 23)
_FRUIT_WEIGHTS = np.concatenate([[0.0], np.geomspace(0.005, 1.0, 22)])


@dataclass(frozen=True, slots=True, eq=False)
class Scores:
    """What the parts of a model say of one fruit.

    Attributes:
        views: (K,) mean over its views of the perceptron's log-probabilities.
        fruit: (K,) log-density of the whole fruit.
        distances: (A, K) squared distance per axis, for each set of axes; last, along the worst axis.
        stranger: log-density of the nearest fruit labelled unknown; −inf without any.
    """

    views: F64
    fruit: F64
    distances: F64
    stranger: float = -math.inf


@dataclass(frozen=True, slots=True)
class Weighing:
    """How much the perceptron and the density count: the logarithm of a kind's odds is their weighted sum.

    Views of one fruit are not independent, so their log-probabilities are averaged, not added; the weight is the
    (inverse) temperature that makes the probabilities come true on fruit held out.
    """

    views: float
    fruit: float

    def log_probabilities(self, scores: Scores) -> F64:
        """Return (K,)."""
        return log_softmax(self.views * scores.views + self.fruit * scores.fruit)


def fit_weighing(scores: Sequence[Scores], kinds: Ints) -> Weighing:
    """Return weights under which the held-out fruit are probable, and which lean on both opinions.

    The truth is softened by one part in N + 2 (Platt 1999): without a mistake among N fruit, certainty is not proven.
    Many weights are as good as the best within its standard error; of those, the ones under which the lesser opinion
    counts most are taken, since either may fail where the other does not.
    """
    if len(scores) == 0 or len(scores[0].views) < 2:
        return Weighing(1.0, 0.0)
    views, fruit = np.array([s.views for s in scores]), np.array([s.fruit for s in scores])
    soft = 1.0 / (len(scores) + 2.0)
    truth = np.full(views.shape, soft / (views.shape[1] - 1))
    truth[np.arange(len(kinds)), kinds] = 1.0 - soft
    both = [a * views + _FRUIT_WEIGHTS[:, None, None] * fruit for a in _VIEW_WEIGHTS]
    losses = np.array([-(truth * log_softmax(logits)).sum(axis=2) for logits in both])
    means = losses.mean(axis=2)
    best = np.unravel_index(int(means.argmin()), means.shape)
    good = means <= means[best] + losses[best].std() / np.sqrt(len(scores))
    lesser = np.minimum(_VIEW_WEIGHTS[:, None] * _lead(views, kinds), _FRUIT_WEIGHTS * _lead(fruit, kinds))
    a, b = np.unravel_index(int(np.where(good, lesser, -np.inf).argmax()), means.shape)
    return Weighing(float(_VIEW_WEIGHTS[a]), float(_FRUIT_WEIGHTS[b]))


def _lead(opinions: F64, kinds: Ints) -> float:
    """Return by how much (N, K) opinions put the true kind before the next, in the median."""
    rows = np.arange(len(kinds))
    others = opinions.copy()
    others[rows, kinds] = -np.inf
    return max(float(np.median(opinions[rows, kinds] - others.max(axis=1))), 1e-6)


@dataclass(frozen=True, slots=True, eq=False)
class Novelty:
    """When a fruit is too far from its kind to be of it.

    The cube root of a squared distance is nearly normal (Wilson & Hilferty 1931), so few held-out fruit suffice to
    say where the rare ones lie. Each set of axes has its own centre and spread, and the worst set decides: what
    differs in colour alone is not hidden by all the shape that fits. And what lies between kinds, so that it is not
    plainly one of them, need not lie far from them to be something else: doubt adds to distance, in square.

    Attributes:
        centres: (A,) of the cube roots of trained fruit's distances.
        spreads: (A,) of the same.
        threshold: standardised distance beyond which a fruit is unknown, > 0.
        doubt: negative logarithm of the best kind's probability beyond which a fruit is unknown, > 0.
    """

    centres: F64
    spreads: F64
    threshold: float
    doubt: float

    def score(self, distances: F64, doubt: float) -> float:
        """Return how far beyond the trained kinds a fruit lies: 1 is the threshold.

        Args:
            distances: (A,) squared, to its kind.
            doubt: negative logarithm of its kind's probability.
        """
        distance = max(0.0, float(_worst(self.centres, self.spreads, distances[None, :])[0]))
        return math.hypot(distance / self.threshold, doubt / self.doubt)


def fit_novelty(own: F64, doubts: F64) -> Novelty:
    """Return the threshold that keeps the promised share of trained fruit.

    Nothing widens it: kinds left out of training lie farther off than what is met on belts, and so prove no room.

    Args:
        own: (N, L, A) distances of held-out fruit to their own kind, each in L lights.
        doubts: (N,) doubts of the held-out fruit that got their kind.
    """
    from scipy.stats import t as student

    fruit, sets = len(own), own.shape[-1]
    doubt = max(_DOUBT, 1.25 * float(np.quantile(doubts, 0.99))) if len(doubts) else _DOUBT
    if fruit == 0:
        return Novelty(np.full(sets, 1.0), np.full(sets, 0.5), _UNTESTED, doubt)
    roots = np.cbrt(own.reshape(-1, sets))
    centres = np.median(roots, axis=0)
    upper = np.sqrt(np.mean(np.maximum(roots - centres, 0.0) ** 2, axis=0) * 2.0)
    spreads = np.maximum(np.maximum(upper, roots.std(axis=0)), 0.02 * np.maximum(centres, 0.1))
    worst = _worst(centres, spreads, own.reshape(-1, sets))
    reach = float(student.ppf(1.0 - _PROMISE, max(fruit - 1, 2))) * math.sqrt(1.0 + 1.0 / fruit)
    needed = max(float(worst.mean()) + reach * max(float(worst.std()), 0.5), 2.5)
    return Novelty(centres, spreads, needed, doubt)


def _worst(centres: F64, spreads: F64, distances: F64) -> F64:
    return np.asarray(((np.cbrt(distances) - centres) / spreads).max(axis=1))


def decide(kinds: tuple[str, ...], scores: Scores, weighing: Weighing, novelty: Novelty) -> KindVote:
    """Return the kind of one fruit: the most probable one, unless the fruit is too far from it."""
    logs = weighing.log_probabilities(scores)
    best = int(logs.argmax())
    score = novelty.score(scores.distances[:, best], -float(logs[best]))
    if scores.stranger > scores.fruit[best]:
        score = max(score, 1.0 + min((scores.stranger - scores.fruit[best]) / 10.0, 1.0))
    excess = _STEEPNESS * novelty.threshold * (score - 1.0)
    unknown = 0.5 * (1.0 + math.tanh(0.5 * excess))
    probabilities = {kind: float((1.0 - unknown) * np.exp(log)) for kind, log in zip(kinds, logs, strict=True)}
    probabilities[UNKNOWN] = unknown
    kind = UNKNOWN if score > 1.0 else kinds[best]
    return KindVote(kind, probabilities[kind], probabilities, score)
