"""A closed, star-shaped surface: an ellipsoid whose radius harmonics stretch and dent."""

from __future__ import annotations

from dataclasses import dataclass

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

    def radius(self, directions: F64) -> F64:
        """Return |q| of the surface (N,) at unit vectors (N, 3) of the ball's own frame."""
        harmonics = self.basis
        return np.ones(len(directions)) if harmonics is None else np.exp(harmonics(directions) @ self.weights)

    def surface_m(self, count: int = GRID) -> F64:
        """Return points (count, 3) of the surface about its centre."""
        directions = sphere_points(count)
        return np.asarray((directions * self.radius(directions)[:, None]) @ np.linalg.inv(self.matrix).T)

    def volume_m3(self) -> float:
        """Return the enclosed volume: ∫ |q|³/3 dΩ, over det A."""
        return float(4.0 / 3.0 * np.pi * np.mean(self.radius(sphere_points(GRID)) ** 3) / np.linalg.det(self.matrix))


def ball(radius_m: float) -> Shape:
    """Return a sphere."""
    return Shape(np.eye(3) / radius_m, np.zeros(0), 0)
