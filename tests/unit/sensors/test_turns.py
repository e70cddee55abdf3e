from __future__ import annotations

import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fruitgui.sensors.sensor import Projector, SensorInfo
from fruitgui.sensors.turns import Light, Schedule, Settling, lights_of, turns
from tests.unit.sensors.scripted import CAMERA

IDS = ["a", "b", "c", "d", "e", "f", "g", "h"]
PAIRS = list(itertools.combinations(IDS, 2))
KINECT = Light(1 / 30)


def lights(sensors: list[str]) -> dict[str, Light]:
    return dict.fromkeys(sensors, KINECT)


@given(overlaps=st.sets(st.sampled_from(PAIRS)), count=st.integers(0, 8))
def test_no_two_that_overlap_share_a_slot_and_each_that_overlaps_has_one_turn(
    overlaps: set[tuple[str, str]], count: int
) -> None:
    sensors = IDS[:count]
    among = [pair for pair in overlaps if set(pair) <= set(sensors)]
    schedule = turns(lights(sensors), among)
    assert sorted(itertools.chain(*schedule.slots)) == [one for one in sensors if any(one in pair for pair in among)]
    for slot in schedule.slots:
        assert slot
        assert not any(set(pair) <= set(slot) for pair in among)
    degree = max((sum(sensor in pair for pair in among) for sensor in sensors), default=0)
    assert len(schedule.slots) <= degree + 1


@pytest.mark.parametrize(
    ("overlaps", "slots"),
    [
        ([], 0),
        ([("a", "b")], 2),
        (list(itertools.pairwise(IDS)), 2),
        ([*itertools.pairwise(IDS), ("h", "a")], 2),
        ([*itertools.pairwise(IDS[:5]), ("e", "a")], 3),
        (PAIRS, 8),
        (None, 8),
    ],
)
def test_chains_and_even_rings_take_two_slots(overlaps: list[tuple[str, str]] | None, slots: int) -> None:
    assert len(turns(lights(IDS), overlaps).slots) == slots


def test_before_overlap_is_known_each_is_alone() -> None:
    assert turns(lights(["b", "a"]), None).slots == (("b",), ("a",))


def test_a_single_sensor_and_one_that_overlaps_with_none_are_never_dark() -> None:
    assert not turns(lights(["a"]), None).alternates("a")
    schedule = turns(lights(["a", "b", "c"]), [("a", "b")])
    assert [schedule.alternates(one) for one in "abc"] == [True, True, False]
    assert schedule.rate_hz("c", 30.0) == 30.0


def test_rate_of_two_kinects_that_settle_as_usual() -> None:
    """20 ms to switch, 150 ms to settle, three frames of 33 ms: 270 ms a turn, 540 ms a round, 5.6 frames a second."""
    schedule = turns(lights(["a", "b"]), [("a", "b")])
    assert schedule.cycle_s == pytest.approx(0.54)
    assert schedule.rate_hz("a", 30.0) == pytest.approx(3 / 0.54)
    assert schedule.longest_wait_s("a", 30.0) == pytest.approx(0.54)


def test_whichever_takes_longer_is_waited_for() -> None:
    by_time, by_frames = (Light(0.1, settling, 0.0) for settling in (Settling(0.5, 3), Settling(0.1, 3)))
    assert by_time.turn_s(1) == pytest.approx(0.6)
    assert by_frames.turn_s(1) == pytest.approx(0.4)


@given(
    sensors=st.integers(2, 5), views=st.integers(1, 5), settle_s=st.floats(0.0, 1.0), hz=st.floats(2.0, 60.0),
    phase=st.floats(0.0, 1.0), one=st.integers(0, 4),
)  # fmt: skip
def test_within_the_longest_wait_every_fruit_is_seen_three_times(
    sensors: int, views: int, settle_s: float, hz: float, phase: float, one: int
) -> None:
    """The captures of the plan, laid out in time, whenever a fruit comes into view."""
    light = Light(1 / hz, Settling(settle_s, 2), 0.01)
    schedule = turns(dict.fromkeys(IDS[:sensors], light), None, views)
    slot, turn_s = one % sensors, light.turn_s(views)
    captures_s = [
        (cycle * sensors + slot + 1) * turn_s - left / hz for cycle in range(9) for left in reversed(range(views))
    ]
    enters_s = phase * schedule.cycle_s + schedule.cycle_s
    leaves_s = enters_s + schedule.longest_wait_s(IDS[slot], hz)
    assert sum(enters_s < at <= leaves_s + 1e-9 for at in captures_s) >= 3


@given(sensors=st.integers(2, 4), views=st.integers(1, 5))
def test_no_shorter_wait_would_do(sensors: int, views: int) -> None:
    light = Light(1 / 30)
    schedule = turns(dict.fromkeys(IDS[:sensors], light), None, views)
    captures_s = [
        (cycle * sensors + 1) * light.turn_s(views) - left / 30 for cycle in range(9) for left in reversed(range(views))
    ]
    wait_s = schedule.longest_wait_s("a", 30.0)
    worst = min(sum(after < at < after + wait_s - 1e-6 for at in captures_s) for after in captures_s[: 3 * views])
    assert worst == 2


def test_no_sensors_have_no_turns() -> None:
    schedule = turns({}, [])
    assert schedule == Schedule()
    assert (schedule.slots, schedule.cycle_s, schedule.alternates("a")) == ((), 0.0, False)


@pytest.mark.parametrize(
    ("light", "overlaps", "views"),
    [
        (Light(0.0), None, 3),
        (Light(float("nan")), None, 3),
        (KINECT, None, 0),
        (KINECT, [("a", "z")], 3),
        (KINECT, [("a", "a")], 3),
    ],
)
def test_plans_that_make_no_sense(light: Light, overlaps: list[tuple[str, str]] | None, views: int) -> None:
    with pytest.raises(ValueError, match=r"positive|pair"):
        turns({"a": light, "b": light}, overlaps, views)


def test_only_sensors_that_blind_others_and_can_be_switched_take_turns() -> None:
    infos = [
        SensorInfo(name, "", "", f"S{name}", CAMERA, hz, projector)
        for name, hz, projector in (
            ("a", 30.0, Projector.SWITCHED), ("b", 0.0, Projector.SWITCHED),
            ("c", 30.0, Projector.HARMLESS), ("d", 30.0, Projector.FIXED),
        )
    ]  # fmt: skip
    measured = Settling(0.4, 9)
    found = lights_of(infos, {"Sb": measured})
    assert list(found) == ["a", "b"]
    assert found["a"].settling == Settling(0.150, 3)
    assert found["b"] == Light(1 / 30, measured)
