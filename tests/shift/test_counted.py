"""Which balls a shift is held to: those of which sensors that were well took pictures."""

from __future__ import annotations

from collections.abc import Iterable

from fruitgui.sensors.turns import VIEWS_NEEDED
from tests.shift.belt import ENTRY_M, SPACING_S, SPEED_M_S, Belt, ball
from tests.shift.counted import Sighting, counted
from tests.shift.mishaps import RECOVERY_S, Mishap

SEED, BEGAN_S, SPAN_S = 3, 500.0, (0.0, 60.0)
IN_THE_MIDDLE_S = -ENTRY_M / SPEED_M_S


def _passed(belt: Belt, fruit: Iterable[int] = ()) -> tuple[int, tuple[int, ...]]:
    """Return how many balls count as passed, and which of them were missed, where these were counted."""
    seen = [
        Sighting(BEGAN_S + one.time_s + IN_THE_MIDDLE_S, 0.06, one.y_m, 1e-4)
        for one in (ball(number, SEED) for number in fruit)
    ]
    count = counted(seen, BEGAN_S, SPAN_S, SEED, belt.pictured)
    assert (count.twice, count.strange) == ((), 0)
    return count.passed, count.missed


def _picture(belt: Belt, kinect: int, number: int, pictures: int) -> None:
    """Take pictures while a ball is in the middle."""
    for count in range(pictures):
        belt(kinect, number * SPACING_S + IN_THE_MIDDLE_S + count / 30.0)


def test_a_ball_that_was_never_pictured_did_not_pass() -> None:
    belt = Belt(SEED)
    assert _passed(belt) == (0, ())
    _picture(belt, 0, 6, VIEWS_NEEDED - 1)
    alone = _passed(belt)
    _picture(belt, 1, 6, 1)
    passed, missed = _passed(belt)
    assert 6 not in alone[1]
    assert passed == len(missed)
    assert 6 in missed
    assert 6 not in _passed(belt, [6])[1]


def test_nobody_is_held_to_what_a_sensor_in_trouble_saw() -> None:
    at_s = 6 * SPACING_S + IN_THE_MIDDLE_S
    mishap = Mishap("unplugged", (0,), at_s - 1.0, at_s + 1.0, ())
    belt = Belt(SEED, lambda kinect, time_s: not mishap.troubles(kinect, time_s))
    _picture(belt, 0, 6, VIEWS_NEEDED)
    assert _passed(belt) == (0, ())
    _picture(belt, 1, 6, VIEWS_NEEDED)
    assert 6 in _passed(belt)[1]
    assert mishap.troubles(0, mishap.to_s + RECOVERY_S)
    assert not mishap.troubles(0, mishap.to_s + RECOVERY_S + 0.1)
