"""Touching fruit taken apart by their tops: two fruit have two tops with a valley between them.

Fruit that touch on a belt meet at a crease, however convex their common outline
is; a pear, a banana, an apple with its dimple do not: from any of their tops a
way leads to any other that hardly descends. So a group is split where the way
between two tops dips by a good part of the lower top's height (its topographic
prominence). Where one fruit hides the foot of another there is no valley to be
seen but a jump in depth; jumps are dug into the height map as moats.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import cv2
import numpy as np

from fruitgui.frame import F32, F64, U8, U16, Bools, Ints
from fruitgui.perception.limits import DepthLimits
from fruitgui.perception.segment import MOST_GROUPS, Groups
from fruitgui.perception.settings import PerceptionSettings


@dataclass(frozen=True, slots=True, eq=False)
class Parts:
    """The fruit of a frame, after splitting; N of them.

    Attributes:
        labels: (h, w) uint8 of the crop; fruit i carries i + 1.
        contours: N outlines (K, 1, 2) int32, crop pixels.
        group: (N,) the group that each came from.
        shared: (N,) whether its group was split.
    """

    labels: U8
    contours: tuple[np.ndarray, ...]
    group: Ints
    shared: Bools


class Splitter(Protocol):
    """One way of taking groups apart."""

    def __call__(self, groups: Groups, depth_mm: U16) -> Parts:
        """Return the fruit in the groups of a depth image (height, width)."""


def unsplit(groups: Groups) -> Parts:
    """Return every group as one fruit."""
    count = len(groups.contours)
    return Parts(groups.labels, groups.contours, np.arange(count), np.zeros(count, bool))


def with_parts(groups: Groups, cuts: dict[int, U8], least_px: float) -> Parts:
    """Return the fruit when some groups are cut.

    Args:
        groups: as segmented.
        cuts: for a group, its parts: uint8 over the group's bounding box, 1 … K on the group's pixels.
        least_px: parts with fewer pixels are dropped from the list.
    """
    labels = groups.labels.copy()
    contours, origin, shared = [], [], []
    for number, contour in enumerate(groups.contours):
        if number not in cuts:
            contours.append(contour)
            origin.append(number)
            shared.append(False)
            continue
        for part in _part_contours(contour, cuts[number], least_px):
            contours.append(part)
            origin.append(number)
            shared.append(True)
    contours, origin, shared = contours[:MOST_GROUPS], origin[:MOST_GROUPS], shared[:MOST_GROUPS]
    labels[:] = 0
    for number, contour in enumerate(contours):
        cv2.drawContours(labels, [contour], 0, number + 1, cv2.FILLED)
    return Parts(labels, tuple(contours), np.array(origin, dtype=np.intp), np.array(shared, dtype=bool))


def _part_contours(group: np.ndarray, parts: U8, least_px: float) -> list[np.ndarray]:
    left, top = group[:, 0, :].min(axis=0)
    found = []
    for part in range(1, int(parts.max()) + 1):
        outlines, _ = cv2.findContours(
            cv2.compare(parts, part, cv2.CMP_EQ), cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE, offset=(int(left), int(top))
        )
        largest = max(outlines, key=cv2.contourArea, default=None)
        if largest is not None and len(largest) >= 8 and cv2.contourArea(largest) >= least_px:
            found.append(largest)
    return found


class HeightSplitter:
    """Splits groups by the prominence of their tops. One per sensor."""

    def __init__(self, limits: DepthLimits, settings: PerceptionSettings) -> None:
        self._limits = limits
        self._settings = settings
        smallest_px = limits.pixels_of(settings.smallest_m, limits.belt_z_m)
        self._scale = 2 if smallest_px >= 6.0 else 1
        self._slope = np.ascontiguousarray(limits.slope[:: self._scale, :: self._scale])
        reach = int(np.clip(round(0.3 * smallest_px / self._scale), 1, 6))
        self._window = np.ones((2 * reach + 1, 2 * reach + 1), np.uint8)
        belt_z = np.array(limits.belt_z_m)
        # A surface seen at 63° recedes by tan 63° = 2 pixels' width per pixel; the depth's own steps add to it.
        self._allowed_mm = 1e3 * (2.0 * self._scale * limits.belt_z_m / limits.focal_px + 1.5 * float(settings.step_at_m(belt_z)))
        self._least_dip_m = max(0.005, 3.0 * float(settings.noise_at_m(belt_z)))
        self._least_px = 0.3 * np.pi / 4.0 * smallest_px**2

    def __call__(self, groups: Groups, depth_mm: U16) -> Parts:
        """Return the fruit in the groups of a depth image (height, width)."""
        if not groups.contours:
            return unsplit(groups)
        s = self._scale
        labels = np.ascontiguousarray(groups.labels[::s, ::s])
        relief = self._relief(groups, depth_mm, labels)
        wide_px = cv2.distanceTransform(cv2.compare(labels, 0, cv2.CMP_GT), cv2.DIST_L2, 3)
        tops = find_tops(relief, wide_px, labels, self._window)
        clusters = self._clusters(relief, wide_px, tops)
        cuts = {}
        for group, peaks in tops_by_group(tops, clusters).items():
            if len(np.unique(clusters[peaks])) > 1:
                cuts[group] = self._cut(groups, group, relief, labels, tops.place[peaks], clusters[peaks])
        return with_parts(groups, cuts, self._least_px) if cuts else unsplit(groups)

    def _relief(self, groups: Groups, depth_mm: U16, labels: U8) -> F32:
        """Return heights above the belt on the coarse grid, gaps filled from around them, jumps dug as moats."""
        s = self._scale
        solid = np.ascontiguousarray(groups.solid[::s, ::s])
        depth = cv2.copyTo(np.ascontiguousarray(depth_mm[self._limits.crop][::s, ::s]), solid)
        moat = self._moats(depth, solid)
        share = cv2.blur(solid.astype(np.float32), (3, 3))
        z_mm = cv2.divide(cv2.blur(depth.astype(np.float32), (3, 3)), cv2.max(share, 1.0), scale=255.0)
        relief = np.float32(self._limits.offset_m) - np.float32(1e-3) * (self._slope * z_mm + 2.0 * moat)
        outside = cv2.bitwise_or(cv2.compare(labels, 0, cv2.CMP_EQ), cv2.compare(share, 8.0, cv2.CMP_LE))
        relief[outside != 0] = 0.0
        return np.asarray(relief, dtype=np.float32)

    def _moats(self, depth: U16, solid: U8) -> U16:
        """Return by how many millimetres depth jumps to the right or down, beyond what a slope would, (h, w)."""
        moat = np.zeros_like(depth)
        for here, there in (((slice(None), slice(1, None)), (slice(None), slice(-1))), ((slice(1, None),), (slice(-1),))):
            jump = cv2.subtract(cv2.absdiff(depth[here], depth[there]), int(self._allowed_mm))
            both = cv2.bitwise_and(solid[here], solid[there])
            jump = cv2.copyTo(jump, both)
            np.maximum(moat[here], jump, out=moat[here])
            np.maximum(moat[there], jump, out=moat[there])
        return moat

    def _clusters(self, relief: F32, wide_px: F32, tops: Tops) -> Ints:
        """Return for every top the number of the fruit it belongs to.

        Tops are joined in the order of the heights of the ways between them. Two
        stay apart where the way dips too much, or the outline narrows too much,
        or both do half of it.
        """
        first, second = _pairs(tops)
        start, end = tops.place[first], tops.place[second]
        saddle, neck = lowest_between(relief, start, end), lowest_between(wide_px, start, end)
        order = np.argsort(-saddle, kind="stable")
        forest = _Forest(tops.height_m, tops.wide_px)
        edges = np.column_stack([first, second])[order].tolist()
        for (a, b), low, narrow in zip(edges, saddle[order].tolist(), neck[order].tolist(), strict=True):
            forest.join(a, b, lambda top_m, wide_px, low=low, narrow=narrow: self._apart(top_m - low, top_m, wide_px - narrow, wide_px))
        return forest.roots()

    def _apart(self, dip_m: float, top_m: float, waist_px: float, wide_px: float) -> bool:
        """Tell whether a dip below the lower top and a waist beside the narrower part make two fruit."""
        dip = dip_m / max(self._settings.prominence * top_m, self._least_dip_m)
        waist = waist_px / max(self._settings.waist * wide_px, 2.0)
        return dip + max(waist, 0.0) >= 1.0

    def _cut(self, groups: Groups, group: int, relief: F32, labels: U8, place: Ints, cluster: Ints) -> U8:
        """Return the parts of one group over its bounding box: every pixel goes to the top it climbs to."""
        left, top, width, height = cv2.boundingRect(groups.contours[group])
        s = self._scale
        window = (slice(top // s, (top + height - 1) // s + 1), slice(left // s, (left + width - 1) // s + 1))
        mine = labels[window] == group + 1
        ground = np.where(mine, relief[window], np.float32(-1.0))
        numbers = np.unique(cluster, return_inverse=True)[1] + 1
        coarse = _basins(ground, place - [window[0].start, window[1].start], numbers.astype(np.uint8))
        coarse[~mine] = 0
        grown = np.where(coarse == 0, cv2.dilate(coarse, np.ones((5, 5), np.uint8)), coarse)
        fine = np.repeat(np.repeat(grown, s, axis=0), s, axis=1)
        start = (top - window[0].start * s, left - window[1].start * s)
        fine = np.pad(fine, ((0, s), (0, s)), mode="edge")[start[0] : start[0] + height, start[1] : start[1] + width]
        own = groups.labels[top : top + height, left : left + width] == group + 1
        return np.ascontiguousarray(np.where(own, fine, 0), dtype=np.uint8)


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


def tops_by_group(tops: Tops, clusters: Ints) -> dict[int, Ints]:
    """Return the tops of every group that has more than one."""
    counts = np.bincount(tops.group)
    return {int(group): np.flatnonzero(tops.group == group) for group in np.flatnonzero(counts > 1)}


def find_tops(relief: F32, wide_px: F32, labels: U8, window: U8, most: int = 400) -> Tops:
    """Return pixels that nothing within the window overtops, and the widest places within twice the window."""
    summit = (relief >= cv2.dilate(relief, window)) & (relief > 0)
    wide = np.ones((2 * window.shape[0] + 1, 2 * window.shape[1] + 1), np.uint8)
    summit |= (wide_px >= cv2.dilate(wide_px, wide)) & (wide_px > 2.0) & (relief > 0)
    place = np.argwhere(summit & (labels > 0))
    if len(place) > most:
        place = place[np.argsort(-relief[place[:, 0], place[:, 1]])[:most]]
    rows, columns = place[:, 0], place[:, 1]
    return Tops(
        place,
        relief[rows, columns].astype(np.float64),
        wide_px[rows, columns].astype(np.float64),
        labels[rows, columns].astype(np.intp) - 1,
    )


def _pairs(tops: Tops) -> tuple[Ints, Ints]:
    first, second = np.nonzero(np.triu(tops.group[:, None] == tops.group[None, :], k=1))
    return first, second


def lowest_between(relief: F32, start: Ints, end: Ints, samples: int = 24) -> F64:
    """Return the lowest height (M,) on the straight ways between places (M, 2) of a height map."""
    way = np.linspace(0.0, 1.0, samples)
    places = start[:, None, :] + way[None, :, None] * (end - start)[:, None, :]
    rows, columns = np.moveaxis(np.rint(places).astype(np.intp), -1, 0)
    return np.asarray(relief[rows, columns].min(axis=1, initial=np.inf), dtype=np.float64)


class _Forest:
    """Tops that grow together into fruit (union-find); every tree knows its highest top and its widest place."""

    def __init__(self, height_m: F64, wide_px: F64) -> None:
        self._parent = list(range(len(height_m)))
        self._height = height_m.tolist()
        self._wide = wide_px.tolist()

    def root(self, top: int) -> int:
        """Return the tree that a top belongs to."""
        while self._parent[top] != top:
            self._parent[top] = self._parent[self._parent[top]]
            top = self._parent[top]
        return top

    def join(self, a: int, b: int, apart: Callable[[float, float], bool]) -> None:
        """Join the trees of two tops unless `apart(lower top's height, narrower tree's half width)`."""
        a, b = self.root(a), self.root(b)
        if a == b or apart(min(self._height[a], self._height[b]), min(self._wide[a], self._wide[b])):
            return
        lower, upper = (a, b) if self._height[a] < self._height[b] else (b, a)
        self._parent[lower] = upper
        self._wide[upper] = max(self._wide[upper], self._wide[lower])

    def roots(self) -> Ints:
        """Return the tree of every top."""
        return np.array([self.root(top) for top in range(len(self._parent))], dtype=np.intp)


def _basins(ground: F32, place: Ints, number: U8) -> U8:
    """Return for every pixel the number of the top that steepest ascent leads to (watershed by pointer jumping)."""
    rows, columns = ground.shape
    padded = np.pad(ground, 1, constant_values=-2.0)
    steps = [(i, j) for i in range(3) for j in range(3)]
    around = np.stack([padded[i : i + rows, j : j + columns] for i, j in steps])
    move = np.array([(i - 1) * columns + (j - 1) for i, j in steps])
    parent = np.arange(rows * columns) + move[around.argmax(axis=0)].reshape(-1)
    for _ in range(12):
        parent = parent[parent]
    roots, inverse = np.unique(parent, return_inverse=True)
    at = np.stack([roots // columns, roots % columns], axis=1)
    many, tops = np.repeat(at, len(place), axis=0), np.tile(place, (len(at), 1))
    saddle = lowest_between(ground, many, tops).reshape(len(at), len(place))
    distance = np.linalg.norm((many - tops).astype(np.float64), axis=1).reshape(len(at), len(place))
    best = np.argmax(saddle - 1e-5 * distance, axis=1)
    return np.asarray(number[best][inverse].reshape(rows, columns), dtype=np.uint8)
