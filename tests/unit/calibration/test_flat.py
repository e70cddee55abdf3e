from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fruitgui.calibration.flat import Shift, best_shift

shifts = st.builds(Shift, st.floats(-2, 2), st.floats(-2, 2), st.floats(-3.1, 3.1))


@given(shifts, shifts, st.integers(0, 999))
def test_shifts_compose_as_their_poses_do(one: Shift, two: Shift, seed: int) -> None:
    points = np.random.default_rng(seed).uniform(-1, 1, (4, 3))
    assert one.after(two).apply(points) == pytest.approx(one.apply(two.apply(points)), abs=1e-9)
    assert one.pose().apply(points) == pytest.approx(one.apply(points), abs=1e-9)
    assert one.inverse().apply(one.apply(points)) == pytest.approx(points, abs=1e-9)


@given(shifts, st.integers(0, 999))
def test_best_shift_finds_what_moved_the_points(shift: Shift, seed: int) -> None:
    points = np.random.default_rng(seed).uniform(-1, 1, (6, 2))
    assert best_shift(points, shift.apply(points)).apply(points) == pytest.approx(shift.apply(points), abs=1e-9)


def test_small_motion_turns_about_the_centre() -> None:
    centre = np.array([1.0, 2.0])
    moved = Shift(0.0, 0.0, 0.0).about(centre, np.array([0.0, 0.0, 0.3]))
    assert moved.apply(centre) == pytest.approx(centre)
