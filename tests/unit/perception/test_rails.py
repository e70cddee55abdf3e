"""Rails inside the region are no fruit; what touches them is, and so is whatever lies in a row."""

from __future__ import annotations

import numpy as np
import pytest

from fruitgui.frame import F64, Frame
from fruitgui.geometry.plane import Plane, Surface
from fruitgui.perception import Perceiver
from fruitgui.perception.cross_section import rail_among
from fruitgui.perception.view import FruitView
from tests.unit.perception.spheres import KINECT, nearest, row_of_balls, views

LONG_M = 0.6


def seen(heights_m: F64) -> tuple[FruitView, ...]:
    """Return what is seen of heights over a belt 1 m below the camera, with steps and noise of depth."""
    rng = np.random.default_rng(0)
    noise = np.repeat(np.repeat(rng.normal(0.0, 1.4e-3, (160, 214)), 3, 0), 3, 1)[:480, :640]
    depth = np.rint((1.0 - heights_m + noise) / 0.0029) * 0.0029
    frame = Frame("k", 0, 0.0, np.full((480, 640, 3), 120, np.uint8), np.rint(depth * 1e3).astype(np.uint16), KINECT)
    return Perceiver("k", KINECT, Surface(Plane(np.array([0.0, 0.0, -1.0]), 1.0))).observe(frame, 0.0).views


def belt(turned_rad: float = 0.0) -> tuple[F64, F64]:
    """Return how far along and across the belt, metres, every pixel of a picture is, the belt turned in it."""
    x, y = KINECT.rays().astype(np.float64).transpose(2, 0, 1)
    cosine, sine = np.cos(turned_rad), np.sin(turned_rad)
    return x * cosine + y * sine, y * cosine - x * sine


def rail(along: F64, across: F64, width_m: float = 0.035, height_m: float = 0.036, length_m: float = 9.0) -> F64:
    return np.where((np.abs(across) < width_m / 2) & (np.abs(along) < length_m / 2), height_m, 0.0)


def ball(along: F64, across: F64, at_m: tuple[float, float], radius_m: float, lifted_m: float = 0.0) -> F64:
    square = radius_m**2 - (along - at_m[0]) ** 2 - (across - at_m[1]) ** 2
    return np.where(square > 0, lifted_m + radius_m + np.sqrt(np.maximum(square, 0.0)), 0.0)


@pytest.mark.parametrize("turned_rad", [0.0, 0.3, 1.0, np.pi / 2])
@pytest.mark.parametrize(("width_m", "height_m"), [(0.015, 0.02), (0.035, 0.036), (0.05, 0.07)])
def test_a_rail_is_nothing(turned_rad: float, width_m: float, height_m: float) -> None:
    assert seen(rail(*belt(turned_rad), width_m, height_m)) == ()


@pytest.mark.parametrize("turned_rad", [0.0, 0.2])
@pytest.mark.parametrize("height_m", [0.02, 0.036, 0.06])
def test_fruit_that_touch_a_rail_stay_whole(turned_rad: float, height_m: float) -> None:
    """Three lean on it from one side, one from the other, and one lies on top."""
    along, across = belt(turned_rad)
    places = {(-0.3, 0.050): 0.034, (-0.22, 0.047): 0.03, (0.05, -0.055): 0.038, (0.28, 0.053): 0.036}
    balls = [ball(along, across, at_m, radius_m) for at_m, radius_m in places.items()]
    alone = seen(np.maximum.reduce([*balls]))
    beside = seen(np.maximum.reduce([*balls, rail(along, across, 0.03, height_m)]))
    assert len(alone) == len(beside) == 4
    for one in alone:
        same = min(beside, key=lambda view: float(np.linalg.norm(view.centre_m - one.centre_m)))
        assert np.linalg.norm(same.centre_m - one.centre_m) < 0.004
        assert same.area_px == pytest.approx(one.area_px, rel=0.12)
        # A rail is not bare belt: what of the outline lies beside it is no silhouette.
        assert 0.0 < np.mean(same.outline_free) < 0.95
        assert np.mean(one.outline_free) > 0.99
    on_top = seen(np.maximum(rail(along, across, 0.05, height_m), ball(along, across, (0.1, 0.0), 0.035, height_m)))
    assert len(on_top) == 1
    assert on_top[0].height_m == pytest.approx(height_m + 0.07, abs=0.008)


@pytest.mark.parametrize("tilt_rad", [0.1, 0.5])
@pytest.mark.parametrize(("radius_m", "fruit"), [(0.0125, 28), (0.02, 18), (0.035, 10)])
def test_balls_in_a_row_longer_than_any_fruit_are_all_seen(tilt_rad: float, radius_m: float, fruit: int) -> None:
    table = row_of_balls((radius_m,) * fruit, 0.0, tilt_rad=tilt_rad, height_m=0.9, seed=3)
    found = views(table)
    assert sorted(nearest(table, view) for view in found) == list(range(fruit))


def test_a_long_straight_fruit_stays() -> None:
    along, across = belt()
    radius_m = 0.02
    cucumber = np.where(np.abs(along) < 0.12, ball(0.0 * along, across, (0.0, 0.0), radius_m), 0.0)
    assert len(seen(cucumber)) == 1


def test_only_points_of_the_common_cross_section_are_a_rails() -> None:
    rng = np.random.default_rng(1)
    bar = np.column_stack([rng.uniform(-0.5, 0.5, 3000), rng.uniform(0.0, 0.03, 3000), rng.uniform(0.03, 0.034, 3000)])
    lump = np.column_stack([rng.uniform(0.1, 0.16, 400), rng.uniform(0.05, 0.11, 400), rng.uniform(0.03, 0.06, 400)])
    is_rail, plain = rail_among(np.vstack([bar, lump]), LONG_M)
    assert is_rail[:3000].mean() > 0.98
    assert not is_rail[3000:].any()
    assert plain[:3000].mean() > 0.8
    assert not rail_among(bar[np.abs(bar[:, 0]) < 0.25], LONG_M)[0].any()
    assert not rail_among(bar[:20], LONG_M)[0].any()
