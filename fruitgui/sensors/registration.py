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

from fruitgui.frame import F32, F64, U16, Bools, Intrinsics, Ints
from fruitgui.geometry.pose import Pose
from fruitgui.sensors.lens import pixels_of_rays

_NEAREST_M, _FARTHEST_M = 0.3, 8.0
_FARTHEST_MM = 60000.0
_CLOSE_ENOUGH_PX = 0.1
"""A polynomial nearer than this to the true pixel, everywhere in view, stands in for the projection."""
_SAME_SURFACE_SHIFT = 6
"""Readings nearer to each other than 1/64 of the distance are of one surface."""
_EMPTY = 64000
"""Stands for "no reading" while readings are drawn: farther than any, and any reading goes before it."""
_EVERY, _SOME = slice(None), slice(None, None, 41)
_NO_GAPS_BELOW = 0.98
_WIDEST_GAP_PX = 8


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
        z_in_color, places = self._z_in_color(z_mm), self._places(z_mm)
        rows, columns = self.color.height + 2, self.color.width + 2
        picture = _nearest(rows, columns, places, z_in_color)[1:-1, 1:-1]
        picture[picture == _EMPTY] = 0
        return _without_gaps(picture, *self._gaps)

    def _places(self, z_mm: U16) -> Ints:
        """Return where in the canvas, which has a border of one pixel, each reading falls."""
        if self._polynomials is None:
            u, v = (one.astype(np.float32) for one in self._pixels(np.maximum(z_mm, 1) * 1e-3))
        else:
            w = _INVERSE_DEPTH[z_mm]
            u, v = (_value(coefficients, w) for coefficients in self._polynomials)
        np.clip(u, -1.0, self.color.width, out=u)
        np.clip(v, -1.0, self.color.height, out=v)
        u += np.float32(1.5)
        v += np.float32(1.5)
        places = v.astype(np.intp)
        places *= self.color.width + 2
        places += u.astype(np.int32)
        return places

    def _z_in_color(self, z_mm: U16) -> U16:
        """Return the depth along the colour camera's axis, `_EMPTY` where there is none."""
        z: F32 = z_mm * self._directions[2]
        z += np.float32(self.pose.translation_m[2] * 1e3 + 0.5)
        np.copyto(z, np.float32(_EMPTY), where=(z_mm == 0) | (z < 1.0) | (z > _FARTHEST_MM))
        return np.asarray(z, dtype=np.uint16)

    @cached_property
    def _directions(self) -> F32:
        """Rays of all depth pixels, z = 1 before turning, in the colour camera's axes: (3, N)."""
        rays = self.depth.rays().reshape(-1, 2).astype(np.float64)
        directions: F32 = (self.pose.rotation @ np.vstack([rays.T, np.ones(len(rays))])).astype(np.float32)
        return directions

    def _pixels(self, z_m: F64, only: slice = _EVERY) -> tuple[F64, F64]:
        """Return the colour pixels of one depth (N,) or () per depth pixel; far outside where behind the camera."""
        x, y, z = (d[only] * z_m + t for d, t in zip(self._directions, self.pose.translation_m, strict=True))
        ahead = z > 1e-3
        z = np.where(ahead, z, 1.0)
        u, v = pixels_of_rays(self.color, x / z, y / z)
        return np.where(ahead, u, -1e4), np.where(ahead, v, -1e4)

    @cached_property
    def _polynomials(self) -> tuple[F32, F32] | None:
        """Coefficients in inverse depth of each depth pixel's u and v, (3, N) each; None where they do not hold.

        A reading moves along its epipolar line as its depth changes, smoothly in
        inverse depth; for cameras a few centimetres apart a parabola is exact to
        hundredths of a pixel.
        """
        low, high = 1.0 / _FARTHEST_M, 1.0 / _NEAREST_M
        nodes = 0.5 * (low + high) + 0.5 * (high - low) * np.cos(np.pi * np.array([1, 3, 5]) / 6)
        samples = np.stack([self._pixels(np.array(1.0 / w)) for w in nodes])
        coefficients = np.einsum("ij,jan->ain", np.linalg.inv(np.vander(nodes, 3, increasing=True)), samples)
        u, v = coefficients.astype(np.float32)
        worst_px = max(self._error_px(u, v, w) for w in np.linspace(low, high, 5))
        return (u, v) if worst_px < _CLOSE_ENOUGH_PX else None

    def _error_px(self, u: F32, v: F32, w: float) -> float:
        """Return how far the polynomials are off at one inverse depth, in view, on some of the pixels."""
        true = np.stack(self._pixels(np.array(1.0 / w), _SOME))
        at = np.full(1, w, dtype=np.float32)
        guess = np.stack([_value(u[:, _SOME], at), _value(v[:, _SOME], at)])
        return float(np.abs(guess - true)[:, self._in_picture(true)].max(initial=0.0))

    def _in_picture(self, pixels: F64) -> Bools:
        u, v = pixels
        return np.asarray((u > -1) & (u < self.color.width) & (v > -1) & (v < self.color.height))

    @cached_property
    def _gaps(self) -> tuple[int, int]:
        """Empty pixels that may lie between neighbours of one surface at 1 m: (along rows, along columns)."""
        u, v = (one.reshape(self.depth.height, self.depth.width) for one in self._pixels(np.array(1.0)))
        return _gap(np.diff(u, axis=1)), _gap(np.diff(v, axis=0))


