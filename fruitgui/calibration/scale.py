"""Whether two sensors see things equally far apart: their depth scales differ where they do not."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, sqrt

import numpy as np

from fruitgui.frame import F64

FEWEST = 4
DOUBT = 0.01
"""Two sensors whose scales differ by less measure volumes that differ by less than three per cent."""

CLEARLY = 3.0
"""Standard deviations from which on a difference is not chance."""


@dataclass(frozen=True, slots=True)
class Scale:
    """How much longer distances between things are in one sensor than in another.

    Attributes:
        value: 1 where the sensors agree.
        std: its standard deviation; infinite where nothing tells.
    """

    value: float = 1.0
    std: float = inf

    @property
    def doubtful(self) -> bool:
        """Whether it is clear that the sensors differ by more than volumes bear."""
        return abs(self.value - 1.0) > max(DOUBT, CLEARLY * self.std)


def scale_between(source_m: F64, target_m: F64) -> Scale:
    """Return how much farther apart the same things are in the target than in the source.

    A straight line through the centres by least squares; what lies off it tells how sure it is. A few things close
    together tell little, however well they meet.

    Args:
        source_m, target_m: (N, 2) where each sees the tops of things, both in the target's belt frame.
    """
    if len(source_m) < FEWEST:
        return Scale()
    a, b = source_m - source_m.mean(axis=0), target_m - target_m.mean(axis=0)
    spread = float((a * a).sum())
    value = float((a * b).sum()) / spread
    off = float(np.square(b - value * a).sum()) / (2 * len(a) - 3)
    return Scale(value, sqrt(off / spread))
