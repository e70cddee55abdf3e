"""From a depth image to the groups of pixels that stand on the belt (paper 2.4.1, 3.1)."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.frame import U8, U16
from fruitgui.perception.limits import DepthLimits
from fruitgui.perception.outline import Contour
from fruitgui.perception.settings import PerceptionSettings

MOST_GROUPS = 254
"""Labels are bytes; a frame with more groups than this keeps the largest."""


@dataclass(frozen=True, slots=True, eq=False)
class Groups:
    """What stands on the belt in one frame, within the crop of the sensor's limits.

    Attributes:
        labels: (h, w) uint8; group i (0-based) carries i + 1, holes filled; 0 is belt.
        solid: (h, w) uint8; 255 where a depth reading is above the belt, inside the region.
        contours: one (K, 1, 2) int32 outline for each group, crop pixels.
    """

    labels: U8
    solid: U8
    contours: tuple[Contour, ...]


class Segmenter:
    """Finds groups above the belt in the frames of one sensor."""

    def __init__(self, limits: DepthLimits, settings: PerceptionSettings) -> None:
        self._limits = limits
        self._settings = settings
        smallest_px = limits.pixels_of(settings.smallest_m, limits.belt_z_m)
        bridge = 2 * int(np.clip(round(smallest_px / 6), 1, 3)) + 1
        self._bridge = cv2.getStructuringElement(cv2.MORPH_RECT, (bridge, bridge))
        thin = 2 * int(np.clip(round(smallest_px / 7), 1, 4)) + 1
        self._thin = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (thin, thin))

    def groups(self, depth_mm: U16) -> Groups:
        """Return the groups in a depth image (height, width)."""
        depth = depth_mm[self._limits.crop]
        solid = cv2.inRange(depth, self._limits.nearest_mm, self._limits.farthest_mm)
        bridged = self._over_holes(depth, solid)
        opened = cv2.morphologyEx(bridged, cv2.MORPH_OPEN, self._thin)
        contours, _ = cv2.findContours(opened, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
        kept = self._large_enough(contours)
        labels = np.zeros(self._limits.shape, np.uint8)
        for number, contour in enumerate(kept):
            cv2.drawContours(labels, [contour], 0, number + 1, cv2.FILLED)
        return Groups(labels, solid, kept)

    def _over_holes(self, depth: U16, solid: U8) -> U8:
        """Close gaps, but only over missing readings: belt seen between two fruit keeps them apart."""
        closed = cv2.morphologyEx(solid, cv2.MORPH_CLOSE, self._bridge)
        missing = cv2.compare(depth, 0, cv2.CMP_EQ)
        return np.asarray(cv2.bitwise_or(solid, cv2.bitwise_and(closed, missing)))

    def _large_enough(self, contours: tuple[Contour, ...]) -> tuple[Contour, ...]:
        """Keep outlines with at least the pixels of half the smallest fruit, seen at their own distance."""
        found = []
        for contour in contours:
            if len(contour) < 8:
                continue
            area = cv2.contourArea(contour)
            if area >= self._least_area(contour):
                found.append((area, contour))
        found.sort(key=lambda pair: -pair[0])
        return tuple(contour for _, contour in found[:MOST_GROUPS])

    def _least_area(self, contour: Contour) -> float:
        """Return half the area of the smallest fruit in pixels where the group stands, by the belt's distance there."""
        column, row = contour[0, 0].tolist()
        z_m = self._limits.offset_m / max(self._limits.slope.item(row, column), 1e-3)
        return float(0.5 * np.pi / 4.0 * self._limits.pixels_of(self._settings.smallest_m, z_m) ** 2)
