from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fruitgui.classification.intervals import rate


def test_the_papers_38_of_40_hold_its_own_interval() -> None:
    found = rate(38, 40)
    assert found.value == pytest.approx(0.95)
    assert (round(found.low, 2), round(found.high, 2)) == (0.83, 0.99)


def test_no_trials_say_nothing() -> None:
    found = rate(0, 0)
    assert math.isnan(found.value)
    assert (found.low, found.high) == (0.0, 1.0)


@given(st.integers(1, 500).flatmap(lambda n: st.tuples(st.integers(0, n), st.just(n))))
def test_the_interval_holds_the_share_and_mirrors(counted: tuple[int, int]) -> None:
    successes, trials = counted
    found, mirrored = rate(successes, trials), rate(trials - successes, trials)
    assert 0.0 <= found.low <= found.value <= found.high <= 1.0
    assert found.low == pytest.approx(1.0 - mirrored.high, abs=1e-9)


@pytest.mark.parametrize("share", [0.02, 0.5, 0.99])
def test_the_interval_covers_at_least_as_often_as_it_says(share: float) -> None:
    random = np.random.default_rng(1)
    drawn = random.binomial(60, share, 2000)
    found = {int(n): rate(int(n), 60) for n in np.unique(drawn)}
    covered = np.mean([found[int(n)].low <= share <= found[int(n)].high for n in drawn])
    assert covered >= 0.95 - 3 * math.sqrt(0.05 * 0.95 / 2000)


@pytest.mark.parametrize(("successes", "trials", "confidence"), [(-1, 3, 0.95), (4, 3, 0.95), (1, 3, 1.0)])
def test_nonsense_is_refused(successes: int, trials: int, confidence: float) -> None:
    with pytest.raises(ValueError, match="no rate"):
        rate(successes, trials, confidence)
