"""Depth limits per pixel say the same as points, heights and a polygon would."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fruitgui.frame import Intrinsics
from fruitgui.geometry.plane import Plane, Surface
from fruitgui.geometry.rotation import rotation_from_vector
from fruitgui.perception import PerceptionSettings
from fruitgui.perception.limits import depth_limits

CAMERA = Intrinsics(64, 48, 52.5, 52.5, 31.5, 23.5)
SETTINGS = PerceptionSettings()


def surface(tilt_rad: float, roll_rad: float, height_m: float, half_m: float) -> Surface:
    normal = rotation_from_vector(np.array([tilt_rad, roll_rad, 0.0])) @ np.array([0.0, 0.0, -1.0])
    plane = Plane(normal, height_m)
    ahead = plane.frame().apply(np.array([0.0, 0.0, height_m / -normal[2]]))[:2]
    square = half_m * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) + ahead
    return Surface(plane, plane.frame().inverse().apply(np.hstack([square, np.zeros((4, 1))])))


@settings(max_examples=60, deadline=None)
@given(
    st.floats(-0.9, 0.9), st.floats(-0.4, 0.4), st.floats(0.6, 1.8), st.floats(0.1, 0.5), st.integers(0, 2**31)
)  # fmt: skip
def test_a_reading_counts_exactly_where_its_point_is_above_the_belt_inside_the_region(
    tilt: float, roll: float, height: float, half: float, seed: int
) -> None:
    place = surface(tilt, roll, height, half)
    limits = depth_limits(CAMERA, place, SETTINGS)
    rng = np.random.default_rng(seed)
    rows = rng.integers(*limits.crop[0].indices(48)[:2], 200)
    columns = rng.integers(*limits.crop[1].indices(64)[:2], 200)
    depth_mm = rng.integers(300, 2500, 200)
    rays = np.hstack([CAMERA.rays()[rows, columns].astype(float), np.ones((200, 1))])
    points = rays * depth_mm[:, None] * 1e-3
    inside = limits.inside_m(points) - limits.inset_m
    above = place.plane.height_m(points)
    at = rows - limits.crop[0].start, columns - limits.crop[1].start
    counts = (depth_mm >= limits.nearest_mm[at]) & (depth_mm <= limits.farthest_mm[at])
    # One millimetre of depth is the resolution of the limits.
    surely = (inside > 2e-3) & (above < SETTINGS.tallest_m - 2e-3) & (above > 0.5 * SETTINGS.tallest_m + 2e-3)
    surely_not = (inside < -2e-3) | (above > SETTINGS.tallest_m + 2e-3) | (above < SETTINGS.lowest_m - 2e-3)
    assert counts[surely].all()
    assert not counts[surely_not].any()


def test_the_lowest_height_grows_with_the_noise_of_distance() -> None:
    near, far = (depth_limits(CAMERA, surface(0.0, 0.0, z, 0.3), SETTINGS) for z in (0.7, 1.6))
    low_near, low_far = (limits.offset_m - float(limits.farthest_mm.max()) * 1e-3 for limits in (near, far))
    assert SETTINGS.lowest_m - 1e-3 <= low_near < 0.009
    assert 0.010 < low_far < 0.020


def test_without_a_region_everything_below_the_tallest_is_looked_at() -> None:
    limits = depth_limits(CAMERA, Surface(Plane(np.array([0.0, 0.0, -1.0]), 1.0)), SETTINGS)
    assert limits.shape == (48, 64)
    assert limits.edges.shape == (0, 3)
    assert np.isinf(limits.inside_m(np.zeros((2, 3)))).all()


def test_a_region_out_of_sight_gives_limits_that_nothing_meets() -> None:
    away = surface(0.0, 0.0, 1.0, 0.1)
    assert away.region_m is not None
    limits = depth_limits(CAMERA, Surface(away.plane, away.region_m + np.array([5.0, 0.0, 0.0])), SETTINGS)
    assert (limits.farthest_mm < limits.nearest_mm).all()


@pytest.mark.parametrize("distortion", [(), (0.1, -0.2, 0.001, -0.002, 0.05)])
def test_rays_of_the_crop_are_those_of_the_camera_whether_its_lens_bends_them(distortion: tuple[float, ...]) -> None:
    camera = replace(CAMERA, distortion=distortion)
    limits = depth_limits(camera, surface(0.5, 0.1, 1.0, 0.2), SETTINGS)
    row, column = (side.reshape(-1) for side in np.indices(limits.shape))
    x, y = limits.rays_at(row, column)
    expected = camera.rays()[limits.crop].reshape(-1, 2)
    assert np.abs(np.stack([x, y], axis=1) - expected).max() < 1e-6
    assert limits.shape != (camera.height, camera.width)
