"""A closed, star-shaped surface: an ellipsoid whose radius harmonics stretch and dent."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from fruitgui.frame import F64
from fruitgui.measurement.harmonics import Basis, basis, sphere_points

SIX = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
"""Entries of a symmetric matrix in the order of the unknowns of a stretch."""

GRID = 700
"""Directions at which a surface is evaluated: 4.5° apart, which loses 0.04 % of a calliper."""


@dataclass(frozen=True, slots=True, eq=False)
class Shape:
    """The points p with |q| = exp(g(q/|q|)), where q = A·p: a ball, made an ellipsoid by A, dented by g.

    Attributes:
        matrix: (3, 3) A, 1/m.
        weights: (K,) of g in the harmonics of `degree`, from degree three on (lower ones are A and the centre).
        degree: highest degree of g; below three there is no g.
    """

    matrix: F64
    weights: F64
    degree: int

    @property
    def basis(self) -> Basis | None:
        """The harmonics of g; None for an ellipsoid."""
        return basis(self.degree) if self.degree >= 3 else None

    def surface(self) -> Surface:
        """Evaluate the surface on the grid of directions."""
        return surface(self)


@dataclass(frozen=True, slots=True, eq=False)
class Surface:
    """A shape on the grid of directions.

    Attributes:
        points_m: (GRID, 3) about the centre, in the axes on which the shape's matrix acts.
        radius: (GRID,) |q| of each.
        inverse: (3, 3) A⁻¹.
        harmonics: (GRID, K) of each direction.
    """

    points_m: F64
    radius: F64
    inverse: F64
    harmonics: F64

    def change(self, index: F64 | int, directions: F64) -> F64:
        """Return d(p·direction) (N, 6 + K) by stretch and weights, of grid points (N,) along directions (N, 3).

        Where p is extreme along the direction this is how the extreme changes.
        """
        chosen = np.atleast_1d(np.asarray(index))
        u = sphere_points(GRID)[chosen]
        back = (np.atleast_2d(directions) @ self.inverse) * self.radius[chosen, None]
        change = np.empty((len(chosen), 6 + self.harmonics.shape[1]))
        for k, (i, j) in enumerate(SIX):
            change[:, k] = back[:, i] * u[:, j] if i == j else back[:, i] * u[:, j] + back[:, j] * u[:, i]
        change[:, 6:] = np.sum(back * u, axis=1)[:, None] * self.harmonics[chosen]
        return change


def surface(shape: Shape) -> Surface:
    """Evaluate a shape on the grid of directions."""
    directions = sphere_points(GRID)
    harmonics = grid_harmonics(shape.degree)
    radius = np.exp(harmonics @ shape.weights)
    inverse = np.asarray(np.linalg.inv(shape.matrix), dtype=np.float64)
    return Surface((directions * radius[:, None]) @ inverse.T, radius, inverse, harmonics)


@lru_cache(maxsize=8)
def grid_harmonics(degree: int) -> F64:
    """Return the harmonics (GRID, K) of the grid's directions. Shared; do not write."""
    values = basis(degree)(sphere_points(GRID)) if degree >= 3 else np.zeros((GRID, 0))
    values.setflags(write=False)
    return values


def ball(radius_m: float) -> Shape:
    """Return a sphere."""
    return Shape(np.eye(3) / radius_m, np.zeros(0), 0)
