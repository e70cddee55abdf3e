"""The pixels of all fruit of a frame in a few flat arrays, fruit after fruit: one pass instead of one per fruit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.frame import F32, F64, U8, U16, Bools, Ints
from fruitgui.perception.limits import DepthLimits
from fruitgui.perception.parts import Parts
from fruitgui.perception.tiles import Tiles, edge_distance, laid_out

ENOUGH_PIXELS = 16_000
"""Where a frame's fruit have more pixels than this, every second is left out: errors of depth are correlated over
some nine pixels (method 1.2), so what is left out would tell nothing new."""

BINS = 96
BESIDE = 4


@dataclass(frozen=True, slots=True, eq=False)
class Runs:
    """Values sorted by group: where each group's begin, and how many they are; N groups, P values.

    Attributes:
        starts, counts: (N,).
    """

    starts: Ints
    counts: Ints

    @classmethod
    def of(cls, counts: Ints) -> Runs:
        """Return runs of so many values each."""
        return cls(np.cumsum(counts) - counts, counts)

    def sums(self, *values: F32) -> F64:
        """Return the sums of values (P,) over each group, (K, N) of K of them."""
        if len(values[0]) == 0:
            return np.zeros((len(values), len(self.starts)))
        first = np.minimum(self.starts, len(values[0]) - 1)
        totals = np.array([np.add.reduceat(value, first) for value in values], dtype=np.float64)
        totals[:, self.counts == 0] = 0.0
        return totals

    def most(self, values: F32) -> F64:
        """Return the largest of not negative values (P,) of each group, (N,), 0 where it has none."""
        if len(values) == 0:
            return np.zeros(len(self.starts))
        largest = np.maximum.reduceat(values, np.minimum(self.starts, len(values) - 1))
        return np.where(self.counts > 0, largest, 0.0).astype(np.float64)

    def spread(self, values: F64) -> F32:
        """Return values (N,) of the groups, each for all of its own, (P,)."""
        return values.astype(np.float32).repeat(self.counts)

    def quantiles(self, rows: Sequence[Binned], at: Sequence[float]) -> F64:
        """Return quantiles (K, N, len(at)) of K rows of values, interpolated within the bins of one histogram."""
        groups = len(self.counts)
        base = (np.arange(groups) * BINS).repeat(self.counts)
        bins = np.concatenate([row.bins(base + number * groups * BINS) for number, row in enumerate(rows)])
        table = np.bincount(bins, minlength=len(rows) * groups * BINS)[: len(rows) * groups * BINS].astype(np.float64)
        rising = table.cumsum()
        before = np.concatenate([[0.0], rising[BINS - 1 : -1 : BINS]])
        total = np.maximum(rising[BINS - 1 :: BINS] - before, 1e-12)
        wanted = before[:, None] + total[:, None] * np.array(at)
        place = np.minimum(rising.searchsorted(wanted), len(table) - 1)
        inside = place + 1.0 - (rising[place] - wanted) / np.maximum(table[place], 1e-12)
        inside = (inside - np.arange(len(rows) * groups)[:, None] * BINS).reshape(len(rows), groups, len(at))
        low = np.array([row.low for row in rows])[:, None, None]
        return np.asarray(low + inside * (np.array([row.high for row in rows])[:, None, None] - low) / BINS)


@dataclass(frozen=True, slots=True, eq=False)
class Binned:
    """Values (P,) between low and high, sorted by group; those not `counted` (P,) are left out."""

    values: F32
    low: float
    high: float
    counted: Bools | None = None

    def bins(self, base: Ints) -> Ints:
        """Return the bin of each value that counts, each group's beginning at `base` (P,)."""
        scaled = (self.values - np.float32(self.low)) * np.float32(BINS / (self.high - self.low))
        bins = np.minimum(np.maximum(scaled, np.float32(0.0)), np.float32(BINS - 1)).astype(np.intp)
        bins += base
        return np.asarray(bins if self.counted is None else bins[self.counted])


