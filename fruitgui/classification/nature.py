"""What a feature's name says about it: what it tells of, how it is scaled, and how far light may move it."""

from __future__ import annotations

from enum import Enum

import numpy as np

from fruitgui.classification.evidence import FeatureNames
from fruitgui.frame import F32, F64, Bools, Ints


class Nature(Enum):
    """What a feature tells of.

    COLOUR: a smooth statistic of colour or texture.
    SHAPE: geometry; the light does not change it.
    BIN: one bin of a histogram. Most are empty in training, and how far they may fill up cannot be learned from
        that; so they are the perceptron's alone.
    """

    COLOUR = "colour"
    SHAPE = "shape"
    BIN = "bin"


CHANGES: tuple[dict[str, float], ...] = (
    {  # Noise of the picture in dim light: it widens all spreads together, and gives grey skins a hue.
        "red_share_std": 0.015, "green_share_std": 0.012, "saturation_std": 0.04, "saturation_mean": 0.03,
        "hue_strength": -0.03, "value_texture": 0.012, "hue_cosine": -0.03,
    },
    {"log_red_to_belt": 0.4},  # another belt, or one that got dirty
    {"log_green_to_belt": 0.4},
    {"log_blue_to_belt": 0.4},
    {"log_value_to_belt": 0.4, "log_red_to_belt": 0.4, "log_green_to_belt": 0.4, "log_blue_to_belt": 0.4},
    {"red_share": 0.012, "green_share": -0.004, "saturation_mean": 0.02, "hue_cosine": 0.03, "hue_sine": -0.03},  # warm
    {"green_share": 0.008, "red_share": -0.004, "hue_sine": 0.03},  # greenish
    {"value_contrast": 0.05},  # a lamp from the side
    {"red_share_std": 0.008, "green_share_std": -0.008},
    {"saturation_std": 0.015},
    {"saturation_mean": 0.03},
    {"hue_strength": 0.01},
    {"value_texture": 0.01},
    {"hue_cosine": 0.03},
    {"hue_sine": 0.03},
    {"length_m": 0.04, "width_m": 0.04, "area_m2": 0.08, "volume_m3": 0.08},  # edges fattened by a pixel or two
    {"height_m": 0.03, "height_to_width": 0.03},
    {"width_to_length": 0.03},
    {"height_to_width": 0.05},
    {"solidity": 0.015},  # outlines cut out of a group, drawn coarser or finer
    {"fill": 0.012},
    {"ellipse_error": 0.015},
    {"lopsidedness": 0.03},
    {"height_p20": 0.025, "height_p50": 0.015, "height_p80": 0.01},
    {"sphere_residual": 0.006},
    {"sphere_radius_m": 0.05},
)  # fmt: skip
"""What light and belt that training did not show may change, each with the standard deviation of every feature in it.

A white balance that is off by 5 % in one channel moves a share s of the sum by 0.05·s·(1 − s), saturation by at most
0.05, hue by a few degrees. The main lamp's direction changes the mean light on a body beside that on the level belt by
a tenth or two (Lambert's cosine over the seen half). Shot noise of a small camera at 100 lx is some 6 of 255 values,
on a dark skin as much as a fifth of its colour. Belts of one make differ by half in reflectance, and get dirty.
"""

_COLOURS = ("red_", "green_", "blue_", "hue_", "saturation_", "value_", "log_", "chroma_", "colour_", "texture_")
_UNITS = ("_m", "_m2", "_m3")
_SMALLEST = 1e-12


def natures(names: FeatureNames) -> tuple[Nature, ...]:
    """Return the nature of every view feature, then of every fruit feature."""
    return (*(_nature(name) for name in names.view), *(Nature.SHAPE for _ in names.fruit))


def _nature(name: str) -> Nature:
    if name.rpartition("_")[2].isdigit():
        return Nature.BIN
    return Nature.COLOUR if name.startswith(_COLOURS) else Nature.SHAPE


def light_changes(names: FeatureNames) -> F64:
    """Return the changes (C, D) that new light may bring: rows are one standard deviation of each, independent."""
    place = {name: at for at, name in enumerate(names.view)}
    changes = np.zeros((len(CHANGES), len(names.view) + len(names.fruit)))
    for row, change in enumerate(CHANGES):
        for name, size in change.items():
            if name in place:
                changes[row, place[name]] = size
    return changes


def axis_sets(names: FeatureNames) -> tuple[Ints, ...]:
    """Return the sets of axes in which a fruit is compared with its kind: all, colour alone, shape alone."""
    what = natures(names)
    colour = [i for i, one in enumerate(what) if one is Nature.COLOUR]
    shape = [i for i, one in enumerate(what) if one is Nature.SHAPE]
    return tuple(np.array(axes, dtype=np.intp) for axes in (sorted(colour + shape), colour, shape) if axes)


def sizes(names: tuple[str, ...]) -> Bools:
    """Return which features are sizes in SI units: positive, compared by ratio."""
    return np.array([name.endswith(_UNITS) for name in names], dtype=bool)


def by_ratio(values: F32 | F64, are_sizes: Bools) -> F64:
    """Return the values (…, F) with sizes replaced by their logarithm; NaN stays NaN."""
    scaled = np.array(values, dtype=np.float64)
    scaled[..., are_sizes] = np.log(np.maximum(scaled[..., are_sizes], _SMALLEST))
    return scaled
