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

import cv2
import numpy as np

from fruitgui.frame import F32, F64, U8, Bools, Ints
from fruitgui.perception.limits import DepthLimits
from fruitgui.perception.outline import Contour
from fruitgui.perception.parts import Parts, is_sound, part_contours, unsplit, whole_slabs, with_parts
from fruitgui.perception.rails import LONG
from fruitgui.perception.relief import Relief, ReliefMaker
from fruitgui.perception.segment import Groups
from fruitgui.perception.settings import PerceptionSettings
from fruitgui.perception.tiles import Box
from fruitgui.perception.tops import Forest, Tops, basins, find_tops, lowest_between, near_two


class HeightSplitter:
    """Splits groups by the prominence of their tops. One per sensor."""

    def __init__(self, limits: DepthLimits, settings: PerceptionSettings) -> None:
        self._limits = limits
        self._settings = settings
        smallest_px = limits.pixels_of(settings.smallest_m, limits.belt_z_m)
        self._scale = 2 if smallest_px >= 6.0 else 1
        self._maker = ReliefMaker(limits, settings, self._scale)
        reach = int(np.clip(round(0.3 * smallest_px / self._scale), 1, 6))
        self._window = np.ones((2 * reach + 1, 2 * reach + 1), np.uint8)
        self._least_dip_m = max(0.005, 3.0 * float(settings.noise_at_m(np.array(limits.belt_z_m))))
        self._thin_px = 0.33 * smallest_px / self._scale
        self._least_px = 0.3 * np.pi / 4.0 * smallest_px**2

    def __call__(self, groups: Groups) -> Parts:
        """Return the fruit in the groups of a frame."""
        if not groups.contours:
            return unsplit(groups)
        relief = self._maker.relief(groups)
        tops = find_tops(relief, self._window)
        cuts: dict[int, list[Contour]] = {}
        solid = len(groups.contours) - groups.flat
        for group in self._doubtful(relief, tops):
            if group >= solid:
                continue
            pieces = self._pieces(groups, group, relief, tops.of(group))
            if is_sound(groups.contours[group], pieces):
                cuts[group] = pieces
        return with_parts(groups, cuts)

    def _pieces(self, groups: Groups, group: int, relief: Relief, tops: Tops) -> list[Contour]:
        """Return the outlines of a group's parts; none where its tops are tops of one fruit."""
        numbers = np.unique(self._clusters(relief, tops), return_inverse=True)[1] + 1
        if numbers.max() < 2:
            return []
        patch = _patch(groups, group, relief)
        parts = basins(patch.ground, tops.place - patch.inner, numbers.astype(np.uint8))
        top_m = np.zeros(int(numbers.max()))
        np.maximum.at(top_m, numbers - 1, tops.height_m)
        parts = cv2.copyTo(parts, patch.mine.astype(np.uint8))
        pixel_m = self._pixel_m(patch.box, 0.5 * float(top_m.max()))
        parts = whole_slabs(parts, top_m, pixel_m, LONG * self._settings.largest_m)
        return part_contours(self._refined(parts, patch, groups, group), patch.box[:2], self._least_px)

    def _pixel_m(self, box: Box, height_m: float) -> float:
        """Return what a pixel of the coarse grid spans at something of that height there: a tilted sensor's differ."""
        left, top, width, height = box
        slope = float(self._limits.slope[top + height // 2, left + width // 2])
        return self._scale * (self._limits.offset_m - height_m) / max(slope, 1e-3) / self._limits.focal_px

    def _refined(self, parts: U8, patch: Patch, groups: Groups, group: int) -> U8:
        """Return the parts over the group's bounding box in the crop's own pixels."""
        left, top, width, height = patch.box
        s = self._scale
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

    def _doubtful(self, relief: Relief, tops: Tops) -> list[int]:
        """Return the groups that have a top from which no straight way leads to the group's highest without a dip."""
        highest = tops.highest()
        others = np.flatnonzero(highest != np.arange(len(highest)))
        highest = highest[others]
        saddle, neck = lowest_between((relief.height_m, relief.wide_px), tops.place[others], tops.place[highest])
        top_m, narrower_px = tops.height_m[others], np.minimum(tops.wide_px[others], tops.wide_px[highest])
        apart = self._score(top_m, narrower_px, top_m - saddle, narrower_px - neck) >= 1.0
        return sorted(set(tops.group[others[apart]].tolist()))

    def _clusters(self, relief: Relief, tops: Tops) -> Ints:
        """Return for every top of one group the number of the fruit it belongs to.

        Tops are joined in the order of the heights of the ways between them. Two
        stay apart where the way dips too much, or the outline narrows too much,
        or both do half of it. Among many tops (a rail has a hundred and more) ways lead to near ones only.
        """
        first, second = near_two(tops.place)
        saddle, neck = lowest_between((relief.height_m, relief.wide_px), tops.place[first], tops.place[second])
        order = np.argsort(-saddle, kind="stable")
        forest = Forest(tops.height_m, tops.wide_px)
        edges = np.column_stack([first, second])[order].tolist()
        for (one, other), low, narrow in zip(edges, saddle[order].tolist(), neck[order].tolist(), strict=True):
            a, b = forest.root(one), forest.root(other)
            if a != b and not self._apart(*forest.lower_and_narrower(a, b), low, narrow):
                forest.join(a, b)
                if forest.trees == 1:
                    break
        if forest.narrowest() < self._thin_px:
            for one, other in edges:
                a, b = forest.root(one), forest.root(other)
                # What is thinner than any fruit is a finger or a leaf's tip: part of what it hangs on.
                if a != b and forest.lower_and_narrower(a, b)[1] < self._thin_px:
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
    """The coarse maps of one group, over its tile.

    Attributes:
        corner, inner: (2,) row and column where it begins on the coarse grid, and in the relief.
        box: left, top, width, height of the group in the crop's own pixels.
        mine: (h, w) whether a pixel belongs to the group.
        ground: (h, w) heights, −1 outside the group.
    """

    corner: Ints
    inner: Ints
    box: tuple[int, int, int, int]
    mine: Bools
    ground: F32


def _patch(groups: Groups, group: int, relief: Relief) -> Patch:
    source, place = relief.tiles.sources[group], relief.tiles.places[group]
    mine = relief.labels[place] > 0
    return Patch(
        np.array([source[0].start, source[1].start]),
        np.array([place[0].start, place[1].start]),
        groups.boxes[group],
        mine,
        np.where(mine, relief.height_m[place], np.float32(-1.0)),
    )
