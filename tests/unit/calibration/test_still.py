from __future__ import annotations

import numpy as np
import pytest

from fruitgui.calibration.still import average
from fruitgui.errors import InputError
from tests.unit.calibration.worlds import OPPOSED, Ball, depth_of, frames_of, scattered


def test_noise_dithers_the_steps_away() -> None:
    depth, _ = depth_of(OPPOSED["left"], [])
    still = average(frames_of("left", OPPOSED["left"], [], seed=1, count=40))
    seen = still.seen & (depth > 0)
    error = np.where(seen, still.inverse_depth - 1 / np.maximum(depth, 0.1), 0.0)
    # 1.4e-3 noise and 2.9e-3/√12 of step over √40 captures: 2.6e-4
    assert error[seen].std() < 3.5e-4


def test_single_capture_is_enough_to_average() -> None:
    still = average(frames_of("left", OPPOSED["left"], [], seed=1, count=1))
    assert still.captures == 1
    assert not still.moved.any()


def test_still_scene_is_not_said_to_have_moved() -> None:
    assert not average(frames_of("left", OPPOSED["left"], scattered(3), seed=2, count=10)).moved.any()


def test_a_ball_moved_by_two_centimetres_is_seen() -> None:
    before = frames_of("left", OPPOSED["left"], [Ball(0.0, 0.0, 0.035)], seed=1, count=5)
    after = frames_of("left", OPPOSED["left"], [Ball(0.02, 0.0, 0.035)], seed=2, count=5)
    later = [type(f)(f.sensor, f.sequence + 5, f.time_s + 1, f.color, f.depth_mm, f.intrinsics) for f in after]
    assert average(before + later).moved.sum() > 20


def test_no_frames_is_said() -> None:
    with pytest.raises(InputError):
        average([])
