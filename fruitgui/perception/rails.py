"""Rails inside the region are taken out of the picture before anything is made of them; fruit that touch them stay."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.frame import F64, U8, U16, Bools, Ints
from fruitgui.perception.cross_section import Line, rail_among
from fruitgui.perception.limits import DepthLimits
from fruitgui.perception.outline import Contour
from fruitgui.perception.settings import PerceptionSettings
from fruitgui.perception.tiles import Box

LONG = 2.0
"""What goes on for longer than so many of the longest fruit is none, not even two that lie end to end."""

EVEN = 0.75
"""Nowhere is a rail much narrower than this part of its width; a row of balls is, where two of them touch."""


RAIL = 255
"""The label of what is a rail's: it is no fruit and no belt."""


@dataclass(frozen=True, slots=True, eq=False)
class Rail:
    """A rail in one frame.

    Attributes:
        box: left, top, width and height of the group that it was found in, crop pixels.
        pixels: (height, width) which pixels of the box are its own.
    """

    box: Box
    pixels: Bools

    @property
    def place(self) -> tuple[slice, slice]:
        """Rows and columns of the box."""
        left, top, width, height = self.box
        return slice(top, top + height), slice(left, left + width)


class RailFinder:
    """Finds rails in the frames of one sensor."""

    def __init__(self, limits: DepthLimits, settings: PerceptionSettings) -> None:
        self._limits = limits
        self._long_m = LONG * settings.largest_m
        # What stands above the belt is nearer than the belt and looks longer.
        self._long_px = 0.8 * limits.pixels_of(self._long_m, limits.belt_z_m)
        # An outline goes there and back, at best diagonally; most are too short to be looked at twice.
        self._least_places = 2.0 * self._long_px / np.sqrt(2.0)
        smallest_px = limits.pixels_of(settings.smallest_m, limits.belt_z_m)
        self._every = 2 if smallest_px >= 6.0 else 1
        thin = 2 * max(round(0.2 * smallest_px), 1) + 1
        self._thin = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (thin, thin))

    def without_rails(
        self, contours: tuple[Contour, ...], depth: U16, solid: U8
    ) -> tuple[tuple[Contour, ...], tuple[Rail, ...]]:
        """Return the outlines of what is left when rails are taken away, and the rails.

        Args:
            contours: outlines of groups, crop pixels.
            depth: (h, w) readings of the crop.
            solid: (h, w) not 0 where they stand on the belt.
        """
        left: list[Contour] = []
        rails: list[Rail] = []
        for contour in contours:
            group = _Group(contour) if self._is_long(contour) else None
            rail = None if group is None else self._rail(group, depth, solid)
            if group is None or rail is None:
                left.append(contour)
            else:
                rails.append(rail)
                left += group.outlines_without(rail, self._thin)
        return tuple(left) if rails else contours, tuple(rails)

    def _is_long(self, contour: Contour) -> bool:
        return len(contour) >= self._least_places and bool(max(cv2.minAreaRect(contour)[1]) >= self._long_px)

    def _rail(self, group: _Group, depth: U16, solid: U8) -> Rail | None:
        """Return the rail in a group, None where there is none."""
        s = self._every
        left, top, width, height = group.box
        box = (slice(top, top + height, s), slice(left, left + width, s))
        row, column = np.nonzero((group.inside[::s, ::s] > 0) & (solid[box] > 0))
        is_rail, plain = rail_among(
            self._points_m(depth[box][row, column], row * s + top, column * s + left), self._long_m
        )
        told_by = np.stack([column, row], axis=1)[is_rail & plain] * np.float64(s)
        if len(told_by) == 0 or group.evenness(told_by) < EVEN:
            return None
        coarse = np.zeros((-(-height // s), -(-width // s)), dtype=bool)
        coarse[row[is_rail], column[is_rail]] = True
        fine = coarse.repeat(s, axis=0)[:height].repeat(s, axis=1)[:, :width]
        return Rail(group.box, fine & (group.inside > 0))

    def _points_m(self, depth_mm: U16, row: Ints, column: Ints) -> F64:
        """Return pixels of the crop as points (N, 3) in the belt's frame, up to a shift along the belt."""
        z_m = depth_mm * 1e-3
        ray_x, ray_y = self._limits.rays_at(row, column)
        points = np.stack([ray_x * z_m, ray_y * z_m, z_m], axis=1) @ self._limits.turn.T
        points[:, 2] += self._limits.offset_m
        return np.asarray(points)


class _Group:
    """One outline, filled, over its bounding box."""

    def __init__(self, contour: Contour) -> None:
        self.box: Box = cv2.boundingRect(contour)
        left, top, width, height = self.box
        self.inside: U8 = np.zeros((height, width), np.uint8)
        cv2.drawContours(self.inside, [contour], 0, 255, cv2.FILLED, offset=(-left, -top))

    def evenness(self, places_px: F64) -> float:
        """Return how narrow the group gets along pixels (N, 2: u, v) in a line, as a part of its usual width there.

        Of circles in a row a tenth is narrower than half the usual width.
        """
        line = Line.through(places_px)
        there = line.coordinates(places_px)[0]
        own = cv2.findNonZero(self.inside).reshape(-1, 2).astype(np.float32)
        along = (own - line.place.astype(np.float32)) @ line.along.astype(np.float32) - np.float32(there.min())
        widths = np.bincount(along[(along >= 0.0) & (along < np.floor(np.ptp(there)))].astype(np.intp))
        widths.sort()
        return float(widths[len(widths) // 10] / max(widths[len(widths) // 2], 1))

    def outlines_without(self, rail: Rail, thin: U8) -> list[Contour]:
        """Return the outlines of what is left without a rail's pixels and without what is as thin as its rims."""
        rest = cv2.morphologyEx(np.where(rail.pixels, np.uint8(0), self.inside), cv2.MORPH_OPEN, thin)
        return list(cv2.findContours(rest, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE, offset=self.box[:2])[0])
