"""Sizes of a closed surface and how they change with its unknowns."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from fruitgui.frame import F64
from fruitgui.measurement.harmonics import sphere_points
from fruitgui.measurement.shape import Surface

ACROSS = 60
"""Directions over half a turn at right angles to the length: 3° apart."""


@dataclass(frozen=True, slots=True, eq=False)
class Extent:
    """A size and how it changes.

    Attributes:
        value: metres, or m³.
        gradient: (6 + K,) by the stretch and the harmonics' weights of the surface.
        direction: (3,) of a calliper.
    """

    value: float
    gradient: F64
    direction: F64 | None = None


def volume(surface: Surface) -> Extent:
    """Return the enclosed volume, m³: ∫ |q|³/3 dΩ, times det A⁻¹."""
    cubes = surface.radius**3
    value = float(4.0 / 3.0 * np.pi * cubes.mean() * abs(np.linalg.det(surface.inverse)))
    gradient = np.zeros(6 + surface.harmonics.shape[1])
    gradient[:3] = value
    gradient[6:] = 3.0 * value * (cubes @ surface.harmonics) / cubes.sum()
    return Extent(value, gradient)


def length_and_diameter(surface: Surface) -> tuple[Extent, Extent]:
    """Return the largest calliper distance, and the largest at right angles to it, metres."""
    longest = _longest(surface.points_m)
    across = _ring(longest, ACROSS)
    along = surface.points_m @ across.T
    widest = across[int(np.argmax(along.max(axis=0) - along.min(axis=0)))]
    value, gradient = _widths(surface, np.stack([longest, widest]))
    return Extent(float(value[0]), gradient[0], longest), Extent(float(value[1]), gradient[1], widest)


def perimeter(surface: Surface, count: int = 24) -> Extent:
    """Return the perimeter of the outline projected along the belt's normal (z), metres.

    By Cauchy: the mean width over all directions, times π (of the outline's hull).
    """
    value, gradient = _widths(surface, _ring(np.array([0.0, 0.0, 1.0]), count))
    return Extent(float(np.pi * value.mean()), np.pi * gradient.mean(axis=0))


def _widths(surface: Surface, directions: F64) -> tuple[F64, F64]:
    """Return the calliper distances (N,) along unit vectors (N, 3) and their gradients (N, 6 + K)."""
    along = surface.points_m @ directions.T
    top, bottom = along.argmax(axis=0), along.argmin(axis=0)
    column = np.arange(len(directions))
    gradient = surface.change(top, directions) - surface.change(bottom, directions)
    return np.asarray(along[top, column] - along[bottom, column]), gradient


@lru_cache(maxsize=2)
def _half_sphere(count: int) -> F64:
    points = sphere_points(2 * count)
    return np.ascontiguousarray(points[points[:, 2] > 0])


def _longest(points_m: F64) -> F64:
    """Return the direction of the largest calliper: the best of many, then along its two extreme points."""
    directions = _half_sphere(150)
    along = points_m @ directions.T
    best = directions[int(np.argmax(along.max(axis=0) - along.min(axis=0)))]
    for _ in range(3):
        along_best = points_m @ best
        chord = points_m[int(np.argmax(along_best))] - points_m[int(np.argmin(along_best))]
        best = chord / np.linalg.norm(chord)
    return np.asarray(best)


def _ring(axis: F64, count: int) -> F64:
    """Return unit vectors (count, 3) over half a turn at right angles to an axis."""
    helper = np.eye(3)[int(np.argmin(np.abs(axis)))]
    first = np.cross(axis, helper)
    first /= np.linalg.norm(first)
    second = np.cross(axis, first)
    angle = np.arange(count) * (np.pi / count)
    return np.asarray(np.cos(angle)[:, None] * first + np.sin(angle)[:, None] * second)
