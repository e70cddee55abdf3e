"""Features tell kinds, not light or distance."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fruitgui.frame import F32, U8
from fruitgui.perception import FEATURE_NAMES
from fruitgui.perception.outline import ellipse_error, fit_ellipses, joined, solidity
from fruitgui.perception.pixels import Binned, Runs
from fruitgui.perception.view import FruitView
from tests.unit.perception.spheres import Table, perceiver, row_of_balls, views

NUMBER = {name: number for number, name in enumerate(FEATURE_NAMES)}


def seen(table: Table, color: U8 | None = None) -> FruitView:
    frame = table.frame()
    found = perceiver(table).observe(frame if color is None else replace(frame, color=color), 0.0).views
    assert len(found) == 1
    return found[0]


def test_features_are_named_finite_and_few() -> None:
    view = seen(row_of_balls((0.035,), 0.0))
    assert view.features.shape == (len(FEATURE_NAMES),)
    assert view.features.dtype == np.float32
    assert np.isfinite(view.features).all()
    assert len(set(FEATURE_NAMES)) == len(FEATURE_NAMES)


@pytest.mark.parametrize("part", [0.35, 0.6, 1.2])
def test_light_moves_only_the_features_that_say_so(part: float) -> None:
    table = row_of_balls((0.035,), 0.0)
    picture = table.frame().color
    bright, dim = seen(table).features, seen(table, np.clip(picture * part, 0, 255).astype(np.uint8)).features
    moved = np.abs(bright - dim)
    for name, shift in zip(FEATURE_NAMES, moved, strict=True):
        if name.startswith(("shape_", "size_")):
            assert shift == 0.0, name
        elif name.startswith("light_"):
            assert shift == pytest.approx(abs(np.log(part)), abs=0.15), name
        elif name.startswith("chroma_"):
            # The dark level that keeps noise from looking like colour takes a part of every ratio.
            assert shift < 0.2, name


def test_distance_changes_neither_size_nor_shape_much() -> None:
    near, far = (seen(row_of_balls((0.038,), 0.0, height_m=z, tilt_rad=0.3)).features for z in (0.7, 1.3))
    for name in ("size_height", "size_length", "size_width", "size_root_area"):
        assert abs(near[NUMBER[name]] - far[NUMBER[name]]) < 0.07, name
    for name in ("shape_width_to_length", "shape_height_to_width", "shape_solidity", "shape_sphere_radius"):
        assert abs(near[NUMBER[name]] - far[NUMBER[name]]) < 0.12, name


def test_sizes_of_a_ball_are_its_diameter() -> None:
    features = seen(row_of_balls((0.038,), 0.0, height_m=0.9)).features
    for name in ("size_height", "size_length", "size_width"):
        assert np.exp(features[NUMBER[name]]) == pytest.approx(0.076, rel=0.06), name
    assert features[NUMBER["shape_sphere_radius"]] == pytest.approx(0.0, abs=0.1)


def test_colours_of_the_belt_do_not_mix_in() -> None:
    """A red ball on a green belt is as red as on a blue one."""
    table = row_of_balls((0.035,), 0.0)
    picture = table.frame().color.copy()
    ball = np.abs(picture.astype(int) - [200, 60, 40]).sum(axis=2) < 60
    reds: list[F32] = []
    for belt in ((30, 160, 40), (30, 40, 160)):
        picture[~ball] = belt
        reds.append(seen(table, picture).features)
    own = [n for n, name in enumerate(FEATURE_NAMES) if name.startswith("chroma_") and "belt" not in name]
    assert np.abs(reds[0] - reds[1])[own].max() < 0.02
    assert reds[0][NUMBER["chroma_red_green_p50"]] == pytest.approx(np.log(204 / 64), abs=0.1)


def test_sums_and_quantiles_by_group_are_those_of_each_group() -> None:
    rng = np.random.default_rng(0)
    counts = np.array([400, 0, 900])
    runs = Runs.of(counts)
    values = rng.normal(0.5, 0.1, 1300).astype(np.float32)
    assert runs.sums(values)[0] == pytest.approx([values[:400].sum(), 0.0, values[400:].sum()], rel=1e-5)
    low = values < 0.5
    all_of_them, lower = runs.quantiles(
        [Binned.of(values, 0.0, 1.0), replace(Binned.of(values, -1.0, 1.0), counted=low)], (0.1, 0.5)
    )
    for group, part in ((0, slice(400)), (2, slice(400, None))):
        assert all_of_them[group] == pytest.approx(np.quantile(values[part], [0.1, 0.5]), abs=0.01)
        assert lower[group] == pytest.approx(np.quantile(values[part][low[part]], [0.1, 0.5]), abs=0.02)
    assert all_of_them[1].tolist() == [0.0, 0.0]
    assert lower[1].tolist() == [-1.0, -1.0]


def circle(radius: int, centre: int = 60) -> np.ndarray:
    import cv2

    picture = np.zeros((120, 120), np.uint8)
    cv2.circle(picture, (centre, centre), radius, 255, -1)
    return cv2.findContours(picture, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)[0][0]


def test_a_circle_fits_its_ellipse_and_a_cross_does_not() -> None:
    import cv2

    picture = np.zeros((120, 120), np.uint8)
    picture[20:100, 50:70] = picture[50:70, 20:100] = 255
    cross = cv2.findContours(picture, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)[0][0]
    assert ellipse_error(circle(30)) < 0.03
    assert ellipse_error(cross) > 0.2
    assert solidity(circle(30)) > 0.95
    assert solidity(cross) < 0.75
    ellipses = fit_ellipses(joined((circle(30), circle(20, 50))))
    assert ellipses.centre_px == pytest.approx(np.array([[60, 60], [50, 50]]), abs=0.3)
    assert ellipses.axes_px == pytest.approx(np.array([[60, 60], [40, 40]]), abs=1.5)


@pytest.mark.parametrize("thick_px", [1, 2, 3])
@pytest.mark.parametrize("end", [(72, 20), (60, 44)])
def test_what_is_hardly_wider_than_a_line_is_the_same_whenever_it_is_looked_at(
    thick_px: int, end: tuple[int, int]
) -> None:
    import cv2

    picture = np.zeros((120, 120), np.uint8)
    cv2.line(picture, (60, 20), end, 255, thick_px)
    outline = cv2.findContours(picture, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)[0][0]
    found = [fit_ellipses(joined((outline,))) for _ in range(6)]
    assert len({(*one.axes_px[0].tolist(), *one.centre_px[0].tolist()) for one in found}) == 1
    assert found[0].axes_px[0, 0] < 1.5 * np.hypot(end[0] - 60, end[1] - 20) + 3.0


def test_the_patch_is_forty_pixels_wide_even_at_the_edge() -> None:
    for view in views(row_of_balls((0.03, 0.035), 0.02)):
        assert view.patch.shape == (40, 40, 3)


def test_points_lie_on_the_ball_and_are_spread_over_it() -> None:
    table = row_of_balls((0.04,), 0.0, height_m=0.6)
    view = seen(table)
    assert 300 <= len(view.points_m) <= 1500
    inner = view.points_m[view.edge_px > 3].astype(float)
    off = np.linalg.norm(inner - table.centres_m()[0], axis=1) - 0.04
    assert np.sqrt(np.mean(off**2)) < 0.0015
    assert view.edge_px.max() == pytest.approx(0.04 * 525 / 0.55, rel=0.2)


def test_every_second_place_of_an_outline_tells_the_same() -> None:
    outlines = joined((circle(9), circle(40), circle(23)))
    thin = outlines.thinned()
    assert [len(one) for one in thin.each] == pytest.approx([len(one) / 2 for one in outlines.each], abs=1)
    for one, all_of_it in zip(thin.each, outlines.each, strict=True):
        assert set(map(tuple, one[:, 0].tolist())) <= set(map(tuple, all_of_it[:, 0].tolist()))
    assert thin.owner[thin.starts].tolist() == [0, 1, 2]
    ellipses = fit_ellipses(outlines)
    assert ellipses.axes_px == pytest.approx(np.array([[18.0] * 2, [80.0] * 2, [46.0] * 2]), abs=1.5)
    assert ellipses.solidity[1:] == pytest.approx(1.0, abs=0.02)
    short = joined((circle(2), circle(40)))
    assert short.thinned() is short
