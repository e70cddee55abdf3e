"""Fruit as they grow: seeded shapes and skins of seven kinds, each a closed mesh of known volume.

Sizes follow trade size ranges (lemon 50–65 mm across, apple 65–85 mm, Hass
avocado 150–280 g, green-skinned avocado 220–420 g, orange 65–85 mm, pear
55–75 mm); reflectances are typical skins under daylight, varied per piece.
The two avocados differ in colour, size and neck, and overlap in each.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.random import Generator

from fruitgui.frame import F32, F64, Ints
from fruitgui.simulation.light import linear
from fruitgui.simulation.mesh import Mesh, icosphere

KINDS = ("lemon", "red_apple", "green_apple", "chilean_avocado", "peruvian_avocado")
"""The five kinds of the source."""

MORE_KINDS = ("orange", "pear")
"""Kinds beyond the source's."""

STEM = linear(np.array([0.30, 0.22, 0.12]))
"""Reflectance of the stem's end."""


@dataclass(frozen=True, slots=True)
class Skin:
    """A skin's colours.

    Attributes:
        base, other: (r, g, b) sRGB 0–1; patches of `other` lie on `base`.
        share: mean share of `other`, and how much it varies between pieces.
        share_spread: standard deviation of the share.
        spots: relative contrast of fine spots (lenticels, pebbles).
        piece_spread: relative spread of brightness and hue between pieces.
        gloss: greatest brightness of the lamp's mirror image.
    """

    base: tuple[float, float, float]
    other: tuple[float, float, float]
    share: float
    share_spread: float
    spots: float
    piece_spread: float
    gloss: float = 0.1


@dataclass(frozen=True, slots=True)
class Recipe:
    """How a kind is made.

    Attributes:
        radius_m: range of half the width across the stem axis.
        aspect: range of height (stem axis) over width.
        bumps: relative amplitude of low-order bumps.
        profile: (cosine from the stem (V,), generator) → (factor of the radius, factor of the width), each (V,).
        skin: colours.
        bend: how far the stem's end may lean over, relative to the radius.
    """

    radius_m: tuple[float, float]
    aspect: tuple[float, float]
    bumps: float
    profile: Callable[[F64, Generator], tuple[F64, F64]]
    skin: Skin
    bend: float = 0.0


def _round(cosine: F64, _rng: Generator) -> tuple[F64, F64]:
    return np.ones_like(cosine), np.ones_like(cosine)


def _apple(cosine: F64, rng: Generator) -> tuple[F64, F64]:
    """Dimples at stem and calyx, broad shoulders."""
    stem = rng.uniform(0.10, 0.22) * np.exp(-(1 - cosine) / rng.uniform(0.03, 0.07))
    calyx = rng.uniform(0.05, 0.14) * np.exp(-(1 + cosine) / rng.uniform(0.02, 0.05))
    return 1 - stem - calyx, 1 + rng.uniform(0.02, 0.11) * cosine


def _lemon(cosine: F64, rng: Generator) -> tuple[F64, F64]:
    """A nipple at the tip, a smaller one at the stem."""
    tip = rng.uniform(0.06, 0.18) * np.exp(-(1 - cosine) / rng.uniform(0.02, 0.05))
    stem = rng.uniform(0.01, 0.08) * np.exp(-(1 + cosine) / rng.uniform(0.02, 0.05))
    return 1 + tip + stem, np.ones_like(cosine)


def _hass(cosine: F64, rng: Generator) -> tuple[F64, F64]:
    """An egg, sometimes with a short neck."""
    return np.ones_like(cosine), 1 - rng.uniform(0.08, 0.30) * cosine


def _green_avocado(cosine: F64, rng: Generator) -> tuple[F64, F64]:
    """A pear-like body with a longer neck."""
    return np.ones_like(cosine), 1 - rng.uniform(0.18, 0.38) * cosine - 0.06 * np.tanh(4 * (cosine - 0.3))


def _pear(cosine: F64, rng: Generator) -> tuple[F64, F64]:
    """A broad base and a slender neck."""
    neck = 0.5 * (1 + np.tanh((cosine - rng.uniform(0.15, 0.35)) / 0.3))
    dimple = rng.uniform(0.04, 0.10) * np.exp(-(1 + cosine) / 0.03)
    return 1 - dimple, 1.06 - rng.uniform(0.30, 0.46) * neck


