"""More things that nobody trains: bottle, glove, twig, stone, banana, two fingers, a sheet of paper, a mandarin."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from tests.second_rig.bodies import F64, Body, Measures, Solid, StarBody, capsule, ellipsoid, revolve

Made = tuple[Body, F64, F64, float, bool]
"""A body, two sRGB colours, gloss, and whether it lies on its side."""


def make(kind: str, rng: np.random.Generator) -> tuple[Made, Measures]:
    """Return one thing of a kind of `ODDMENTS`, with its truth."""
    made = ODDMENTS[kind](rng)
    return made, made[0].measures()


def _bottle(rng: np.random.Generator) -> Made:
    half, wide = float(rng.uniform(0.055, 0.08)), float(rng.uniform(0.024, 0.033))
    z = half * np.cos(np.linspace(np.pi, 0.0, 500))
    neck = 0.5 * (1.0 + np.tanh((z / half - rng.uniform(0.3, 0.45)) / 0.12))
    outline = wide * (1.0 - 0.55 * neck) * np.sqrt(np.maximum(1.0 - np.abs(z / half) ** 16, 0.0))
    colour = rng.uniform(20.0, 235.0, 3)
    return revolve(z, outline), colour, colour * 0.95, 0.4, True


def _glove(rng: np.random.Generator) -> Made:
    scale, thick = float(rng.uniform(0.9, 1.1)), float(rng.uniform(0.009, 0.014))
    roots = np.array([[0.04, y, 0.0] for y in (-0.03, -0.01, 0.01, 0.03)]) * scale
    angles = np.array([-0.3, -0.1, 0.1, 0.3]) * rng.uniform(0.5, 1.2) + rng.normal(0.0, 0.06, 4)
    tips = roots + rng.uniform(0.05, 0.07, 4)[:, None] * np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)

    def value(points: F64) -> F64:
        parts = [ellipsoid(points, np.zeros(3), np.array([0.06, 0.045, thick]) * scale)]
        parts += [capsule(points, a, b, 0.0085 * scale) for a, b in zip(roots, tips, strict=True)]
        parts.append(capsule(points, np.array([-0.02, -0.03, 0.0]), np.array([0.02, -0.07, 0.0]) * scale, 0.009))
        return np.minimum.reduce(parts)

    colour = np.array([(40.0, 90.0, 170.0), (225.0, 225.0, 215.0), (60.0, 60.0, 62.0)][int(rng.integers(3))])
    return Solid(value, 0.125 * scale), colour, colour * 0.85, 0.1, False


def _twig(rng: np.random.Generator) -> Made:
    half, thick = float(rng.uniform(0.05, 0.09)), float(rng.uniform(0.003, 0.006))
    knee = np.array([rng.uniform(-0.3, 0.3) * half, rng.uniform(-0.2, 0.2) * half, 0.0])
    ends = np.array([[-half, 0.0, 0.0], [half, rng.uniform(-0.3, 0.3) * half, 0.0]])

    def value(points: F64) -> F64:
        return np.minimum(capsule(points, ends[0], knee, thick), capsule(points, knee, ends[1], 0.8 * thick))

    brown = np.array([96.0, 70.0, 46.0]) * rng.uniform(0.7, 1.4)
    return Solid(value, 1.12 * half), brown, brown * 0.8, 0.05, False


def _stone(rng: np.random.Generator) -> Made:
    size = float(rng.uniform(0.02, 0.035))
    z = size * np.cos(np.linspace(np.pi, 0.0, 500))
    outline = rng.uniform(1.1, 1.6) * np.sqrt(np.maximum(size**2 - z**2, 0.0))
    a, b, c = 0.08 * rng.standard_normal(3)
    grey = np.full(3, rng.uniform(70.0, 170.0))
    return revolve(z, outline, (float(a), float(b), float(c), 0.02)), grey, grey * 0.8, 0.05, False


def _banana(rng: np.random.Generator) -> Made:
    bow, thick = float(rng.uniform(0.09, 0.12)), float(rng.uniform(0.016, 0.020))
    turns = np.linspace(-0.7, 0.7, 9)
    places = np.stack([bow * np.sin(turns), bow * (np.cos(turns) - 0.9), 0 * turns], axis=1)
    radii = thick * (1.0 - 0.35 * np.abs(turns / 0.7) ** 3)

    def value(points: F64) -> F64:
        pieces = zip(places, places[1:], 0.5 * (radii + np.roll(radii, -1)), strict=False)
        return np.minimum.reduce([capsule(points, a, b, float(r)) for a, b, r in pieces])

    yellow = np.array([232.0, 196.0, 66.0]) * rng.uniform(0.9, 1.05)
    return Solid(value, bow + thick), yellow, yellow * np.array([0.85, 0.8, 0.6]), 0.15, False


def _fingers(rng: np.random.Generator) -> Made:
    half, thick = float(rng.uniform(0.03, 0.045)), float(rng.uniform(0.0075, 0.0105))
    spread = float(rng.uniform(0.0, 0.25))

    def value(points: F64) -> F64:
        sides = [ellipsoid(points, np.array([-half, 0.0, 0.0]), np.array([1.6, 2.3, 1.05]) * thick)]
        for side in (-1.0, 1.0):
            root, tip = np.array([-half, side * thick, 0.0]), np.array([half, side * (thick + spread * half), 0.0])
            sides.append(capsule(points, root, tip, thick))
        return np.minimum.reduce(sides)

    skin = np.array([205.0, 150.0, 125.0]) * rng.uniform(0.6, 1.05)
    return Solid(value, 1.5 * half + 2.3 * thick), skin, skin * 0.9, 0.1, False


def _sheet(rng: np.random.Generator) -> Made:
    half = rng.uniform((0.04, 0.03), (0.07, 0.05))
    bow = float(rng.uniform(0.0, 3.0))

    def value(points: F64) -> F64:
        flat = points.copy()
        flat[:, 2] -= bow * points[:, 0] ** 2
        beyond = np.abs(flat) - np.append(half, 0.001)
        return np.asarray(np.linalg.norm(np.maximum(beyond, 0.0), axis=1) + np.minimum(beyond.max(axis=1), 0.0))

    white = np.full(3, rng.uniform(225.0, 245.0))
    return Solid(value, 1.05 * float(np.linalg.norm(half)), slack=0.5), white, white * 0.97, 0.02, False


def _mandarin(rng: np.random.Generator) -> Made:
    size = 0.031 * float(rng.normal(1.0, 0.06))
    angles = np.linspace(0.0, np.pi, 361)
    rho = size * (1.0 - 0.16 * np.cos(angles) ** 2)
    a, b, c = 0.012 * rng.standard_normal(3)
    body = StarBody(np.cos(angles)[::-1].copy(), rho[::-1].copy(), (float(a), float(b), float(c), 0.0))
    return body, np.array([230.0, 104.0, 20.0]), np.array([224.0, 136.0, 44.0]), 0.3, False


ODDMENTS: dict[str, Callable[[np.random.Generator], Made]] = {
    "bottle": _bottle,
    "glove": _glove,
    "twig": _twig,
    "stone": _stone,
    "banana": _banana,
    "fingers": _fingers,
    "sheet": _sheet,
    "mandarin": _mandarin,
}
