"""Flat things are seen by colour and a rise of many readings; stains, shadows and the fringes of fruit are not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fruitgui.frame import Bools, Frame
from fruitgui.geometry.plane import Plane, Surface
from fruitgui.perception import Perceiver
from fruitgui.perception.view import FruitView
from tests.unit.perception.spheres import KINECT, Ball, Table

MIDDLE_M = 0.545
"""Where on the belt the middle of the tilted table's picture is."""

GREEN, PALE, SHADE = (60, 105, 40), (240, 240, 240), (70, 70, 70)


def laid(
    table: Table, x_m: float, y_m: float, rgb: tuple[int, int, int], rise_m: float,
    half_m: tuple[float, float] = (0.045, 0.0225),
) -> Frame:  # fmt: skip
    """Return the table's frame with an ellipse of that colour on it, 90 by 45 mm, so much above the belt."""
    frame = table.frame()
    rays = np.concatenate([KINECT.rays().astype(float), np.ones((480, 640, 1))], axis=2)
    slope = -(rays @ table.plane().normal)
    feet = table.plane().frame().apply((rays * (table.height_m / slope)[..., None]).reshape(-1, 3)).reshape(480, 640, 3)
    there: Bools = np.hypot((feet[..., 0] - x_m) / half_m[0], (feet[..., 1] - y_m) / half_m[1]) < 1.0
    grain = np.random.default_rng(1).normal(0.0, 4.0, (480, 640, 1))
    color = np.where(there[..., None], np.clip(np.array(rgb) + grain, 0, 255), frame.color).astype(np.uint8)
    lower = np.where(there & (frame.depth_mm > 0), 1e3 * rise_m / slope, 0.0)
    depth = (frame.depth_mm - np.rint(lower)).astype(np.uint16)
    return replace(frame, color=color, depth_mm=depth)


def seen(table: Table, frame: Frame) -> tuple[FruitView, ...]:
    return Perceiver("ball", KINECT, table.surface()).observe(frame, 0.0).views


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("rgb", [GREEN, PALE])
def test_a_flat_thing_is_seen_whole_where_it_lies(seed: int, rgb: tuple[int, int, int]) -> None:
    table = Table((), seed=seed)
    views = seen(table, laid(table, 0.03, MIDDLE_M - 0.05, rgb, 0.004))
    assert len(views) == 1
    place = table.plane().frame().apply(views[0].centre_m[None])[0]
    assert np.hypot(place[0] - 0.03, place[1] - MIDDLE_M + 0.05) < 0.01
    assert views[0].whole
    assert not views[0].shared


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("rgb", [GREEN, SHADE])
def test_a_stain_and_a_shadow_are_nothing(seed: int, rgb: tuple[int, int, int]) -> None:
    table = Table((), seed=seed)
    assert seen(table, laid(table, 0.03, MIDDLE_M - 0.05, rgb, 0.0)) == ()


def test_what_has_the_belts_colour_and_lies_flat_is_not_seen() -> None:
    table = Table(())
    assert seen(table, laid(table, 0.03, MIDDLE_M - 0.05, (110, 110, 110), 0.004)) == ()


def test_bits_that_depth_shows_of_a_leaf_become_the_leaf() -> None:
    table = Table(())
    frame = laid(table, 0.0, MIDDLE_M, GREEN, 0.004)
    depth = frame.depth_mm.copy()
    patch = depth[232:248, 295:312]
    patch[patch > 0] -= 12
    views = seen(table, replace(frame, depth_mm=depth))
    assert len(views) == 1
    assert views[0].area_px > 600


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("rgb", [GREEN, SHADE])
def test_a_small_fruit_does_not_grow_by_its_shadow_or_a_stain(seed: int, rgb: tuple[int, int, int]) -> None:
    table = Table((Ball(0.0, MIDDLE_M, 0.0105),), seed=seed)
    (alone,) = seen(table, table.frame())
    (beside,) = seen(table, laid(table, 0.01, MIDDLE_M, rgb, 0.0, (0.022, 0.018)))
    assert beside.area_px == alone.area_px


@pytest.mark.parametrize("narrower_px", [0, 1, 2])
@pytest.mark.parametrize("turned", [0.02, 0.04])
def test_the_fringe_of_a_rails_colour_is_nothing(narrower_px: int, turned: float) -> None:
    """The floor beyond a rail has its colour; colour and depth of the rail end some pixels apart."""
    rng = np.random.default_rng(narrower_px)
    v, u = np.mgrid[:480, :640]
    beyond = v - 300 - turned * u
    noise = np.repeat(np.repeat(rng.normal(0.0, 1.4e-3, (160, 214)), 3, 0), 3, 1)[:480, :640]
    depth = 1.0 - np.select([beyond >= 12, beyond >= 0], [-0.3, 0.026]) + noise
    rail = (beyond >= narrower_px)[..., None]
    color = np.where(rail, (200, 195, 205), (40, 70, 140)) + rng.normal(0.0, 4.0, (480, 640, 1))
    frame = Frame(
        "ball", 0, 0.0, np.clip(color, 0, 255).astype(np.uint8), np.rint(1e3 * depth).astype(np.uint16), KINECT
    )
    surface = Surface(Plane(np.array([0.0, 0.0, -1.0]), 1.0))
    assert Perceiver("ball", KINECT, surface).observe(frame, 0.0).views == ()


@pytest.mark.parametrize("nearer_m", [0.0, 0.02])
def test_fruit_are_the_same_with_a_leaf_far_or_near_beside_them(nearer_m: float) -> None:
    table = Table((Ball(-0.1, MIDDLE_M, 0.035), Ball(0.12, MIDDLE_M + 0.05, 0.03)))
    leaf = laid(table, -0.03 - nearer_m, MIDDLE_M - 0.08, GREEN, 0.004)
    alone, beside = seen(table, table.frame()), seen(table, leaf)
    assert len(alone) == 2
    assert len(beside) == 3
    for fruit in alone:
        same = min(beside, key=lambda view: float(np.linalg.norm(view.centre_m - fruit.centre_m)))
        np.testing.assert_array_equal(same.outline_px, fruit.outline_px)
        np.testing.assert_array_equal(same.points_m, fruit.points_m)
