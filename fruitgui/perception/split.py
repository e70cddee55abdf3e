"""Touching fruit taken apart by their tops: two fruit have two tops with a valley between them.

Fruit that touch on a belt meet at a crease, however convex their common outline
is; a pear, a banana, an apple with its dimple do not: from any of their tops a
way leads to any other that hardly descends. So a group is split where the way
between two tops dips by a good part of the lower top's height (its topographic
prominence). Where one fruit hides the foot of another there is no valley to be
seen but a jump in depth; jumps are dug into the height map as moats.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Protocol

import cv2
import numpy as np

from fruitgui.frame import F32, F64, U8, U16, Bools, Ints
from fruitgui.perception.limits import DepthLimits
from fruitgui.perception.outline import Contour, solidity
from fruitgui.perception.segment import MOST_GROUPS, Groups
from fruitgui.perception.settings import PerceptionSettings

CONVEX = 0.945
"""An outline that fills this part of its convex hull has no notch where two fruit could meet …"""

INDEX_SPAN = 2.0**20
"""More than the pixels of any group on the coarse grid."""

CRESCENT = 0.83
"""A part that fills less of its own hull is a crescent: what shows of a fruit behind another, or a piece of a bowl."""

ROUND = 0.93
"""A part that fills this much may be the fruit in front. There cannot be more crescents than such."""


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
    contours: tuple[Contour, ...]
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


def with_parts(groups: Groups, cuts: dict[int, list[Contour]]) -> Parts:
    """Return the fruit when some groups are replaced by parts; one without parts is dropped."""
    found: list[tuple[int, bool, Contour]] = []
    for number, contour in enumerate(groups.contours):
        found.extend((number, number in cuts, part) for part in cuts.get(number, [contour]))
    found = found[:MOST_GROUPS]
    # What was not cut only gets another number; of what was cut nothing is left but what is drawn.
    numbers = np.zeros(256, np.uint8)
    numbers[[number + 1 for number, shared, _ in found if not shared]] = [
        place + 1 for place, (_, shared, _) in enumerate(found) if not shared
    ]
    labels = cv2.LUT(groups.labels, numbers)
    for place, (_, shared, contour) in enumerate(found):
        if shared:
            cv2.drawContours(labels, [contour], 0, place + 1, cv2.FILLED)
    contours = tuple(contour for _, _, contour in found)
    origin = np.array([number for number, _, _ in found], dtype=np.intp)
    return Parts(labels, contours, origin, np.array([shared for _, shared, _ in found], dtype=bool))


def part_contours(parts: U8, corner: tuple[int, int], least_px: float) -> list[Contour]:
    """Return the outline of the largest piece of each part.

    Args:
        parts: (h, w) uint8, 1 … K on the pixels of the parts.
        corner: column and row of the crop where `parts` begins.
        least_px: smaller parts are left out.
    """
    found = []
    for part in range(1, int(parts.max()) + 1):
        alone = cv2.compare(parts, part, cv2.CMP_EQ)
        outlines, _ = cv2.findContours(alone, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE, offset=corner)
        largest = max(outlines, key=cv2.contourArea, default=None)
        if largest is not None and len(largest) >= 8 and cv2.contourArea(largest) >= least_px:
            found.append(largest)
    return found


def _is_sound(group: Contour, parts: list[Contour]) -> bool:
    """Tell whether a cut leaves several parts, and something convex is not cut into crescents as a bowl would be."""
    if len(parts) < 2:
        return False
    filled = [solidity(part) for part in parts]
    crescents, rounds = sum(part < CRESCENT for part in filled), sum(part >= ROUND for part in filled)
    return solidity(group) <= CONVEX or crescents <= rounds


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
        self._cross = cv2.getStructuringElement(cv2.MORPH_CROSS, (3, 3))
        belt_z = np.array(limits.belt_z_m)
        # A surface seen at 56° recedes by tan 56° = 1.5 pixels' width per pixel; the depth's own steps add to it.
        slope_m = 1.5 * self._scale * limits.belt_z_m / limits.focal_px
        self._allowed_mm = round(1e3 * (slope_m + 1.2 * float(settings.step_at_m(belt_z))))
        self._least_dip_m = max(0.005, 3.0 * float(settings.noise_at_m(belt_z)))
        self._thin_px = 0.33 * smallest_px / self._scale
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
        cuts: dict[int, list[Contour]] = {}
        for group in self._doubtful(relief, wide_px, tops):
            mine = tops.of(group)
            clusters = self._clusters(relief, wide_px, mine)
            numbers = np.unique(clusters, return_inverse=True)[1] + 1
            if numbers.max() < 2:
                continue
            patch = self._patch(groups.contours[group], group, labels, relief)
            parts = _basins(patch.ground, mine.place - patch.corner, numbers.astype(np.uint8))
            pieces = part_contours(self._refined(parts, patch, groups, group), patch.box[:2], self._least_px)
            if _is_sound(groups.contours[group], pieces):
                cuts[group] = pieces
        return with_parts(groups, cuts) if cuts else unsplit(groups)

    def _patch(self, contour: Contour, group: int, labels: U8, relief: F32) -> Patch:
        """Return the coarse maps of one group."""
        left, top, width, height = cv2.boundingRect(contour)
        s = self._scale
        rows, columns = slice(top // s, (top + height - 1) // s + 1), slice(left // s, (left + width - 1) // s + 1)
        mine = labels[rows, columns] == group + 1
        ground = np.where(mine, relief[rows, columns], np.float32(-1.0))
        return Patch(np.array([rows.start, columns.start]), (left, top, width, height), mine, ground)

    def _refined(self, parts: U8, patch: Patch, groups: Groups, group: int) -> U8:
        """Return the parts over the group's bounding box in the crop's own pixels."""
        left, top, width, height = patch.box
        s = self._scale
        parts = cv2.copyTo(parts, patch.mine.astype(np.uint8))
        grown = cv2.copyTo(parts, parts, cv2.dilate(parts, np.ones((5, 5), np.uint8)))
        rows, columns = parts.shape
        fine = cv2.resize(grown, (columns * s, rows * s), interpolation=cv2.INTER_NEAREST)
        row, column = top - int(patch.corner[0]) * s, left - int(patch.corner[1]) * s
        own = cv2.compare(groups.labels[top : top + height, left : left + width], group + 1, cv2.CMP_EQ)
        # The coarse grid may end a pixel before the crop does.
        fine = fine[row : row + height, column : column + width]
        fine = cv2.copyMakeBorder(
            fine, 0, height - fine.shape[0], 0, width - fine.shape[1], cv2.BORDER_REPLICATE
        )  # fmt: skip
        return np.asarray(cv2.bitwise_and(fine, own))

    def _relief(self, groups: Groups, depth_mm: U16, labels: U8) -> F32:
        """Return heights above the belt on the coarse grid, gaps filled from around them, jumps dug as moats."""
        s = self._scale
        solid = np.ascontiguousarray(groups.solid[::s, ::s])
        depth = cv2.copyTo(np.ascontiguousarray(depth_mm[self._limits.crop][::s, ::s]), solid)
        moat = self._moats(depth).astype(np.float32)
        share = cv2.boxFilter(solid, cv2.CV_32F, (3, 3), normalize=False)
        z_mm = cv2.divide(cv2.boxFilter(depth, cv2.CV_32F, (3, 3), normalize=False), cv2.max(share, 9.0), scale=255.0)
        z_mm *= self._slope
        moat *= np.float32(2.0)
        z_mm += moat
        z_mm *= np.float32(-1e-3)
        z_mm += np.float32(self._limits.offset_m)
        inside = cv2.bitwise_and(cv2.compare(labels, 0, cv2.CMP_GT), cv2.compare(share, 72.0, cv2.CMP_GT))
        return np.asarray(cv2.copyTo(z_mm, inside), dtype=np.float32)

    def _moats(self, depth: U16) -> U16:
        """Return by how many millimetres what lies behind an edge is farther than a slope would make it, (h, w).

        Only the farther side of an edge is dug: the rim of a bowl stays a ridge.
        """
        # Where nothing stands (depth 0), nothing is in front: 0 − 1 is the largest number there is.
        in_front = cv2.erode(depth - np.uint16(1), self._cross)
        return np.asarray(cv2.subtract(cv2.subtract(depth, in_front), self._allowed_mm + 1))

    def _doubtful(self, relief: F32, wide_px: F32, tops: Tops) -> list[int]:
        """Return the groups that have a top from which no straight way leads to the group's highest without a dip."""
        highest = tops.highest()
        ends = tops.place[highest]
        saddle, neck = lowest_between((relief, wide_px), tops.place, ends)
        narrower_px = np.minimum(tops.wide_px, tops.wide_px[highest])
        apart = self._score(tops.height_m, narrower_px, tops.height_m - saddle, narrower_px - neck) >= 1.0
        return [int(group) for group in np.unique(tops.group[apart])]

    def _clusters(self, relief: F32, wide_px: F32, tops: Tops) -> Ints:
        """Return for every top of one group the number of the fruit it belongs to.

        Tops are joined in the order of the heights of the ways between them. Two
        stay apart where the way dips too much, or the outline narrows too much,
        or both do half of it.
        """
        first, second = _pairs(tops)
        start, end = tops.place[first], tops.place[second]
        saddle, neck = lowest_between((relief, wide_px), start, end)
        order = np.argsort(-saddle, kind="stable")
        forest = _Forest(tops.height_m, tops.wide_px)
        edges = np.column_stack([first, second])[order].tolist()
        for (a, b), low, narrow in zip(edges, saddle[order].tolist(), neck[order].tolist(), strict=True):
            if not self._apart(*forest.lower_and_narrower(a, b), low, narrow):
                forest.join(a, b)
        if forest.narrowest() < self._thin_px:
            for a, b in edges:
                # What is thinner than any fruit is a finger or a leaf's tip: part of what it hangs on.
                if forest.lower_and_narrower(a, b)[1] < self._thin_px:
                    forest.join(a, b)
        return forest.roots()

    def _apart(self, top_m: float, wide_px: float, low_m: float, narrow_px: float) -> bool:
        """Tell whether a dip below the lower top and a waist beside the narrower part make two fruit."""
        dip = (top_m - low_m) / max(self._settings.prominence * top_m, self._least_dip_m)
        return dip + max((wide_px - narrow_px) / max(self._settings.waist * wide_px, 2.0), 0.0) >= 1.0

    def _score(self, top_m: F64, wide_px: F64, dip_m: F64, waist_px: F64) -> F64:
        """Return the same for arrays, as a number that is 1 where two fruit begin."""
        dip = dip_m / np.maximum(self._settings.prominence * top_m, self._least_dip_m)
        return np.asarray(dip + np.maximum(waist_px / np.maximum(self._settings.waist * wide_px, 2.0), 0.0))


