"""From a depth image to the groups of pixels that stand on the belt (paper 2.4.1, 3.1)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.frame import U8, U16
from fruitgui.perception.limits import DepthLimits
from fruitgui.perception.outline import Contour
from fruitgui.perception.rails import RAIL, Rail, RailFinder
from fruitgui.perception.settings import PerceptionSettings
from fruitgui.perception.tiles import Box

MOST_GROUPS = 254
"""Labels are bytes; a frame with more groups than this keeps the largest."""


@dataclass(frozen=True, slots=True, eq=False)
class Groups:
    """What stands on the belt in one frame, within the crop of the sensor's limits.

    Attributes:
        labels: (h, w) uint8; group i (0-based) carries i + 1, holes filled; 0 is belt, `RAIL` is rail.
        standing_mm: (h, w) uint16; depth readings above the belt, inside the region; 0 elsewhere.
        contours: one (K, 1, 2) int32 outline for each group, crop pixels.
        boxes: one left, top, width and height for each outline.
        rails: that were taken out.
        flat: so many of the groups, the last ones, are flat things that colour showed.
    """

    labels: U8
    standing_mm: U16
    contours: tuple[Contour, ...]
    boxes: tuple[Box, ...]
    rails: tuple[Rail, ...] = ()
    flat: int = 0


class Segmenter:
    """Finds groups above the belt in the frames of one sensor."""

    def __init__(self, limits: DepthLimits, settings: PerceptionSettings) -> None:
        self._limits = limits
        smallest_px = limits.pixels_of(settings.smallest_m, limits.belt_z_m)
        bridge = 2 * int(np.clip(round(smallest_px / 6), 1, 3)) + 1
        self._bridge = cv2.getStructuringElement(cv2.MORPH_RECT, (bridge, bridge))
        thin = 2 * int(np.clip(round(smallest_px / 7), 1, 4)) + 1
        z_m = limits.offset_m / np.maximum(limits.slope, 1e-3)
        self._least_area = 0.5 * np.pi / 4.0 * (settings.smallest_m * limits.focal_px / z_m) ** 2
        self._thin = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (thin, thin))
        self._rails = RailFinder(limits, settings)

    def groups(self, depth_mm: U16) -> Groups:
        """Return the groups in a depth image (height, width)."""
        depth = depth_mm[self._limits.crop]
        solid = cv2.inRange(depth, self._limits.nearest_mm, self._limits.farthest_mm)
        bridged = self._over_holes(depth, solid)
        opened = cv2.morphologyEx(bridged, cv2.MORPH_OPEN, self._thin)
        contours, _ = cv2.findContours(opened, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
        kept, rails = self._rails.without_rails(self._large_enough(contours), depth, solid)
        if rails:
            kept = self._large_enough(kept)
        labels = drawn(kept, self._limits.shape)
        for rail in rails:
            solid[rail.place][rail.pixels] = 0
            labels[rail.place][rail.pixels & (labels[rail.place] == 0)] = RAIL
        boxes = tuple(cv2.boundingRect(contour) for contour in kept)
        return Groups(labels, cv2.copyTo(depth, solid), kept, boxes, rails)

    def _over_holes(self, depth: U16, solid: U8) -> U8:
        """Close gaps, but only over missing readings: belt seen between two fruit keeps them apart."""
        closed = cv2.morphologyEx(solid, cv2.MORPH_CLOSE, self._bridge)
        missing = cv2.compare(depth, 0, cv2.CMP_EQ)
        return np.asarray(cv2.bitwise_or(solid, cv2.bitwise_and(closed, missing)))

    def _large_enough(self, contours: Sequence[Contour]) -> tuple[Contour, ...]:
        """Keep outlines with at least the pixels of half the smallest fruit, seen at the belt's distance there."""
        contours = [contour for contour in contours if len(contour) >= 8]
        if not contours:
            return ()
        area = np.array([cv2.contourArea(contour) for contour in contours])
        column, row = np.array([contour[0, 0] for contour in contours]).T
        kept = np.flatnonzero(area >= self._least_area[row, column])
        largest = kept[np.argsort(-area[kept], kind="stable")][:MOST_GROUPS]
        return tuple(contours[number] for number in largest.tolist())


def drawn(contours: tuple[Contour, ...], shape: tuple[int, ...]) -> U8:
    """Return a picture of outlines filled: i (0-based) carries i + 1."""
    labels = np.zeros(shape, np.uint8)
    for number, contour in enumerate(contours):
        cv2.drawContours(labels, [contour], 0, number + 1, cv2.FILLED)
    return labels
