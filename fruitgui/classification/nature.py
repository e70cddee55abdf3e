"""What a feature's name says about it: how it answers to light, and how it is scaled."""

from __future__ import annotations

from enum import Enum

import numpy as np

from fruitgui.classification.evidence import FeatureNames
from fruitgui.frame import F32, F64, Bools


class Nature(Enum):
    """What a feature tells of.

    LIGHT: brightness as such; all such features rise by the same number when the light gets brighter.
    COLOUR: chroma, texture, brightness beside the belt's: the light changes it little.
    SHAPE: geometry: the light does not change it.
    """

    LIGHT = "light"
    COLOUR = "colour"
    SHAPE = "shape"


_LIGHT = ("light",)
_COLOUR = ("chroma", "colour", "color", "hue", "saturation", "value", "texture", "belt", "tone")
_UNITS = ("_m", "_m2", "_m3")
_SMALLEST = 1e-12


def natures(names: FeatureNames) -> tuple[Nature, ...]:
    """Return the nature of every view feature, then of every fruit feature."""
    return (*(_nature(name) for name in names.view), *(Nature.SHAPE for _ in names.fruit))


def _nature(name: str) -> Nature:
    if name.startswith(_LIGHT):
        return Nature.LIGHT
    return Nature.COLOUR if name.startswith(_COLOUR) else Nature.SHAPE


def sizes(names: tuple[str, ...]) -> Bools:
    """Return which features are sizes in SI units: positive, compared by ratio."""
    return np.array([name.endswith(_UNITS) for name in names], dtype=bool)


def by_ratio(values: F32 | F64, are_sizes: Bools) -> F64:
    """Return the values (…, F) with sizes replaced by their logarithm; NaN stays NaN."""
    scaled = np.array(values, dtype=np.float64)
    scaled[..., are_sizes] = np.log(np.maximum(scaled[..., are_sizes], _SMALLEST))
    return scaled