@dataclass(frozen=True, slots=True, eq=False)
class Patch:
    """The coarse maps of one group, over its bounding box.

    Attributes:
        corner: (2,) row and column where it begins on the coarse grid.
        box: left, top, width, height in the crop's own pixels.
        mine: (h, w) whether a pixel belongs to the group.
        ground: (h, w) heights, −1 outside the group.
    """

    corner: Ints
    box: tuple[int, int, int, int]
    mine: Bools
    ground: F32


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


def find_tops(relief: F32, wide_px: F32, labels: U8, window: U8, most: int = 400) -> Tops:
    """Return pixels that nothing within the window overtops, and the widest places within twice the window."""
    wide = np.ones((2 * window.shape[0] + 1, 2 * window.shape[1] + 1), np.uint8)
    summit = cv2.compare(relief, cv2.dilate(relief, window), cv2.CMP_GE)
    widest = cv2.compare(wide_px, cv2.max(cv2.dilate(wide_px, wide), 2.0), cv2.CMP_GE)
    inside = cv2.compare(relief, 0.0, cv2.CMP_GT)
    found = cv2.findNonZero(cv2.bitwise_and(cv2.bitwise_or(summit, widest), inside))
    place = np.zeros((0, 2), np.intp) if found is None else found.reshape(-1, 2)[:, ::-1].astype(np.intp)
    if len(place) > most:
        place = place[np.argsort(-relief[place[:, 0], place[:, 1]])[:most]]
    rows, columns = place[:, 0], place[:, 1]
    return Tops(
        place,
        relief[rows, columns].astype(np.float64),
        wide_px[rows, columns].astype(np.float64),
        labels[rows, columns].astype(np.intp) - 1,
    )


