"""Leaves, paper, twigs: things too flat for single depth readings, found by their colour and a mean of many readings.

A reading errs by 1.4 mm · z², so nothing lower than 8 mm stands out of the belt at 1 m by depth alone (`limits`). What
differs from the belt in colour is looked at once more: it is a thing if all its readings together lie above the belt
just around it, those beyond what depth shows of it too. A stain, a wet patch, a shadow differ in colour and do not
rise. What is in one patch with something tall, or mostly beside it, is left to depth: colours of fruit run over their
edges, and those of rails, which part the belt from what lies beyond it.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from fruitgui.frame import F32, F64, U8, U16, Bools, Ints
from fruitgui.perception.colour import LOGARITHM
from fruitgui.perception.limits import DepthLimits, half_of
from fruitgui.perception.outline import Contour
from fruitgui.perception.rails import RAIL
from fruitgui.perception.segment import MOST_GROUPS, Groups, drawn
from fruitgui.perception.settings import PerceptionSettings

CELL = 4
"""Pixels of the sensor between two places at which colours are compared."""

TALL_M = 0.02
"""What rises higher is seen by depth."""

UNLIKE = (0.12, 0.12, 0.25)
"""Least difference from the belt's logarithms of red to green, blue to green, and green that counts: a worn belt's
chroma differs by 0.05 from place to place, and light falls off by a tenth across a picture."""

SPREADS = 5.0
"""Or so many of the belt's own standard deviations, where these are larger."""

SEEN_BY_DEPTH = 0.5
"""A patch of which depth shows more than this share, or which lies so much within 25 mm of something tall or of a rail,
is left to depth."""

RISES = 2.5
"""Standard deviations by which the mean of a flat thing's readings must lie above the belt around it."""

LEAST_RISE_M = 1.5e-3
"""And at least so much: the belt itself is no more even over a hand's width, and dark dye shifts readings by less."""

CORRELATED_PX = 50.0
"""Readings that err alike (method 1.2)."""

_HIGHEST_M = 0.03
_LEAST_READ = 4
_MEDIAN_TO_DEVIATION = 1.4826
_RATIOS = np.array([[1.0, -1.0, 0.0], [0.0, -1.0, 1.0], [0.0, 1.0, 0.0]], dtype=np.float32)
"""From logarithms of red, green and blue to those of red to green, blue to green, and green."""

_NEAR = np.ones((7, 7), np.uint8)
_BESIDE = np.ones((3, 3), np.uint8)


