"""Meshes: closed, outward, and measured as analytic bodies are."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fruitgui.simulation.foreign import FOREIGN, box_of
from fruitgui.simulation.fruit import RECIPES, ball, grow, sphere
from fruitgui.simulation.mesh import Mesh, callipers, outline_length_m
from fruitgui.simulation.oddments import ODDMENTS

HALF_AXES = st.tuples(*[st.floats(0.01, 0.08)] * 3)
UP = np.array([0.0, 0.0, 1.0])


def ellipsoid(half_axes_m: tuple[float, float, float]) -> Mesh:
    directions, triangles = sphere(4)
    return Mesh(directions * np.array(half_axes_m), triangles, np.ones((len(directions), 3), np.float32))


@given(HALF_AXES)
@settings(max_examples=20, deadline=None)
def test_the_volume_of_an_ellipsoid_is_known(half_axes_m: tuple[float, float, float]) -> None:
    exact = 4 / 3 * np.pi * np.prod(half_axes_m)
    # 5120 facets of a sphere lie inside it: their edges span 4.0°, which costs 0.22 % of the volume
    assert ellipsoid(half_axes_m).volume_m3() == pytest.approx(exact, rel=0.003)
    assert ellipsoid(half_axes_m).volume_m3() < exact


@given(HALF_AXES)
@settings(max_examples=20, deadline=None)
def test_length_and_diameter_are_the_two_largest_axes(half_axes_m: tuple[float, float, float]) -> None:
    size = callipers(ellipsoid(half_axes_m))
    _, middle, longest = sorted(half_axes_m)
    # no vertex need lie on an axis: facets span 4°, so a tip may be missed by 1 − cos 2°
    assert size.length_m == pytest.approx(2 * longest, rel=0.002)
    # of two nearly equal axes the length's direction is loose, never its size
    assert size.diameter_m == pytest.approx(2 * middle, rel=0.004)


@given(HALF_AXES)
@settings(max_examples=20, deadline=None)
def test_the_outline_of_an_ellipsoid_is_an_ellipse(half_axes_m: tuple[float, float, float]) -> None:
    a, b, _ = half_axes_m
    h = ((a - b) / (a + b)) ** 2
    ramanujan = np.pi * (a + b) * (1 + 3 * h / (10 + np.sqrt(4 - 3 * h)))
    assert outline_length_m(ellipsoid(half_axes_m), UP) == pytest.approx(ramanujan, rel=0.004)


def test_a_box_is_measured_exactly() -> None:
    size_m = np.array([0.12, 0.08, 0.05])
    mesh = box_of(size_m, np.random.default_rng(0))
    assert mesh.volume_m3() == pytest.approx(size_m.prod(), rel=1e-12)
    assert callipers(mesh).length_m == pytest.approx(np.linalg.norm(size_m), rel=1e-9)
    # corners are cut between two of 720 directions: at most four times 1.2 mm
    assert outline_length_m(mesh, UP) == pytest.approx(0.40, abs=2e-3)
    np.testing.assert_allclose(mesh.centre_m(), 0, atol=1e-12)


@pytest.mark.parametrize("kind", [*RECIPES, *FOREIGN, *ODDMENTS])
def test_every_body_is_closed_outward_and_centred(kind: str) -> None:
    for seed in range(2):
        rng = np.random.default_rng(seed)
        mesh = grow(kind, rng) if kind in RECIPES else {**FOREIGN, **ODDMENTS}[kind](rng).centred()
        # weld corners that lie on each other (the faces of a box), then each edge is walked once each way
        _, weld = np.unique(np.round(mesh.vertices_m, 9), axis=0, return_inverse=True)
        corners = weld.ravel()[mesh.triangles]
        start, end = corners.ravel(), np.roll(corners, -1, axis=1).ravel()
        walked = np.sort(start * corners.max() * 2 + end)
        assert (np.diff(walked) > 0).all()
        np.testing.assert_array_equal(walked, np.sort(end * corners.max() * 2 + start))
        assert mesh.volume_m3() > 1e-6
        np.testing.assert_allclose(mesh.centre_m(), 0, atol=1e-9)
        assert mesh.albedo.min() >= 0
        assert mesh.albedo.max() <= 1


@pytest.mark.parametrize(
    ("kind", "ml", "long_mm"),
    [
        ("lemon", (60, 230), (55, 110)),
        ("red_apple", (110, 330), (60, 95)),
        ("green_apple", (100, 320), (60, 95)),
        ("chilean_avocado", (110, 350), (68, 125)),
        ("peruvian_avocado", (190, 480), (85, 150)),
        ("orange", (120, 340), (60, 95)),
        ("pear", (100, 330), (70, 130)),
    ],
)
def test_fruit_have_the_sizes_of_their_kind_and_vary(
    kind: str, ml: tuple[float, float], long_mm: tuple[float, float]
) -> None:
    grown = [grow(kind, np.random.default_rng(seed)) for seed in range(15)]
    volumes_ml = np.array([mesh.volume_m3() for mesh in grown]) * 1e6
    lengths_mm = np.array([callipers(mesh).length_m for mesh in grown]) * 1e3
    assert ml[0] < volumes_ml.min()
    assert volumes_ml.max() < ml[1]
    assert long_mm[0] < lengths_mm.min()
    assert lengths_mm.max() < long_mm[1]
    assert volumes_ml.std() / volumes_ml.mean() > 0.1


def test_the_two_avocados_differ_and_overlap() -> None:
    small = np.array([grow("chilean_avocado", np.random.default_rng(s)).volume_m3() for s in range(25)])
    large = np.array([grow("peruvian_avocado", np.random.default_rng(s)).volume_m3() for s in range(25)])
    assert large.mean() > 1.2 * small.mean()
    assert small.max() > large.min()


def test_a_scaled_and_turned_body_keeps_its_shape() -> None:
    mesh = ball(0.03, (1.0, 0.5, 0.0)).scaled_to(200e-6)
    assert mesh.volume_m3() == pytest.approx(200e-6, rel=1e-12)
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    assert mesh.turned(turn).volume_m3() == pytest.approx(200e-6, rel=1e-9)
