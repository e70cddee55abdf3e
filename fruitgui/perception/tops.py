"""The tops of height maps, and which of them are tops of one fruit."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import cv2
import numpy as np

from fruitgui.frame import F32, F64, U8, Ints
from fruitgui.perception.relief import Relief

INDEX_BITS = 20
"""Two to this power is more than the pixels of any group on the coarse grid."""

WAY: F32 = np.linspace(0.0, 1.0, 32, dtype=np.float32)[:, None]
WAY.setflags(write=False)
"""Where on the way between two tops heights are looked up."""


@dataclass(frozen=True, slots=True, eq=False)
class Tops:
    """Local summits of a height map, and the widest places of the outlines; T of them.

    Attributes:
        place: (T, 2) row and column.
        height_m: (T,).
        wide_px: (T,) distance from the outline.
        group: (T,) 0-based.
    """

    place: Ints
    height_m: F64
    wide_px: F64
    group: Ints

    def of(self, group: int) -> Tops:
        """Return the tops of one group."""
        mine = self.group == group
        return Tops(self.place[mine], self.height_m[mine], self.wide_px[mine], self.group[mine])

    def highest(self) -> Ints:
        """Return, for every top, the number of the highest top of its group, (T,)."""
        order = np.lexsort((self.height_m, self.group))
        last = np.searchsorted(self.group[order], self.group, side="right") - 1
        return np.asarray(order[last])


def find_tops(relief: Relief, window: U8, most: int = 400) -> Tops:
    """Return pixels that nothing within the window overtops, and the widest places within twice the window."""
    height_m, wide_px = relief.height_m, relief.wide_px
    wide = np.ones((2 * window.shape[0] + 1, 2 * window.shape[1] + 1), np.uint8)
    summit = cv2.compare(height_m, cv2.dilate(height_m, window), cv2.CMP_GE)
    widest = cv2.compare(wide_px, cv2.max(cv2.dilate(wide_px, wide), 2.0), cv2.CMP_GE)
    inside = cv2.compare(height_m, 0.0, cv2.CMP_GT)
    found = np.flatnonzero(cv2.bitwise_and(cv2.bitwise_or(summit, widest), inside) != 0)
    if len(found) > most:
        found = found[np.argsort(-height_m.reshape(-1).take(found))[:most]]
    return Tops(
        np.stack(np.divmod(found, height_m.shape[1]), axis=1),
        height_m.reshape(-1).take(found).astype(np.float64),
        wide_px.reshape(-1).take(found).astype(np.float64),
        relief.labels.reshape(-1).take(found).astype(np.intp) - 1,
    )


@lru_cache(maxsize=64)
def every_two(count: int) -> tuple[Ints, Ints]:
    """Return the numbers of every two of so many."""
    first, second = np.triu_indices(count, k=1)
    return first, second


def near_two(place: Ints, most: int = 12) -> tuple[Ints, Ints]:
    """Return the numbers of every two of T places (T, 2) of which one is among the `most` nearest of the other."""
    if len(place) <= 2 * most:
        return every_two(len(place))
    apart = ((place[:, None] - place[None]) ** 2).sum(axis=2)
    near = np.argpartition(apart, most, axis=1)[:, : most + 1]
    own = np.repeat(np.arange(len(place)), most + 1)
    pairs = np.unique(np.sort(np.stack([own, near.ravel()], axis=1), axis=1), axis=0)
    pairs = pairs[pairs[:, 0] != pairs[:, 1]]
    return pairs[:, 0], pairs[:, 1]


def lowest_between(maps: tuple[F32, ...], start: Ints, end: Ints, way: F32 = WAY) -> tuple[F64, ...]:
    """Return, for each map, the lowest value (M,) on the straight ways between places (M, 2: row, column)."""
    first, last = (places.T.astype(np.float32) + np.float32(0.5) for places in (start, end))
    rows, columns = ((a + way * (b - a)).astype(np.intp) for a, b in zip(first, last, strict=True))
    rows *= maps[0].shape[1]
    rows += columns
    return tuple(values.reshape(-1).take(rows).min(axis=0, initial=np.inf).astype(np.float64) for values in maps)


class Forest:
    """Tops that grow together into fruit (union-find); every tree knows its highest top and its widest place."""

    def __init__(self, height_m: F64, wide_px: F64) -> None:
        self._parent = list(range(len(height_m)))
        self._height = height_m.tolist()
        self._wide = wide_px.tolist()
        self.trees = len(height_m)

    def root(self, top: int) -> int:
        """Return the tree that a top belongs to."""
        parent = self._parent
        while parent[top] != top:
            parent[top] = parent[parent[top]]
            top = parent[top]
        return top

    def lower_and_narrower(self, a: int, b: int) -> tuple[float, float]:
        """Return the height of the lower and the half width of the narrower of two trees."""
        return min(self._height[a], self._height[b]), min(self._wide[a], self._wide[b])

    def join(self, a: int, b: int) -> None:
        """Join two trees."""
        lower, upper = (a, b) if self._height[a] < self._height[b] else (b, a)
        self._parent[lower] = upper
        self._wide[upper] = max(self._wide[upper], self._wide[lower])
        self.trees -= 1

    def narrowest(self) -> float:
        """Return the half width of the narrowest tree."""
        return min(float(self._wide[top]) for top, parent in enumerate(self._parent) if top == parent)

    def roots(self) -> Ints:
        """Return the tree of every top."""
        return np.array([self.root(top) for top in range(len(self._parent))], dtype=np.intp)


def basins(ground: F32, place: Ints, number: U8) -> U8:
    """Return for every pixel the number of the top that steepest ascent leads to (watershed by pointer jumping)."""
    rows, columns = ground.shape
    pixel = np.arange(rows * columns, dtype=np.float64).reshape(rows, columns)
    # Height in tenths of a millimetre and the pixel's own index in one exact number: the largest of the
    # neighbourhood tells where it is.
    key = np.rint(ground.astype(np.float64) * 1e4) * 2.0**INDEX_BITS + pixel
    parent = cv2.dilate(key, np.ones((3, 3), np.uint8)).astype(np.intp).reshape(-1) & (2**INDEX_BITS - 1)
    for _ in range(8):
        parent = parent.take(parent)
    roots = np.flatnonzero(parent == np.arange(rows * columns))
    at = np.stack([roots // columns, roots % columns], axis=1)
    many, tops = np.repeat(at, len(place), axis=0), np.tile(place, (len(at), 1))
    saddle = lowest_between((ground,), many, tops, WAY[::3])[0].reshape(len(at), len(place))
    distance = np.abs(many - tops).sum(axis=1).reshape(len(at), len(place))
    part = np.zeros(rows * columns, np.uint8)
    part[roots] = number[np.argmax(saddle - 1e-5 * distance, axis=1)]
    return np.asarray(part[parent].reshape(rows, columns))
