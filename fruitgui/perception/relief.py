"""Height maps of what stands on the belt, on a coarse grid, in which jumps in depth are dug as moats."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.frame import F32, U8, U16
from fruitgui.perception.limits import DepthLimits
from fruitgui.perception.segment import Groups
from fruitgui.perception.settings import PerceptionSettings
from fruitgui.perception.tiles import Tiles, edge_distance, laid_out


@dataclass(frozen=True, slots=True, eq=False)
class Relief:
    """The groups of a frame side by side, each in a tile of its own, seen on the coarse grid.

    Attributes:
        tiles: where they lie in the coarse picture and in the maps.
        labels: (h, w) uint8; group i (0-based) carries i + 1, in its own tile.
        height_m: (h, w) float32 above the belt, gaps filled from around them; 0 outside the groups.
        wide_px: (h, w) float32, distance from the group's outline.
    """

    tiles: Tiles
    labels: U8
    height_m: F32
    wide_px: F32


class ReliefMaker:
    """Makes the reliefs of one sensor's frames.

    Args:
        limits: of the sensor.
        settings: its noise, and the smallest fruit.
        scale: pixels of the picture between two of the coarse grid, down and across.
    """

    def __init__(self, limits: DepthLimits, settings: PerceptionSettings, scale: int) -> None:
        self._scale = scale
        self._offset_m = np.float32(limits.offset_m)
        self._slope = np.ascontiguousarray(limits.slope[::scale, ::scale])
        self._cross = cv2.getStructuringElement(cv2.MORPH_CROSS, (3, 3))
        # A surface seen at 56° recedes by tan 56° = 1.5 pixels' width per pixel; the depth's own steps add to it.
        slope_m = 1.5 * scale * limits.belt_z_m / limits.focal_px
        self._allowed_mm = round(1e3 * (slope_m + 1.2 * float(settings.step_at_m(np.array(limits.belt_z_m)))))

    def relief(self, groups: Groups) -> Relief:
        """Return the relief of at least one group."""
        s = self._scale
        boxes = [
            (left // s, top // s, (left + width - 1) // s - left // s + 1, (top + height - 1) // s - top // s + 1)
            for left, top, width, height in groups.boxes
        ]
        tiles = laid_out(boxes, self._slope.shape)
        labels = tiles.owned(groups.labels[::s, ::s])
        height_m = self._heights(tiles.cut(groups.standing_mm[::s, ::s]), tiles.cut(self._slope), labels)
        return Relief(tiles, labels, height_m, edge_distance(tiles, cv2.compare(labels, 0, cv2.CMP_GT)))

    def _heights(self, depth: U16, slope: F32, labels: U8) -> F32:
        share = cv2.boxFilter(cv2.compare(depth, 0, cv2.CMP_GT), cv2.CV_32F, (3, 3), normalize=False)
        moat = self._moats(depth).astype(np.float32)
        z_mm = cv2.divide(cv2.boxFilter(depth, cv2.CV_32F, (3, 3), normalize=False), cv2.max(share, 9.0), scale=255.0)
        z_mm *= slope
        moat *= np.float32(2.0)
        z_mm += moat
        z_mm *= np.float32(-1e-3)
        z_mm += self._offset_m
        inside = cv2.bitwise_and(cv2.compare(labels, 0, cv2.CMP_GT), cv2.compare(share, 72.0, cv2.CMP_GT))
        return np.asarray(cv2.copyTo(z_mm, inside), dtype=np.float32)

    def _moats(self, depth: U16) -> U16:
        """Return by how many millimetres what lies behind an edge is farther than a slope would make it, (h, w).

        Only the farther side of an edge is dug: the rim of a bowl stays a ridge.
        """
        # Where nothing stands (depth 0), nothing is in front: 0 − 1 is the largest number there is.
        in_front = cv2.erode(depth - np.uint16(1), self._cross)
        return np.asarray(cv2.subtract(cv2.subtract(depth, in_front), self._allowed_mm + 1))
