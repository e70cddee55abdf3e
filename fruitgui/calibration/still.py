"""One picture from all captures of a still scene, and whether it stood still.

Noise and quantisation of structured light are uniform in inverse depth
(Khoshelham & Elberink 2012: σ_z = 1.4e-3 z², step 2.9e-3 z² for a Kinect v1),
so captures are averaged and compared there. Noise of a reading dithers its
quantisation, so the mean of many captures is finer than one step.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise

import cv2
import numpy as np

from fruitgui.calibration.levels import inverse_depths
from fruitgui.errors import InputError
from fruitgui.frame import F32, U8, Bools, Frame, Intrinsics

INVERSE_NOISE = 1.4e-3
"""Standard deviation of a single inverse depth, 1/m; other technologies are quieter at these ranges."""

INVERSE_STEP = 2.9e-3
"""Quantisation step of inverse depth of a Kinect v1, 1/m."""

MOST_FRAMES = 40
"""More captures per sensor teach nothing: correlated errors no longer average out."""

SAME_READING = 3.0 * (INVERSE_STEP + INVERSE_NOISE)
"""Two readings of one surface differ by no more than this, 1/m (13 mm at 1 m)."""


@dataclass(frozen=True, slots=True, eq=False)
class Still:
    """What one sensor saw of a still scene, averaged over its captures.

    Attributes:
        sensor: the sensor's id.
        intrinsics: of the picture.
        inverse_depth: (H, W) mean 1/z in 1/m, 0 where most captures have no reading.
        color: (H, W, 3) mean colour, RGB.
        captures: how many captures were averaged.
        moved: (H, W) true where the scene changed between captures.
    """

    sensor: str
    intrinsics: Intrinsics
    inverse_depth: F32
    color: U8
    captures: int
    moved: Bools

    @property
    def seen(self) -> Bools:
        """(H, W) true where there is a reading."""
        return np.asarray(self.inverse_depth > 0)

    def points(self) -> F32:
        """Return every pixel's point in the optical frame, metres: (H, W, 3), zeros where no reading."""
        z = np.zeros_like(self.inverse_depth)
        np.divide(1.0, self.inverse_depth, out=z, where=self.inverse_depth > 0)
        return np.concatenate([self.intrinsics.rays() * z[..., None], z[..., None]], axis=2)


def average(frames: Sequence[Frame]) -> Still:
    """Average the captures of one sensor, outliers of each pixel left out.

    Raises:
        InputError: no captures, or captures of different sizes.
    """
    chosen = _spread(sorted(frames, key=lambda frame: frame.time_s), MOST_FRAMES)
    if not chosen:
        raise InputError("no_frames", "A sensor gave no frames.", "Record a few seconds of the still scene.")
    if len({frame.depth_mm.shape for frame in chosen}) != 1:
        raise InputError(
            "mixed_sizes",
            f"Frames of {chosen[0].sensor} differ in size.",
            "Record all frames of a sensor at one resolution.",
        )
    of_reading = inverse_depths(chosen)
    inverse = [np.take(of_reading, frame.depth_mm) for frame in chosen]
    return Still(
        sensor=chosen[0].sensor,
        intrinsics=chosen[0].intrinsics,
        inverse_depth=_robust_mean(inverse),
        color=np.mean([frame.color for frame in _spread(chosen, 9)], axis=0).round().astype(np.uint8),
        captures=len(chosen),
        moved=_moved(inverse),
    )


def _spread(frames: Sequence[Frame], most: int) -> list[Frame]:
    """Return at most `most` frames, evenly spread from first to last."""
    if len(frames) <= most:
        return list(frames)
    return [frames[i] for i in np.linspace(0, len(frames) - 1, most).round().astype(int)]


