"""What the device's raw depth means in millimetres."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from fruitgui.frame import U16, Ints

RAW_VALUES = 2048
NO_RAW = 2047
FARTHEST_MM = 10000.0
"""Farther than this the steps between two raw values are wider than 30 cm; nothing is meant by them."""

_RAW_PER_PIXEL, _OFFSET_PX = 4.0, 0.375


@dataclass(frozen=True, slots=True)
class ZeroPlane:
    """The factory's reference picture, with which the device compares what it sees. These are the usual values.

    Attributes:
        emitter_cm: from the projector to the infrared camera.
        reference_cm: how far away the reference picture was taken.
        pixel_cm: size of a pixel of the full (1280 wide) infrared picture on that plane.
        const_shift_px: shift that stands for no difference, in pixels of that picture.
    """

    emitter_cm: float = 7.5
    reference_cm: float = 120.0
    pixel_cm: float = 0.1042
    const_shift_px: float = 200.0

    @property
    def focal_px(self) -> float:
        """Focal length of the infrared camera, pixels of the picture of 640."""
        return self.reference_cm / (2.0 * self.pixel_cm)

    @property
    def is_plausible(self) -> bool:
        """Whether these can be a Kinect's; a device that is broken says anything, or nothing but zeros."""
        if self.pixel_cm == 0.0:
            return False
        limits = (
            (self.emitter_cm, 5.0, 10.0),
            (self.reference_cm, 60.0, 240.0),
            (self.focal_px, 450.0, 700.0),
            (self.const_shift_px, 50.0, 400.0),
        )
        return all(math.isfinite(value) and low <= value <= high for value, low, high in limits)


def depth_table(plane: ZeroPlane) -> U16:
    """Return the depth of each raw value (2048,), whole millimetres, 0 where none is meant.

    The shift of the pattern against the reference picture is a disparity, and
    depth = reference · emitter / (emitter − shift) (Khoshelham and Elberink,
    Sensors 12, 2012). libfreenect cuts the result off instead of rounding it, and
    lets raw values beyond the last meaningful one wrap to plausible depths.
    """
    raw = np.arange(RAW_VALUES, dtype=np.float64)
    shift_cm = (raw / _RAW_PER_PIXEL - plane.const_shift_px - _OFFSET_PX) * plane.pixel_cm
    left_cm = plane.emitter_cm - shift_cm
    with np.errstate(divide="ignore"):
        depth_mm = 10.0 * plane.reference_cm * plane.emitter_cm / left_cm
    good = (left_cm > 0.0) & (depth_mm >= 0.5) & (depth_mm <= FARTHEST_MM) & (raw < NO_RAW)
    return np.where(good, np.rint(np.where(good, depth_mm, 0.0)), 0.0).astype(np.uint16)


def millimetres(raw: U16, table: U16) -> U16:
    """Return the depth of raw values, same shape; none for values that no device gives."""
    index: Ints = np.minimum(raw, NO_RAW).astype(np.intp)
    return table.take(index)
