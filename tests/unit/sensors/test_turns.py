from __future__ import annotations

import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fruitgui.sensors.turns import Schedule, turns

IDS = ["a", "b", "c", "d", "e", "f", "g", "h"]
PAIRS = list(itertools.combinations(IDS, 2))


@given(overlaps=st.sets(st.sampled_from(PAIRS)), count=st.integers(0, 8))
def test_no_two_that_overlap_share_a_slot_and_each_has_one_turn(overlaps: set[tuple[str, str]], count: int) -> None:
    sensors = IDS[:count]
    among = [pair for pair in overlaps if set(pair) <= set(sensors)]
    schedule = turns(sensors, among, 0.1)
    assert sorted(itertools.chain(*schedule.slots)) == sensors
    for slot in schedule.slots:
        assert slot
        assert not any(set(pair) <= set(slot) for pair in among)
    degree = max((sum(sensor in pair for pair in among) for sensor in sensors), default=0)
    assert len(schedule.slots) <= degree + 1


@pytest.mark.parametrize(
    ("overlaps", "slots"),
    [
        ([], 1),
        ([("a", "b")], 2),
        (list(itertools.pairwise(IDS)), 2),
        ([*itertools.pairwise(IDS), ("h", "a")], 2),
        ([*itertools.pairwise(IDS[:5]), ("e", "a")], 3),
        (PAIRS, 8),
        (None, 8),
    ],
)
def test_chains_and_even_rings_take_two_slots(overlaps: list[tuple[str, str]] | None, slots: int) -> None:
    assert len(turns(IDS, overlaps, 0.1).slots) == slots


def test_before_overlap_is_known_each_is_alone() -> None:
    assert turns(["b", "a"], None, 0.1).slots == (("b",), ("a",))


def test_rate_and_belt_speed() -> None:
    """Two opposed sensors, a capture each 0.1 s, 0.6 m of belt in view: five captures a second of each."""
    schedule = turns(["a", "b"], [("a", "b")], 0.1)
    assert schedule.rate_hz == pytest.approx(5.0)
    assert schedule.highest_belt_speed_m_s(0.6) == pytest.approx(1.0)
    assert schedule.highest_belt_speed_m_s(-1.0) == 0.0


@given(
    speed_part=st.floats(0.2, 1.0), enters_s=st.floats(0, 10), slots=st.integers(1, 5), length_m=st.floats(0.1, 2.0),
    sensor=st.integers(0, 4),
)  # fmt: skip
def test_at_the_highest_speed_every_fruit_is_seen_three_times(
    speed_part: float, enters_s: float, slots: int, length_m: float, sensor: int
) -> None:
    schedule = turns(IDS[:slots], None, 0.1)
    one = IDS[sensor % slots]
    stay_s = length_m / (schedule.highest_belt_speed_m_s(length_m) * speed_part) + 1e-6
    seen, time_s = 0, schedule.next_turn_s(one, enters_s)
    while time_s <= enters_s + stay_s:
        seen += 1
        time_s = schedule.next_turn_s(one, time_s + schedule.cycle_s / 2)
    assert seen >= 3


@given(time_s=st.floats(0, 1e4), slots=st.integers(1, 8))
def test_the_next_turn_is_that_sensors_own(time_s: float, slots: int) -> None:
    schedule = turns(IDS[:slots], None, 0.1)
    for sensor in IDS[:slots]:
        turn_s = schedule.next_turn_s(sensor, time_s)
        assert time_s - 1e-9 <= turn_s <= time_s + schedule.cycle_s + 1e-9
        assert sensor in schedule.sensors_at(turn_s + 0.05)


def test_no_sensors_have_no_turns() -> None:
    schedule = turns([], [], 0.1)
    assert schedule == Schedule((), 0.1)
    assert (schedule.rate_hz, schedule.cycle_s, schedule.sensors_at(1.0)) == (0.0, 0.0, ())
    assert schedule.highest_belt_speed_m_s(1.0) == 0.0
    with pytest.raises(KeyError):
        schedule.next_turn_s("a", 0.0)


@pytest.mark.parametrize(
    ("sensors", "overlaps", "period_s"),
    [
        (["a"], None, 0.0),
        (["a"], None, float("nan")),
        (["a", "a"], None, 0.1),
        (["a"], [("a", "z")], 0.1),
        (["a"], [("a", "a")], 0.1),
    ],
)
def test_plans_that_make_no_sense(sensors: list[str], overlaps: list[tuple[str, str]] | None, period_s: float) -> None:
    with pytest.raises(ValueError, match=r"period|twice|pair"):
        turns(sensors, overlaps, period_s)
