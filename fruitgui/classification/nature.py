"""What a feature's name says about it: what it tells of, how it is scaled, and what may move it."""

from __future__ import annotations

from enum import Enum

import numpy as np

from fruitgui.classification.evidence import FeatureNames
from fruitgui.frame import F32, F64, Bools, Ints


class Nature(Enum):
    """What a feature tells of."""

    COLOUR = "colour"
    SHAPE = "shape"


CHANGES: tuple[dict[str, float], ...] = (
    {  # brighter or darker pictures; near black, the offset of the camera bends ratios
        "light_value_p50": -0.5,
        "chroma_blue_green_p10": 0.05, "chroma_blue_green_p50": 0.05, "chroma_blue_green_p90": 0.05,
        "chroma_saturation_mean": -0.01,
    },
    {  # noise of the picture in dim light widens what is measured against the sum, and gives grey skins a hue
        "chroma_red_std": 0.007, "chroma_green_std": 0.006, "chroma_saturation_std": 0.011,
        "chroma_saturation_mean": 0.006, "chroma_hue_strength": 0.006,
    },
    {  # and, where a skin is dark in green, what is measured against green
        "chroma_red_green_p90": 0.05, "chroma_blue_green_p90": 0.07, "texture_step": 0.02, "texture_spread": 0.02,
        "texture_dark": -0.06, "texture_bright": 0.04, "texture_specular_share": 0.01, "chroma_reddish_share": 0.03,
    },
    {"chroma_red_green_p10": -0.05, "chroma_blue_green_p10": -0.07, "texture_step": 0.01},
    {  # warmer or colder light
        "chroma_red_green_p10": 0.05, "chroma_red_green_p50": 0.05, "chroma_red_green_p90": 0.05,
        "chroma_blue_green_p10": -0.05, "chroma_blue_green_p50": -0.05, "chroma_blue_green_p90": -0.05,
        "chroma_red_mean": 0.012, "chroma_green_mean": 0.002, "chroma_saturation_mean": 0.01,
        "chroma_hue_cosine": 0.012, "chroma_hue_sine": -0.008, "chroma_reddish_share": 0.03,
        "chroma_greenish_share": -0.03,
    },
    {  # greener or more purple light
        "chroma_red_green_p10": -0.03, "chroma_red_green_p50": -0.03, "chroma_red_green_p90": -0.03,
        "chroma_blue_green_p10": -0.03, "chroma_blue_green_p50": -0.03, "chroma_blue_green_p90": -0.03,
        "chroma_red_mean": -0.004, "chroma_green_mean": 0.008, "chroma_hue_sine": 0.008,
        "chroma_reddish_share": -0.02, "chroma_greenish_share": 0.02,
    },
    {"chroma_red_green_to_belt": 0.1},  # a belt that got dirty; the colour of the light cancels
    {"chroma_blue_green_to_belt": 0.1},
    {"chroma_value_to_belt": 0.15},
    {"texture_spread": 0.03, "texture_dark": -0.05, "texture_bright": 0.05},  # a lamp from the side
    {"texture_dark": 0.05},
    {"texture_specular_share": 0.01, "texture_bright": 0.03},
    {"texture_step": 0.01},
    {"chroma_red_std": 0.006, "chroma_green_std": -0.006},
    {"chroma_saturation_std": 0.01},
    {"chroma_saturation_mean": 0.015},
    {"chroma_hue_strength": 0.004},
    {"chroma_hue_cosine": 0.006},
    {"chroma_hue_sine": 0.006},
    {"chroma_red_mean": 0.004},
    {"chroma_green_mean": 0.004},
    {"chroma_reddish_share": 0.3},  # shares beyond a fixed colour: a skin near that colour is on either side of it
    {"chroma_greenish_share": 0.4},
    {"size_length": 0.04, "size_width": 0.04, "size_root_area": 0.04, "shape_height_to_root_area": -0.03},  # fat edges
    {"size_height": 0.03, "height_m": 0.03, "shape_height_to_width": 0.03, "shape_height_to_root_area": 0.03},
    {"volume_m3": 0.06, "length_m": 0.02, "diameter_m": 0.02, "perimeter_m": 0.02},  # a fit with a side unseen
    {"volume_m3": 0.03},
    {"length_m": 0.02},
    {"diameter_m": 0.02},
    {"perimeter_m": 0.015},
    {  # a neighbour cuts the outline
        "size_width": -0.08, "size_root_area": -0.05, "shape_width_to_length": -0.08, "shape_height_to_width": 0.08,
        "shape_height_to_root_area": 0.05, "shape_solidity": -0.015, "shape_ellipse_error": 0.02,
    },
    {"shape_width_to_length": 0.03, "shape_height_to_width": 0.04},
    {"shape_solidity": 0.015},
    {"shape_fill": 0.012},
    {"shape_ellipse_error": 0.015},
    {"shape_tips": 0.02},
    {"shape_lopsidedness": 0.03},
    {"shape_height_p20": 0.025, "shape_height_p50": 0.015, "shape_height_p80": 0.01, "shape_flat_share": -0.02},
    {"shape_flat_share": 0.02},
    {"shape_sphere_residual": 0.006},
    {"shape_sphere_radius": 0.05},
)  # fmt: skip
"""What another light, belt or neighbour than training's may change: the limit of each change, on features together.

Anything within a limit is as likely as anything else, so its standard deviation is the limit divided by √3; limits
taken for deviations let oranges pass for apples. Features that are not named here bear nothing.

Derived: a white balance that is off by 10 % in one channel moves the logarithm of its (gamma-encoded) level by 0.045
and a share s of the sum by 0.05·s·(1 − s); hue is a vector as long as the saturation. 100–1000 lx is a factor of 10:
±0.5 in the logarithm of the level, where the camera does not adapt. Shot noise of a small camera at 100 lx is some 6 of
255 values; the calmed picture averages 36 pixels, of which a colour filter leaves about nine independent: 2 values, in
a dark channel 6 %. Two pixels of fattened edge are 4 % of a fruit of 50 pixels.

Set by what simulated lines showed, and not derived: how far a dirty belt, a lamp from the side, a neighbour's cut, the
shares beyond a fixed colour and the shapes' own scatter go.
"""

