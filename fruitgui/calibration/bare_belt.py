"""What one frame says of the bare parts of the belt: how far they are read to be, and how bright, red and blue.

Fruit may pass meanwhile: what does not lie on the belt's plane is not looked at.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.calibration import planes
from fruitgui.calibration.still import average
from fruitgui.calibration.surface import fit_belt
from fruitgui.frame import F64, Bools, Frame

LOOKED_AT_PX = 160
"""Pictures are thinned to about this width: thousands of pixels are enough."""

NEAR = 0.012
"""Readings this near the belt, as a share of its distance, are of the belt: fruit are higher."""

LEAST_SHARE = 0.2
"""At least so much of the belt that was bare at first must be bare again."""

FEWEST_PX = 200
LEAST_VALUE, MOST_VALUE = 4.0, 250.0
"""Colours darker or brighter than this say nothing of the light."""

TONE = 2.0
"""Values go about with the square root of light."""


@dataclass(frozen=True, slots=True, eq=False)
class BeltPatch:
    """The belt as a sensor saw it first.

    Attributes:
        coefficients: (3,) of its plane, 1/z = a·(x, y, 1).
        on: (h, w) pixels of it, thinned.
        step: every so-manieth pixel is looked at.
        distance_m: of the belt, the middle one of its pixels.
    """

    coefficients: F64
    on: Bools
    step: int
    distance_m: float


@dataclass(frozen=True, slots=True)
class BeltReading:
    """What one frame says of the belt.

    Attributes:
        time_s: of the frame, in the sensor's own clock.
        off_m: how much farther the belt is read to be than at first.
        light: (red, green, blue) of its bare parts, linear, 0–1; None where they are too dark or too bright to tell.
    """

    time_s: float
    off_m: float
    light: tuple[float, float, float] | None


def first_patch(frames: Sequence[Frame]) -> BeltPatch | None:
    """Return the belt in one sensor's frames; None where there is none. Fruit on it do not matter."""
    still = average(frames)
    belt = fit_belt(still)
    if belt is None:
        return None
    step = max(1, still.intrinsics.width // LOOKED_AT_PX)
    on = belt.on[::step, ::step]
    if on.sum() < FEWEST_PX:
        return None
    coefficients = planes.coefficients_of(belt.plane)
    distance_m = float(np.median(1.0 / (planes.rays_of(still, step)[on] @ coefficients)))
    return BeltPatch(coefficients, on, step, distance_m)


def read_belt(frame: Frame, patch: BeltPatch, about_m: float = 0.0) -> BeltReading | None:
    """Return what a frame says of the belt; None where it is covered, or no longer where it was.

    Args:
        frame: of the same sensor, uncorrected as the patch's frames were, or corrected as they were.
        patch: the belt as it was seen first.
        about_m: how much farther it was read to be lately.
    """
    step = patch.step
    depth_m = frame.depth_mm[::step, ::step].astype(np.float64) * 1e-3
    rays = frame.intrinsics.rays()[::step, ::step]
    a = patch.coefficients
    share = depth_m * (rays[..., 0] * a[0] + rays[..., 1] * a[1] + a[2]) - 1.0
    about = about_m / patch.distance_m
    bare = patch.on & (depth_m > 0) & (np.abs(share - about) < NEAR)
    if bare.sum() < max(FEWEST_PX, LEAST_SHARE * patch.on.sum()):
        return None
    middle = float(share[bare].mean())
    bare &= np.abs(share - middle) < NEAR
    off = float(share[bare].mean())
    return BeltReading(frame.time_s, off * patch.distance_m, _light(frame, bare, step))


def _light(frame: Frame, bare: Bools, step: int) -> tuple[float, float, float] | None:
    """Return the middle colour of what is bare, away from fruit and their shadows."""
    inner = cv2.erode(bare.astype(np.uint8), np.ones((3, 3), np.uint8)).astype(bool)
    colors = frame.color[::step, ::step][inner]
    if len(colors) < FEWEST_PX:
        return None
    red, green, blue = (float(np.mean(_middle(colors[:, channel]))) for channel in range(3))
    if not all(LEAST_VALUE < one < MOST_VALUE for one in (red, green, blue)):
        return None
    linear = [(one / 255.0) ** TONE for one in (red, green, blue)]
    return linear[0], linear[1], linear[2]


def _middle(values: np.ndarray) -> np.ndarray:
    """Return the values between the quartiles: their mean is a median that is finer than one step."""
    low, high = np.percentile(values, (25, 75))
    return np.asarray(values[(values >= low) & (values <= high)])