def _robust_mean(inverse: Sequence[F32]) -> F32:
    """Return the mean of readings near the pixel's median, 0 where fewer than half the captures have one."""
    few = inverse if len(inverse) <= 5 else [inverse[i] for i in np.linspace(0, len(inverse) - 1, 5).astype(int)]
    middle = _median_of_readings(np.stack(few))
    total: F32 = np.zeros(middle.shape, dtype=np.float32)
    count: F32 = np.zeros(middle.shape, dtype=np.float32)
    for one in inverse:
        near = (np.abs(one - middle) < SAME_READING) & (one > 0)
        total += np.where(near, one, np.float32(0.0))
        count += near
    total /= np.maximum(count, np.float32(1.0))
    return np.where(count * 2 >= len(inverse), total, np.float32(0.0)).astype(np.float32)


def _median_of_readings(stack: F32) -> F32:
    """Return the median over captures of the non-zero values, 0 where there is none: (K, H, W) → (H, W)."""
    if len(stack) == 1:
        return np.asarray(stack[0], dtype=np.float32)
    ordered = _in_order(stack)  # zeros first
    missing = (stack == 0).sum(axis=0)
    rank = np.minimum(missing + (len(stack) - missing) // 2, len(stack) - 1)
    return np.asarray(np.take_along_axis(ordered, rank[None], axis=0)[0])


def _in_order(stack: F32) -> F32:
    """Return few pictures (K, H, W) sorted pixel by pixel: whole pictures are compared, which is quick."""
    ordered = list(stack)
    for last in range(len(ordered) - 1, 0, -1):
        for at in range(last):
            low, high = ordered[at], ordered[at + 1]
            ordered[at], ordered[at + 1] = np.minimum(low, high), np.maximum(low, high)
    return np.stack(ordered)


def _moved(inverse: Sequence[F32]) -> Bools:
    """Return where groups of captures, in order of time, disagree over patches wider than any edge flickers.

    Depth edges flicker by up to two pixels, in bands two pixels wide, and readings of steep faces jitter
    with them; something that moved by a centimetre changes a patch at least five pixels wide somewhere
    that was, or then is, no steep face.
    """
    height, width = inverse[0].shape
    changed = np.zeros((height, width), dtype=np.uint8)
    parts = _in_groups(inverse, 5)
    groups = [_robust_mean(part) for part in parts]
    patch = max(3, round(5 * width / 640)) | 1
    kernel = np.ones((patch, patch), np.uint8)
    steep = [_range(group) for group in groups]
    fewest = min(len(part) for part in parts)
    bound = INVERSE_STEP + 5.0 * INVERSE_NOISE * np.sqrt(2.0 / fewest)
    for i, j in combinations(range(len(groups)), 2):
        before, after = groups[i], groups[j]
        allowed = bound + 0.75 * np.minimum(steep[i], steep[j])
        differs = (np.abs(before - after) > allowed) & (before > 0) & (after > 0)
        changed |= cv2.morphologyEx(differs.astype(np.uint8), cv2.MORPH_OPEN, kernel)
    return _large_blobs(changed, round(2.5 * patch**2))


def _range(inverse: F32) -> F32:
    """Return the range of readings within two pixels of each pixel, gaps left out."""
    kernel = np.ones((5, 5), np.uint8)
    low = cv2.erode(np.where(inverse > 0, inverse, np.float32(np.inf)).astype(np.float32), kernel)
    high = cv2.dilate(inverse, kernel)
    return np.where(np.isfinite(low), high - low, np.float32(0.0)).astype(np.float32)


def _large_blobs(changed: U8, least_px: int) -> Bools:
    _, names, stats, _ = cv2.connectedComponentsWithStats(changed, connectivity=8)
    large = stats[:, cv2.CC_STAT_AREA] >= least_px
    large[0] = False
    return np.asarray(large[names])


def _in_groups(inverse: Sequence[F32], most: int) -> list[Sequence[F32]]:
    groups = min(most, len(inverse))
    bounds = np.linspace(0, len(inverse), groups + 1).round().astype(int)
    return [inverse[a:b] for a, b in pairwise(bounds)]
