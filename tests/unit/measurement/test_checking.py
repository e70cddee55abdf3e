from __future__ import annotations

import numpy as np
import pytest

from fruitgui.errors import CancelledByUserError
from fruitgui.measurement.checking import check_correction
from fruitgui.measurement.fruit import Quantity, Size
from fruitgui.measurement.references import Reference

BIAS, CHANCE = 1.08, 0.02


def _references(count: int, seed: int) -> list[Reference]:
    """Return fruit whose volume is fitted 8 % too large, give or take 2 %."""
    random = np.random.default_rng(seed)
    given = []
    for _ in range(count):
        true_m3 = float(random.uniform(1e-4, 3e-4))
        fitted_m3 = true_m3 * BIAS * float(np.exp(random.normal(0.0, CHANCE)))
        none = Quantity(0.07, 1e-3)
        size = Size(Quantity(fitted_m3, CHANCE * fitted_m3), none, none, none, 0.8)
        given.append(Reference("lemon", size, true_m3, None))
    return given


def test_a_fruit_is_corrected_by_what_the_others_teach() -> None:
    checks = check_correction(_references(12, 1))
    assert len(checks) == 12
    before = np.mean([abs(one.fitted_m3.value / one.true_m3 - 1.0) for one in checks])
    after = np.mean([abs(one.corrected_m3.value / one.true_m3 - 1.0) for one in checks])
    assert before == pytest.approx(BIAS - 1.0, abs=3 * CHANCE / np.sqrt(12))
    assert after < 2.0 * CHANCE
    held = [abs(one.corrected_m3.value - one.true_m3) < 1.96 * one.corrected_m3.std for one in checks]
    assert np.mean(held) > 0.75


def test_a_fruit_alone_of_its_kind_is_not_judged_by_itself() -> None:
    one, *others = _references(6, 2)
    alone = Reference("pear", one.size, one.volume_m3, None)
    (check,) = [each for each in check_correction([alone, *others]) if each.kind == "pear"]
    assert check.corrected_m3.value != pytest.approx(check.true_m3, rel=1e-6)


def test_weights_alone_and_single_fruit_are_no_checks() -> None:
    (one, other) = _references(2, 3)
    assert check_correction([one]) == ()
    weighed = Reference("lemon", other.size, None, 0.1)
    assert len(check_correction([one, weighed])) == 1
    with pytest.raises(CancelledByUserError):
        check_correction([one, other], lambda: True)