class FlatFinder:
    """Finds flat things in the frames of one sensor.

    Args:
        limits: of the sensor.
        settings: its noise, and the smallest thing that is looked for.
    """

    def __init__(self, limits: DepthLimits, settings: PerceptionSettings) -> None:
        self._limits = limits
        self._settings = settings
        self._shape = half_of(*half_of(*limits.shape))
        slope = np.maximum(limits.slope, 1e-3)
        self._slope = self._cells(limits.slope)
        self._tall_mm = self._cells((1e3 * (limits.offset_m - TALL_M) / slope).astype(np.uint16))
        self._reach = self._cells(limits.farthest_mm) > 0
        smallest_px = limits.pixels_of(settings.smallest_m, limits.belt_z_m)
        self._least_cells = max(np.pi / 4.0 * (smallest_px / CELL) ** 2, 3.0)

    def add(self, groups: Groups, depth_mm: U16, calm: U8) -> Groups:
        """Return the groups of a frame and the flat things in it; groups that are parts of these are left out.

        Args:
            groups: found by depth.
            depth_mm: (height, width) of the whole picture.
            calm: see `colour.calm_picture`.
        """
        standing, labels = self._cells(groups.standing_mm), self._cells(groups.labels)
        seen, tall = labels > 0, (standing > 0) & (standing < self._tall_mm)
        unlike = self._unlike(self._thinned(calm), seen)
        rail = (labels == RAIL).view(np.uint8)
        marked = (unlike & (cv2.dilate(rail, _BESIDE) == 0)).view(np.uint8)
        count, patches, stats, _ = cv2.connectedComponentsWithStats(marked, connectivity=8, ltype=cv2.CV_16U)
        area = stats[:, cv2.CC_STAT_AREA]
        fringe = seen | (cv2.dilate(rail | tall.view(np.uint8), _NEAR) > 0)
        covered = np.bincount(patches[fringe], minlength=count)
        covered[patches[tall & seen]] = area.max()
        wanted = (area >= self._least_cells) & (covered < SEEN_BY_DEPTH * area)
        wanted[0] = False
        if not wanted.any():
            return groups
        depth = depth_mm[self._limits.crop]
        patches = np.where(wanted, np.arange(count), 0).astype(np.uint16).take(patches)
        wanted = self._rises(patches, count, unlike | seen, self._cells(depth))
        partly = wanted & (np.bincount(patches[seen], minlength=count) > 0)
        if partly.any():
            # A small fruit lifts the mean of its own shadow: what depth does not show must rise by itself.
            beyond = np.where(cv2.dilate(seen.view(np.uint8), _BESIDE) > 0, np.uint16(0), patches)
            wanted &= ~partly | self._rises(beyond, count, unlike | seen, self._cells(depth))
        things = [_outline(*self._fine(patches, number, stats[number])) for number in np.flatnonzero(wanted).tolist()]
        return _with_flat(groups, things, depth, np.unique(labels[tall & seen])) if things else groups

    def _cells(self, picture: NDArray[Any]) -> NDArray[Any]:
        rows, columns = self._shape
        return np.ascontiguousarray(picture[::CELL, ::CELL][:rows, :columns])

    def _thinned(self, calm: U8) -> U8:
        """Return every second pixel and row of a calm picture: the cells' colours."""
        rows, columns = self._shape
        # OpenCV's copy of the nearest takes a fifth of the time of numpy's of a view with steps.
        return np.asarray(cv2.resize(calm[: 2 * rows, : 2 * columns], (columns, rows), interpolation=cv2.INTER_NEAREST))

    def _unlike(self, cells: U8, seen: Bools) -> Bools:
        """Return where (h, w) the colour is not the belt's."""
        logs = cv2.LUT(cells, LOGARITHM)
        bare = np.flatnonzero((self._reach & ~seen)[::3, ::3])
        if len(bare) < 16:
            return np.zeros(self._shape, dtype=bool)
        belt = _RATIOS @ logs[::3, ::3].reshape(-1, 3).take(bare, axis=0).T
        middle = _medians(belt)
        unit = np.maximum(UNLIKE, SPREADS * _MEDIAN_TO_DEVIATION * _medians(np.abs(belt - middle[:, None])))
        apart = cv2.transform(logs, np.column_stack([_RATIOS, -middle]) / unit[:, None])
        return np.asarray((cv2.transform(apart * apart, np.ones((1, 3), np.float32)) > 1.0) & self._reach)

    def _fine(self, patches: Ints, number: int, box: Ints) -> tuple[U8, tuple[int, int]]:
        """Return the pixels of a patch with a margin, uint8 0 or 1, and the column and row where they begin."""
        margin = 4
        left, top = max(int(box[0]) - margin, 0), max(int(box[1]) - margin, 0)
        right, below = int(box[0] + box[2]) + margin, int(box[1] + box[3]) + margin
        coarse = (patches[top:below, left:right] == number).astype(np.uint8) * np.uint8(255)
        rows, columns = self._limits.shape
        wide, tall = coarse.shape[1] * CELL, coarse.shape[0] * CELL
        fine = cv2.resize(coarse, (wide, tall), interpolation=cv2.INTER_LINEAR)
        fine = fine[: rows - top * CELL, : columns - left * CELL]
        return np.asarray(cv2.threshold(fine, 127, 1, cv2.THRESH_BINARY)[1]), (left * CELL, top * CELL)

    def _rises(self, patches: U16, count: int, taken: Bools, depth_mm: U16) -> Bools:
        """Tell of which patches (count,) the readings lie above those of the belt around them.

        Args:
            patches: (h, w) number of each cell's patch; 0 belongs to none.
            count: how many, 0 among them.
            taken: (h, w) what is no belt.
            depth_mm: (h, w) one reading of each cell: neighbouring readings err alike.
        """
        ring = cv2.dilate(patches, _NEAR)
        ring[cv2.dilate(taken.view(np.uint8), _BESIDE) > 0] = 0
        ring[~self._reach] = 0
        own, height_m, away_m = self._means(patches, count, depth_mm)
        belt, belt_m, _ = self._means(ring, count, depth_mm)
        one = self._settings.noise_at_m(away_m) ** 2 + self._settings.step_at_m(away_m) ** 2 / 12.0
        std_m = np.sqrt(one * (CORRELATED_PX / CELL**2) * (1.0 / np.maximum(own, 1) + 1.0 / np.maximum(belt, 1)))
        enough = (own >= _LEAST_READ) & (belt >= _LEAST_READ)
        return np.asarray(enough & (height_m - belt_m > np.maximum(LEAST_RISE_M, RISES * std_m)))

    def _means(self, patches: U16, count: int, depth_mm: U16) -> tuple[Ints, F64, F64]:
        """Return for each patch how many of its cells have a sound reading, and their mean height and distance."""
        found = np.flatnonzero(patches)
        number = patches.reshape(-1).take(found).astype(np.intp)
        z_m = depth_mm.reshape(-1).take(found) * np.float32(1e-3)
        height_m = np.float32(self._limits.offset_m) - self._slope.reshape(-1).take(found) * z_m
        read = ((z_m > 0) & (np.abs(height_m) < _HIGHEST_M)).astype(np.float32)
        cells, heights, distances = (np.bincount(number, read * values, count) for values in (1.0, height_m, z_m))
        total = np.maximum(cells, 1.0)
        return cells.astype(np.intp), heights / total, distances / total


