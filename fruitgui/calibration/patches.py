"""One view as small patches of surface: a plane about every second pixel, its normal as quiet as the surface allows.

A plane is linear in inverse depth, 1/z = a·(x, y, 1), and there noise is uniform, so a patch is its `a`: a·X = 1
for the points X of its plane. Normals fitted to a few pixels are off by degrees. Thousands of them on a bare
table pull a registration aside along it, as if the noise held it; so patches of one large flat share its normal,
and only where the surface truly leans is a registration held.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.calibration import planes
from fruitgui.calibration.relief import edge_px, far_from_edges
from fruitgui.calibration.still import INVERSE_NOISE, INVERSE_STEP, Still
from fruitgui.frame import F32, F64, Bools, Intrinsics

FARTHEST_M = 4.0
VARIANCE = INVERSE_NOISE**2 + INVERSE_STEP**2 / 12
"""Of one reading of a Kinect v1, 1/m²."""

ROUGHEST = 4.0
"""Readings that spread by more than this many times `VARIANCE` about their plane lie across an edge or a fold."""

ON_FLAT = 3.0e-3
"""Patches of a flat lie within this of it, 1/m: what a window's mean errs, and what real devices bend."""

LEAN_COS = float(np.cos(np.radians(20.0)))
"""Normals of small windows that lean less than this from a flat's are of it: three times what noise makes of them."""

MOST_FLATS, FEWEST_ON_FLAT, TRIALS = 16, 50, 150
EVERY = 3
"""One patch in so many, each way, takes part in registering: windows of patches nearer than that share their pixels."""


@dataclass(frozen=True, slots=True, eq=False)
class Patches:
    """The patches of one view.

    Attributes:
        camera: of the picture.
        stride: pixels from one patch to the next.
        planes: (H/stride, W/stride, 3) the a of every patch, zeros where there is none.
        points_m: (N, 3) middles of the chosen patches, optical frame.
        normals: (N, 3) of these, towards the sensor.
    """

    camera: Intrinsics
    stride: int
    planes: F32
    points_m: F64
    normals: F64


