"""Registration of any two views: what it must not do."""

from __future__ import annotations

import numpy as np
import pytest

from fruitgui.calibration.arbitrary import scan, search
from fruitgui.calibration.still import Still
from fruitgui.frame import Intrinsics


def view(seed: int, bumps_m: float) -> Still:
    """A wall of bumps that has nothing in common with another."""
    rng = np.random.default_rng(seed)
    depth_m = 1.2 + bumps_m * rng.random((120, 160))
    return Still(
        sensor=f"k{seed}",
        intrinsics=Intrinsics(160, 120, 140.0, 140.0, 79.5, 59.5),
        color=np.zeros((120, 160, 3), dtype=np.uint8),
        inverse_depth=(1.0 / depth_m).astype(np.float32),
        captures=1,
        moved=np.zeros((120, 160), dtype=bool),
    )


def test_views_that_have_nothing_in_common_leave_standard_output_alone(capfd: pytest.CaptureFixture[str]) -> None:
    """Open3D prints its warnings there, where a program may be waiting for one JSON object."""
    found = search(scan(view(1, 0.4), 0.03), scan(view(2, 0.0), 0.03))
    assert found.doubt
    assert capfd.readouterr().out == ""
