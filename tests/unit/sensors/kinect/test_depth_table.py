from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from fruitgui.sensors.kinect.depth_table import NO_RAW, ZeroPlane, depth_table, millimetres


def test_the_usual_table_is_that_of_the_openkinect_project() -> None:
    table = depth_table(ZeroPlane())
    # 123.6 mm · tan(raw / 2842.5 + 1.1863), fitted by Magnenat (openkinect.org, "Imaging information") to measured ones
    for raw in range(450, 850, 10):
        assert table[raw] == pytest.approx(123.6 * math.tan(raw / 2842.5 + 1.1863), rel=0.01)
    assert (table[500], table[1000]) == (586, 3864)


def test_only_meant_values_have_a_depth() -> None:
    table = depth_table(ZeroPlane())
    assert (table[:1055] > 0).all()
    assert (np.diff(table[:1055].astype(int)) >= 0).all()
    assert not table[1055:].any()


def test_each_step_is_a_quarter_of_a_pixel_of_the_full_picture() -> None:
    # one disparity step at depth z: dz = z² · step / (focal · baseline), here 1/8 of a pixel of the picture of 640
    plane = ZeroPlane()
    table = depth_table(plane).astype(float)
    for raw in (600, 700, 800, 900):
        z_m = table[raw] / 1000.0
        step_mm = 1000.0 * z_m**2 * 0.125 / (plane.focal_px * plane.emitter_cm / 100.0)
        assert (table[raw + 8] - table[raw - 8]) / 16 == pytest.approx(step_mm, rel=0.02)


def test_values_that_no_device_gives_are_none() -> None:
    table = depth_table(ZeroPlane())
    raw = np.array([[0, 700, 1054], [NO_RAW, 5000, 65535]], np.uint16)
    assert millimetres(raw, table).tolist() == [[table[0], table[700], table[1054]], [0, 0, 0]]


@example(0.0, 0.0, 0.0, 0.0)
@given(st.floats(allow_nan=True), st.floats(allow_nan=True), st.floats(allow_nan=True), st.floats(allow_nan=True))
def test_a_broken_device_s_words_make_no_table(emitter: float, reference: float, pixel: float, shift: float) -> None:
    with np.errstate(all="ignore"):
        plane = ZeroPlane(emitter, reference, pixel, shift)
        if plane.is_plausible:
            table = depth_table(plane)
            assert (np.diff(table[table > 0].astype(int)) >= 0).all()
        else:
            assert not all(map(math.isfinite, (emitter, reference, pixel, shift))) or plane != ZeroPlane()