_COLOURS = ("chroma_", "light_", "texture_", "colour_")
_UNITS = ("_m", "_m2", "_m3")
_SMALLEST = 1e-12
_SATURATION = "chroma_saturation_mean"
_HUE = ("chroma_hue_cosine", "chroma_hue_sine")
_HUE_STRENGTH = "chroma_hue_strength"
_STD_OF_LIMIT = 3.0**-0.5
_TINT = ("chroma_red_green_p50", "chroma_blue_green_p50", "chroma_red_mean", "chroma_green_mean", *_HUE)


def natures(names: FeatureNames) -> tuple[Nature, ...]:
    """Return the nature of every view feature, then of every fruit feature."""
    return (*(_nature(name) for name in names.view), *(Nature.SHAPE for _ in names.fruit))


def _nature(name: str) -> Nature:
    return Nature.COLOUR if name.startswith(_COLOURS) else Nature.SHAPE


def borne_changes(names: FeatureNames) -> F64:
    """Return the standard deviations (C, D) of the changes that features must bear, independent of each other.

    See `CHANGES`, which has their limits.
    """
    place = {name: at for at, name in enumerate((*names.view, *names.fruit))}
    changes = np.zeros((len(CHANGES), len(place)))
    for row, change in enumerate(CHANGES):
        for name, size in change.items():
            if name in place:
                changes[row, place[name]] = size * _STD_OF_LIMIT
    return changes


def shape_axes(names: FeatureNames) -> Ints:
    """Return which view features tell of shape or size."""
    return np.array([i for i, name in enumerate(names.view) if _nature(name) is Nature.SHAPE], dtype=np.intp)


def axis_sets(names: FeatureNames) -> tuple[Ints, ...]:
    """Return the sets of axes in which a fruit is compared with its kind: all, colour, tint, grain, shape, size.

    Tint, grain and size are a few axes each: what differs in those alone drowns in the many that fit.
    """
    what = natures(names)
    every = (*names.view, *names.fruit)
    colour = [i for i, one in enumerate(what) if one is Nature.COLOUR]
    shape = [i for i, one in enumerate(what) if one is Nature.SHAPE]
    tint = [i for i in colour if every[i] in _TINT]
    grain = [i for i in colour if every[i].startswith("texture_") or every[i].endswith("_std")]
    size = [i for i in shape if every[i].startswith("size_") or every[i].endswith(_UNITS)]
    sets = (sorted(colour + shape), colour, tint, grain, shape, size)
    return tuple(np.array(axes, dtype=np.intp) for axes in sets if axes)


def sizes(names: tuple[str, ...]) -> Bools:
    """Return which features are sizes in SI units: positive, compared by ratio."""
    return np.array([name.endswith(_UNITS) for name in names], dtype=bool)


def steadied(values: F32 | F64, names: FeatureNames) -> F64:
    """Return view features (n, F) as they are compared: sizes by ratio, hue as a vector as long as the saturation.

    The hue of a grey skin is chance; weighed by saturation it does not matter there.
    """
    steady = by_ratio(values, sizes(names.view))
    place = {name: at for at, name in enumerate(names.view)}
    if _SATURATION in place:
        saturation = steady[:, place[_SATURATION]].copy()
        for name in _HUE:
            if name in place:
                steady[:, place[name]] *= saturation
        if _HUE_STRENGTH in place:
            steady[:, place[_HUE_STRENGTH]] = (1.0 - steady[:, place[_HUE_STRENGTH]]) * saturation
    return steady


def by_ratio(values: F32 | F64, are_sizes: Bools) -> F64:
    """Return the values (…, F) with sizes replaced by their logarithm; NaN stays NaN."""
    scaled = np.array(values, dtype=np.float64)
    scaled[..., are_sizes] = np.log(np.maximum(scaled[..., are_sizes], _SMALLEST))
    return scaled
