from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from fruitgui.calibration.levels import inverse_depths, steps
from fruitgui.frame import F64, Frame, Intrinsics

CAMERA = Intrinsics(320, 240, 270.0, 270.0, 159.5, 119.5)


def frame_of(depth_m: F64) -> Frame:
    millimetres = np.round(1000.0 * depth_m).astype(np.uint16)
    return Frame("s", 0, 0.0, np.zeros((*depth_m.shape, 3), np.uint8), millimetres, CAMERA)


@settings(max_examples=25)
@given(st.floats(2.0e-3, 4.0e-3), st.floats(-0.05, 0.05), st.floats(0.8, 1.2), st.floats(2.2, 3.0))
def test_readings_come_back_as_they_were_counted(step: float, base: float, near_m: float, far_m: float) -> None:
    true = 1.0 / np.linspace(near_m, far_m, 320 * 240).reshape(240, 320)
    counted = base + step * np.round((true - base) / step)
    frame = frame_of(1.0 / counted)
    off = 1.0 / inverse_depths([frame])[frame.depth_mm] - 1.0 / counted
    rounded = 1e-3 * frame.depth_mm - 1.0 / counted
    assert np.sqrt((off**2).mean()) < 0.5 * np.sqrt((rounded**2).mean())


def test_a_sensor_without_steps_is_left_as_it_is() -> None:
    frame = frame_of(np.random.default_rng(0).uniform(0.7, 2.0, (240, 320)))
    found = inverse_depths([frame])
    assert np.array_equal(found[700:2000], (1000.0 / np.arange(700, 2000)).astype(np.float32))
    assert found[0] == found[65535] == 0.0


def test_a_step_is_never_taken_for_its_neighbour() -> None:
    step = 0.125 / 43.5
    counted = step * np.arange(130, 520).repeat(40)
    frame = frame_of(1.0 / counted[: 320 * 48].reshape(48, 320))
    found = inverse_depths([frame])[frame.depth_mm]
    assert np.abs(found - counted[: 320 * 48].reshape(48, 320)).max() < 0.5 * step


def test_too_few_levels_tell_nothing() -> None:
    inverse = np.zeros(65536)
    inverse[1:] = 1000.0 / np.arange(1, 65536)
    counts = np.zeros(65536, dtype=np.intp)
    counts[[1400, 1406, 1412]] = 1000
    assert steps(inverse, counts) is None