def _medians(rows: F32) -> F32:
    middle = rows.shape[1] // 2
    return np.asarray(np.partition(rows, middle, axis=1)[:, middle])


def _outline(mask: U8, corner: tuple[int, int]) -> Contour:
    outlines, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE, offset=corner)
    return max(outlines, key=cv2.contourArea)


def _with_flat(groups: Groups, things: list[Contour], depth: U16, solid: U8) -> Groups:
    """Return the groups with flat things as the last of them.

    A group that meets one becomes part of it, but for rails and those whose labels are `solid`: these stay as they are.
    """
    spared = np.isin(np.arange(RAIL + 1), [RAIL, *solid.tolist()])[groups.labels]
    canvas = drawn(tuple(things), groups.labels.shape)
    canvas[spared] = 0
    swallowed = {int(number) - 1 for number in np.unique(groups.labels[canvas > 0]) if number}
    for number in swallowed:
        cv2.drawContours(canvas, groups.contours, number, 1, cv2.FILLED)
    canvas[spared] = 0
    outlines, _ = cv2.findContours(canvas, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    kept = [contour for number, contour in enumerate(groups.contours) if number not in swallowed]
    flat = [outline for outline in outlines if len(outline) >= 8][: MOST_GROUPS - len(kept)]
    labels, standing = drawn((*kept, *flat), groups.labels.shape), groups.standing_mm.copy()
    labels[groups.labels == RAIL] = RAIL
    cv2.copyTo(depth, canvas, standing)
    contours = (*kept, *flat)
    boxes = tuple(cv2.boundingRect(contour) for contour in contours)
    return replace(groups, labels=labels, standing_mm=standing, contours=contours, boxes=boxes, flat=len(flat))
