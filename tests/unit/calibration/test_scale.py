"""Whether two sensors see things equally far apart: told where it is clear, and not where chance would do it."""

from __future__ import annotations

import numpy as np
import pytest

from fruitgui.calibration.scale import Scale, scale_between

OFF_M = 0.004
"""How far a top is seen from where another sensor sees it."""


def _seen(rng: np.random.Generator, things: int, within_m: float, ratio: float) -> Scale:
    tops_m = rng.uniform(-within_m / 2, within_m / 2, (things, 2))
    source_m = tops_m + rng.normal(0.0, OFF_M / 2**0.5, tops_m.shape)
    target_m = ratio * tops_m + rng.normal(0.0, OFF_M / 2**0.5, tops_m.shape)
    return scale_between(source_m, target_m)


@pytest.mark.parametrize(("things", "within_m"), [(5, 0.15), (6, 0.3), (12, 0.5), (25, 0.9)])
def test_sensors_that_agree_are_not_doubted_however_little_they_share(things: int, within_m: float) -> None:
    rng = np.random.default_rng(things)
    found = [_seen(rng, things, within_m, 1.0) for _ in range(400)]
    assert np.mean([one.doubtful for one in found]) < 0.03
    off = np.array([(one.value - 1.0) / one.std for one in found])
    assert 0.85 < np.median(np.abs(off)) / 0.6745 < 1.35


@pytest.mark.parametrize("ratio", [0.975, 1.025])
def test_sensors_that_differ_are_doubted_where_they_share_much(ratio: float) -> None:
    rng = np.random.default_rng(1)
    found = [_seen(rng, 20, 0.8, ratio) for _ in range(100)]
    assert np.mean([one.doubtful for one in found]) > 0.97
    assert np.median([one.value for one in found]) == pytest.approx(ratio, abs=0.001)


def test_a_few_things_say_nothing() -> None:
    few_m = np.eye(3)[:, :2]
    assert not scale_between(few_m, 2.0 * few_m).doubtful
