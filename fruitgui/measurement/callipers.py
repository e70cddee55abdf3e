"""Sizes of a closed surface and how they change with its unknowns."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from fruitgui.frame import F64
from fruitgui.measurement.harmonics import sphere_points
from fruitgui.measurement.shape import GRID, SIX, Shape



@dataclass(frozen=True, slots=True, eq=False)
class Extent:
    """A size and its gradient (6 + K,) by the stretch and the harmonics' weights of the surface."""

    value: float
    gradient: F64


def volume(shape: Shape) -> Extent:
    """Return the volume, m³."""
    directions = sphere_points(GRID)
    cubes = shape.radius(directions) ** 3
    value = shape.volume_m3()
    gradient = np.zeros(6 + len(shape.weights))
    gradient[:3] = value
    if shape.basis is not None:
        gradient[6:] = 3.0 * value * (cubes @ _grid_harmonics(shape.degree)) / cubes.sum()
    return Extent(value, gradient)


@lru_cache(maxsize=8)
def _grid_harmonics(degree: int) -> F64:
    from fruitgui.measurement.harmonics import basis

    return basis(degree)(sphere_points(GRID))


@lru_cache(maxsize=2)
def _half_sphere(count: int) -> F64:
    points = sphere_points(2 * count)
    return np.ascontiguousarray(points[points[:, 2] > 0])


def support_change(shape: Shape, index: int, direction: F64) -> F64:
    """Return d(p·direction) (6 + K,) of the grid's surface point `index`, where p is extreme along `direction`."""
    u = sphere_points(GRID)[index]
    harmonics = None if shape.basis is None else _grid_harmonics(shape.degree)[index]
    radius = 1.0 if harmonics is None else float(np.exp(harmonics @ shape.weights))
    back = np.linalg.solve(shape.matrix.T, direction) * radius
    change = np.zeros(6 + len(shape.weights))
    for k, (i, j) in enumerate(SIX):
        change[k] = back[i] * u[j] if i == j else back[i] * u[j] + back[j] * u[i]
    if harmonics is not None:
        change[6:] = (back @ u) * harmonics
    return change


def _width(shape: Shape, surface_m: F64, direction: F64) -> Extent:
    along = surface_m @ direction
    top, bottom = int(np.argmax(along)), int(np.argmin(along))
    gradient = support_change(shape, top, direction) - support_change(shape, bottom, direction)
    return Extent(float(along[top] - along[bottom]), gradient)


def length_and_diameter(shape: Shape) -> tuple[Extent, Extent]:
    """Return the largest calliper distance, and the largest at right angles to it, metres."""
    surface = shape.surface_m()
    longest = _longest(surface)
    across = _ring(longest, 60)
    along = surface @ across.T
    widest = across[int(np.argmax(along.max(axis=0) - along.min(axis=0)))]
    return _width(shape, surface, longest), _width(shape, surface, widest)


def _longest(surface_m: F64) -> F64:
    """Return the direction of the largest calliper: the best of many, then along its two extreme points."""
    directions = _half_sphere(150)
    along = surface_m @ directions.T
    best = directions[int(np.argmax(along.max(axis=0) - along.min(axis=0)))]
    for _ in range(3):
        along_best = surface_m @ best
        chord = surface_m[int(np.argmax(along_best))] - surface_m[int(np.argmin(along_best))]
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


def perimeter(shape: Shape, count: int = 24) -> Extent:
    """Return the perimeter of the outline projected along the belt's normal, metres.

    By Cauchy: the mean width over all directions, times π (of the outline's hull).
    """
    surface = shape.surface_m()
    widths = [_width(shape, surface, direction) for direction in _ring(np.array([0.0, 0.0, 1.0]), count)]
    value = np.pi * float(np.mean([w.value for w in widths]))
    return Extent(value, np.pi * np.mean([w.gradient for w in widths], axis=0))