def patches(still: Still) -> Patches:
    """Fit the patches of one view."""
    scale = still.intrinsics.width / 640
    stride = max(1, round(2 * scale))
    rays = planes.rays_of(still)[::stride, ::stride]
    small = _windows(still, max(2, round(4 * scale)), stride)
    large = _windows(still, max(3, round(7 * scale)), stride)
    fitted, sound = small.planes, small.sound
    inverse = (fitted * rays).sum(axis=2)
    sound &= inverse > 1.0 / FARTHEST_M
    fitted[~sound] = 0.0
    flat = _share_normals(fitted, inverse, rays, sound)
    straight = inverse - np.where(flat | ~large.sound, 0.0, _sag(small, large, inverse, rays))
    fitted *= (straight / np.where(sound, inverse, 1.0))[..., None]
    chosen = np.zeros_like(sound)
    chosen[EVERY // 2 :: EVERY, EVERY // 2 :: EVERY] = True
    chosen &= sound
    a = fitted[chosen]
    return Patches(
        camera=still.intrinsics,
        stride=stride,
        planes=fitted.astype(np.float32),
        points_m=rays[chosen] / straight[chosen][:, None],
        normals=-a / np.linalg.norm(a, axis=1, keepdims=True),
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Windows:
    """Planes (…, 3) of the windows about every `stride`-th pixel, where they are sound, how far they reach (rays²)."""

    planes: F64
    sound: Bools
    reach: F64


def _sag(small: _Windows, large: _Windows, inverse: F64, rays: F64) -> F64:
    """Return by how much the small window's mean misses the surface in its middle, where that is bent, 1/m.

    The mean over a bent surface misses its middle in proportion to the window's second moment; two sizes tell it.
    Seen from twice as far the same window misses four times as much, which would pull near and far views apart.
    """
    grown = np.maximum(large.reach - small.reach, small.reach)
    return np.asarray(((large.planes * rays).sum(axis=2) - inverse) * small.reach / np.where(grown > 0, grown, 1.0))


def _windows(still: Still, half_px: int, stride: int) -> _Windows:
    usable = still.seen & (far_from_edges(still) >= edge_px(still))
    wide = 2 * half_px + 1
    use = usable.astype(np.float64)

    def total(of: F64) -> F64:
        summed = cv2.boxFilter(of, cv2.CV_64F, (wide, wide), normalize=False, borderType=cv2.BORDER_CONSTANT)
        return np.asarray(summed[::stride, ::stride], dtype=np.float64)

    def mean(of: F64) -> F64:
        return total(use * of) / count

    count = np.maximum(total(use), 1.0)
    q, rays = still.inverse_depth.astype(np.float64), planes.rays_of(still)
    x, y = rays[..., 0], rays[..., 1]
    mx, my, mq = mean(x), mean(y), mean(q)
    xx, xy, yy = mean(x * x) - mx * mx, mean(x * y) - mx * my, mean(y * y) - my * my
    xq, yq, qq = mean(x * q) - mx * mq, mean(y * q) - my * mq, mean(q * q) - mq * mq
    full = (0.3 * half_px / still.intrinsics.fx) ** 4  # a whole window has (half_px / fx)⁴ / 9
    det = xx * yy - xy * xy
    sound = usable[::stride, ::stride] & (count > 0.5 * wide**2) & (det > full)
    det = np.where(sound, det, 1.0)
    a, b = (yy * xq - xy * yq) / det, (xx * yq - xy * xq) / det
    sound &= qq - a * xq - b * yq < ROUGHEST * VARIANCE
    return _Windows(np.stack([a, b, mq - a * mx - b * my], axis=2), np.asarray(sound), xx + yy)


def _share_normals(fitted: F64, inverse: F64, rays: F64, sound: Bools) -> Bools:
    """Give all patches of a large flat its normal, in place; each keeps its own distance. Return which are of one."""
    free = sound.copy()
    rng = np.random.default_rng(0)
    for _ in range(MOST_FLATS):
        plane = _largest_flat(fitted, inverse, rays, free, rng)
        if plane is None:
            break
        on = free & _lies_on(plane, fitted, inverse, rays)
        fitted[on] = plane * (inverse[on] / (rays[on] @ plane))[:, None]
        free &= ~on
    return sound & ~free


def _largest_flat(fitted: F64, inverse: F64, rays: F64, free: Bools, rng: np.random.Generator) -> F64 | None:
    """Return the plane (3,) that most free patches lie on; None where only few do."""
    thin = np.zeros_like(free)
    thin[::4, ::4] = True
    thin &= free
    v, u = np.nonzero(thin)
    if len(v) * 16 < FEWEST_ON_FLAT:
        return None
    tried = fitted[v, u][rng.choice(len(v), min(TRIALS, len(v)), replace=False)]
    a, q, ray = fitted[thin], inverse[thin], rays[thin]
    lengths = np.linalg.norm(a, axis=1)[:, None] * np.linalg.norm(tried, axis=1)
    votes = ((np.abs(q[:, None] - ray @ tried.T) < 2 * ON_FLAT) & (a @ tried.T > LEAN_COS * lengths)).sum(axis=0)
    plane = tried[int(votes.argmax())]
    for _ in range(3):
        on = free & _lies_on(plane, fitted, inverse, rays)
        if on.sum() < FEWEST_ON_FLAT:
            return None
        plane = np.linalg.lstsq(rays[on], inverse[on], rcond=None)[0]
    return np.asarray(plane)


def _lies_on(plane: F64, fitted: F64, inverse: F64, rays: F64) -> Bools:
    near = np.abs(inverse - rays @ plane) < ON_FLAT
    return np.asarray(near & (fitted @ plane > LEAN_COS * np.linalg.norm(fitted, axis=2) * np.linalg.norm(plane)))
