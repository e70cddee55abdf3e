"""Which part of the belt nobody sees while sensors are away."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fruitgui.frame import F64
from fruitgui.station.live.blind import Blind, blind_part, blind_words


def box(x0: float, x1: float, y0: float, y1: float) -> F64:
    return np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]], dtype=np.float64)


LEFT_RIGHT = {"left": box(0.0, 0.8, 0.0, 0.35), "right": box(0.1, 0.9, -0.3, 0.1)}
"""The belt is 0.65 m wide; the left sensor sees the upper 0.35 m of it, both see 0.1 m in between."""


def test_what_only_the_left_one_sees_is_blind_without_it() -> None:
    blind = blind_part(LEFT_RIGHT, {"left"}, along=True)
    assert blind.sensors == ("left",)
    assert blind.lanes_m is not None
    assert np.array(blind.lanes_m) == pytest.approx(np.array([[0.40, 0.65]]), abs=0.011)
    assert blind.sides == ("left",)
    assert blind.width_m == pytest.approx(0.65)
    assert blind.loses_fruit
    text = blind_words(blind)
    assert "Sensor left gives nothing" in text
    assert "the left part of the belt (0.41–0.65 m from its right edge" in text


def test_the_right_one_likewise() -> None:
    blind = blind_part(LEFT_RIGHT, {"right"}, along=True)
    assert blind.sides == ("right",)
    assert blind.lanes_m is not None
    assert np.array(blind.lanes_m) == pytest.approx(np.array([[0.0, 0.30]]), abs=0.011)


def test_sensors_one_behind_the_other_make_up_for_each_other() -> None:
    rows = {"first": box(0.0, 0.5, 0.0, 0.6), "second": box(0.6, 1.1, 0.0, 0.6)}
    blind = blind_part(rows, {"first"}, along=True)
    assert blind.lanes_m == ()
    assert not blind.loses_fruit
    assert blind.share == pytest.approx(0.5, abs=0.01)
    assert "seen by another" in blind_words(blind)


def test_a_strip_that_shows_no_fruit_whole_does_not_count_as_seen() -> None:
    rows = {"wide": box(0.0, 0.8, 0.0, 0.6), "sliver": box(0.8, 0.85, 0.0, 0.6)}
    assert blind_part(rows, {"wide"}, along=True).sides == ("whole",)


def test_without_any_sensor_the_whole_belt_is_blind() -> None:
    blind = blind_part(LEFT_RIGHT, {"left", "right"}, along=True)
    assert blind.sides == ("whole",)
    assert blind.share == 1.0
    assert "Sensors left, right give nothing; the whole belt" in blind_words(blind)


def test_the_middle_of_three() -> None:
    side_by_side = {name: box(0.0, 0.8, 0.3 * n, 0.3 * n + 0.3) for n, name in enumerate(("a", "b", "c"))}
    assert blind_part(side_by_side, {"b"}, along=True).sides == ("middle",)
    assert blind_part(side_by_side, {"a", "c"}, along=True).sides == ("right", "left")


def test_until_the_belt_is_seen_to_run_only_a_share_can_be_told() -> None:
    blind = blind_part(LEFT_RIGHT, {"left"}, along=False)
    assert blind.lanes_m is None
    assert blind.loses_fruit
    assert "% of the belt is seen by no sensor" in blind_words(blind)


def test_nothing_is_blind_while_all_are_there_or_where_nothing_was_ever_seen() -> None:
    assert not blind_part(LEFT_RIGHT, (), along=True).loses_fruit
    nowhere = {"left": np.zeros((0, 2))}
    assert blind_part(nowhere, {"left"}, along=True) == Blind(("left",), (), 0.0, 0.0)


@given(
    st.lists(
        st.tuples(st.floats(-1, 1), st.floats(0.15, 1), st.floats(-1, 1), st.floats(0.05, 1)), min_size=1, max_size=5
    ),
    st.sets(st.integers(0, 4)),
)
def test_a_fruit_is_said_to_be_lost_exactly_where_nobody_sees_its_lane(
    boxes: list[tuple[float, float, float, float]], away: set[int]
) -> None:
    footprints = {str(n): box(x, x + long, y, y + wide) for n, (x, long, y, wide) in enumerate(boxes)}
    gone = {str(n) for n in away}
    blind = blind_part(footprints, gone, along=True)
    assert blind.lanes_m is not None
    low = min(one[0, 1] for one in footprints.values())
    for y in np.arange(low + 0.0125, low + (blind.width_m or 0.0), 0.05):
        lanes = [one for name, one in footprints.items() if one[0, 1] + 0.03 < y < one[2, 1] - 0.03]
        there = [name for name, one in footprints.items() if one[0, 1] - 0.03 < y < one[2, 1] + 0.03]
        told = any(begin + low <= y <= end + low for begin, end in blind.lanes_m)
        if lanes and all(name in gone for name in there):
            assert told
        if any(one is footprints[name] for one, name in itertools.product(lanes, set(footprints) - gone)):
            assert not told
