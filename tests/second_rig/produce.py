"""Five kinds of fruit, two that nobody trains, and things that are no fruit at all."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from tests.second_rig.bodies import F64, Body, Measures, Solid, StarBody, capsule, ellipsoid, revolve
from tests.second_rig.oddments import ODDMENTS, make

KINDS = ("lemon", "red_apple", "green_apple", "chilean_avocado", "peruvian_avocado")
FOREIGN = ("hand", "leaf", "box", "orange", "potato")


@dataclass(frozen=True, slots=True, eq=False)
class Thing:
    """One object with its look and its truth.

    Attributes:
        colour, blotch: two sRGB colours (0–255) that its texture mixes.
        gloss: strength of the highlight.
        lies: whether its long axis rests on the belt.
    """

    kind: str
    body: Body
    truth: Measures
    colour: F64
    blotch: F64
    gloss: float
    lies: bool


def grow(kind: str, rng: np.random.Generator) -> Thing:
    """Return one object of a kind, no two alike."""
    if kind in _FRUIT:
        return _FRUIT[kind](rng)
    if kind in ODDMENTS:
        (body, colour, blotch, gloss, lies), truth = make(kind, rng)
        return Thing(kind, body, truth, np.clip(colour, 3.0, 250.0), np.clip(blotch, 3.0, 250.0), gloss, lies)
    return _OTHERS[kind](rng)


def sphere(radius_m: float, colour: tuple[float, float, float]) -> Thing:
    """Return a plain ball, the same every time."""
    z = radius_m * np.cos(np.linspace(np.pi, 0.0, 400))
    body = revolve(z, np.sqrt(np.maximum(radius_m**2 - z**2, 0.0)))
    return Thing("ball", body, body.measures(), np.array(colour), np.array(colour), 0.2, False)


def _axis(half_m: float) -> F64:
    return half_m * np.cos(np.linspace(np.pi, 0.0, 500))


def _warp(rng: np.random.Generator, strength: float, lobes: float = 0.0) -> tuple[float, float, float, float]:
    a, b, c = strength * rng.standard_normal(3)
    return float(a), float(b), float(c), lobes * float(rng.uniform(0.5, 1.5))


def _finish(kind: str, body: StarBody, rng: np.random.Generator, colours: tuple[tuple[float, ...], tuple[float, ...]],
            gloss: float, lies: bool) -> Thing:  # fmt: skip
    shift = rng.normal(0.0, 6.0, 3)
    first, second = (np.clip(np.array(colour) + shift, 3.0, 250.0) for colour in colours)
    return Thing(kind, body, body.measures(), first, second, gloss * float(rng.uniform(0.7, 1.3)), lies)


def _lemon(rng: np.random.Generator) -> Thing:
    scale = rng.normal(1.0, 0.06)
    half, waist = 0.041 * scale * rng.normal(1.0, 0.03), 0.0285 * scale
    z = _axis(half)
    u = z / half
    belly = waist * np.sqrt(np.maximum(1.0 - np.abs(u) ** 2.3, 0.0)) * (1.0 - 0.22 * u**8)
    body = revolve(z, belly, _warp(rng, 0.012))
    return _finish("lemon", body, rng, ((226, 186, 38), (204, 176, 60)), 0.25, True)


def _apple(kind: str, rng: np.random.Generator) -> Thing:
    red = kind == "red_apple"
    size = (0.0385 if red else 0.0355) * rng.normal(1.0, 0.055)
    angles = np.linspace(0.0, np.pi, 721)
    taper = 0.03 if red else 0.09
    dip = 0.17 * np.exp(-((angles / 0.33) ** 2)) + 0.11 * np.exp(-(((np.pi - angles) / 0.3) ** 2))
    tall = 1.0 + (-0.03 if red else 0.06) * np.cos(angles) ** 2
    rho = size * (1.0 + taper * np.cos(angles)) * tall * (1.0 - dip)
    body = StarBody(np.cos(angles)[::-1].copy(), rho[::-1].copy(), _warp(rng, 0.015, 0.008))
    colours = ((142, 28, 34), (176, 92, 46)) if red else ((142, 172, 62), (158, 186, 92))
    return _finish(kind, body, rng, colours, 0.5, False)


def _avocado(kind: str, rng: np.random.Generator) -> Thing:
    chilean = kind == "chilean_avocado"
    scale = rng.normal(1.0, 0.06)
    half, waist, neck = (0.048, 0.0335, 0.20) if chilean else (0.063, 0.0385, 0.30)
    half *= scale * rng.normal(1.0, 0.03)
    z = _axis(half)
    u = z / half
    outline = waist * scale * np.sqrt(np.maximum(1.0 - u * u, 0.0)) * (1.0 - neck * u)
    body = revolve(z, outline, _warp(rng, 0.012))
    colours = ((50, 44, 40), (66, 72, 42)) if chilean else ((72, 104, 46), (98, 124, 60))
    return _finish(kind, body, rng, colours, 0.3, True)


def _orange(rng: np.random.Generator) -> Thing:
    size = 0.037 * rng.normal(1.0, 0.05)
    angles = np.linspace(0.0, np.pi, 361)
    rho = size * (1.0 - 0.02 * np.cos(angles) ** 2)
    body = StarBody(np.cos(angles)[::-1].copy(), rho[::-1].copy(), _warp(rng, 0.01))
    return _finish("orange", body, rng, ((232, 118, 24), (222, 128, 44)), 0.3, False)


def _potato(rng: np.random.Generator) -> Thing:
    half = 0.052 * rng.normal(1.0, 0.08)
    z = _axis(half)
    outline = 0.034 * np.sqrt(np.maximum(1.0 - np.abs(z / half) ** 2.6, 0.0))
    body = revolve(z, outline, _warp(rng, 0.07))
    return _finish("potato", body, rng, ((168, 132, 88), (140, 104, 66)), 0.05, True)


def _hand(rng: np.random.Generator) -> Thing:
    scale = float(rng.normal(1.0, 0.07))
    spread = rng.uniform(0.7, 1.3)
    roots = np.array([[0.035, y, 0.0] for y in (-0.03, -0.01, 0.01, 0.03)]) * scale
    angles = spread * np.array([-0.25, -0.08, 0.08, 0.25])
    reach = 0.075 * scale
    tips = roots + reach * np.stack([np.cos(angles), np.sin(angles), np.full(4, -0.1)], axis=1)
    thumb = np.array([[-0.02, -0.04, 0.0], [0.025, -0.085, -0.005]]) * scale

    def value(points: F64) -> F64:
        parts = [ellipsoid(points, np.zeros(3), np.array([0.055, 0.045, 0.019]) * scale)]
        parts += [capsule(points, a, b, 0.0095 * scale) for a, b in zip(roots, tips, strict=True)]
        parts.append(capsule(points, thumb[0], thumb[1], 0.011 * scale))
        return np.minimum.reduce(parts)

    body = Solid(value, 0.135 * scale)
    skin = np.array([205.0, 150.0, 125.0]) * rng.uniform(0.6, 1.05)
    return Thing("hand", body, body.measures(), skin, skin * 0.9, 0.1, False)


def _leaf(rng: np.random.Generator) -> Thing:
    length, width = float(rng.uniform(0.04, 0.06)), float(rng.uniform(0.02, 0.03))
    curl = float(rng.uniform(0.4, 0.6)) * 0.05 / length**2

    def value(points: F64) -> F64:
        flat = points.copy()
        flat[:, 2] += curl * points[:, 0] ** 2 - 0.01
        return ellipsoid(flat, np.zeros(3), np.array([length, width, 0.003]))

    body = Solid(value, length * 1.15, slack=0.3)
    green = np.array([60.0, 120.0, 40.0]) * rng.uniform(0.7, 1.2)
    return Thing("leaf", body, body.measures(), green, green * 0.8, 0.1, False)


def _box(rng: np.random.Generator) -> Thing:
    half = rng.uniform([0.03, 0.025, 0.018], [0.05, 0.04, 0.035])

    def value(points: F64) -> F64:
        beyond = np.abs(points) - half
        outside = np.linalg.norm(np.maximum(beyond, 0.0), axis=1)
        return np.asarray(outside + np.minimum(beyond.max(axis=1), 0.0))

    body = Solid(value, float(np.linalg.norm(half)) * 1.01)
    colour = rng.uniform(40.0, 220.0, 3)
    return Thing("box", body, body.measures(), colour, colour * 0.92, 0.05, False)


_FRUIT: dict[str, Callable[[np.random.Generator], Thing]] = {
    "lemon": _lemon,
    "red_apple": lambda rng: _apple("red_apple", rng),
    "green_apple": lambda rng: _apple("green_apple", rng),
    "chilean_avocado": lambda rng: _avocado("chilean_avocado", rng),
    "peruvian_avocado": lambda rng: _avocado("peruvian_avocado", rng),
}
_OTHERS: dict[str, Callable[[np.random.Generator], Thing]] = {
    "hand": _hand,
    "leaf": _leaf,
    "box": _box,
    "orange": _orange,
    "potato": _potato,
}
