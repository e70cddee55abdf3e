"""Depth of a camera of its own brought into the colour camera's picture.

Each reading is put where the colour camera sees its point, both lenses
included; where several meet, the nearest surface wins. Where the colour
picture is finer than the depth, the gaps between neighbours of one surface
are filled; nothing is filled across an edge or into a hole.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from fruitgui.frame import F32, F64, U16, Bools, Intrinsics
from fruitgui.geometry.pose import Pose

_NEAREST_M = 0.3
_EXACT_PX = 0.05
"""A polynomial that is nearer to the true pixel than this stands in for the full projection."""
_SAME_SURFACE_SHIFT = 6
"""Readings nearer to each other than 1/64 of the distance are of one surface."""
_EMPTY = 65535
_FARTHEST_MM = 60000.0
_NOWHERE = 0
"""Place in the canvas, a corner of its border, of readings that are not drawn."""
_NO_GAPS_BELOW = 0.98
_WIDEST_GAP_PX = 8


class DegenerateRegistrationError(ValueError):
    """The colour camera cannot see what the depth camera sees."""


@dataclass(frozen=True, eq=False)
class Registration:
    """How depth is brought into the colour picture.

    Attributes:
        depth: the depth camera.
        color: the colour camera.
        pose: from the depth camera's optical frame into the colour camera's.
    """

    depth: Intrinsics
    color: Intrinsics
    pose: Pose

    def apply(self, depth_mm: U16) -> U16:
        """Return depth along the colour camera's axis, mm, (color.height, color.width), 0 = no reading.

        Args:
            depth_mm: (depth.height, depth.width), 0 = no reading.
        """
        z_mm = np.ascontiguousarray(depth_mm).ravel()
        places = self._places(z_mm)
        z_in_color = self._z_in_color(z_mm)
        places[(z_mm == 0) | (z_in_color == _EMPTY)] = _NOWHERE
        canvas = np.full((self.color.height + 2) * (self.color.width + 2), _EMPTY, dtype=np.uint16)
        _draw_nearest(canvas, places, z_in_color)
        picture = canvas.reshape(self.color.height + 2, self.color.width + 2)[1:-1, 1:-1]
        picture = np.where(picture == _EMPTY, np.uint16(0), picture)
        return _without_gaps(picture, *self._gaps)

    def _places(self, z_mm: U16) -> NDArray[np.int32]:
        """Return where in the canvas, which has a border of one pixel, each reading falls."""
        if self._polynomial is None:
            pixels = self._pixels_exactly(z_mm.astype(np.float64) * 1e-3).astype(np.float32)
            u, v = pixels[:, 0], pixels[:, 1]
        else:
            w = _inverse_depth_table()[z_mm]
            u, v = (_value(coefficients, w) for coefficients in self._polynomial)
        np.clip(u, -1.0, self.color.width, out=u)
        np.clip(v, -1.0, self.color.height, out=v)
        u += np.float32(1.5)
        v += np.float32(1.5)
        places = v.astype(np.int32)
        places *= self.color.width + 2
        places += u.astype(np.int32)
        return places

    def _z_in_color(self, z_mm: U16) -> U16:
        z = z_mm * self._directions[:, 2]
        z += np.float32(self.pose.translation_m[2] * 1e3 + 0.5)
        np.copyto(z, np.float32(_EMPTY), where=(z < 1.0) | (z > _FARTHEST_MM))
        return z.astype(np.uint16)

    @cached_property
    def _directions(self) -> F32:
        """Rays of all depth pixels, z = 1 before turning, in the colour camera's axes: (N, 3)."""
        rays = self.depth.rays().reshape(-1, 2).astype(np.float64)
        directions = self.pose.turn(np.hstack([rays, np.ones((len(rays), 1))]))
        return np.asarray(directions, dtype=np.float32, order="F")

    def _pixels_exactly(self, z_m: F64) -> F64:
        """Return the colour pixels (N, 2) of one depth per depth pixel; far outside where it is not in view."""
        points = self._directions.astype(np.float64) * z_m[:, None] + self.pose.translation_m
        ahead = points[:, 2] > 1e-3
        points[~ahead] = (0.0, 0.0, 1.0)
        pixels = self.color.project(points)
        outside = ~(ahead & self._in_lens(points))
        pixels[outside] = -1e4
        return pixels

    def _in_lens(self, points_m: F64) -> Bools:
        """Tell which points are within the picture as the lens bends it.

        Outside it the lens polynomial is not defined and may fold back into the picture.
        """
        if not self.color.distortion:
            return np.ones(len(points_m), dtype=bool)
        rays = self.color.rays()
        x, y = points_m[:, 0] / points_m[:, 2], points_m[:, 1] / points_m[:, 2]
        low, high = rays.min(axis=(0, 1)) - 0.05, rays.max(axis=(0, 1)) + 0.05
        return np.asarray((x > low[0]) & (x < high[0]) & (y > low[1]) & (y < high[1]))

    @cached_property
    def _polynomial(self) -> tuple[F32, F32] | None:
        """Coefficients in inverse depth of each depth pixel's u and v, (3, N) each; None where they do not hold."""
        w = np.array([0.05, 0.4, 0.7]) / _NEAREST_M * 1.0
        w = np.array([w[0], 0.5 * (w[0] + 1.0 / _NEAREST_M), 1.0 / _NEAREST_M])
        count = len(self._directions)
        samples = np.stack([self._pixels_exactly(np.full(count, 1.0 / one)) for one in w])
        inverse = np.linalg.inv(np.vander(w, 3, increasing=True))
        coefficients = np.einsum("ij,jnk->kin", inverse, samples)
        seen = (samples > -1e3).all(axis=(0, 2))
        if not seen.all():
            coefficients[:, 0, ~seen] = -1e4
            coefficients[:, 1:, ~seen] = 0.0
        for between in (w[0] * 0.7 + w[2] * 0.3, w[0] * 0.3 + w[2] * 0.7):
            true = self._pixels_exactly(np.full(count, 1.0 / between))
            guess = coefficients[:, 0] + between * (coefficients[:, 1] + between * coefficients[:, 2])
            inside = (true > -1e3).all(axis=1) & self._in_picture(true)
            if np.abs(guess.T - true)[inside].max(initial=0.0) > _EXACT_PX:
                return None
        u, v = coefficients.astype(np.float32)
        return u, v

    def _in_picture(self, pixels: F64) -> Bools:
        u, v = pixels[:, 0], pixels[:, 1]
        return np.asarray((u > -1) & (u < self.color.width) & (v > -1) & (v < self.color.height))

    @cached_property
    def _gaps(self) -> tuple[int, int]:
        """Empty pixels that may lie between neighbours of one surface at 1 m: (along rows, along columns)."""
        shape = (self.depth.height, self.depth.width, 2)
        pixels = self._pixels_exactly(np.ones(self.depth.height * self.depth.width)).reshape(shape)
        return _gap(np.diff(pixels[..., 0], axis=1)), _gap(np.diff(pixels[..., 1], axis=0))


