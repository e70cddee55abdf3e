"""Depth of a camera of its own brought into the colour camera's picture.

Each reading is drawn over the area that its pixel covers in the colour
picture, both lenses included: over every colour pixel whose middle lies in
it. Where several meet, the nearest surface wins. Drawn as points, surfaces
would end half a depth pixel early and half a colour pixel late, and shrink or
grow unless both are alike. Where a surface slopes, neighbours part by less
than a pixel; such cracks are closed, wider gaps and edges stay as they are.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fruitgui.frame import F32, F64, U16, Bools, Intrinsics, Ints
from fruitgui.geometry.pose import Pose
from fruitgui.sensors.footprints import EMPTY, nearest, reach, spread, without_cracks
from fruitgui.sensors.lens import pixels_of_rays

_NEAREST_M, _FARTHEST_M = 0.3, 8.0
_FARTHEST_MM = 60000.0
_CLOSE_ENOUGH_PX = 0.1
"""A polynomial nearer than this to the true pixel, everywhere in view, stands in for the projection."""
_EVERY, _SOME = slice(None), slice(None, None, 41)
_WIDEST_HALF_PX = 8.0
"""No reading reaches farther than this from its middle: more is where the colour camera stops seeing."""


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
        places, z_in_color = self._covered(np.ascontiguousarray(depth_mm).ravel())
        picture = nearest(self.color.height * self.color.width, places, z_in_color)
        picture[picture == EMPTY] = 0
        return without_cracks(picture.reshape(self.color.height, self.color.width))

    def _covered(self, z_mm: U16) -> tuple[Ints, U16]:
        """Return the places, in the picture laid out row by row, that readings cover, and the depth there."""
        u, v = self._middles(z_mm)
        half_v = self._halves[1]
        left, wide = reach(*self._sides(u), self.color.width)
        corners, high = reach(v - half_v, v + half_v, self.color.height)
        corners *= self.color.width
        corners += left
        z_in_color = self._z_in_color(z_mm)
        np.copyto(high, 0, where=z_in_color == EMPTY)
        return spread(corners, wide, high, self.color.width, z_in_color)

    def _middles(self, z_mm: U16) -> tuple[F32, F32]:
        """Return where in the colour picture (u, v) the middle of each reading falls, (N,) each."""
        if self._polynomials is None:
            u, v = (one.astype(np.float32) for one in self._pixels(np.maximum(z_mm, 1) * 1e-3))
            return u, v
        w = _INVERSE_DEPTH.take(z_mm)
        u, v = (_value(coefficients, w) for coefficients in self._polynomials)
        return u, v

    def _sides(self, u: F32) -> tuple[F32, F32]:
        """Return where each reading begins and ends along the colour picture's rows, (N,) each.

        The cameras stand side by side, so across a slope readings draw apart or
        together; neighbours of one surface meet half way between their middles.
        """
        half, grid = self._halves[0], (self.depth.height, self.depth.width)
        left, right, middles = u - half, u + half, u.reshape(grid)
        apart = middles[:, 1:] - middles[:, :-1]
        apart -= self._steps
        apart *= 0.5
        np.copyto(apart, 0.0, where=np.abs(apart) > self._most_apart_px)
        left.reshape(grid)[:, 1:] -= apart
        right.reshape(grid)[:, :-1] += apart
        return left, right

    def _z_in_color(self, z_mm: U16) -> U16:
        """Return the depth along the colour camera's axis, `EMPTY` where there is none."""
        z = z_mm.astype(np.float32)
        z *= self._directions[2]
        z += np.float32(self.pose.translation_m[2] * 1e3 + 0.5)
        np.copyto(z, np.float32(EMPTY), where=(z_mm == 0) | (z < 1.0) | (z > _FARTHEST_MM))
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
    def _halves(self) -> tuple[F32, F32]:
        """How far each depth pixel reaches from its middle along u and v, colour pixels at 1 m: (N,) each.

        It is a square turned a little; the upright one of the same size stands for it.
        """
        u, v = (_half(one.reshape(self.depth.height, self.depth.width)) for one in self._pixels(np.array(1.0)))
        return u, v

    @cached_property
    def _steps(self) -> F32:
        """From each depth pixel's middle to the next one's in its row on a level surface: (rows, columns - 1)."""
        half = self._halves[0].reshape(self.depth.height, self.depth.width)
        return half[:, 1:] + half[:, :-1]

    @cached_property
    def _most_apart_px(self) -> np.float32:
        """How far the edge between neighbours of one surface may lie from where it does on a level one."""
        return np.float32(0.25 * np.median(self._halves[0]))


def _half(pixels: F64) -> F32:
    """Return half of what a coordinate (rows, columns) changes over one pixel of its grid, (N,)."""
    steps = [np.gradient(pixels, axis=axis) for axis in (0, 1) if pixels.shape[axis] > 1]
    half = 0.5 * np.sqrt(sum((step**2 for step in steps), np.zeros(pixels.shape)))
    return np.minimum(half, _WIDEST_HALF_PX).astype(np.float32).ravel()


_INVERSE_DEPTH = np.zeros(65536, dtype=np.float32)
_INVERSE_DEPTH[1:] = 1000.0 / np.arange(1, 65536)


def _value(coefficients: F32, w: F32) -> F32:
    value: F32 = coefficients[2] * w
    value += coefficients[1]
    value *= w
    value += coefficients[0]
    return value
