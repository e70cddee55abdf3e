"""Touching fruit come apart; single ones of any shape stay whole."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fruitgui.frame import F64, Frame
from fruitgui.geometry.plane import Plane, Surface
from fruitgui.perception import Perceiver, PerceptionSettings
from fruitgui.perception.paper import KMeansSplitter
from fruitgui.perception.tops import near_two
from fruitgui.perception.view import FruitView
from tests.unit.perception.spheres import KINECT, Ball, Table, nearest, perceiver, row_of_balls, views


@pytest.mark.parametrize("tilt_rad", [0.1, 0.5, 0.8])
@pytest.mark.parametrize(("radii_m", "height_m"), [((0.035, 0.035), 0.7), ((0.035, 0.03, 0.04), 1.1)])
def test_balls_side_by_side_come_apart(tilt_rad: float, radii_m: tuple[float, ...], height_m: float) -> None:
    table = row_of_balls(radii_m, 0.0, tilt_rad=tilt_rad, height_m=height_m, seed=3)
    found = views(table)
    assert sorted(nearest(table, view) for view in found) == list(range(len(radii_m)))
    assert all(view.shared for view in found)
    for view in found:
        # The cut may run a pixel or two off the crease; the centre stays within a tenth of a fruit.
        assert np.linalg.norm(view.centre_m - table.centres_m()[nearest(table, view)]) < 0.007


@pytest.mark.parametrize("tilt_rad", [0.3, 0.7])
def test_a_ball_behind_another_is_seen_as_one_of_its_own(tilt_rad: float) -> None:
    """Along the line of sight there is no valley between them, only a jump in depth."""
    front = row_of_balls((0.04,), 0.0, tilt_rad=tilt_rad).balls[0]
    for step in (-1.0, 1.0):
        behind = Ball(front.x_m, front.y_m + step * 2.0 * np.sqrt(0.04 * 0.033), 0.033)
        table = Table((front, behind), tilt_rad=tilt_rad)
        assert sorted(nearest(table, view) for view in views(table)) == [0, 1]


def drawn(heights_m: F64, step_m: float = 0.002, noise_m: float = 1.0e-3) -> tuple[FruitView, ...]:
    """Return what is seen of a height map on a belt 1 m below the camera, with steps and noise of depth."""
    rng = np.random.default_rng(0)
    depth = np.full((480, 640), 1.0)
    rows, columns = heights_m.shape
    depth[150 : 150 + rows, 200 : 200 + columns] -= heights_m
    depth += np.repeat(np.repeat(rng.normal(0.0, noise_m, (96, 128)), 5, 0), 5, 1)
    depth_mm = np.rint(np.rint(depth / step_m) * step_m * 1e3).astype(np.uint16)
    frame = Frame("ball", 0, 0.0, np.full((480, 640, 3), 120, np.uint8), depth_mm, KINECT)
    return Perceiver("ball", KINECT, Surface(Plane(np.array([0.0, 0.0, -1.0]), 1.0))).observe(frame, 0.0).views


def grid() -> tuple[F64, F64]:
    """Millimetres around the middle of a 200 × 200 pixel patch at about 1 m."""
    v, u = (np.mgrid[:200, :200] - 100.0) * 1.85
    return u, v


def ball_mm(u: F64, v: F64, radius: float, centre: float | None = None) -> F64:
    return (radius if centre is None else centre) + np.sqrt(np.maximum(radius**2 - u**2 - v**2, 0.0))


def test_an_apple_with_a_deep_dimple_is_one() -> None:
    u, v = grid()
    r = np.hypot(u, v)
    apple = np.where(r < 38, ball_mm(u, v, 38.0) - 16.0 * np.exp(-((r / 9.0) ** 2)), 0.0)
    assert len(drawn(apple * 1e-3)) == 1


def test_a_pear_is_one() -> None:
    u, v = grid()
    half = np.interp(u, [-45, -30, 0, 25, 55, 60], [0, 25, 34, 26, 16, 0], left=0.0, right=0.0)
    pear = np.where(np.abs(v) < half, half + np.sqrt(np.maximum(half**2 - v**2, 0.0)), 0.0)
    assert len(drawn(pear * 1e-3)) == 1


def test_a_banana_is_one() -> None:
    u, v = grid()
    bent = np.hypot(u, v + 120.0) - 120.0
    along = np.arctan2(u, v + 120.0) * 120.0
    half = np.interp(np.abs(along), [0, 60, 85, 90], [18, 17, 8, 0])
    banana = np.where(np.abs(bent) < half, half + np.sqrt(np.maximum(half**2 - bent**2, 0.0)), 0.0)
    assert len(drawn(banana * 1e-3)) == 1


def test_a_bowl_is_one() -> None:
    u, v = grid()
    r = np.hypot(u, v)
    bowl = np.where(r < 60, np.where(r > 52, 60.0, 8.0 + 30.0 * (r / 60) ** 2), 0.0)
    found = drawn(bowl * 1e-3)
    assert len(found) == 1
    assert not found[0].shared


@pytest.mark.parametrize("tilt_rad", [0.0, 0.7, 1.4])
def test_a_hand_with_its_arm_is_one_however_long(tilt_rad: float) -> None:
    """It narrows at the wrist and at every knuckle, and is longer than any fruit."""
    cosine, sine = np.cos(tilt_rad), np.sin(tilt_rad)
    v, u = (np.mgrid[:240, :240] - 120.0) * 1.85
    along, across = u * cosine + v * sine, v * cosine - u * sine
    palm = np.hypot(along, across) < 45.0
    arm = (
        (along > -165.0)
        & (along < 0.0)
        & (np.abs(across) < np.interp(along, [-165.0, -70.0, -45.0], [36.0, 26.0, 13.0]))
    )
    fingers = np.zeros_like(palm)
    for turned in (-0.42, -0.14, 0.14, 0.42):
        reach = along * np.cos(turned) + across * np.sin(turned)
        fingers |= (reach > 0.0) & (reach < 145.0) & (np.abs(across * np.cos(turned) - along * np.sin(turned)) < 10.0)
    assert [view.shared for view in drawn(np.where(palm | arm | fingers, 0.028, 0.0))] == [False]


def test_two_bananas_side_by_side_are_two() -> None:
    u, v = grid()
    both = np.zeros_like(u)
    for middle in (-18.0, 18.0):
        across = v - middle
        half = np.interp(np.abs(u), [0, 60, 80, 85], [18, 17, 8, 0])
        one = np.where(np.abs(across) < half, half + np.sqrt(np.maximum(half**2 - across**2, 0.0)), 0.0)
        both = np.maximum(both, one)
    assert len(drawn(both * 1e-3)) == 2


def test_a_patch_without_readings_does_not_split_a_dark_fruit() -> None:
    table = row_of_balls((0.04,), 0.0, tilt_rad=0.3)
    frame = table.frame()
    left, top, width, height = views(table)[0].box_px
    depth = frame.depth_mm.copy()
    depth[top + height // 4 : top + height // 2, left + width // 3 : left + width // 3 + 9] = 0
    found = perceiver(table).observe(replace(frame, depth_mm=depth), 0.0).views
    assert len(found) == 1
    assert np.linalg.norm(found[0].centre_m - table.centres_m()[0]) < 0.004


def test_the_source_splits_two_balls_with_k_means_and_drops_what_is_no_ellipse() -> None:
    table = row_of_balls((0.035, 0.035), 0.0, tilt_rad=0.2)
    eye = perceiver(table)
    settings = PerceptionSettings()
    paper = perceiver(table, splitter=KMeansSplitter(eye.limits, settings))
    found = paper.observe(table.frame(), 0.0).views
    assert sorted(nearest(table, view) for view in found) == [0, 1]
    four = row_of_balls((0.035,) * 7, 0.0, tilt_rad=0.2)
    assert len(perceiver(four, splitter=KMeansSplitter(eye.limits, settings)).observe(four.frame(), 0.0).views) < 7


def test_few_tops_are_all_compared_and_many_with_their_nearest() -> None:
    few = np.argwhere(np.ones((4, 6), bool))
    assert len(near_two(few)[0]) == 24 * 23 // 2
    many = np.argwhere(np.ones((3, 60), bool))
    first, second = near_two(many)
    assert (first < second).all()
    assert len(np.unique(np.stack([first, second]), axis=1).T) == len(first) < 180 * 13
    # Each is compared with those beside it, so that a whole ridge can grow together.
    together = set(zip(first.tolist(), second.tolist(), strict=True))
    assert all((at, at + 1) in together for at in range(59))
