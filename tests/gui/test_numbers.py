from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtCore import QLocale

from fruitgui.gui.numbers import (
    count_text,
    decimals_for,
    measured_text,
    number_text,
    percent_text,
    shares_text,
)
from fruitgui.gui.widgets.histogram import ticks


@pytest.fixture(autouse=True)
def english() -> None:
    QLocale.setDefault(QLocale("en"))


def test_thousands_stand_apart_by_a_narrow_space() -> None:
    assert count_text(1248) == "1\u202f248"
    assert count_text(7) == "7"


@pytest.mark.parametrize(("std", "decimals"), [(0.04, 2), (0.012, 3), (2.0, 1), (4.0, 0), (40.0, 0), (0.0, 1)])
def test_no_more_digits_are_shown_than_are_known(std: float, decimals: int) -> None:
    assert decimals_for(std) == decimals


@pytest.mark.parametrize(
    ("value", "std", "text"),
    [(112.3, 2.1, "112 ± 4\u2009ml"), (98.26, 0.5, "98.3 ± 1.0\u2009ml"), (250.0, 0.001, "250.0 ± 0.0\u2009ml")],
)
def test_measured_values_carry_half_their_interval(value: float, std: float, text: str) -> None:
    assert measured_text(value, std, "ml") == text


def test_numbers_follow_the_window_s_language() -> None:
    QLocale.setDefault(QLocale("es"))
    assert number_text(98.26, 1) == "98,3"
    QLocale.setDefault(QLocale("en"))
    assert number_text(1234.5, 1) == "1234.5"


@pytest.mark.parametrize(("share", "text"), [(1.0, "100\u2009%"), (0.9999, "99\u2009%"), (0.5, "50\u2009%")])
def test_only_what_is_certain_is_a_hundred_per_cent(share: float, text: str) -> None:
    assert percent_text(share) == text


@given(st.lists(st.integers(0, 5000), min_size=1, max_size=12))
def test_shares_sum_to_the_whole_and_no_part_is_it(counts: list[int]) -> None:
    shares = [float(text.split()[0]) for text in shares_text(counts)]
    assert sum(shares) == pytest.approx(100.0 if sum(counts) else 0.0)
    for share, count in zip(shares, counts, strict=True):
        assert (share > 0.0) == (count > 0)
        assert (share == 100.0) == (0 < count == sum(counts))
        assert share == pytest.approx(100 * count / max(sum(counts), 1), abs=0.1 * len(counts))


def test_what_is_nearly_all_is_not_all() -> None:
    assert shares_text([9996, 4]) == ["99.9\u2009%", "0.1\u2009%"]
    assert shares_text([1, 1, 1]) == ["33.4\u2009%", "33.3\u2009%", "33.3\u2009%"]


@given(st.floats(-1e6, 1e6), st.floats(1e-3, 1e6))
def test_ticks_are_few_round_and_inside(low: float, width: float) -> None:
    high = low + width
    marks = ticks(low, high)
    assert len(marks) <= 7
    assert all(low < mark < high for mark in marks)
    if len(marks) > 1:
        step = marks[1] - marks[0]
        leading = step / 10.0 ** math.floor(math.log10(step) + 1e-9)
        assert any(abs(leading - one) < 1e-3 for one in (1, 2, 5, 10))