def _gap(steps_px: F64) -> int:
    steps = steps_px[(steps_px > 0) & (steps_px < _WIDEST_GAP_PX + 1)]
    widest = float(np.quantile(steps, 0.99)) if steps.size else 0.0
    return 0 if widest < _NO_GAPS_BELOW else min(max(int(np.ceil(widest)) - 1, 1), _WIDEST_GAP_PX)


_INVERSE_DEPTH = np.zeros(65536, dtype=np.float32)
_INVERSE_DEPTH[1:] = 1000.0 / np.arange(1, 65536)


def _value(coefficients: F32, w: F32) -> F32:
    value: F32 = coefficients[2] * w
    value += coefficients[1]
    value *= w
    value += coefficients[0]
    return value


def _nearest(rows: int, columns: int, places: Ints, z_mm: U16) -> U16:
    """Draw each reading at its place; where several meet, one of the nearest surface stays.

    Of readings of one surface any may stay: always keeping the least would pull
    the surface towards the sensor by the noise.
    """
    canvas: U16 = np.full(rows * columns, _EMPTY, dtype=np.uint16)
    canvas[places] = z_mm
    picture = canvas.reshape(rows, columns)
    picture[(0, -1), :] = 0
    picture[:, (0, -1)] = 0
    nearer = _goes_before(z_mm, canvas.take(places))
    while len(nearer):
        places, z_mm = places[nearer], z_mm[nearer]
        canvas[places] = z_mm
        nearer = _goes_before(z_mm, canvas.take(places))
    return picture


def _goes_before(z_mm: U16, drawn_mm: U16) -> Ints:
    """Return which readings are of a surface that is nearer than what is drawn in their place."""
    return np.flatnonzero(z_mm + (z_mm >> _SAME_SURFACE_SHIFT) < drawn_mm)


def _without_gaps(depth_mm: U16, along_rows: int, along_columns: int) -> U16:
    """Fill gaps of up to so many pixels whose two ends are of one surface.

    The grid of readings is bent, so its rows step from one row of the picture to
    the next; what is open at such a step is closed along the rows once the
    columns beside it are.
    """
    if along_rows:
        depth_mm = _fill(depth_mm, along_rows)
    if along_columns:
        depth_mm = np.ascontiguousarray(_fill(np.ascontiguousarray(depth_mm.T), along_columns).T)
        depth_mm = _fill(depth_mm, max(along_rows, 1))
    return depth_mm


def _fill(depth_mm: U16, widest: int) -> U16:
    """Fill gaps within the rows, also those through which a farther surface shines."""
    filled = depth_mm.copy()
    for gap in range(1, widest + 1):
        left, right = filled[:, : -gap - 1], filled[:, gap + 1 :]
        near, far = np.minimum(left, right), np.maximum(left, right)
        far += far >> _SAME_SURFACE_SHIFT
        one_surface = (near > 0) & (far - near <= near >> (_SAME_SURFACE_SHIFT - 1))
        for step in range(1, gap + 1):
            middle = filled[:, step : step - gap - 1]
            open_here = np.flatnonzero(one_surface & (middle - np.uint16(1) >= far))
            rows, columns = np.divmod(open_here, middle.shape[1])
            first, last = left[rows, columns].astype(np.int32), right[rows, columns].astype(np.int32)
            middle[rows, columns] = (first + (2 * (last - first) * step + gap + 1) // (2 * (gap + 1))).astype(np.uint16)
    return filled