@dataclass(frozen=True, slots=True, eq=False)
class Pixels:
    """Sampled pixels of a frame's fruit, sorted by fruit; P pixels, N fruit.

    Attributes:
        runs: where each fruit's pixels are.
        index: (P,) index in the flattened crop.
        valid: (P,) float32, 1 where there is a sound depth reading on the fruit, else 0.
        x_m, y_m, depth_m: (P,) float32 in the optical frame, 0 where not valid.
        height_m: (P,) float32 above the belt; meaningless where not valid.
        ray_x, ray_y: (P,) float32, x/z and y/z.
        edge_px: (P,) float32, distance from the edge of the fruit.
        beside_px: (P,) float32, the same four pixels to the right, 0 beyond the fruit.
        deepest_px: (N,) the largest distance from its edge.
        every: pixels of the picture that one sample stands for.
    """

    runs: Runs
    index: Ints
    valid: F32
    x_m: F32
    y_m: F32
    depth_m: F32
    height_m: F32
    ray_x: F32
    ray_y: F32
    edge_px: F32
    beside_px: F32
    deepest_px: F64
    every: int


def gather_pixels(parts: Parts, standing_mm: U16, limits: DepthLimits) -> Pixels:
    """Return the pixels of all fruit (at least one), thinned out where there are many.

    Args:
        parts: the fruit.
        standing_mm: (h, w) of the crop, depth readings that count as fruit, 0 elsewhere.
        limits: of the sensor.
    """
    tiles = laid_out(parts.boxes, parts.labels.shape, gap=BESIDE + 1)
    own = tiles.owned(parts.labels)
    edges = edge_distance(tiles, _inside(own, parts, tiles))
    down, across = _thinning(cv2.countNonZero(own))
    sources, places = tiles.thinned(down, across)
    sampled = [own[place].ravel() for place in places]
    found = np.flatnonzero(np.concatenate(sampled))
    ends = np.cumsum([len(one) for one in sampled])
    index = np.concatenate([limits.grid[source].ravel() for source in sources]).take(found)
    edge_px = np.concatenate([edges[place].ravel() for place in places]).take(found)
    beside = [edges[rows, columns.start + BESIDE : columns.stop + BESIDE : across].ravel() for rows, columns in places]
    runs = Runs.of(np.diff(found.searchsorted(ends), prepend=0))
    depth_m = standing_mm.reshape(-1).take(index) * np.float32(1e-3)
    ray_x, ray_y = limits.ray_x.take(index), limits.ray_y.take(index)
    return Pixels(
        runs=runs,
        index=index,
        valid=(depth_m > 0).astype(np.float32),
        x_m=ray_x * depth_m,
        y_m=ray_y * depth_m,
        depth_m=depth_m,
        height_m=np.float32(limits.offset_m) - limits.slope.reshape(-1).take(index) * depth_m,
        ray_x=ray_x,
        ray_y=ray_y,
        edge_px=edge_px,
        beside_px=np.concatenate(beside).take(found),
        deepest_px=runs.most(edge_px),
        every=down * across,
    )


def _inside(own: U8, parts: Parts, tiles: Tiles) -> U8:
    """Return the mosaic that is not 0 inside the fruit; where two fruit touch is an edge too."""
    inside = cv2.compare(own, 0, cv2.CMP_GT)
    for number in np.flatnonzero(parts.shared).tolist():
        cv2.drawContours(inside, [parts.contours[number]], 0, 0, 1, offset=tiles.shift(number))
    return np.asarray(inside)


def _thinning(pixels: int) -> tuple[int, int]:
    """Return every how manieth row and column is looked at."""
    for down, across in ((1, 1), (2, 1), (2, 2), (3, 2)):
        if pixels <= ENOUGH_PIXELS * down * across:
            return down, across
    return 3, 3
