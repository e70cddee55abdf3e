"""What the factory wrote into a device of how its two cameras stand to each other.

For each pixel of depth the device knows by how much its place in the colour
picture differs: a cubic polynomial of column and row, given by its differences,
and a shift along the rows that is linear in inverse depth (libfreenect 0.5.3,
src/registration.c). libfreenect itself cuts the places off to whole pixels; here
they stay as exact as they are.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F64
from fruitgui.sensors.kinect.depth_table import ZeroPlane

FIELDS = (
    "dx_center", "ax", "bx", "cx", "dx", "dx_start", "ay", "by", "cy", "dy", "dy_start", "dx_beta_start",
    "dy_beta_start", "rollout_blank", "rollout_size", "dx_beta_inc", "dy_beta_inc", "dxdx_start", "dxdy_start",
    "dydx_start", "dydy_start", "dxdxdx_start", "dydxdx_start", "dxdxdy_start", "dydxdy_start", "back_comp1",
    "dydydx_start", "back_comp2", "dydydy_start",
)  # fmt: skip
"""Of the device's own record, 32 bits each."""

ORDERS = ((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2), (3, 0), (2, 1), (1, 2), (0, 3))
"""(differences along the columns, along the rows) of the fields below."""

DIFFERENCES = {
    "x": ("dx_start", "dxdx_start", "dydx_start", "dxdxdx_start", "dydxdx_start", "dydydx_start",
          "ax", "cx", "dx", "bx"),
    "y": ("dy_start", "dxdy_start", "dydy_start", "dxdxdy_start", "dydxdy_start", "dydydy_start",
          "ay", "cy", "dy", "by"),
}  # fmt: skip
"""The fields that hold the differences of each coordinate, in this order."""

UNITS_PX = tuple(2.0**-power for power in (8, 15, 15, 23, 23, 23, 31, 31, 31, 31))
"""What a step of each is worth."""

_BITS = (19, 21, 21, 24, 24, 24, 32, 32, 32, 32)
"""As many of each are used."""

RGB_DISTANCE_CM = 2.4
"""From the infrared camera to the colour camera, as the makers' own software takes it; devices themselves say 2.3."""

_OFFSET_PX, _SHIFT_OFFSET_PX, _MIDDLE_PX = 1.0, 0.375, 0.5
"""The device's places begin with 1, depth's shift is rounded up a little, and its pixels begin at whole numbers."""


@dataclass(frozen=True, slots=True)
class Factory:
    """What one device says of itself.

    Attributes:
        zero_plane: how raw depth becomes depth.
        registration: the device's record, a value for each of `FIELDS`; zeros where it says nothing.
        start_lines: rows that its colour picture is cut off at the top, counted in pixels of 480.
    """

    zero_plane: ZeroPlane = ZeroPlane()  # noqa: RUF009 - frozen
    registration: tuple[int, ...] = (0,) * len(FIELDS)
    start_lines: int = 0

    def color_pixels(self, u: F64, v: F64, z_m: F64) -> tuple[F64, F64]:
        """Return where (u, v) of the colour picture readings of depth pixels fall; middles of pixels at whole numbers.

        Args:
            u, v: pixels of the depth picture. z_m: depth there. All of one shape.
        """
        du, dv = (self._difference(axis, u, v) for axis in ("x", "y"))
        along = self.parallax_px_m * (100.0 / self.zero_plane.reference_cm - 1.0 / z_m) + _SHIFT_OFFSET_PX
        across = self.start_lines * 480.0 / 640.0
        return u + du + _OFFSET_PX + along - _MIDDLE_PX, v + dv + _OFFSET_PX - across - _MIDDLE_PX

    @property
    def parallax_px_m(self) -> float:
        """By how many colour pixels a reading at 1 m is shifted against one that is far away."""
        return RGB_DISTANCE_CM * 1e-2 * self.zero_plane.focal_px

    def _difference(self, axis: str, u: F64, v: F64) -> F64:
        steps = self._steps(axis)
        return sum((step * one for step, one in zip(steps, newton_basis(u, v), strict=True)), np.zeros(np.shape(u)))

    def _steps(self, axis: str) -> Sequence[float]:
        values = (self.registration[FIELDS.index(name)] for name in DIFFERENCES[axis])
        return [_signed(value, bits) * unit for value, bits, unit in zip(values, _BITS, UNITS_PX, strict=True)]


def newton_basis(u: F64, v: F64) -> list[F64]:
    """Return what each difference counts for at depth pixels: products of binomials; rows count from 1."""
    along, down = _binomials(np.asarray(u, np.float64)), _binomials(np.asarray(v, np.float64) + 1.0)
    return [along[i] * down[j] for i, j in ORDERS]


def _binomials(n: F64) -> list[F64]:
    return [np.ones_like(n), n, n * (n - 1.0) / 2.0, n * (n - 1.0) * (n - 2.0) / 6.0]


def _signed(value: int, bits: int) -> int:
    value &= (1 << bits) - 1
    return value - (1 << bits) if value >> (bits - 1) else value
