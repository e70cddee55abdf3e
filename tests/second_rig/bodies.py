"""Solid bodies as implicit functions, with volumes and calliper distances found by numeric integration.

A body lies in its own frame, metres. `value` is negative inside; a step of `slack * value`
along any ray never passes through the surface from outside (sphere tracing).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

F64 = NDArray[np.float64]


class Body(Protocol):
    """What can be rendered and measured."""

    @property
    def radius_m(self) -> float:
        """Radius of a ball about the origin that holds the body."""

    @property
    def shell_m(self) -> F64:
        """Half axes of an ellipsoid about the origin that holds the body."""

    @property
    def slack(self) -> float:
        """Share of `value` that is safe to step."""

    @property
    def surface_m(self) -> F64:
        """Points spread over the surface, (N, 3)."""

    def value(self, points_m: F64) -> F64:
        """Return the implicit function of (N, 3) points."""


@dataclass(frozen=True, slots=True)
class Measures:
    """Truth about a body.

    Attributes:
        centre_m: centre of volume in the body's frame.
        length_m: largest calliper distance.
        diameter_m: largest calliper distance at right angles to that.
    """

    volume_m3: float
    centre_m: F64
    length_m: float
    diameter_m: float


@dataclass(frozen=True, slots=True, eq=False)
class StarBody:
    """A solid of revolution about z given by its polar profile, bent out of round by `warp`.

    Attributes:
        cosines, radii_m: the profile, cos(polar angle) ascending against distance from the origin.
        warp: factors of x², xy, xz and of the five-lobed term, on the unit direction.
    """

    cosines: F64
    radii_m: F64
    warp: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    surface_m: F64 = field(init=False)
    shell_m: F64 = field(init=False)
    slack: float = field(init=False)

    def __post_init__(self) -> None:
        directions, _ = _sphere()
        rho = self.reach(directions)
        object.__setattr__(self, "surface_m", directions * rho[:, None])
        axes = np.abs(self.surface_m).max(axis=0)
        object.__setattr__(self, "shell_m", axes * np.linalg.norm(self.surface_m / axes, axis=1).max() * 1.01)
        turn = np.abs(np.gradient(self.radii_m, np.arccos(self.cosines))) / self.radii_m
        steepest = float(turn[2:-2].max()) + 2.0 * float(np.abs(self.warp).sum()) + 4.0 * abs(self.warp[3])
        object.__setattr__(self, "slack", 0.97 / float(np.hypot(1.0, steepest)))

    @property
    def radius_m(self) -> float:
        """Radius of the ball that holds it."""
        return float(np.linalg.norm(self.surface_m, axis=1).max()) * 1.01

    def reach(self, directions: F64) -> F64:
        """Return the distance of the surface from the origin along unit directions."""
        x, y, z = directions.T
        rho = np.interp(z, self.cosines, self.radii_m).astype(directions.dtype)
        a, b, c, lobes = self.warp
        bend = 1.0 + a * x * x + b * x * y + c * x * z
        if lobes:
            bend = bend + lobes * (16.0 * x**5 - 20.0 * x**3 * (1.0 - z * z) + 5.0 * x * (1.0 - z * z) ** 2)
        return np.asarray(rho * bend)

    def value(self, points_m: F64) -> F64:
        """Return the distance from the origin beyond the surface."""
        distance = np.sqrt(points_m[:, 0] ** 2 + points_m[:, 1] ** 2 + points_m[:, 2] ** 2) + 1e-12
        return np.asarray(distance - self.reach(points_m / distance[:, None]))

    def measures(self) -> Measures:
        """Return volume ∫ρ³/3 dΩ, centre ∫ρ⁴d/4 dΩ / V and calliper distances."""
        directions, weights = _sphere()
        rho = self.reach(directions)
        volume = float(np.sum(weights * rho**3) / 3.0)
        centre = np.asarray((weights * rho**4 / 4.0) @ directions / volume)
        # Two degrees apart and less, and the tips: callipers right within 0.05 mm.
        coarse = np.concatenate([_sphere(60, 60)[0], [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]])
        return Measures(volume, centre, *callipers(coarse * self.reach(coarse)[:, None]))


def revolve(z_m: F64, radius_m: F64, warp: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)) -> StarBody:
    """Return the body whose outline is r(z); the origin is put on the axis at half the volume's height."""
    slices = np.pi * radius_m**2
    middle = float(np.trapezoid(slices * z_m, z_m) / np.trapezoid(slices, z_m))
    z = z_m - middle
    polar = np.arctan2(radius_m, z)
    order = np.argsort(polar)
    angles = np.linspace(0.0, np.pi, 721)
    rho = np.interp(angles, polar[order], np.hypot(z, radius_m)[order])
    return StarBody(np.cos(angles)[::-1].copy(), rho[::-1].copy(), warp)


