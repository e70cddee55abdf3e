from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fruitgui.calibration.borders import Border, borders, heading_between, turn_between
from fruitgui.calibration.flat import Shift
from fruitgui.calibration.relief import Relief, relief
from fruitgui.calibration.still import average
from fruitgui.calibration.surface import fit_belt
from tests.unit.calibration.worlds import OPPOSED, frames_of, scattered


def striped(sensor: str) -> Relief:
    """Return a view of a belt that stands out in colour from what lies beside it, with noise."""
    rng = np.random.default_rng(3)
    frames = []
    for frame in frames_of(sensor, OPPOSED[sensor], scattered(1), seed=1, count=3, half_width_m=0.3):
        color = frame.color.astype(np.float64)
        color[frame.depth_mm == 0] += 90.0
        noisy = np.clip(color + rng.normal(0.0, 4.0, color.shape), 0, 255).astype(np.uint8)
        frames.append(replace(frame, color=noisy))
    still = average(frames)
    belt = fit_belt(still)
    assert belt is not None
    return relief(still, belt)


def test_borders_of_a_belt_tell_the_heading_to_a_few_hundredths_of_a_degree() -> None:
    left, right = striped("left"), striped("right")
    mine, theirs = borders(left), borders(right)
    assert min(len(mine), len(theirs)) >= 2
    true = right.frame @ OPPOSED["right"].inverse() @ OPPOSED["left"] @ left.frame.inverse()
    heading = float(np.arctan2(true.rotation[1, 0], true.rotation[0, 0]))
    found = heading_between(mine, theirs)
    assert found is not None
    # 0.2 px of 300 px, and what the planes' tilts (0.05° at most, 30° off the axis) turn
    assert np.degrees(abs(np.sin(found - heading))) < 0.06
    x, y = true.translation_m[:2]
    turn = turn_between(mine, theirs, Shift(float(x), float(y), heading + np.radians(0.4)))
    assert turn is not None
    assert np.degrees(turn.turn_rad) == pytest.approx(-0.4, abs=0.06)
    assert abs(turn.turn_rad + np.radians(0.4)) < 4 * turn.std_rad


def test_borders_far_apart_or_not_parallel_say_nothing() -> None:
    along = np.array([1.0, 0.0])
    one = Border(np.zeros(2), along, 1e-4, 0.3)
    nowhere = Shift(0.0, 0.0, 0.0)
    assert turn_between([one], [Border(np.array([0.0, 0.2]), along, 1e-4, 0.3)], nowhere) is None
    leaning = np.array([np.cos(0.05), np.sin(0.05)])
    assert turn_between([one], [Border(np.zeros(2), leaning, 1e-4, 0.3)], nowhere) is None
    assert turn_between([], [one], nowhere) is None


def test_a_border_has_no_sense_of_direction() -> None:
    one = Border(np.zeros(2), np.array([1.0, 0.0]), 1e-4, 0.3)
    other = Border(np.zeros(2), np.array([-np.cos(1e-3), -np.sin(1e-3)]), 1e-4, 0.3)
    turn = turn_between([one], [other], Shift(0.0, 0.0, 0.0))
    assert turn is not None
    assert turn.turn_rad == pytest.approx(1e-3, abs=1e-6)
