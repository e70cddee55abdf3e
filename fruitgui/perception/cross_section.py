"""Which points on the belt are a rail's: those of one cross-section that goes on for longer than any fruit.

A rail has the same cross-section all along. Points are seen in the belt's frame along their own direction, cut into
short stretches, and each stretch into cells across and upwards. Cells that most stretches meet are common; stretches
that meet most of these are plain. Where plain stretches follow each other for long enough, the cells that they meet
are the rail's. What touches a rail, leans on it or hides it lies in other cells.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.frame import F64, Bools, Ints

STRETCH_M = 0.02
"""Length of a stretch: at 1.2 m several readings fall into each of its cells."""

CELL_M = 0.008
"""Edge of a cell: four standard deviations of depth noise at the usual 1.2 m."""

COMMON = 0.35
"""Share of all stretches that meet a common cell: things may hide the rail in many."""

PLAIN = 0.6
"""Share of the common cells that a stretch meets where little stands before it."""

SURE = 0.5
"""Share of plain stretches that meet a cell of the rail: noise and holes empty some."""

LEAST = 50
"""Of fewer points nothing is told."""

LOOKED_AT = 300
"""Points that a direction is found from."""

TURNS_RAD = (np.radians(np.arange(-8.0, 8.1, 0.8)), np.radians(np.arange(-0.6, 0.7, 0.15)))
"""How far the points' principal axis may be from the rail's direction, and how exactly that is found."""


@dataclass(frozen=True, slots=True, eq=False)
class Line:
    """A place (2,) in a plane, and a unit vector (2,) along a line through it."""

    place: F64
    along: F64

    @classmethod
    def through(cls, points: F64) -> Line:
        """Return the principal axis of points (N, 2)."""
        place = points.mean(axis=0)
        apart = points - place
        return cls(place, np.linalg.eigh(apart.T @ apart)[1][:, 1])

    def coordinates(self, points: F64) -> tuple[F64, F64]:
        """Return how far along the line and across it points (N, 2) lie, (N,) each."""
        apart = points - self.place
        return apart @ self.along, apart[:, 1] * self.along[0] - apart[:, 0] * self.along[1]

    def straightened(self, points_m: F64) -> Line:
        """Return the line turned to where points (N, 2) crowd into the fewest lanes.

        What lies beside a rail turns the principal axis, but not this.
        """
        line, looked_at = self, points_m[:: len(points_m) // LOOKED_AT + 1]
        for turns_rad in TURNS_RAD:
            along, across = line.coordinates(looked_at)
            cosine, sine = np.cos(turns_rad), np.sin(turns_rad)
            best = int(np.argmax(_crowding(np.outer(cosine, across) - np.outer(sine, along))))
            turn = np.array([[cosine[best], -sine[best]], [sine[best], cosine[best]]])
            line = Line(self.place, turn @ line.along)
        return line


def rail_among(points_m: F64, long_m: float) -> tuple[Bools, Bools]:
    """Tell which points are a rail's, (N,), and which lie along its plain stretches, (N,).

    Args:
        points_m: (N, 3) in the belt's frame.
        long_m: no fruit, nor two in a line, are so long. Without plain stretches for so long there is no rail.
    """
    none = np.zeros(len(points_m), dtype=bool)
    if len(points_m) < LEAST:
        return none, none
    flat = points_m[:, :2]
    along, across = Line.through(flat).straightened(flat).coordinates(flat)
    stretch, lane, level = _bins(along, STRETCH_M), _bins(across, CELL_M), _bins(points_m[:, 2], CELL_M)
    lanes, levels = int(lane.max()) + 1, int(level.max()) + 1
    met = np.zeros((int(stretch.max()) + 1, lanes * levels), dtype=bool)
    met[stretch, lane * levels + level] = True
    first, last = _longest(_plain(met))
    if (last - first) * STRETCH_M < long_m:
        return none, none
    sure = met[first:last].mean(axis=0) >= SURE
    # Noise carries points over into the cells above and below.
    section = cv2.dilate(sure.reshape(lanes, levels).astype(np.uint8), np.ones((1, 3), np.uint8))
    return section[lane, level] > 0, (stretch >= first) & (stretch < last)


def _bins(values: F64, width: float) -> Ints:
    bins = np.floor(values / width).astype(np.intp)
    return np.asarray(bins - bins.min())


def _crowding(across_m: F64) -> F64:
    """Return how much places across (K, N) crowd into few lanes, for each of K ways to look, (K,)."""
    lane = _bins(across_m, CELL_M)
    ways, lanes = len(lane), int(lane.max()) + 1
    counts = np.bincount((lane + lanes * np.arange(ways)[:, None]).ravel(), minlength=ways * lanes)
    return np.asarray((counts.reshape(ways, lanes).astype(np.float64) ** 2).sum(axis=1))


def _plain(met: Bools) -> Bools:
    """Tell which stretches (S,) are plain, given which cells each meets, (S, C); one bad one between two is none."""
    common = met.mean(axis=0) >= COMMON
    if not common.any():
        return np.zeros(len(met), dtype=bool)
    plain = met[:, common].mean(axis=1) >= PLAIN
    plain[1:-1] |= plain[:-2] & plain[2:]
    return np.asarray(plain)


def _longest(plain: Bools) -> tuple[int, int]:
    """Return where the longest run of what is true begins and ends."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], plain, [False]])))
    begins, ends = edges[::2], edges[1::2]
    if len(begins) == 0:
        return 0, 0
    longest = int(np.argmax(ends - begins))
    return int(begins[longest]), int(ends[longest])
