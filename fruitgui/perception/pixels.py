"""All pixels of all fruit of a frame in a few flat arrays, fruit after fruit: one pass instead of one per fruit."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F32, F64, U8, U16, Ints
from fruitgui.perception.limits import DepthLimits


@dataclass(frozen=True, slots=True, eq=False)
class Pixels:
    """The pixels of a frame's fruit, sorted by fruit; P pixels, N fruit.

    Attributes:
        starts, counts: (N,) where each fruit's pixels begin, and how many.
        owner: (P,) the fruit that each pixel belongs to, 0-based.
        index: (P,) index in the flattened crop.
        valid: (P,) float32, 1 where there is a sound depth reading on the fruit, else 0.
        depth_m: (P,) float32, 0 where not valid.
        height_m: (P,) float32 above the belt.
        rays: (P, 2) float32, x/z and y/z.
        edge_px: (P,) float32, distance from the edge of the fruit.
    """

    starts: Ints
    counts: Ints
    owner: Ints
    index: Ints
    valid: F32
    depth_m: F32
    height_m: F32
    rays: F32
    edge_px: F32

    @property
    def fruit(self) -> int:
        """Number of fruit."""
        return len(self.starts)

    def sums(self, values: np.ndarray) -> F64:
        """Return the sum of values (P,) over each fruit, (N,)."""
        return np.asarray(np.bincount(self.owner, weights=values, minlength=self.fruit))

    def means(self, values: np.ndarray, weights: np.ndarray) -> F64:
        """Return the weighted mean of values (P,) over each fruit, (N,); 0 where all weights are 0."""
        return self.sums(values * weights) / np.maximum(self.sums(weights), 1e-12)

    def part(self, fruit: int) -> slice:
        """Return where one fruit's pixels lie."""
        return slice(int(self.starts[fruit]), int(self.starts[fruit] + self.counts[fruit]))

    def quantiles(self, values: np.ndarray, weights: np.ndarray, low: float, high: float, at: tuple[float, ...]) -> F64:
        """Return weighted quantiles (N, len(at)) of values (P,) from histograms of 256 bins between low and high."""
        bins = np.clip((values - low) * (256.0 / (high - low)), 0, 255).astype(np.intp)
        flat = np.bincount(self.owner * 256 + bins, weights=weights, minlength=self.fruit * 256)
        rising = np.cumsum(flat.reshape(self.fruit, 256), axis=1)
        total = np.maximum(rising[:, -1:], 1e-12)
        place = [(rising < part * total).sum(axis=1) for part in at]
        return low + (np.stack(place, axis=1) + 0.5) * ((high - low) / 256.0)


def gather_pixels(labels: U8, solid: U8, edge_px: F32, depth_mm: U16, limits: DepthLimits, fruit: int) -> Pixels:
    """Return the pixels of all fruit.

    Args:
        labels: (h, w) of the crop, fruit i carries i + 1.
        solid: (h, w) of the crop, non-zero where the reading counts as fruit.
        edge_px: (h, w) of the crop, distance from each fruit's edge.
        depth_mm: (height, width) of the whole picture.
        limits: of the sensor.
        fruit: how many.
    """
    flat = labels.reshape(-1)
    index = np.flatnonzero(flat != 0)
    owner = flat.take(index)
    order = np.argsort(owner, kind="stable")
    index = index.take(order)
    owner = owner.take(order).astype(np.intp) - 1
    counts = np.bincount(owner, minlength=fruit)
    valid = (solid.reshape(-1).take(index) != 0).astype(np.float32)
    depth_m = depth_mm.reshape(-1).take(limits.pixels.take(index)).astype(np.float32)
    depth_m *= valid
    depth_m *= np.float32(1e-3)
    height_m = np.float32(limits.offset_m) - limits.slope.reshape(-1).take(index) * depth_m
    return Pixels(
        starts=np.concatenate([[0], np.cumsum(counts)[:-1]]).astype(np.intp),
        counts=counts.astype(np.intp),
        owner=owner,
        index=index,
        valid=valid,
        depth_m=depth_m,
        height_m=height_m,
        rays=limits.rays.take(index, axis=0),
        edge_px=edge_px.reshape(-1).take(index),
    )
