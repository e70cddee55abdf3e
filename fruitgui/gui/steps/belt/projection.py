"""From the plan of the belt to a view of it and back: from above, or through a sensor's picture. Plain data."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from fruitgui.frame import F64, Intrinsics
from fruitgui.station.belt_setting import PlanMotion, looked_at, seen_at
from fruitgui.station.station import Station

GRID_M = 0.1
MARGIN = 0.10
SHORTEST_ARROW_M, LONGEST_ARROW_M = 0.15, 0.5


class Projection(Protocol):
    """A view of the plan, in pixels of a picture of its own size."""

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the picture."""

    def seen(self, plan_m: F64) -> F64:
        """Return the pixels (N, 2) of points of the plan (N, 2); not a number where they are out of sight."""

    def plan(self, pixels: F64) -> F64:
        """Return the points of the plan (N, 2) of pixels (N, 2); not a number where they show none of it."""


@dataclass(frozen=True, slots=True, eq=False)
class Above:
    """From above: the longer side of the region lies from left to right.

    Attributes:
        size: of the picture. scale: pixels per metre.
        turn: (2, 2) from the plan's axes to the picture's, v up. middle_m: of the plan, in the picture's middle.
    """

    size: tuple[int, int]
    scale: float
    turn: F64
    middle_m: F64

    def seen(self, plan_m: F64) -> F64:
        """Return the pixels of points of the plan."""
        flat = (plan_m - self.middle_m) @ self.turn.T * self.scale
        return np.asarray(np.array(self.size) / 2.0 + flat * [1.0, -1.0])

    def plan(self, pixels: F64) -> F64:
        """Return the points of the plan of pixels."""
        flat = (np.asarray(pixels, np.float64) - np.array(self.size) / 2.0) * [1.0, -1.0] / self.scale
        return np.asarray(flat @ self.turn + self.middle_m)


def above(shown_m: F64, heading_rad: float, width: int, height: int) -> Above:
    """Return the view from above that shows points of the plan (N, 2) as large as it can, a heading to the right."""
    c, s = np.cos(heading_rad), np.sin(heading_rad)
    turn = np.array([[c, s], [-s, c]])
    flat = shown_m @ turn.T
    low, high = flat.min(axis=0), flat.max(axis=0)
    span = np.maximum(high - low, 0.05) * (1.0 + 2.0 * MARGIN)
    scale = float(min(width / span[0], height / span[1]))
    return Above((width, height), scale, turn, (low + high) / 2.0 @ turn)


@dataclass(frozen=True, slots=True, eq=False)
class Through:
    """Through a sensor's picture."""

    station: Station
    sensor: str
    camera: Intrinsics

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the picture."""
        return self.camera.width, self.camera.height

    def seen(self, plan_m: F64) -> F64:
        """Return the pixels of points of the plan."""
        return seen_at(self.station, self.sensor, self.camera, plan_m)

    def plan(self, pixels: F64) -> F64:
        """Return the points of the plan of pixels."""
        return looked_at(self.station, self.sensor, self.camera, pixels)


def plan_points(view: Projection, width: int, height: int) -> F64:
    """Return the points of the plan (height, width, 2) that a view shows, in a picture of another size."""
    u, v = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    scale = np.array([view.size[0] / width, view.size[1] / height])
    return view.plan(np.stack([u, v], -1).reshape(-1, 2) * scale).reshape(height, width, 2)


def motion_arrow(motion: PlanMotion | None, corners_m: F64, view: Projection | None) -> tuple[F64, F64] | None:
    """Return from where to where an arrow on the plan shows a motion; None where it is not known.

    It lies in the middle of the view, or of the region where there is no view, and is as long as the belt moves in two
    seconds, within reason.
    """
    if motion is None:
        return None
    middle = corners_m.mean(axis=0) if view is None else view.plan(np.array([view.size]) / 2.0)[0]
    way = np.array([np.cos(motion.heading_rad), np.sin(motion.heading_rad)])
    length_m = min(max(2.0 * motion.speed_m_s, SHORTEST_ARROW_M), LONGEST_ARROW_M)
    return middle - way * length_m / 2, middle + way * length_m / 2


def grid_lines(corners_m: F64, heading_rad: float) -> list[F64]:
    """Return lines (N, 2) on the plan, ten centimetres apart, along a heading and across it, around a region."""
    c, s = np.cos(heading_rad), np.sin(heading_rad)
    turn = np.array([[c, s], [-s, c]])
    flat = corners_m @ turn.T
    low = np.floor(flat.min(axis=0) / GRID_M) * GRID_M
    high = np.ceil(flat.max(axis=0) / GRID_M) * GRID_M
    steps = np.linspace(0.0, 1.0, 33)[:, None]
    lines = []
    for axis in (0, 1):
        for at in np.arange(low[axis], high[axis] + GRID_M / 2, GRID_M):
            start, end = low.copy(), high.copy()
            start[axis] = end[axis] = at
            lines.append((start + (end - start) * steps) @ turn)
    return lines
