"""The pixels of all fruit of a frame in a few flat arrays, fruit after fruit: one pass instead of one per fruit."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F32, F64, U8, U16, Ints
from fruitgui.perception.limits import DepthLimits

ENOUGH_PIXELS = 16_000
"""Where a frame's fruit have more pixels than this, every second is left out: errors of depth are correlated over
some nine pixels (method 1.2), so what is left out would tell nothing new."""

BINS = 96
BESIDE = 4


@dataclass(frozen=True, slots=True, eq=False)
class Pixels:
    """Sampled pixels of a frame's fruit, sorted by fruit; P pixels, N fruit.

    Attributes:
        starts, counts: (N,) where each fruit's pixels begin, and how many.
        owner: (P,) the fruit that each pixel belongs to, 0-based.
        index: (P,) index in the flattened crop.
        valid: (P,) float32, 1 where there is a sound depth reading on the fruit, else 0.
        depth_m: (P,) float32, 0 where not valid.
        height_m: (P,) float32 above the belt; meaningless where not valid.
        ray_x, ray_y: (P,) float32, x/z and y/z.
        edge_px: (P,) float32, distance from the edge of the fruit.
        beside_px: (P,) float32, the same four pixels to the right.
        every: pixels of the picture that one sample stands for.
    """

    starts: Ints
    counts: Ints
    owner: Ints
    index: Ints
    valid: F32
    depth_m: F32
    height_m: F32
    ray_x: F32
    ray_y: F32
    edge_px: F32
    beside_px: F32
    every: int

    @property
    def fruit(self) -> int:
        """Number of fruit."""
        return len(self.starts)

    def sums(self, *values: F32) -> F64:
        """Return the sums of values (P,) over each fruit: (N,) of one, (K, N) of several."""
        return grouped_sums(self.starts, self.counts, *values)

    def quantiles(self, values: F32, weights: F32, low: float, high: float, at: tuple[float, ...]) -> F64:
        """Return weighted quantiles (N, len(at)) of values (P,) between low and high."""
        return grouped_quantiles(self.owner, self.fruit, values, weights, (low, high), at)

    def part(self, fruit: int) -> slice:
        """Return where one fruit's pixels lie."""
        return slice(int(self.starts[fruit]), int(self.starts[fruit] + self.counts[fruit]))


def grouped_sums(starts: Ints, counts: Ints, *values: F32) -> F64:
    """Return the sums of values (P,), sorted by group, over each group: (N,) of one, (K, N) of several."""
    length = len(values[0])
    if length == 0:
        return np.zeros((len(values), len(starts)) if len(values) > 1 else len(starts))
    first = np.minimum(starts, length - 1)
    totals = np.empty((len(values), len(starts)))
    for total, value in zip(totals, values, strict=True):
        total[:] = np.add.reduceat(value, first)
    if not counts.all():
        totals[:, counts == 0] = 0.0
    return totals if len(values) > 1 else np.asarray(totals[0])


def grouped_quantiles(
    owner: Ints, groups: int, values: F32, weights: F32 | None, limits: tuple[float, float], at: tuple[float, ...]
) -> F64:
    """Return quantiles (N, len(at)) of values (P,) in each group, interpolated within the bins of a histogram."""
    low, high = limits
    scaled = (values - np.float32(low)) * np.float32(BINS / (high - low))
    bins = np.minimum(np.maximum(scaled, np.float32(0.0)), np.float32(BINS - 1)).astype(np.intp)
    bins += owner * BINS
    table = np.bincount(bins, weights=weights, minlength=groups * BINS)
    rising = table.reshape(groups, BINS).cumsum(axis=1)
    total = np.maximum(rising[:, -1], 1e-12)
    wanted = total[:, None] * np.array(at)
    place = np.minimum((rising[:, None, :] < wanted[:, :, None]).sum(axis=2), BINS - 1)
    index = place + np.arange(groups)[:, None] * BINS
    found = place + 1.0 - (rising.reshape(-1).take(index) - wanted) / np.maximum(table.take(index), 1e-12)
    return np.asarray(low + found * ((high - low) / BINS))


def gather_pixels(labels: U8, solid: U8, edge_px: F32, depth_mm: U16, limits: DepthLimits, fruit: int) -> Pixels:
    """Return the pixels of all fruit, thinned out where there are many.

    Args:
        labels: (h, w) of the crop, fruit i carries i + 1.
        solid: (h, w) of the crop, non-zero where the reading counts as fruit.
        edge_px: (h, w) of the crop, distance from each fruit's edge.
        depth_mm: (height, width) of the whole picture.
        limits: of the sensor.
        fruit: how many.
    """
    down, across = _thinning(int(np.count_nonzero(labels)))
    grid = labels[::down, ::across]
    found = np.flatnonzero(grid != 0)
    label = grid.reshape(-1).take(found)
    order = np.argsort(label, kind="stable")
    found, owner = found.take(order), label.take(order).astype(np.intp) - 1
    index = limits.thinned(down, across).take(found)
    counts = np.bincount(owner, minlength=fruit)
    valid = (solid.reshape(-1).take(index) != 0).astype(np.float32)
    depth_m = depth_mm.reshape(-1).take(limits.pixels.take(index)).astype(np.float32)
    depth_m *= valid
    depth_m *= np.float32(1e-3)
    return Pixels(
        starts=np.concatenate([[0], np.cumsum(counts)[:-1]]).astype(np.intp),
        counts=counts.astype(np.intp),
        owner=owner,
        index=index,
        valid=valid,
        depth_m=depth_m,
        height_m=np.float32(limits.offset_m) - limits.slope.reshape(-1).take(index) * depth_m,
        ray_x=limits.ray_x.take(index),
        ray_y=limits.ray_y.take(index),
        edge_px=edge_px.reshape(-1).take(index),
        beside_px=edge_px.reshape(-1).take(index + BESIDE, mode="clip"),
        every=down * across,
    )


def _thinning(pixels: int) -> tuple[int, int]:
    """Return every how manieth row and column is looked at."""
    for down, across in ((1, 1), (2, 1), (2, 2), (3, 2)):
        if pixels <= ENOUGH_PIXELS * down * across:
            return down, across
    return 3, 3
