from __future__ import annotations

import struct

import numpy as np
import pytest

from fruitgui.sensors.kinect.cameras import cameras_of, nominal_cameras
from fruitgui.sensors.kinect.depth_table import ZeroPlane
from fruitgui.sensors.kinect.factory import FIELDS, Factory
from tests.emulated_usb.factory_made import registration_bytes


def factory(record: bytes) -> Factory:
    return Factory(registration=struct.unpack("<29i", record))


@pytest.mark.parametrize(
    ("focal_px", "middle_px", "k1", "roll"),
    [(525.0, (319.5, 239.5), 0.0, 0.0), (517.0, (327.0, 251.0), 0.05, -0.01), (535.0, (310.0, 230.0), -0.03, 0.02)],
)
def test_the_factory_s_cameras_are_found_again(
    focal_px: float, middle_px: tuple[float, float], k1: float, roll: float
) -> None:
    found = cameras_of(factory(registration_bytes(focal_px, middle_px, k1, roll)))
    color, pose = found.registration.color, found.registration.pose
    assert found.rms_px is not None
    # what the lens bends differs a little with depth, which the factory's cubic does not know
    assert found.rms_px < 0.3
    # the differences come in steps of 1/2^31 pixel, so a cubic over 640 pixels is known to some hundredths
    assert (color.fx, color.fy) == pytest.approx((focal_px, focal_px), abs=0.5)
    assert (color.cx, color.cy) == pytest.approx(middle_px, abs=0.5)
    assert pose.rotation[1, 0] == pytest.approx(np.sin(roll), abs=1e-4)
    assert pose.translation_m[0] == pytest.approx(-0.024 * ZeroPlane().focal_px / focal_px, abs=1e-4)


def test_a_registered_plane_lies_where_the_infrared_camera_saw_it() -> None:
    registration = cameras_of(factory(registration_bytes(k1=0.05, roll=0.01))).registration
    depth = registration.depth
    z_mm = np.full((480, 640), 900, np.uint16)
    z_mm[100:140, 200:260] = 800
    registered = registration.apply(z_mm)
    rays = registration.color.rays()
    v, u = np.nonzero(registered == 800)
    x_m = rays[v, u, 0] * 0.8 - registration.pose.translation_m[0]
    y_m = rays[v, u, 1] * 0.8
    x_m, y_m = (np.stack([x_m, y_m], 1) @ registration.pose.rotation[:2, :2]).T
    # the square's edges, in the infrared camera's own frame, to a pixel of 1.5 mm
    assert x_m.min() == pytest.approx((199.5 - depth.cx) / depth.fx * 0.8, abs=2e-3)
    assert x_m.max() == pytest.approx((259.5 - depth.cx) / depth.fx * 0.8, abs=2e-3)
    assert y_m.min() == pytest.approx((99.5 - depth.cy) / depth.fy * 0.8, abs=2e-3)
    assert y_m.max() == pytest.approx((139.5 - depth.cy) / depth.fy * 0.8, abs=2e-3)
    assert len(u) * (0.8 / registration.color.fx) ** 2 == pytest.approx(40 * 60 * (0.8 / depth.fx) ** 2, rel=0.02)


def test_what_a_broken_device_says_is_not_believed() -> None:
    rng = np.random.default_rng(8)
    usual = nominal_cameras(ZeroPlane()).registration
    for _ in range(10):
        found = cameras_of(Factory(registration=tuple(int(n) for n in rng.integers(-(2**31), 2**31, len(FIELDS)))))
        assert found.rms_px is None
        assert found.registration.color == usual.color
