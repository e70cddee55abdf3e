"""What one picture says of the light that it was taken in."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.frame import F32, U16

STEP_PX = 8
"""Readings so far apart are looked at: nearer ones err alike (method 1.2)."""


@dataclass(frozen=True, slots=True, eq=False)
class Glimpse:
    """One picture of a sensor.

    Attributes:
        since_s: its projector had been on.
        frames: pictures since then, before this one; damaged ones count.
        holes: share of the picture without depth, 0–1.
        depth_mm: (h, w) float32, every eighth reading down and across; NaN where there is none.
    """

    since_s: float
    frames: int
    holes: float
    depth_mm: F32


def glimpse(depth_mm: U16, since_s: float, frames: int) -> Glimpse:
    """Return what a depth picture (height, width) says."""
    coarse = depth_mm[STEP_PX // 2 :: STEP_PX, STEP_PX // 2 :: STEP_PX].astype(np.float32)
    coarse[coarse == 0.0] = np.nan
    return Glimpse(since_s, frames, 1.0 - cv2.countNonZero(depth_mm) / depth_mm.size, coarse)


@dataclass(frozen=True, slots=True, eq=False)
class Level:
    """What pictures in steady light have in common.

    Deviations are judged from each picture to the next: a light that is still changing does not make them large.

    Attributes:
        holes: median share of the picture without depth. holes_std: of one picture's.
        noise_mm: standard deviation of one reading from picture to picture (root mean square over readings; the
            hundredth that jumps farthest counts as if it jumped no farther than the others).
        depth_mm: (h, w) float32, median; NaN where most pictures have none.
        bias_std_mm: of the mean of one picture's readings less these.
        apart_mm, apart_std_mm: mean of how far one picture's readings are from these either way, and its deviation.
    """

    holes: float
    holes_std: float
    noise_mm: float
    depth_mm: F32
    bias_std_mm: float
    apart_mm: float
    apart_std_mm: float

    @classmethod
    def of(cls, pictures: Sequence[Glimpse]) -> Level:
        """Return the level of at least two pictures, in order."""
        stack = np.stack([one.depth_mm for one in pictures])
        seen = np.isfinite(stack).mean(axis=0) >= MOSTLY
        depth = np.full(stack.shape[1:], np.nan, np.float32)
        depth[seen] = np.nanmedian(stack[:, seen], axis=0)
        holes = [one.holes for one in pictures]
        bias_mm, apart_mm = zip(*(_from(depth, one.depth_mm) for one in pictures), strict=True)
        steps = np.diff(stack[:, seen].astype(np.float64), axis=0) ** 2
        steps = steps[np.isfinite(steps)]
        # A reading at an edge that is now of this side, now of the other, would outweigh a thousand others.
        noise = float(np.sqrt(0.5 * np.minimum(steps, np.quantile(steps, BUT_FEW)).mean())) if steps.size else 0.0
        return cls(
            float(np.median(holes)), _deviation(holes), noise, depth, _deviation(bias_mm),
            float(np.median(apart_mm)), _deviation(apart_mm),
        )  # fmt: skip

    def holds(self, picture: Glimpse) -> bool:
        """Tell whether a picture is as the steady ones are, by four of their own standard deviations."""
        bias_mm, apart_mm = _from(self.depth_mm, picture.depth_mm)
        return (
            picture.holes - self.holes <= max(SPREADS * self.holes_std, LEAST_HOLES)
            and abs(bias_mm) <= max(SPREADS * self.bias_std_mm, LEAST_OFF_MM)
            and apart_mm - self.apart_mm <= max(SPREADS * self.apart_std_mm, LEAST_OFF_MM)
        )

    def moved_mm(self, other: Level) -> float:
        """Return how far the readings of two levels lie apart in the mean, millimetres; NaN where none is common."""
        return _from(self.depth_mm, other.depth_mm)[1]


MOSTLY = 0.6
"""A reading counts where at least so many pictures have it."""

BUT_FEW = 0.99
"""Share of the steps between readings beyond which the others count no more."""

SPREADS = 4.0
LEAST_HOLES = 0.004
"""Share of the picture by which holes may differ whatever their spread: a thousand pixels of a Kinect's."""

FAR_MM = 40.0
LEAST_OFF_MM = 0.5
"""A quarter of a Kinect's own step at 1 m."""


def _from(level_mm: F32, depth_mm: F32) -> tuple[float, float]:
    """Return the means of readings less a level's, and of how far they are from it; NaN where none is in both.

    Means, since medians of whole steps jump by whole steps; one that is far off counts as if it were not so far.
    """
    apart = depth_mm - level_mm
    apart = np.clip(apart[np.isfinite(apart)], -FAR_MM, FAR_MM)
    return (float(apart.mean()), float(np.abs(apart).mean())) if apart.size else (float("nan"), float("nan"))


def _deviation(values: Sequence[float]) -> float:
    """Return the standard deviation of values from one to the next, as most of them have it."""
    return float(1.4826 * np.median(np.abs(np.diff(values))) / np.sqrt(2.0))
