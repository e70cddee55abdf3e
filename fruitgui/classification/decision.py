"""From the scores of one fruit to its kind, or to `unknown`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fruitgui.classification.evidence import UNKNOWN, KindVote
from fruitgui.classification.network import log_softmax
from fruitgui.frame import F64, Ints

_PROMISE = 0.0005
"""Share of trained fruit that the threshold may reject by the distribution of their held-out distances: a twentieth of
the one in a hundred that may come out unknown, as tails are heavier than a dozen fruit of a kind show."""

_UNTESTED = 6.0
"""The threshold where no fruit could be held out."""

_USUAL_SPREAD = 0.1
_PRIOR_FRUIT = 3
"""The spread of cube roots of distances, and the fruit it weighs: few held-out fruit may lie together by chance."""

_CENTRE_FRUIT = 5.0
_SPREAD_FRUIT = 10.0
"""The fruit that all kinds together weigh in the centre and the spread of one. Centres of kinds differed by half of
what fruit of a kind do (0.05 beside 0.11), which is worth five fruit; spreads by a quarter, which is worth ten."""

_MAD_TO_DEVIATION = 1.4826
_STEEPNESS = 1.5
_VIEW_WEIGHTS = np.geomspace(0.05, 8.0, 23)
_FRUIT_WEIGHTS = np.concatenate([[0.0], np.geomspace(0.005, 1.0, 22)])


@dataclass(frozen=True, slots=True, eq=False)
class Scores:
    """What the parts of a model say of one fruit.

    Attributes:
        views: (K,) mean over its views of the perceptron's log-probabilities.
        fruit: (K,) log-density of the whole fruit.
        distances: (K,) squared distance per axis.
        measured: share of the axes that were measured.
        stranger: log-density of all fruit labelled unknown, each counting as much as a kind; −inf without any.
    """

    views: F64
    fruit: F64
    distances: F64
    measured: float = 1.0
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
    say where the rare ones lie. A mean over few axes scatters more, by the root of their number.

    Attributes:
        centres: (K,) of the cube roots of each kind's distances.
        spreads: (K,) of the same, > 0.
        thresholds: (K,) standardised distance beyond which a fruit of the kind is unknown, > 0.
    """

    centres: F64
    spreads: F64
    thresholds: F64

    def score(self, kind: int, distance: float, measured: float = 1.0) -> float:
        """Return how far beyond a kind a fruit lies: 1 is the threshold.

        Args:
            kind: its number.
            distance: squared, per axis.
            measured: share of the axes that were measured.
        """
        beyond = max(0.0, (math.cbrt(distance) - float(self.centres[kind])) / float(self.spreads[kind]))
        return beyond * math.sqrt(measured) / float(self.thresholds[kind])


def fit_novelty(own: F64, kinds: Ints, count: int) -> Novelty:
    """Return the thresholds that keep the promised share of each kind's fruit.

    Kinds differ in how far their own fruit lie from them: blotched ones farther, plain ones nearer. A kind's mean and
    variance are drawn towards those of all kinds (normal with an inverse gamma's prior, Gelman et al. 2013, 3.3), and
    its next fruit is judged by the Student's distribution that follows.

    Nothing widens them: kinds left out of training lie farther off than what is met on belts, and so prove no room. Nor
    does an odd fruit among the trained ones (spoiled, or labelled by mistake): what is far out counts as three spreads.

    Args:
        own: (N,) squared distances of held-out fruit to their own kind.
        kinds: (N,) number of the kind of each.
        count: K; a kind of which none was held out is taken to be like the others.
    """
    from scipy.stats import t as student

    if len(own) == 0:
        return Novelty(np.ones(count), np.full(count, _USUAL_SPREAD), np.full(count, _UNTESTED))
    members = [np.flatnonzero(kinds == kind) for kind in range(count)]
    fruit = np.array([len(rows) for rows in members])
    roots = _tamed(np.cbrt(own), members)
    seen = fruit > 0
    means = np.array([roots[rows].mean() if len(rows) else 0.0 for rows in members])
    squares = np.array([np.sum((roots[rows] - mean) ** 2) for rows, mean in zip(members, means, strict=True)])
    freedom = int(fruit.sum() - seen.sum()) + _PRIOR_FRUIT
    common = float(squares.sum() + _PRIOR_FRUIT * _USUAL_SPREAD**2) / freedom
    centre = float(means[seen].mean())
    centres = (fruit * means + _CENTRE_FRUIT * centre) / (fruit + _CENTRE_FRUIT)
    squares += np.where(seen, fruit * _CENTRE_FRUIT / (fruit + _CENTRE_FRUIT) * (means - centre) ** 2, 0.0)
    spreads = np.sqrt((squares + _SPREAD_FRUIT * common) / (fruit + _SPREAD_FRUIT))
    rare = student.ppf(1.0 - _PROMISE, fruit + _SPREAD_FRUIT)
    return Novelty(centres, spreads, np.asarray(rare * np.sqrt(1.0 + 1.0 / (fruit + _CENTRE_FRUIT))))


def _tamed(roots: F64, members: Sequence[Ints]) -> F64:
    """Return the roots (N,) with what lies far above its kind's middle taken as three spreads above it."""
    usual, middles = float(np.median(roots)), np.empty(len(roots))
    for rows in members:
        if len(rows):
            share = len(rows) / (len(rows) + _CENTRE_FRUIT)
            middles[rows] = share * float(np.median(roots[rows])) + (1.0 - share) * usual
    deviation = _MAD_TO_DEVIATION * float(np.median(np.abs(roots - middles)))
    return np.asarray(np.minimum(roots, middles + 3.0 * deviation))


def decide(kinds: tuple[str, ...], scores: Scores, weighing: Weighing, novelty: Novelty) -> KindVote:
    """Return the kind of one fruit: the most probable one, unless the fruit is too far from it."""
    logs = weighing.log_probabilities(scores)
    best = int(logs.argmax())
    score = novelty.score(best, float(scores.distances[best]), scores.measured)
    if scores.stranger > scores.fruit[best]:
        score = max(score, 1.0 + min((scores.stranger - scores.fruit[best]) / 10.0, 1.0))
    excess = _STEEPNESS * float(novelty.thresholds[best]) * (score - 1.0)
    unknown = 0.5 * (1.0 + math.tanh(0.5 * excess))
    probabilities = {kind: float((1.0 - unknown) * np.exp(log)) for kind, log in zip(kinds, logs, strict=True)}
    probabilities[UNKNOWN] = unknown
    kind = UNKNOWN if score > 1.0 else kinds[best]
    return KindVote(kind, probabilities[kind], probabilities)
