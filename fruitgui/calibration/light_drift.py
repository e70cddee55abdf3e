"""Whether the light, or the camera's answer to it, has changed: the bare belt is a grey card that is always in view."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

BRIGHTER = 0.30
"""Share by which the light may change: a value of 255 moves by one in eight, a bin and a quarter of the ten by which
colours are compared."""

REDDER = 0.12
"""Share by which red or blue may change against green before hues of fruit move towards their neighbours'."""

FEWEST = 4


@dataclass(frozen=True, slots=True)
class LightDrift:
    """How the light on the belt is now against how it was at first.

    Attributes:
        brightness: times as bright as at first.
        red, blue: times as red, or as blue, against green.
    """

    brightness: float
    red: float
    blue: float

    @property
    def brightness_off(self) -> bool:
        """Whether it is so much brighter or darker that kinds may be mistaken."""
        return abs(math.log(self.brightness)) > math.log1p(BRIGHTER)

    @property
    def white_off(self) -> bool:
        """Whether white is no longer what it was."""
        return max(abs(math.log(self.red)), abs(math.log(self.blue))) > math.log1p(REDDER)


def light_drift(
    first: Sequence[tuple[float, float, float]], lately: Sequence[tuple[float, float, float]]
) -> LightDrift | None:
    """Compare the light on the belt (linear red, green, blue) of two spans; None where either has too few looks."""
    if min(len(first), len(lately)) < FEWEST:
        return None
    before, now = (np.median(np.asarray(some, dtype=np.float64), axis=0) for some in (first, lately))
    red, green, blue = (float(one) for one in now / before)
    # Weights of the eye (ITU-R BT.709).
    weights = np.array([0.2126, 0.7152, 0.0722])
    return LightDrift(float(weights @ now) / float(weights @ before), red / green, blue / green)
