"""What perception assumes of fruit and of structured light; every value follows from physics or from the trade."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F64


@dataclass(frozen=True, slots=True)
class PerceptionSettings:
    """Limits inside which something on the belt is looked at as fruit.

    Attributes:
        smallest_m: diameter of the smallest fruit that must be seen.
        largest_m: no fruit is longer; longer groups are rails, arms, cloth.
        tallest_m: nothing higher above the belt is looked at.
        lowest_m: never look below this height: belts sag and fitted planes err by a few millimetres.
        prominence: two tops are two fruit when the way between them dips by this part of the lower one's height.
        waist: or when the outline between them narrows by this part of the narrower one's half width; half a dip and
            half a waist count alike.
        max_points: points kept of one view.
        noise_m: depth noise at 1 m, growing with the square of distance (Khoshelham & Elberink 2012).
        step_m: depth quantisation at 1 m, growing likewise (1/8 px of disparity, f ≈ 580 px, b = 75 mm).
        fattening_px: structured light widens what stands in front by up to this.
        paper_area_m2: paper mode: groups between these areas are split.
        paper_ellipse_error: paper mode: rms distance from the fitted ellipse, as a part of its radius, that fits.
    """

    smallest_m: float = 0.025
    largest_m: float = 0.30
    tallest_m: float = 0.20
    lowest_m: float = 0.006
    prominence: float = 0.12
    waist: float = 0.6
    max_points: int = 1200
    noise_m: float = 1.4e-3
    step_m: float = 2.9e-3
    fattening_px: float = 2.0
    paper_area_m2: tuple[float, float] = (0.003, 0.04)
    paper_ellipse_error: float = 0.07

    def noise_at_m(self, z_m: F64) -> F64:
        """Return the standard deviation of one depth reading at distance z, shape of `z_m`."""
        return np.asarray(self.noise_m * np.square(z_m))

    def step_at_m(self, z_m: F64) -> F64:
        """Return the depth step between neighbouring readings at distance z, shape of `z_m`."""
        return np.asarray(self.step_m * np.square(z_m))
