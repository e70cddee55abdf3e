from __future__ import annotations

import pytest

from fruitgui.classification.comparing import Verdict, compare


def test_a_difference_that_chance_makes_easily_is_none() -> None:
    both = compare([True] * 18 + [False] * 2, [True] * 16 + [False] * 2 + [True] * 2)
    assert (both.right, both.other_right, both.only, both.only_other) == (18, 18, 2, 2)
    assert both.chance == 1.0
    assert both.verdict is Verdict.ALIKE
    few = compare([True] * 5, [False] * 5)
    assert few.chance == pytest.approx(2 * 0.5**5)
    assert few.verdict is Verdict.ALIKE, "five fruit prove nothing"


def test_a_clear_difference_is_said_either_way() -> None:
    good, bad = [True] * 20, [True] * 10 + [False] * 10
    assert compare(good, bad).verdict is Verdict.BETTER
    assert compare(bad, good).verdict is Verdict.WORSE
    assert compare(good, bad).chance == pytest.approx(2 * 0.5**10)


def test_models_that_always_agree_are_alike() -> None:
    both = compare([True, False], [True, False])
    assert both.chance == 1.0
    assert compare([], []).verdict is Verdict.ALIKE
    with pytest.raises(ValueError, match=r"shorter|longer"):
        compare([True], [])
