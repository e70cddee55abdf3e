"""What a device's depth is off by is taken out once, where frames are read."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fruitgui.frame import Intrinsics
from fruitgui.sensors.depth_correction import DepthCorrection
from fruitgui.sensors.recordings import open_recording
from tests.unit.sensors import ros_files as ros

CAMERA = Intrinsics(64, 48, 60.0, 61.0, 31.5, 23.5)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    messages = [m for n in range(5) for sensor in ("k1", "k2") for m in ros.frameset(sensor, 1.0 + n / 10)]
    return ros.write_mcap(tmp_path / "r.mcap", messages)


def test_depth_is_corrected_once_where_it_is_read(path: Path) -> None:
    correction = DepthCorrection(scale=1.01, offset_m=-0.004)
    recording = open_recording(path)
    plain = [frame for _, frame in recording.frames() if frame.sensor == "k1"]
    corrected = [frame for _, frame in recording.frames(corrections={"k1": correction}) if frame.sensor == "k1"]
    for before, after in zip(plain, corrected, strict=True):
        np.testing.assert_array_equal(after.depth_mm, correction.apply(before.depth_mm, CAMERA))
        assert not np.array_equal(after.depth_mm, before.depth_mm)
    others = [frame for _, frame in recording.frames(corrections={"k1": correction}) if frame.sensor == "k2"]
    np.testing.assert_array_equal(others[0].depth_mm, ros.depth(1.0))


@given(
    scale=st.floats(0.9, 1.1), offset_m=st.floats(-0.05, 0.05), radial_2=st.sampled_from([0.0, 0.02, -0.01]),
    radial_4=st.sampled_from([0.0, 0.01]),
)  # fmt: skip
def test_correction_is_the_formula_to_half_a_millimetre(
    scale: float, offset_m: float, radial_2: float, radial_4: float
) -> None:
    mm = ros.depth(1.0)
    got = DepthCorrection(scale, offset_m, radial_2, radial_4).apply(mm, CAMERA)
    r2 = (CAMERA.rays().astype(np.float64) ** 2).sum(axis=-1)
    true = (scale + radial_2 * r2 + radial_4 * r2**2) * mm + offset_m * 1e3
    assert (got[mm == 0] == 0).all()
    assert np.abs(got - true)[mm > 0].max() <= 0.5 + 1e-3


def test_correction_beyond_what_depth_can_say_is_no_reading() -> None:
    mm = np.array([[0, 1, 40, 60000, 65535]], np.uint16)
    camera = Intrinsics(5, 1, 1.0, 1.0, 2.0, 0.0)
    assert DepthCorrection(1.2, -0.05).apply(mm, camera).tolist() == [[0, 0, 0, 0, 0]]
    assert DepthCorrection().apply(mm, camera) is mm
