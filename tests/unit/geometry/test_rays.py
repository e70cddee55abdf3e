"""A pixel's ray is the same whether it is asked for alone or with all others."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fruitgui.frame import Intrinsics

LENSES = ((), (0.11, -0.23, 0.0012, -0.0008, 0.05))


@pytest.mark.parametrize("distortion", LENSES)
@given(u=st.integers(0, 319), v=st.integers(0, 239))
def test_one_ray_is_that_of_the_picture(distortion: tuple[float, ...], u: int, v: int) -> None:
    camera = Intrinsics(320, 240, 262.5, 263.0, 158.2, 121.7, distortion)
    (ray,) = camera.rays_at(np.array([[u, v]], dtype=np.float64))
    assert ray == pytest.approx(camera.rays()[v, u], abs=1e-6)
    (pixel,) = camera.project(np.array([[*ray, 1.0]]))
    assert pixel == pytest.approx((u, v), abs=0.01)
