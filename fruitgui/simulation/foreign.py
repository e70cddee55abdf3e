"""Things that do not belong on the belt: hand, leaf, box, stone, cup. Closed meshes of known volume."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from numpy.random import Generator

from fruitgui.frame import F32, F64, Ints
from fruitgui.simulation.fruit import sphere, waves
from fruitgui.simulation.light import linear
from fruitgui.simulation.mesh import Mesh


def hand(rng: Generator) -> Mesh:
    """Return a flat hand with five spread fingers and a stub of the forearm."""
    azimuth, polar, triangles = _globe(240, 48)
    fingers = np.deg2rad(np.array([-62.0, -24.0, -8.0, 8.0, 24.0]) + rng.normal(0, 2, 5))
    reach = np.array([0.060, 0.095, 0.105, 0.098, 0.080]) * rng.uniform(0.9, 1.1)
    outline = np.full_like(azimuth, 0.045)
    for angle, finger in zip(fingers, reach, strict=True):
        off = (azimuth - angle + np.pi) % (2 * np.pi) - np.pi
        outline = np.maximum(outline, 0.045 + (finger - 0.010) * np.exp(-((off / 0.085) ** 4)))
    arm = (azimuth - np.pi + np.pi) % (2 * np.pi) - np.pi
    outline = np.maximum(outline, 0.045 + 0.13 * np.exp(-((arm / 0.30) ** 6)))
    thick = rng.uniform(0.012, 0.018)
    level = np.sign(np.cos(polar)) * np.abs(np.cos(polar)) ** 0.6
    across = np.sin(polar) ** 0.6
    vertices = np.stack([outline * across * np.cos(azimuth), outline * across * np.sin(azimuth), thick * level], axis=1)
    tone = np.array([0.80, 0.58, 0.46]) * rng.uniform(0.45, 1.05)
    return Mesh(vertices, triangles, _plain(tone, len(vertices), rng, 0.03))


def leaf(rng: Generator) -> Mesh:
    """Return a curled leaf, a few millimetres thick."""
    directions, triangles = sphere(4)
    x, y, z = directions.T
    half = np.array([rng.uniform(0.035, 0.060), rng.uniform(0.015, 0.028), rng.uniform(0.001, 0.002)])
    body = directions * half * np.stack([np.ones_like(x), 1 - 0.3 * x**2, np.ones_like(z)], axis=1)
    curl = rng.uniform(1.5, 6.0, 2) * np.array([1.0, 1.5])
    body[:, 2] += curl[0] * body[:, 0] ** 2 + curl[1] * body[:, 1] ** 2
    tone = np.array([0.24, 0.42, 0.14]) * rng.uniform(0.7, 1.3, 3)
    return Mesh(
        body, triangles, _plain(tone, len(body), rng, 0.06) * (0.9 + 0.1 * np.cos(40 * y))[:, None].astype("f4")
    )


def box(rng: Generator) -> Mesh:
    """Return a carton with a printed pattern."""
    return box_of(rng.uniform((0.06, 0.05, 0.03), (0.14, 0.10, 0.09)), rng)


def box_of(size_m: F64, rng: Generator) -> Mesh:
    """Return a carton of the given edges (3,), metres."""
    vertices, triangles = _cube(10)
    albedo = _plain(rng.uniform(0.25, 0.9, 3), len(vertices), rng, 0.02)
    printed = np.all(np.abs(vertices[:, :2] - rng.uniform(-0.2, 0.2, 2)) < rng.uniform(0.15, 0.4, 2), axis=1)
    albedo[printed] = linear(rng.uniform(0.1, 0.9, 3))
    return Mesh(vertices * size_m, triangles, albedo)


def stone(rng: Generator) -> Mesh:
    """Return a rough stone."""
    directions, triangles = sphere(4)
    rough = 1 + waves(directions, rng, 0.09, 1.0, 5.0) + waves(directions, rng, 0.02, 6.0, 14.0)
    half = rng.uniform(0.022, 0.045) * rng.uniform((1.0, 0.7, 0.55), (1.3, 1.0, 0.8))
    return Mesh(
        directions * rough[:, None] * half, triangles, _plain(np.full(3, rng.uniform(0.3, 0.6)), len(rough), rng, 0.08)
    )


def cup(rng: Generator) -> Mesh:
    """Return a closed paper cup (a cone frustum)."""
    azimuth, polar, triangles = _globe(64, 40)
    height_m, foot_m, rim_m = rng.uniform(0.07, 0.11), rng.uniform(0.022, 0.028), rng.uniform(0.032, 0.042)
    longest = np.maximum(np.abs(np.cos(polar)), np.abs(np.sin(polar)))
    level, across = np.cos(polar) / longest, np.sin(polar) / longest
    radius = across * (foot_m + (rim_m - foot_m) * 0.5 * (level + 1))
    vertices = np.stack([radius * np.cos(azimuth), radius * np.sin(azimuth), 0.5 * height_m * level], axis=1)
    return Mesh(vertices, triangles, _plain(rng.uniform(0.6, 0.95, 3), len(vertices), rng, 0.01))


def potato(rng: Generator) -> Mesh:
    """Return a potato: fruit-like, and no fruit."""
    directions, triangles = sphere(4)
    knobby = 1 + waves(directions, rng, 0.05, 1.5, 4.0)
    half = rng.uniform(0.026, 0.036) * np.array([rng.uniform(1.2, 1.7), 1.0, rng.uniform(0.8, 0.95)])
    skin = rng.uniform(0.85, 1.1) * np.array([0.68, 0.54, 0.36])
    return Mesh(directions * knobby[:, None] * half, triangles, _plain(skin, len(knobby), rng, 0.07))


FOREIGN: Mapping[str, Callable[[Generator], Mesh]] = {
    "hand": hand,
    "potato": potato,
    "leaf": leaf,
    "box": box,
    "stone": stone,
    "cup": cup,
}
"""Makers of foreign objects by kind."""


def _plain(srgb: F64, count: int, rng: Generator, grain: float) -> F32:
    return linear(np.clip(srgb * (1 + grain * rng.normal(size=(count, 1))), 0.02, 0.97))


def _globe(around: int, down: int) -> tuple[F64, F64, Ints]:
    """Return azimuth (V,), polar angle (V,) and triangles (T, 3) of a closed globe with two poles."""
    ring = np.arange(around) * 2 * np.pi / around
    rows = np.pi * np.arange(1, down) / down
    azimuth = np.concatenate([np.tile(ring, down - 1), [0.0, 0.0]])
    polar = np.concatenate([np.repeat(rows, around), [0.0, np.pi]])
    north, south = len(azimuth) - 2, len(azimuth) - 1
    here = np.arange(around)
    after = (here + 1) % around
    parts = [np.stack([np.full(around, north), here, after], axis=1)]
    for row in range(down - 2):
        upper, lower = row * around, (row + 1) * around
        parts.append(np.stack([upper + here, lower + here, lower + after], axis=1))
        parts.append(np.stack([upper + here, lower + after, upper + after], axis=1))
    last = (down - 2) * around
    parts.append(np.stack([last + here, np.full(around, south), last + after], axis=1))
    return azimuth, polar, np.concatenate(parts)


def _cube(cells: int) -> tuple[F64, Ints]:
    """Return vertices (V, 3) in ±0.5 and outward triangles of a cube, each face of cells × cells squares."""
    grid = np.linspace(-0.5, 0.5, cells + 1)
    u, v = (axis.ravel() for axis in np.meshgrid(grid, grid, indexing="ij"))
    i, j = (axis.ravel() for axis in np.meshgrid(np.arange(cells), np.arange(cells), indexing="ij"))
    corner, side = i * (cells + 1) + j, cells + 1
    face = np.concatenate(
        [np.stack([corner, corner + side, corner + side + 1], 1), np.stack([corner, corner + side + 1, corner + 1], 1)]
    )
    vertices: list[F64] = []
    triangles: list[Ints] = []
    for axis in range(3):
        for sign in (-1.0, 1.0):
            points = np.empty((len(u), 3))
            points[:, axis], points[:, (axis + 1) % 3], points[:, (axis + 2) % 3] = 0.5 * sign, u, v
            triangles.append((face if sign > 0 else face[:, ::-1]) + len(vertices) * len(u))
            vertices.append(points)
    return np.concatenate(vertices), np.concatenate(triangles)