@lru_cache(maxsize=64)
def _every_two(count: int) -> tuple[Ints, Ints]:
    first, second = np.triu_indices(count, k=1)
    return first, second


def _pairs(tops: Tops) -> tuple[Ints, Ints]:
    """Return the numbers of every two tops."""
    return _every_two(len(tops.group))


WAY: F32 = np.linspace(0.0, 1.0, 32, dtype=np.float32)[:, None]
WAY.setflags(write=False)
"""Where on the way between two tops heights are looked up."""


def lowest_between(maps: tuple[F32, ...], start: Ints, end: Ints, way: F32 = WAY) -> tuple[F64, ...]:
    """Return, for each map, the lowest value (M,) on the straight ways between places (M, 2: row, column)."""
    first, last = (places.T.astype(np.float32) + np.float32(0.5) for places in (start, end))
    rows, columns = ((a + way * (b - a)).astype(np.intp) for a, b in zip(first, last, strict=True))
    rows *= maps[0].shape[1]
    rows += columns
    return tuple(values.reshape(-1).take(rows).min(axis=0, initial=np.inf).astype(np.float64) for values in maps)


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

    def lower_and_narrower(self, a: int, b: int) -> tuple[float, float]:
        """Return the height of the lower and the half width of the narrower of two tops' trees."""
        a, b = self.root(a), self.root(b)
        return min(self._height[a], self._height[b]), min(self._wide[a], self._wide[b])

    def join(self, a: int, b: int) -> None:
        """Join the trees of two tops."""
        a, b = self.root(a), self.root(b)
        lower, upper = (a, b) if self._height[a] < self._height[b] else (b, a)
        self._parent[lower] = upper
        self._wide[upper] = max(self._wide[upper], self._wide[lower])

    def narrowest(self) -> float:
        """Return the half width of the narrowest tree."""
        return min(float(self._wide[top]) for top, parent in enumerate(self._parent) if top == parent)

    def roots(self) -> Ints:
        """Return the tree of every top."""
        return np.array([self.root(top) for top in range(len(self._parent))], dtype=np.intp)


