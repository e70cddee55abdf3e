"""The fruit of a frame once groups are taken apart, however that was done."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import cv2
import numpy as np

from fruitgui.frame import F64, U8, Bools, Ints
from fruitgui.perception.outline import Contour, solidity
from fruitgui.perception.rails import Rail
from fruitgui.perception.segment import MOST_GROUPS, Groups
from fruitgui.perception.tiles import Box

CONVEX = 0.945
"""An outline that fills this part of its convex hull has no notch where two fruit could meet …"""

CRESCENT = 0.83
"""A part that fills less of its own hull is a crescent: what shows of a fruit behind another, or a piece of a bowl."""

ROUND = 0.93
"""A part that fills this much may be the fruit in front. There cannot be more crescents than such."""

SLAB = 0.45
"""What is lower than this part of its width is no fruit, nor four that lie in a square and were taken for one: these
have 0.47."""

SLAB_M = 0.045
"""Nor is a slab taller, whatever its width."""

SMALLEST_M, FLAT, LOWEST_M = 0.035, 0.6, 0.03
"""A part at least so large, and at least so tall for its size and at all, is built like a fruit."""

LEVEL_M = 0.008
"""What the tops of one slab's parts differ by: three standard deviations of a height at 1.4 m."""


@dataclass(frozen=True, slots=True, eq=False)
class Parts:
    """The fruit of a frame, after splitting; N of them.

    Attributes:
        labels: (h, w) uint8 of the crop; fruit i carries i + 1, rails `RAIL`.
        contours: N outlines (K, 1, 2) int32, crop pixels.
        boxes: N times left, top, width and height of the outline.
        group: (N,) the group that each came from.
        shared: (N,) whether its group was split.
        rails: that were taken out.
    """

    labels: U8
    contours: tuple[Contour, ...]
    boxes: tuple[Box, ...]
    group: Ints
    shared: Bools
    rails: tuple[Rail, ...] = ()


class Splitter(Protocol):
    """One way of taking groups apart."""

    def __call__(self, groups: Groups) -> Parts:
        """Return the fruit in the groups of a frame."""


def unsplit(groups: Groups) -> Parts:
    """Return every group as one fruit."""
    count = len(groups.contours)
    return Parts(groups.labels, groups.contours, groups.boxes, np.arange(count), np.zeros(count, bool), groups.rails)


def with_parts(groups: Groups, cuts: dict[int, list[Contour]]) -> Parts:
    """Return the fruit when some groups are replaced by parts; one without parts is dropped."""
    if not cuts:
        return unsplit(groups)
    labels = groups.labels.copy()
    count = len(groups.contours) - len(cuts)
    pieces = [(number, piece) for number, found in cuts.items() for piece in found][: MOST_GROUPS - count]
    count += len(pieces)
    found = dict(enumerate(groups.contours))
    # Only what changes is drawn: parts get the numbers that came free; so do the last groups where some were dropped.
    for number in cuts:
        cv2.drawContours(labels, [found.pop(number)], 0, 0, cv2.FILLED)
    moved = [(number, found.pop(number)) for number in list(found) if number >= count] + pieces
    group, boxes = list(range(count)), list(groups.boxes[:count]) + [(0, 0, 0, 0)] * (count - len(groups.boxes))
    for new, (number, contour) in zip([new for new in range(count) if new not in found], moved, strict=True):
        cv2.drawContours(labels, [contour], 0, new + 1, cv2.FILLED)
        found[new], group[new], boxes[new] = contour, number, cv2.boundingRect(contour)
    contours = tuple([found[number] for number in range(count)])
    shared = np.array([number in cuts for number in group], dtype=bool)
    return Parts(labels, contours, tuple(boxes), np.array(group, dtype=np.intp), shared, groups.rails)


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


def whole_slabs(parts: U8, top_m: F64, pixel_m: float, longest_m: float) -> U8:
    """Return the parts of a group with those joined that are one flat body: a hand narrows at wrist and knuckles.

    A part much lower than it is wide is no fruit, and what is level with it and grown together with it no other body,
    unless it is built like a fruit.

    Args:
        parts: (h, w) uint8, 1 … K on the pixels of the parts.
        top_m: (K,) their tops' heights.
        pixel_m: what a pixel spans.
        longest_m: parts that together are longer are not joined: they are many things. A hand with its arm is not.
    """
    if not (top_m < SLAB_M).any():
        return parts
    size_m = pixel_m * np.sqrt(4.0 / np.pi * np.bincount(parts.ravel(), minlength=len(top_m) + 1)[1:])
    joins = (size_m < SMALLEST_M) | (top_m < np.maximum(FLAT * size_m, LOWEST_M))
    for part in np.flatnonzero(joins & (top_m < SLAB_M)).tolist():
        if top_m[part] > SLAB * min(_extent(parts == part + 1)) * pixel_m:
            continue
        level = joins & (np.abs(top_m - top_m[part]) < LEVEL_M)
        body = _grown_together(np.append(False, level)[parts], parts == part + 1)
        if max(_extent(body)) * pixel_m <= longest_m:
            parts = np.where(body, np.uint8(part + 1), parts)
    return parts


def _grown_together(mask: Bools, part: Bools) -> Bools:
    """Return the connected pieces of a mask (h, w) in which a part lies."""
    _, pieces = cv2.connectedComponents(mask.view(np.uint8))
    return np.isin(pieces, np.unique(pieces[part & mask]))


def _extent(mask: Bools) -> tuple[float, float]:
    """Return the sides of the smallest rectangle round a mask, pixels."""
    points = cv2.findNonZero(mask.view(np.uint8))
    return (0.0, 0.0) if points is None else cv2.minAreaRect(points)[1]


def is_sound(group: Contour, parts: list[Contour]) -> bool:
    """Tell whether a cut leaves several parts, and something convex is not cut into crescents as a bowl would be."""
    if len(parts) < 2:
        return False
    filled = [solidity(part) for part in parts]
    crescents, rounds = sum(part < CRESCENT for part in filled), sum(part >= ROUND for part in filled)
    return solidity(group) <= CONVEX or crescents <= rounds