RECIPES: Mapping[str, Recipe] = {
    "lemon": Recipe((0.025, 0.034), (1.15, 1.50), 0.014, _lemon,
                    Skin((0.93, 0.80, 0.16), (0.78, 0.78, 0.22), 0.12, 0.12, 0.05, 0.05, 0.20)),
    "red_apple": Recipe((0.033, 0.043), (0.84, 1.00), 0.016, _apple,
                        Skin((0.66, 0.08, 0.11), (0.86, 0.66, 0.26), 0.16, 0.12, 0.07, 0.09, 0.40)),
    "green_apple": Recipe((0.032, 0.042), (0.84, 1.00), 0.016, _apple,
                          Skin((0.58, 0.74, 0.22), (0.72, 0.80, 0.38), 0.25, 0.15, 0.06, 0.07, 0.40)),
    "chilean_avocado": Recipe((0.029, 0.037), (1.25, 1.60), 0.016, _hass,
                              Skin((0.20, 0.16, 0.14), (0.24, 0.27, 0.13), 0.35, 0.22, 0.16, 0.14, 0.06), 0.04),
    "peruvian_avocado": Recipe((0.032, 0.039), (1.40, 1.80), 0.018, _green_avocado,
                               Skin((0.31, 0.43, 0.15), (0.22, 0.30, 0.12), 0.25, 0.15, 0.09, 0.10, 0.18), 0.06),
    "orange": Recipe((0.033, 0.042), (0.92, 1.04), 0.010, _round,
                     Skin((0.95, 0.52, 0.08), (0.93, 0.62, 0.14), 0.25, 0.15, 0.06, 0.05, 0.20)),
    "mandarin": Recipe((0.026, 0.034), (0.76, 0.90), 0.014, _apple,
                       Skin((0.94, 0.46, 0.07), (0.92, 0.58, 0.16), 0.20, 0.15, 0.07, 0.06, 0.20)),
    "pear": Recipe((0.029, 0.037), (1.30, 1.65), 0.018, _pear,
                   Skin((0.74, 0.75, 0.28), (0.66, 0.50, 0.24), 0.16, 0.12, 0.08, 0.08, 0.12), 0.06),
}  # fmt: skip


def grow(kind: str, rng: Generator) -> Mesh:
    """Return one piece of fruit of a kind of `RECIPES`, centred on its centre of volume, stem along z."""
    recipe = RECIPES[kind]
    directions, triangles = sphere(4)
    cosine = directions[:, 2]
    radius_m = rng.uniform(*recipe.radius_m)
    aspect = rng.uniform(*recipe.aspect)
    radial, width = recipe.profile(cosine, rng)
    shape = directions * (radial * (1 + waves(directions, rng, recipe.bumps, 1.0, 3.5)))[:, None]
    oval = rng.uniform(0.97, 1.0)
    shape = shape * np.stack([width, width * oval, np.full_like(width, aspect)], axis=1) * radius_m
    shape[:, 0] += recipe.bend * rng.uniform(0, 1) * shape[:, 2] ** 2 / radius_m
    albedo = paint(directions, recipe.skin, rng)
    albedo[cosine > rng.uniform(0.975, 0.992)] = STEM
    return Mesh(shape, triangles, albedo, float(recipe.skin.gloss * rng.uniform(0.2, 1))).centred()


def ball(radius_m: float, colour: tuple[float, float, float]) -> Mesh:
    """Return a sphere of one colour (sRGB 0–1); its volume is the mesh's, a little under the sphere's."""
    directions, triangles = sphere(4)
    return Mesh(directions * radius_m, triangles, np.tile(linear(np.array(colour)), (len(directions), 1)))


@lru_cache(maxsize=8)
def sphere(subdivisions: int) -> tuple[F64, Ints]:
    """Return `icosphere(subdivisions)`, made once. Shared; do not write."""
    directions, triangles = icosphere(subdivisions)
    directions.setflags(write=False)
    triangles.setflags(write=False)
    return directions, triangles


def waves(directions: F64, rng: Generator, amplitude: float, low: float, high: float, count: int = 7) -> F64:
    """Return a smooth random field of directions (V, 3): `count` plane waves of `low` to `high` rad per radius."""
    axes = rng.normal(size=(count, 3))
    axes *= (rng.uniform(low, high, count) / np.linalg.norm(axes, axis=1))[:, None]
    phases = rng.uniform(0, 2 * np.pi, count)
    return np.asarray(amplitude * np.sqrt(2 / count) * np.cos(directions @ axes.T + phases).sum(axis=1))


def paint(directions: F64, skin: Skin, rng: Generator) -> F32:
    """Return linear reflectances (V, 3) of one piece's skin."""
    share = np.clip(rng.normal(skin.share, skin.share_spread), 0.0, 0.8)
    patches = waves(directions, rng, 0.5, 1.5, 5.0)
    mix = np.clip(0.5 + 1.5 * (patches - np.quantile(patches, 1 - share)), 0, 1)[:, None] if share > 0.01 else 0.0
    colour = (1 - mix) * np.array(skin.base) + mix * np.array(skin.other)
    colour = colour * (1 + skin.piece_spread * rng.normal()) * (1 + 0.5 * skin.piece_spread * rng.normal(size=3))
    spots = skin.spots * rng.normal(size=(len(directions), 1))
    return linear(np.clip(colour * (1 + spots), 0.01, 0.98))
