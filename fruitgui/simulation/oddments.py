"""More things that nobody trains: bottle, twig, banana, two fingers, a sheet of paper. Tubes along a path, mostly."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from numpy.random import Generator

from fruitgui.frame import F32, F64, Ints
from fruitgui.simulation.fruit import sphere
from fruitgui.simulation.light import linear
from fruitgui.simulation.mesh import Mesh

_AROUND = 32
_ALONG = 48


def bottle(rng: Generator) -> Mesh:
    """Return a small bottle with a neck and a cap of another colour."""
    along = np.linspace(-1.0, 1.0, _ALONG)
    half_m, wide_m = rng.uniform(0.060, 0.085), rng.uniform(0.024, 0.034)
    neck = 0.5 * (1.0 + np.tanh((along - rng.uniform(0.35, 0.5)) / 0.08))
    radius = wide_m * (1.0 - rng.uniform(0.5, 0.65) * neck) * _closing(along, 40)
    path = np.stack([half_m * along, 0.0 * along, 0.0 * along], axis=1)
    mesh = _tube(path, radius, rng.uniform(0.1, 0.9, 3), 0.01, rng, gloss=0.3)
    mesh.albedo[mesh.vertices_m[:, 0] > 0.8 * half_m] = linear(rng.uniform(0.1, 0.9, 3))
    return mesh


def twig(rng: Generator) -> Mesh:
    """Return a bent twig, as thick as a pencil."""
    along = np.linspace(-1.0, 1.0, _ALONG)
    half_m = rng.uniform(0.05, 0.11)
    bends = rng.normal(0.0, 0.10, (2, 2)) * half_m
    path = np.stack([half_m * along, *(bend[0] * along**2 + bend[1] * along**3 for bend in bends)], axis=1)
    radius = rng.uniform(0.003, 0.006) * (1.0 - 0.25 * along) * _closing(along, 60)
    return _tube(path, radius, np.array([0.36, 0.26, 0.17]) * rng.uniform(0.7, 1.4), 0.1, rng)


def banana(rng: Generator) -> Mesh:
    """Return a banana: a fruit, bent, that nobody trained."""
    along = np.linspace(-1.0, 1.0, _ALONG)
    turn, bow_m = rng.uniform(0.5, 0.8), rng.uniform(0.09, 0.13)
    path = np.stack([bow_m * np.sin(turn * along), bow_m * np.cos(turn * along), 0.0 * along], axis=1)
    radius = rng.uniform(0.016, 0.021) * (1.0 - 0.45 * np.abs(along) ** 3) * _closing(along, 30)
    return _tube(path, radius, np.array([0.92, 0.78, 0.22]) * rng.uniform(0.9, 1.05), 0.05, rng)


def fingers(rng: Generator) -> Mesh:
    """Return two fingers that part from one knuckle, as a hand that reaches for something shows them."""
    along = np.linspace(-1.0, 1.0, _ALONG)
    half_m, thick_m = rng.uniform(0.035, 0.048), rng.uniform(0.0075, 0.0105)
    skin = np.array([0.80, 0.58, 0.46]) * rng.uniform(0.45, 1.05)
    spread = rng.uniform(0.0, 0.2)
    parts = [_knuckle(half_m, thick_m, skin, rng)]
    for side in (-1.0, 1.0):
        aside = side * (1.05 * thick_m + 0.5 * spread * half_m * (1.0 + along))
        path = np.stack([half_m * along, aside, 0.0 * along], axis=1)
        parts.append(_tube(path, thick_m * _closing(along, 12), skin, 0.03, rng))
    starts = np.cumsum([0, *(len(part.vertices_m) for part in parts[:-1])]).tolist()
    return Mesh(
        np.concatenate([part.vertices_m for part in parts]),
        np.concatenate([part.triangles + start for part, start in zip(parts, starts, strict=True)]),
        np.concatenate([part.albedo for part in parts]),
    )


def _knuckle(half_m: float, thick_m: float, skin: F64, rng: Generator) -> Mesh:
    """Return what both fingers grow from, a part of either inside it."""
    directions, triangles = sphere(4)
    body = directions * np.array([1.6, 2.3, 1.05]) * thick_m - [half_m, 0.0, 0.0]
    return Mesh(body, triangles, _plain(skin, len(body), rng, 0.03))


def sheet(rng: Generator) -> Mesh:
    """Return a sheet of paper, a little bowed, printed in one place."""
    directions, triangles = sphere(5)
    longest = np.abs(directions[:, :2]).max(axis=1, keepdims=True)
    reach = np.linalg.norm(directions[:, :2], axis=1, keepdims=True)
    square = directions[:, :2] * np.where(longest > 1e-9, reach / np.maximum(longest, 1e-9), 0.0)
    half = rng.uniform((0.04, 0.03), (0.08, 0.06))
    flat = square * half
    bow = rng.uniform(0.0, 2.5, 2)
    body = np.column_stack([flat, 0.0008 * directions[:, 2] + flat**2 @ bow])
    albedo = _plain(np.full(3, rng.uniform(0.85, 0.97)), len(body), rng, 0.01)
    albedo[np.all(np.abs(square - rng.uniform(-0.4, 0.4, 2)) < 0.25, axis=1)] = linear(rng.uniform(0.05, 0.6, 3))
    return Mesh(body, triangles, albedo)


ODDMENTS: Mapping[str, Callable[[Generator], Mesh]] = {
    "bottle": bottle,
    "twig": twig,
    "banana": banana,
    "fingers": fingers,
    "sheet": sheet,
}
"""Makers by kind."""


def _closing(along: F64, power: int) -> F64:
    """Return a factor that rounds a tube off at both ends, ±1."""
    return np.asarray(np.sqrt(np.maximum(1.0 - np.abs(along) ** power, 1e-6)))


def _tube(path_m: F64, radius_m: F64, srgb: F64, grain: float, rng: Generator, gloss: float = 0.0) -> Mesh:
    """Return the closed tube about a path (K, 3) that runs along x, its radii (K,)."""
    turn = np.arange(_AROUND) * 2.0 * np.pi / _AROUND
    tangent = np.gradient(path_m, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    up = np.cross(tangent, np.cross(np.array([0.0, 0.0, 1.0]), tangent))
    up /= np.linalg.norm(up, axis=1, keepdims=True)
    ring = np.cos(turn)[None, :, None] * up[:, None] + np.sin(turn)[None, :, None] * np.cross(tangent, up)[:, None]
    around = (path_m[:, None] + radius_m[:, None, None] * ring).reshape(-1, 3)
    vertices = np.concatenate([around, path_m[[0, -1]]])
    return Mesh(vertices, _tube_triangles(len(path_m)), _plain(srgb, len(vertices), rng, grain), gloss)


def _tube_triangles(rings: int) -> Ints:
    here = np.arange(_AROUND)
    after = (here + 1) % _AROUND
    start, end = rings * _AROUND, rings * _AROUND + 1
    last = (rings - 1) * _AROUND
    parts = [np.stack([np.full(_AROUND, start), after, here], axis=1)]
    for low in range(0, last, _AROUND):
        high = low + _AROUND
        parts.append(np.stack([low + here, low + after, high + after], axis=1))
        parts.append(np.stack([low + here, high + after, high + here], axis=1))
    parts.append(np.stack([np.full(_AROUND, end), last + here, last + after], axis=1))
    return np.concatenate(parts)


def _plain(srgb: F64, count: int, rng: Generator, grain: float) -> F32:
    return linear(np.clip(srgb * (1 + grain * rng.normal(size=(count, 1))), 0.02, 0.97))