@dataclass(frozen=True, slots=True, eq=False)
class Solid:
    """Any body given by its function; its truth is counted on a fine grid.

    Attributes:
        function: the implicit function, (N, 3) → (N,).
    """

    function: Callable[[F64], F64]
    radius_m: float
    slack: float = 0.8
    surface_m: F64 = field(init=False)

    @property
    def shell_m(self) -> F64:
        """Half axes of the ball that holds it."""
        return np.full(3, self.radius_m)

    def __post_init__(self) -> None:
        directions, _ = _sphere(24, 48)
        far = directions * self.radius_m
        inward = np.zeros(len(far))
        for _ in range(60):
            inward += self.slack * self.function(far - directions * inward[:, None])
            inward = np.clip(inward, 0.0, 1.999 * self.radius_m)
        object.__setattr__(self, "surface_m", far - directions * inward[:, None])

    def value(self, points_m: F64) -> F64:
        """Return the implicit function."""
        return self.function(points_m)

    def measures(self) -> Measures:
        """Return the truth, by counting cells of about 1/100 of the extent."""
        axis = np.linspace(-self.radius_m, self.radius_m, 101)
        cells = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)
        inside = cells[self.function(cells) < 0.0]
        volume = len(inside) * float(axis[1] - axis[0]) ** 3
        return Measures(volume, inside.mean(axis=0), *callipers(self.surface_m))


def ellipsoid(points: F64, centre: F64, axes: F64) -> F64:
    """Return about the distance of points (N, 3) from an ellipsoid, negative inside."""
    scaled = (points - centre) / axes
    return (np.sqrt(np.einsum("ij,ij->i", scaled, scaled)) - 1.0) * float(axes.min())


def capsule(points: F64, start: F64, end: F64, radius: float) -> F64:
    """Return the distance of points (N, 3) from a rounded rod, negative inside."""
    along = end - start
    share = np.clip((points - start) @ along / float(along @ along), 0.0, 1.0)
    return np.asarray(np.linalg.norm(points - start - share[:, None] * along, axis=1) - radius)


def callipers(surface_m: F64) -> tuple[float, float]:
    """Return the largest calliper distance of points and the largest at right angles to it."""
    from scipy.spatial import ConvexHull

    hull = surface_m[ConvexHull(surface_m).vertices]
    squares = np.sum(hull**2, axis=1)
    gaps = squares[:, None] + squares[None] - 2.0 * hull @ hull.T
    i, j = np.unravel_index(int(np.argmax(gaps)), gaps.shape)
    along = (hull[i] - hull[j]) / np.linalg.norm(hull[i] - hull[j])
    helper = np.eye(3)[int(np.argmin(np.abs(along)))]
    first = np.cross(along, helper) / np.linalg.norm(np.cross(along, helper))
    second = np.cross(along, first)
    turns = np.linspace(0.0, np.pi, 361)
    spread = hull @ (np.outer(first, np.cos(turns)) + np.outer(second, np.sin(turns)))
    return float(np.sqrt(gaps[i, j])), float(np.ptp(spread, axis=0).max())


@lru_cache(maxsize=8)
def _sphere(rows: int = 64, columns: int = 128) -> tuple[F64, F64]:
    """Return unit directions and weights of a Gauss–Legendre × uniform quadrature."""
    z, weight = np.polynomial.legendre.leggauss(rows)
    turn = (np.arange(columns) + 0.5) * 2.0 * np.pi / columns
    across = np.sqrt(1.0 - z * z)
    directions = np.stack(
        [np.outer(across, np.cos(turn)), np.outer(across, np.sin(turn)), np.repeat(z[:, None], columns, axis=1)],
        axis=-1,
    )
    return directions.reshape(-1, 3), np.repeat(weight * 2.0 * np.pi / columns, columns)
