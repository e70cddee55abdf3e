"""What a factory would write into a Kinect with given cameras."""

from __future__ import annotations

import struct

import numpy as np

from fruitgui.frame import F64
from fruitgui.sensors.kinect.factory import DIFFERENCES, FIELDS, UNITS_PX, newton_basis

_MASK = (1 << 32) - 1


def registration_bytes(
    focal_px: float = 525.0,
    middle_px: tuple[float, float] = (316.0, 242.0),
    k1: float = 0.02,
    roll: float = 0.004,
    infrared_focal_px: float = 120.0 / (2 * 0.1042),
) -> bytes:
    """Return the device's record (116 bytes) for a colour camera with these intrinsics, rolled by some radians.

    The differences of a cubic polynomial are fitted to where the colour camera
    sees what lies on the reference plane, 1.2 m away.
    """
    u, v = (one.ravel() for one in np.meshgrid(np.arange(4.0, 640, 9), np.arange(4.0, 480, 9)))
    wanted = _color_pixels(u, v, focal_px, middle_px, k1, roll, infrared_focal_px)
    values = dict.fromkeys(FIELDS, 0)
    basis = np.stack(newton_basis(u, v), axis=1)
    for axis, target, own in (("x", wanted[0], u), ("y", wanted[1], v)):
        # what the device adds of its own: places begin with 1, along the rows shifts are rounded up, see `Factory`
        constant = 1.0 - 0.5 + (0.375 if axis == "x" else 0.0)
        steps, *_ = np.linalg.lstsq(basis, target - own - constant, rcond=None)
        for name, step, unit in zip(DIFFERENCES[axis], steps, UNITS_PX, strict=True):
            values[name] = round(float(step) / unit)
    return struct.pack("<29I", *(values[name] & _MASK for name in FIELDS))


def _color_pixels(
    u: F64, v: F64, focal_px: float, middle_px: tuple[float, float], k1: float, roll: float, infrared_px: float
) -> tuple[F64, F64]:
    x, y = (u - 319.5) / infrared_px, (v - 239.5) / infrared_px
    parallax = 0.024 * infrared_px / focal_px / 1.2
    x, y = np.cos(roll) * x - np.sin(roll) * y - parallax, np.sin(roll) * x + np.cos(roll) * y
    bend = 1.0 + k1 * (x * x + y * y)
    return focal_px * x * bend + middle_px[0], focal_px * y * bend + middle_px[1]