def _gap(steps_px: F64) -> int:
    steps = steps_px[(steps_px > 0) & (steps_px < _WIDEST_GAP_PX + 1)]
    widest = float(np.quantile(steps, 0.99)) if steps.size else 0.0
    return 0 if widest < _NO_GAPS_BELOW else min(max(int(np.ceil(widest)) - 1, 1), _WIDEST_GAP_PX)


_INVERSE_DEPTH = np.zeros(65536, dtype=np.float32)
_INVERSE_DEPTH[1:] = 1000.0 / np.arange(1, 65536)


def _inverse_depth_table() -> F32:
    return _INVERSE_DEPTH


def _value(coefficients: F32, w: F32) -> F32:
    value = coefficients[2] * w
    value += coefficients[1]
    value *= w
    value += coefficients[0]
    return value


def _draw_nearest(canvas: U16, places: NDArray[np.int32], z_mm: U16) -> None:
    """Write each reading to its place; where several meet, one of the nearest surface stays.

    Of readings of one surface any may stay: always keeping the least would pull
    the surface towards the sensor by the noise.
    """
    drawn = z_mm
    while len(places):
        canvas[places] = drawn
        canvas[_NOWHERE] = 0
        nearer = drawn + (drawn >> _SAME_SURFACE_SHIFT) < canvas[places]
        places, drawn = places[nearer], drawn[nearer]


def _without_gaps(depth_mm: U16, along_rows: int, along_columns: int) -> U16:
    """Fill gaps of up to so many pixels whose two ends are of one surface."""
    if along_rows:
        depth_mm = _fill(depth_mm, along_rows)
    if along_columns:
        depth_mm = np.ascontiguousarray(_fill(np.ascontiguousarray(depth_mm.T), along_columns).T)
    return depth_mm


def _fill(depth_mm: U16, widest: int) -> U16:
    """Fill gaps within the rows, also those through which a farther surface shines."""
    filled = depth_mm.copy()
    for gap in range(1, widest + 1):
        left, right = filled[:, : -gap - 1], filled[:, gap + 1 :]
        near, far = np.minimum(left, right), np.maximum(left, right)
        one_surface = (near > 0) & (far - near <= near >> _SAME_SURFACE_SHIFT)
        for step in range(1, gap + 1):
            middle = filled[:, step : step - gap - 1]
            open_here = one_surface & ((middle == 0) | (middle > far + (far >> _SAME_SURFACE_SHIFT)))
            between = left + ((right.astype(np.int32) - left) * step // (gap + 1)).astype(np.uint16)
            middle[open_here] = between[open_here]
    return filled
