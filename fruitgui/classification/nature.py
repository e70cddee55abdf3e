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


LIGHT_TOLERANCE = {
    "red_share": 0.012,
    "green_share": 0.008,
    "red_share_std": 0.010,
    "green_share_std": 0.010,
    "hue_cosine": 0.04,
    "hue_sine": 0.04,
    "hue_strength": 0.02,
    "saturation_mean": 0.03,
    "saturation_std": 0.02,
    "log_value_to_belt": 0.10,
    "log_red_to_belt": 0.10,
    "log_green_to_belt": 0.10,
    "log_blue_to_belt": 0.12,
    "value_contrast": 0.03,
    "value_texture": 0.02,
}
"""Standard deviation by which light that training did not show may move each colour feature.

A white balance that is off by 5 % in one channel moves a share s of the sum by 0.05·s·(1 − s), saturation by at most
0.05, hue by a few degrees. The main lamp's direction changes the mean light on a body beside that on the level belt by
a tenth (Lambert's cosine over the seen half). Noise of the picture (about 2–6 of 255 from 1000 to 100 lx) adds to all
spreads in square.
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


def tolerances(names: FeatureNames) -> F64:
    """Return by how much light may move every view feature, then every fruit feature (D,)."""
    return np.array([*(LIGHT_TOLERANCE.get(name, 0.0) for name in names.view), *(0.0 for _ in names.fruit)])


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
