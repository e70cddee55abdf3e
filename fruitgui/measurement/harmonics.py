"""Real spherical harmonics as polynomials of a unit vector, values and slopes at thousands of points at once.

A harmonic of degree l restricted to the sphere is a polynomial of degree l. The
homogeneous monomials of degrees L and L − 1 together span all harmonics up to
L, so one table of monomials and one small matrix serve all of them, and the
gradient is another small matrix over the same table (x² + y² + z² = 1 raises
the derivative's degree back by two).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TypeVar

import numpy as np

from fruitgui.frame import F32, F64, Ints

Real = TypeVar("Real", F32, F64)


@dataclass(frozen=True, slots=True, eq=False)
class Basis:
    """Harmonics of the chosen degrees, each with a mean square of one over the sphere.

    Attributes:
        powers: (M, 3) exponents of x, y, z of the monomials.
        matrix: (M, K) from monomials to harmonics.
        slope: three (M, K), from monomials to the tangential derivative along x, y, z.
        degree: (K,) degree l of each harmonic.
        order: (K,) order m, negative for the sine kind; 0 turns about the z axis unchanged.
    """

    powers: Ints
    matrix: F64
    slope: tuple[F64, F64, F64]
    degree: Ints
    order: Ints

    def monomials(self, directions: Real) -> Real:
        """Return the table of monomials (M, N) at unit vectors (3, N), in their precision."""
        top = int(self.powers.max())
        x, y, z = (_powers(axis, top) for axis in directions)
        table = np.empty((len(self.powers), directions.shape[1]), dtype=directions.dtype)
        for row, (i, j, k) in zip(table, self.powers.tolist(), strict=True):
            np.multiply(x[i], y[j], out=row)
            row *= z[k]
        return table

    def __call__(self, directions: F64) -> F64:
        """Return the harmonics (N, K) at unit vectors (N, 3)."""
        return np.asarray(self.monomials(np.ascontiguousarray(directions.T)).T @ self.matrix)

    def with_slope(self, directions: F32, weights: F64, harmonics: F32 | None = None) -> tuple[F32, F32]:
        """Return, at unit vectors (3, N), the weighted sum g (N,) of the harmonics and the slope of g (3, N).

        Where `harmonics` (K, N) is given, they are written into it.
        """
        monomials = self.monomials(directions)
        sums = np.column_stack([self.matrix @ weights, *(slope @ weights for slope in self.slope)])
        level, *along = sums.T.astype(np.float32) @ monomials
        if harmonics is not None:
            np.matmul(self.matrix.T.astype(np.float32), monomials, out=harmonics)
        slope: F32 = np.stack(along)
        slope -= (slope * directions).sum(axis=0) * directions
        return level, slope


def _powers(values: Real, top: int) -> list[Real]:
    powers = [np.ones_like(values)]
    for _ in range(top):
        powers.append(powers[-1] * values)
    return powers


@lru_cache(maxsize=8)
def basis(degree: int) -> Basis:
    """Return the harmonics of degrees 3 to `degree`; an ellipsoid has those below."""
    powers = np.array([(i, j, n - i - j) for n in (degree, degree - 1) for i in range(n + 1) for j in range(n + 1 - i)])
    sphere = sphere_points(1200)
    wanted = [(n, m) for n in range(3, degree + 1) for m in range(-n, n + 1)]
    values = np.stack([_harmonic(n, m, sphere) for n, m in wanted], axis=1)
    matrix = np.asarray(np.linalg.lstsq(_table(powers, sphere), values, rcond=None)[0], dtype=np.float64)
    slopes = [_tangential(powers, matrix, axis, sphere) for axis in range(3)]
    orders = np.array(wanted)
    return Basis(powers, matrix, (slopes[0], slopes[1], slopes[2]), orders[:, 0], orders[:, 1])


def _table(powers: Ints, points: F64) -> F64:
    return np.asarray(np.prod(points[:, None, :] ** powers[None], axis=2))


def _tangential(powers: Ints, matrix: F64, axis: int, sphere: F64) -> F64:
    """Return the matrix over monomials (M, K) of the derivative along one axis.

    It is that of the harmonic extended off the sphere without change along the
    radius, up to the multiple of the unit vector that the caller takes away.
    The derivative has degree l − 1: within the span of the same monomials.
    """
    lowered = powers.copy()
    lowered[:, axis] -= 1
    factor = np.where(powers[:, axis] > 0, powers[:, axis], 0).astype(np.float64)
    derivative = (_table(np.maximum(lowered, 0), sphere) * factor) @ matrix
    return np.asarray(np.linalg.lstsq(_table(powers, sphere), derivative, rcond=None)[0])


def _harmonic(n: int, m: int, directions: F64) -> F64:
    """Return one real harmonic (N,), mean square one, by the recursion of associated Legendre functions."""
    x, y, z = directions.T
    planar = (x + 1j * y) ** abs(m)
    legendre = _legendre(n, abs(m), z)
    values = legendre * (planar.imag if m < 0 else planar.real)
    return np.asarray(values / np.sqrt(_mean_square(n, abs(m))))


def _legendre(n: int, m: int, z: F64) -> F64:
    """Return P_n^m(z) / (1 − z²)^(m/2), (N,)."""
    before, here = np.zeros_like(z), np.full_like(z, np.prod(np.arange(1, 2 * m, 2.0)))
    for k in range(m + 1, n + 1):
        before, here = here, ((2 * k - 1) * z * here - (k + m - 1) * before) / (k - m)
    return here


def _mean_square(n: int, m: int) -> float:
    ratio = np.prod(np.arange(n - m + 1, n + m + 1, dtype=np.float64))
    return float(ratio / (2 * n + 1) / (1 if m == 0 else 2))


@lru_cache(maxsize=8)
def sphere_points(count: int) -> F64:
    """Return `count` unit vectors spread evenly (Fibonacci's lattice), symmetric in no plane. Shared; do not write."""
    k = np.arange(count) + 0.5
    z = 1.0 - 2.0 * k / count
    azimuth = np.pi * (1.0 + np.sqrt(5.0)) * k
    radius = np.sqrt(1.0 - z**2)
    points = np.stack([radius * np.cos(azimuth), radius * np.sin(azimuth), z], axis=1)
    points.setflags(write=False)
    return points
