"""Where a kind ends: by its own held-out fruit, drawn towards those of all kinds."""

from __future__ import annotations

import numpy as np

from fruitgui.classification.decision import Novelty, fit_novelty
from fruitgui.classification.evidence import LabelledFruit
from fruitgui.classification.training import train
from fruitgui.frame import F64
from tests.unit.classification.orchard import NAMES, Orchard

PLAIN, BLOTCHED = (0.6, 0.08), (0.75, 0.14)
"""Centre and spread of the cube roots of distances, as held-out lemons and striped apples had them."""


def _distances(centre: float, spread: float, fruit: int, random: np.random.Generator) -> F64:
    return np.asarray((centre + spread * random.standard_normal(fruit)) ** 3)


def _fitted(random: np.random.Generator, each: int) -> Novelty:
    own = [_distances(*PLAIN, each, random), _distances(*BLOTCHED, each, random), _distances(*PLAIN, each, random)]
    return fit_novelty(np.concatenate(own), np.repeat(np.arange(3), each), 3)


def _ends(novelty: Novelty) -> F64:
    """Return the cube root of the distance at which each kind ends."""
    return novelty.centres + novelty.spreads * novelty.thresholds


def test_a_kind_that_varies_more_ends_farther_out() -> None:
    for seed in range(20):
        ends = _ends(_fitted(np.random.default_rng(seed), each=12))
        assert ends[1] > ends[[0, 2]].max()


def test_hardly_a_fruit_is_beyond_its_kinds_end() -> None:
    """Twelve fruit of each kind promise one in two thousand; of those yet to come fewer than one in 300 are refused."""
    random = np.random.default_rng(1)
    beyond = []
    for _ in range(100):
        novelty = _fitted(random, each=12)
        for kind, (centre, spread) in enumerate((PLAIN, BLOTCHED)):
            beyond += [novelty.score(kind, one) > 1.0 for one in _distances(centre, spread, 100, random)]
    assert np.mean(beyond) < 1 / 300


def test_many_fruit_of_a_kind_speak_for_themselves() -> None:
    ends = _ends(_fitted(np.random.default_rng(2), each=2000))
    # One in two thousand of a normal distribution lies beyond 3.29 spreads.
    wanted = [centre + 3.29 * spread for centre, spread in (PLAIN, BLOTCHED, PLAIN)]
    assert np.allclose(ends, wanted, atol=0.02)


def test_an_odd_fruit_does_not_open_its_kind() -> None:
    random = np.random.default_rng(3)
    own, kinds = np.concatenate([_distances(*PLAIN, 12, random) for _ in range(3)]), np.repeat(np.arange(3), 12)
    before = _ends(fit_novelty(own, kinds, 3))
    own[own[:12].argmin()] = 1.66**3
    after = _ends(fit_novelty(own, kinds, 3))
    assert before[0] < after[0] < before[0] + 0.2
    assert np.abs(after[1:] - before[1:]).max() < 0.05


def test_a_kind_without_held_out_fruit_is_like_the_others() -> None:
    random = np.random.default_rng(4)
    novelty = fit_novelty(_distances(*PLAIN, 24, random), np.repeat([0, 2], 12), 3)
    ends = _ends(novelty)
    assert ends[[0, 2]].min() - 0.05 < ends[1] < ends[[0, 2]].max() + 0.2
    assert _ends(fit_novelty(np.zeros(0), np.zeros(0, dtype=np.intp), 2)).shape == (2,)


def test_what_goes_together_in_one_kind_alone_is_learned() -> None:
    """A striped kind: ten features move together from fruit to fruit. Others move alone, and so far are strangers."""
    random = np.random.default_rng(5)
    orchard = Orchard.planted(kinds=3, apart=12.0, seed=6)
    stripes = np.zeros(orchard.means.shape[1])
    stripes[:10] = 1.0

    def striped(evidence: LabelledFruit) -> LabelledFruit:
        if evidence.kind != "kind 0":
            return evidence
        moved = evidence.evidence.view_features + stripes * 2.5 * random.standard_normal()
        return LabelledFruit(
            evidence.fruit_id,
            evidence.kind,
            type(evidence.evidence)(moved.astype(np.float32), evidence.evidence.fruit_features),
        )

    model = train([striped(one) for one in orchard.harvest(each=20, views=8, seed=7)], NAMES, seed=1).model
    own = model.core.density.covariances[0][:10, :10]
    other = model.core.density.covariances[1][:10, :10]

    def together(covariance: F64) -> float:
        scale = np.sqrt(np.diag(covariance))
        return float((covariance / np.outer(scale, scale))[~np.eye(10, dtype=bool)].mean())

    assert together(own) > together(other) + 0.2
