"""The belt's travel and the fruit's own motion."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fruitgui.simulation.motion import SpeedProfile, Wobble, change, constant, smooth_step, stop_and_start

KNOTS = st.lists(st.tuples(st.floats(0.05, 3.0), st.floats(0.0, 0.5)), min_size=1, max_size=5)


@given(KNOTS, st.floats(0.0, 12.0))
def test_travel_is_the_integral_of_speed(knots: list[tuple[float, float]], end_s: float) -> None:
    times_s = np.cumsum([gap for gap, _ in knots])
    profile = SpeedProfile(tuple(times_s.tolist()), tuple(speed for _, speed in knots))
    fine = np.linspace(0, end_s, 20001)
    speeds = np.interp(fine, profile.times_s, profile.speeds_m_s)
    numeric_m = float(np.sum((speeds[1:] + speeds[:-1]) / 2 * np.diff(fine)))
    assert profile.travel_m(end_s) == pytest.approx(numeric_m, abs=1e-5)


@given(st.floats(0.02, 0.5), st.floats(0.0, 5.0))
def test_time_at_inverts_travel(speed_m_s: float, far_m: float) -> None:
    profile = change(speed_m_s, 0.6 * speed_m_s, 3.0)
    assert profile.travel_m(profile.time_at(far_m)) == pytest.approx(far_m, abs=1e-9)


def test_a_belt_stops_and_starts_again() -> None:
    profile = stop_and_start(0.2, stop_s=4.0, rest_s=2.0, ramp_s=0.4)
    assert profile.speed_m_s(3.9) == 0.2
    assert profile.speed_m_s(5.0) == 0.0
    assert profile.speed_m_s(7.0) == 0.2
    # 4 s, half of each ramp, and what is left
    assert profile.travel_m(10.0) == pytest.approx(0.2 * (4.0 + 0.2 + 0.2 + 10.0 - 6.8))
    assert constant(0.1).travel_m(-2.0) == pytest.approx(-0.2)


@given(st.floats(-1.0, 1.0), st.floats(0.0, 6.28))
def test_a_fruit_rolls_as_far_as_it_turns(roll_rad: float, axis_rad: float) -> None:
    wobble = Wobble(axis_rad=axis_rad, roll_rad=roll_rad, roll_s=1.0, start_s=2.0)
    assert wobble.turn_rad(1.9) == 0.0
    assert wobble.turn_rad(3.1) == pytest.approx(roll_rad)
    moved = wobble.moved_m(3.1, 0.035)
    assert np.linalg.norm(moved) == pytest.approx(abs(roll_rad) * 0.035, abs=1e-12)
    # the top of a rolling ball runs ahead of its centre
    top = wobble.rotation(2.05) @ np.array([0.0, 0.0, 0.035])
    if abs(roll_rad) > 1e-3:
        assert top[:2] @ moved > 0


def test_rocking_dies_out() -> None:
    wobble = Wobble(rock_rad=0.1, rock_hz=1.0, decay_s=1.0)
    turns = [abs(wobble.turn_rad(t)) for t in np.linspace(8, 10, 50)]
    assert max(turns) < 1e-4
    assert smooth_step(-1) == 0
    assert smooth_step(2) == 1
