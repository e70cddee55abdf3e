from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fruitgui.geometry.rotation import rotation_from_vector
from fruitgui.measurement.callipers import Extent, length_and_diameter, perimeter, volume
from fruitgui.measurement.harmonics import basis
from fruitgui.measurement.shape import SIX, Shape, Surface, ball

AXES = st.tuples(*[st.floats(0.02, 0.06)] * 3)
TURN = st.tuples(*[st.floats(-3.0, 3.0)] * 3)


@given(AXES, TURN)
def test_ellipsoids_have_the_sizes_of_their_formulas(
    axes: tuple[float, float, float], turn: tuple[float, float, float]
) -> None:
    shape = Shape(np.diag(1 / np.array(axes)) @ rotation_from_vector(np.array(turn)).T, np.zeros(0), 0)
    surface = shape.surface()
    assert volume(surface).value == pytest.approx(4 / 3 * np.pi * np.prod(axes), rel=1e-9)
    length, diameter = length_and_diameter(surface)
    # a grid 4.5° apart misses the tips by at most (0.04)² / 2 · (a/c)² of the size
    assert length.value == pytest.approx(2 * max(axes), rel=8e-3)
    assert 2 * min(axes) * 0.99 <= diameter.value <= 2 * max(axes)
    if max(axes) > 1.2 * sorted(axes)[1]:
        assert diameter.value == pytest.approx(2 * sorted(axes)[1], rel=2e-2)


def test_perimeter_of_a_lying_spheroid_is_the_ellipses() -> None:
    shape = Shape(np.diag(1 / np.array([0.05, 0.03, 0.03])), np.zeros(0), 0)
    from fruitgui.perception.paper import ellipse_perimeter

    assert perimeter(shape.surface()).value == pytest.approx(ellipse_perimeter(0.05, 0.03), rel=4e-3)


@given(st.integers(0, 2**32 - 1))
def test_gradients_tell_how_sizes_change(seed: int) -> None:
    rng = np.random.default_rng(seed)
    degree = 4
    weights = rng.normal(size=len(basis(degree).degree)) * 0.003
    body = rotation_from_vector(rng.normal(size=3))
    shape = Shape(np.diag(1 / np.array([0.05, 0.034, 0.03])) @ body.T, weights, degree)
    change = rng.normal(size=6 + len(weights)) * 5e-4
    stretch = np.zeros((3, 3))
    for value, (i, j) in zip(change[:6], SIX, strict=True):
        stretch[i, j] = stretch[j, i] = value
    moved = Shape(np.linalg.solve(np.eye(3) + stretch, shape.matrix), weights + change[6:], degree)
    # second order in the step
    for size, grid in ((volume, 1e-4), (perimeter, 3e-4)):
        before, after = size(shape.surface()), size(moved.surface())
        expected = before.gradient @ change
        assert after.value - before.value == pytest.approx(expected, rel=0.1, abs=grid * before.value)
    # The length is the largest of many chords: it lies above its tangent, but for the grid's next point, (0.04)² / 2.
    # Where two chords tie it may lie above by as much as any chord changes: it has a kink there, not a gradient.
    before, after = _length(shape.surface()), _length(moved.surface())
    gain, expected = after.value - before.value, before.gradient @ change
    most = np.linalg.norm(stretch, 2) + 2.0 * np.abs(change[6:]).sum()
    assert expected - 4e-3 * before.value <= gain <= most * before.value


def _length(surface: Surface) -> Extent:
    return length_and_diameter(surface)[0]


def test_ball() -> None:
    length, diameter = length_and_diameter(ball(0.04).surface())
    assert length.value == pytest.approx(0.08, rel=2e-3)
    assert diameter.value == pytest.approx(0.08, rel=2e-3)
