"""From when on lost pictures matter: as soon as a fruit may pass that a sensor sees fewer than three times."""

from __future__ import annotations

from collections.abc import Sequence
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fruitgui.frame import F64
from fruitgui.sensors.turns import VIEWS_NEEDED
from fruitgui.station.live.above import FromAbove
from fruitgui.station.live.sparse import KNOWN_TO, QUIET_S, SparseWatch, mean_way_m
from fruitgui.station.turn_plan import WHOLE_FRUIT_M
from tests.unit.station.test_blind import LEFT_RIGHT, box

WAY_M = 0.8
TWICE = {"left": box(0.0, WAY_M, 0.0, 0.4), "right": box(0.1, 0.1 + WAY_M, 0.0, 0.4)}
SPEED_M_S = 0.5
PASSING_S = KNOWN_TO * (WAY_M - WHOLE_FRUIT_M) / SPEED_M_S


class Watched:
    """A watch over two sensors, and what was said."""

    def __init__(self, footprints_m: dict[str, F64] = LEFT_RIGHT) -> None:
        self.said: list[tuple[str, tuple[str, ...]]] = []
        above = cast("FromAbove", SimpleNamespace(footprints_m=footprints_m, along=True))
        self.watch = SparseWatch(footprints_m, above, lambda code, _, sensors: self.said.append((code, sensors)))
        self.absences = dict.fromkeys(footprints_m, 0)

    def see(self, name: str, times_s: Sequence[float], speed_m_s: float = SPEED_M_S) -> None:
        for time_s in times_s:
            self.watch.see(name, time_s, np.array([0.0, speed_m_s, 0.0]), self.absences)


def _frames_seen(entered_s: float, times_s: Sequence[float]) -> int:
    """Return how many frames were taken while a fruit was whole in view."""
    return sum(entered_s < time_s < entered_s + PASSING_S for time_s in times_s)


@given(st.lists(st.floats(0.02, 1.2), min_size=4, max_size=25))
def test_it_is_said_just_where_a_fruit_may_be_seen_too_seldom(between_s: list[float]) -> None:
    times_s = np.cumsum(between_s).tolist()
    watched = Watched()
    watched.see("left", times_s)
    # a fruit that came just after any of the frames, and left before the last one
    entries = [one + 1e-6 for one in times_s if one + PASSING_S + 1e-6 < times_s[-1]]
    seldom = any(_frames_seen(entry, times_s) < VIEWS_NEEDED for entry in entries)
    assert bool(watched.said) >= seldom
    most_s = max(times_s[n + VIEWS_NEEDED] - times_s[n] for n in range(len(times_s) - VIEWS_NEEDED))
    if watched.said:
        assert most_s > PASSING_S


def test_a_belt_half_as_fast_needs_half_as_many_pictures() -> None:
    every_s = 0.9 * PASSING_S / VIEWS_NEEDED
    enough, fast, slow = Watched(), Watched(), Watched()
    enough.see("left", [n * every_s for n in range(9)])
    fast.see("left", [n * every_s for n in range(9)], 2.0 * SPEED_M_S)
    slow.see("left", [2.0 * n * every_s for n in range(9)], 0.5 * SPEED_M_S)
    standing = Watched()
    standing.see("left", [60.0 * n for n in range(9)], 0.0)
    assert [bool(one.said) for one in (enough, fast, slow, standing)] == [False, True, False, False]


def test_one_that_others_see_as_well_costs_no_fruit_and_one_alone_does() -> None:
    for footprints_m, code, loses_fruit in ((TWICE, "sensor_sparse", False), (LEFT_RIGHT, "part_sparse", True)):
        watched = Watched(footprints_m)
        watched.see("right", [n / 30.0 for n in range(60)])
        watched.see("left", [n * PASSING_S for n in range(6)])
        assert watched.said == [(code, ("left",))], "once"
        now = watched.watch.now()
        assert now is not None
        assert (now.sensors, now.loses_fruit) == (("left",), loses_fruit)
        without = watched.watch.now(("right",))
        assert without is not None
        assert without.loses_fruit, "the other one is away"
        assert watched.watch.now(("left",)) is None, "one that is away is another matter"


def test_it_holds_until_all_was_well_for_a_while_and_is_said_anew_then() -> None:
    watched = Watched()
    watched.see("left", [n * PASSING_S for n in range(5)])
    well_s = [4 * PASSING_S + n / 30.0 for n in range(1, round(30 * QUIET_S) + 6)]
    watched.see("left", well_s[: len(well_s) // 2])
    assert watched.watch.now() is not None
    watched.see("left", well_s[len(well_s) // 2 :])
    assert watched.watch.now() is None
    watched.see("left", [well_s[-1] + n * PASSING_S for n in range(1, 5)])
    assert watched.said == 2 * [("part_sparse", ("left",))]


def test_what_came_before_a_sensor_was_away_says_nothing_of_what_comes_after() -> None:
    watched = Watched()
    watched.see("left", [n / 30.0 for n in range(30)])
    watched.absences["left"] += 1
    watched.see("left", [60.0 + n / 30.0 for n in range(30)])
    assert watched.said == []


@pytest.mark.parametrize(
    ("footprint_m", "way_m"),
    [
        (box(0.0, 0.8, -0.2, 0.3), 0.8),
        (np.array([[0.0, 0.0], [0.6, 0.0], [0.8, 0.4], [0.0, 0.4]]), 0.7),
        (np.zeros((0, 2)), 0.0),
        (np.array([[0.0, 0.1], [0.4, 0.1], [0.8, 0.1]]), 0.0),
    ],
)
def test_the_way_of_a_fruit_through_a_view_is_the_mean_of_its_lanes(footprint_m: F64, way_m: float) -> None:
    assert mean_way_m(footprint_m) == pytest.approx(way_m)
