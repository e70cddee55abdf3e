"""The pixels of all fruit of a frame in a few flat arrays, fruit after fruit: one pass instead of one per fruit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.frame import F32, F64, U8, U16, Bools, Ints
from fruitgui.perception.limits import DepthLimits
from fruitgui.perception.parts import Parts
from fruitgui.perception.tiles import edge_distance, laid_out

ENOUGH_PIXELS = 16_000
"""Where a frame's fruit have more pixels than this, every second is left out, and five of six of a full frame's: errors
of depth are correlated over some nine pixels (method 1.2), and the colours looked up are means of more than four."""

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

    @classmethod
    def ending(cls, ends: Ints) -> Runs:
        """Return runs that lie one after another, by where each ends."""
        starts = np.zeros_like(ends)
        starts[1:] = ends[:-1]
        return cls(starts, ends - starts)

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
        """Return quantiles (K, N, len(at)) of K rows of values, interpolated within the bins of one histogram.

        Of a group of which nothing is counted they are the lowest value there is.
        """
        groups = len(self.counts)
        base = (np.arange(groups) * BINS).repeat(self.counts)
        size = groups * BINS
        nowhere = len(rows) * size
        bins = np.concatenate([row.within(base + number * size, nowhere) for number, row in enumerate(rows)])
        table = np.bincount(bins, minlength=nowhere)[:nowhere].astype(np.float64)
        rising = table.cumsum()
        before = np.concatenate([[0.0], rising[BINS - 1 : -1 : BINS]])
        total = np.maximum(rising[BINS - 1 :: BINS] - before, 1e-12)
        wanted = before[:, None] + total[:, None] * np.array(at)
        place = np.minimum(rising.searchsorted(wanted), len(table) - 1)
        inside = place + 1.0 - (rising[place] - wanted) / np.maximum(table[place], 1e-12)
        inside -= np.arange(len(rows) * groups)[:, None] * BINS
        inside = np.where(total[:, None] >= 1.0, inside, 0.0).reshape(len(rows), groups, len(at))
        low = np.array([row.low for row in rows])[:, None, None]
        return np.asarray(low + inside * (np.array([row.high for row in rows])[:, None, None] - low) / BINS)


@dataclass(frozen=True, slots=True, eq=False)
class Binned:
    """Bins (P,) of values between low and high, sorted by group; those not `counted` (P,) are left out."""

    bins: Ints
    low: float
    high: float
    counted: Bools | None = None

    @classmethod
    def of(cls, values: F32, low: float, high: float) -> Binned:
        """Return the bins of values (P,); what is not between low and high counts as these."""
        scaled = values - np.float32(low)
        scaled *= np.float32(BINS / (high - low))
        np.maximum(scaled, np.float32(0.0), out=scaled)
        np.minimum(scaled, np.float32(BINS - 1), out=scaled)
        return cls(scaled.astype(np.intp), low, high)

    def within(self, base: Ints, nowhere: int) -> Ints:
        """Return the bins when each group's begin at `base` (P,), and `nowhere` for values that do not count."""
        bins = self.bins + base
        return bins if self.counted is None else np.where(self.counted, bins, nowhere)


@dataclass(frozen=True, slots=True, eq=False)
class Pixels:
    """Sampled pixels of a frame's fruit, sorted by fruit; P pixels, N fruit.

    Attributes:
        runs: where each fruit's pixels are.
        row, column: (P,) in the crop.
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
    row: Ints
    column: Ints
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
    rails = sum(np.count_nonzero(rail.pixels) for rail in parts.rails)
    down, across = _thinning(cv2.countNonZero(parts.labels) - rails)
    tiles = laid_out(parts.boxes, parts.labels.shape, BESIDE + 1, (down, across))
    own = tiles.owned(parts.labels)
    edges = edge_distance(tiles, _inside(own, parts, tiles.shifts)).reshape(-1)
    runs, row, column = _sorted_by_fruit(own[::down, ::across], len(parts.boxes))
    row, column = row * down, column * across
    place = row * own.shape[1] + column
    row -= tiles.shifts[:, 1].repeat(runs.counts)
    column -= tiles.shifts[:, 0].repeat(runs.counts)
    edge_px = edges.take(place)
    depth_m = standing_mm.reshape(-1).take(row * limits.shape[1] + column) * np.float32(1e-3)
    ray_x, ray_y = limits.rays_at(row, column)
    along_x, along_y, along_z = limits.turn[2].astype(np.float32)
    return Pixels(
        runs=runs,
        row=row,
        column=column,
        valid=(depth_m > 0).astype(np.float32),
        x_m=ray_x * depth_m,
        y_m=ray_y * depth_m,
        depth_m=depth_m,
        height_m=np.float32(limits.offset_m) + (ray_x * along_x + ray_y * along_y + along_z) * depth_m,
        ray_x=ray_x,
        ray_y=ray_y,
        edge_px=edge_px,
        beside_px=edges.take(place + BESIDE),
        deepest_px=runs.most(edge_px),
        every=down * across,
    )


def _sorted_by_fruit(own: U8, fruit: int) -> tuple[Runs, Ints, Ints]:
    """Return where rows and columns of each fruit's pixels are, and these rows and columns (P,)."""
    flat = own.ravel()
    found = np.flatnonzero(flat != 0)
    label = flat.take(found)
    order = label.argsort(kind="stable")
    ends = label.take(order).searchsorted(np.arange(1, fruit + 1, dtype=np.uint8), side="right")
    place = found.take(order)
    row = place // own.shape[1]
    return Runs.ending(ends), row, place - row * own.shape[1]


def _inside(own: U8, parts: Parts, shifts: Ints) -> U8:
    """Return the mosaic that is not 0 inside the fruit; where two fruit touch is an edge too."""
    inside = cv2.compare(own, 0, cv2.CMP_GT)
    for number in np.flatnonzero(parts.shared).tolist():
        cv2.drawContours(inside, [parts.contours[number]], 0, 0, 1, offset=shifts[number].tolist())
    return np.asarray(inside)


def _thinning(pixels: int) -> tuple[int, int]:
    """Return every how manieth row and column is looked at."""
    for down, across in ((1, 1), (2, 1), (3, 2)):
        if pixels <= ENOUGH_PIXELS * down * across:
            return down, across
    return 3, 3
