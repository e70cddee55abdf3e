from __future__ import annotations

import numpy as np
import pytest

from fruitgui.classification.asking import most_telling, uncertainty
from fruitgui.classification.evidence import KindVote


def _vote(**shares: float) -> KindVote:
    kind = max(shares, key=lambda one: shares[one])
    return KindVote(kind, shares[kind], shares)


def test_uncertainty_grows_from_one_sure_kind_to_all_alike() -> None:
    sure, leaning, open_ = _vote(a=1.0, b=0.0), _vote(a=0.8, b=0.2), _vote(a=0.5, b=0.5)
    assert uncertainty(sure) == 0.0
    assert uncertainty(sure) < uncertainty(leaning) < uncertainty(open_)
    assert uncertainty(open_) == pytest.approx(1.0)


def test_fruit_that_look_the_same_are_not_asked_about_one_after_the_other() -> None:
    chance = np.random.default_rng(0)
    twins = np.array([5.0, 5.0]) + chance.normal(scale=0.01, size=(6, 2))
    others = chance.normal(size=(20, 2))
    uncertain = [0.9] * 6 + [0.5] * 20
    order = most_telling(uncertain, np.vstack([twins, others]), 10)
    assert order[0] < 6, "the most uncertain comes first"
    assert sum(row < 6 for row in order) == 1, "one of the twins says it all"
    assert len(set(order)) == 10


def test_what_was_not_measured_does_not_matter() -> None:
    points = np.array([[1.0, np.nan], [2.0, np.nan], [9.0, 4.0]])
    assert sorted(most_telling([0.1, 0.2, 0.3], points, 9)) == [0, 1, 2]
    assert most_telling([], np.zeros((0, 3)), 4) == []