def _basins(ground: F32, place: Ints, number: U8) -> U8:
    """Return for every pixel the number of the top that steepest ascent leads to (watershed by pointer jumping)."""
    rows, columns = ground.shape
    pixel = np.arange(rows * columns, dtype=np.float64).reshape(rows, columns)
    # Height in tenths of a millimetre and the pixel's own index in one exact number: the largest of the
    # neighbourhood tells where it is.
    key = np.rint(ground.astype(np.float64) * 1e4) * INDEX_SPAN + pixel
    parent = np.mod(cv2.dilate(key, np.ones((3, 3), np.uint8)), INDEX_SPAN).astype(np.intp).reshape(-1)
    for _ in range(8):
        parent = parent[parent]
    roots = np.flatnonzero(parent == np.arange(rows * columns))
    at = np.stack([roots // columns, roots % columns], axis=1)
    many, tops = np.repeat(at, len(place), axis=0), np.tile(place, (len(at), 1))
    saddle = lowest_between((ground,), many, tops, WAY[::3])[0].reshape(len(at), len(place))
    distance = np.abs(many - tops).sum(axis=1).reshape(len(at), len(place))
    part = np.zeros(rows * columns, np.uint8)
    part[roots] = number[np.argmax(saddle - 1e-5 * distance, axis=1)]
    return np.asarray(part[parent].reshape(rows, columns))
