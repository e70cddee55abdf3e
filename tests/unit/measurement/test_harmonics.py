from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fruitgui.frame import F64
from fruitgui.measurement.harmonics import basis, sphere_points


@pytest.mark.parametrize("degree", [3, 4, 6])
def test_harmonics_are_orthonormal_over_the_sphere(degree: int) -> None:
    harmonics = basis(degree)
    values = harmonics(sphere_points(6000))
    # Fibonacci's lattice integrates products of degree 12 to about 1e-4
    assert np.abs(values.T @ values / 6000 - np.eye(values.shape[1])).max() < 1e-3
    assert len(harmonics.degree) == (degree + 1) ** 2 - 9


def test_harmonics_agree_with_scipy() -> None:
    from scipy.special import sph_harm_y

    directions = sphere_points(50)
    polar, azimuth = np.arccos(directions[:, 2]), np.arctan2(directions[:, 1], directions[:, 0])
    harmonics = basis(5)
    values = harmonics(directions)
    for column, (n, m) in enumerate(zip(harmonics.degree, harmonics.order, strict=True)):
        complex_value = sph_harm_y(n, abs(m), polar, azimuth) * np.sqrt(4 * np.pi) * (1.0 if m == 0 else np.sqrt(2))
        expected = complex_value.imag if m < 0 else complex_value.real
        assert min(np.abs(values[:, column] - expected).max(), np.abs(values[:, column] + expected).max()) < 1e-9


def test_zonal_harmonics_do_not_change_about_the_axis() -> None:
    harmonics = basis(6)
    polar = np.array([0.3, 1.1, 2.0])
    for azimuth in (0.0, 1.0, 2.5):
        u = np.stack([np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)], axis=1)
        zonal = harmonics(u)[:, harmonics.order == 0]
        if azimuth == 0.0:
            first = zonal
        assert np.allclose(zonal, first, atol=1e-9)


@given(st.integers(0, 2**32 - 1))
def test_slope_is_the_derivative_along_the_sphere(seed: int) -> None:
    rng = np.random.default_rng(seed)
    harmonics = basis(6)
    weights = rng.normal(size=len(harmonics.degree)) * 0.05
    u = rng.normal(size=(5, 3))
    u /= np.linalg.norm(u, axis=1, keepdims=True)
    along = rng.normal(size=(5, 3))
    along -= np.sum(along * u, axis=1, keepdims=True) * u
    step = 1e-4

    def level(points: F64) -> F64:
        return harmonics(points / np.linalg.norm(points, axis=1, keepdims=True)) @ weights

    value, slope = harmonics.with_slope(u.T.astype(np.float64), weights)
    numeric = (level(u + step * along) - level(u - step * along)) / (2 * step)
    assert np.allclose(value, level(u), atol=1e-5)
    assert np.allclose(np.sum(slope.T * along, axis=1), numeric, atol=2e-3)
    assert np.allclose(np.sum(slope.T * u, axis=1), 0.0, atol=1e-4)
