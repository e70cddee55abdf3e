"""Watches whether each sensor gives enough pictures for every fruit that passes it to be seen often enough.

Pictures are lost on their way, damaged, left out by a line that has no time, or of no use: why does not matter here,
how many a fruit gets does. A belt twice as fast needs twice as many.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Collection, Iterable, Mapping

import cv2
import numpy as np

from fruitgui.frame import F64
from fruitgui.sensors.turns import VIEWS_NEEDED
from fruitgui.station.live.above import FromAbove
from fruitgui.station.live.blind import Blind, blind_part, sparse_words
from fruitgui.station.turn_plan import WHOLE_FRUIT_M

KNOWN_TO = 1.03
"""Times as long as a fruit takes: the belt's speed is known to a hundredth or two."""

QUIET_S = 10.0
"""A sensor gives enough again once it did for so long: words that come and go with each picture cannot be read, and a
lot is to remember one such time, not its shreds."""


class SparseWatch:
    """Looks at when the line's frames were taken. One thread calls `see`, any `now`.

    Args:
        sensors: the station's ids.
        above: the belt from above, as it is known by now.
        warn: told of what a person should know: code, text, sensors.
    """

    def __init__(
        self, sensors: Iterable[str], above: FromAbove, warn: Callable[[str, str, tuple[str, ...]], None]
    ) -> None:
        self._above = above
        self._warn = warn
        self._taken_s = {name: deque[float](maxlen=VIEWS_NEEDED + 1) for name in sensors}
        self._absences: dict[str, int] = {}
        self._lately_s: dict[str, float] = {}
        self._sparse: tuple[str, ...] = ()
        self._ways_m: tuple[Mapping[str, F64], dict[str, float]] = ({}, {})
        self._found: tuple[object, Blind | None] = (None, None)

    def see(self, name: str, time_s: float, velocity_m_s: F64 | None, absences: Mapping[str, int]) -> None:
        """Note that a frame was followed.

        Args:
            name: of its sensor.
            time_s: when it was taken.
            velocity_m_s: (3,) of the belt; None while it is not known.
            absences: how often each sensor was away so far: what it gave before says nothing of what comes after.
        """
        taken_s = self._taken_s[name]
        if absences.get(name, 0) != self._absences.get(name, 0):
            taken_s.clear()
            self._lately_s.pop(name, None)
        self._absences[name] = absences.get(name, 0)
        taken_s.append(time_s)
        if len(taken_s) > VIEWS_NEEDED and time_s - taken_s[0] > KNOWN_TO * self._passing_s(name, velocity_m_s):
            self._lately_s[name] = time_s
        elif name in self._lately_s and abs(time_s - self._lately_s[name]) > QUIET_S:
            del self._lately_s[name]
        self._tell(tuple(one for one in self._taken_s if one in self._lately_s))

    def now(self, away: Collection[str] = ()) -> Blind | None:
        """Return who gives too few pictures, and what of the belt none of the others sees; None where all give enough.

        Args:
            away: sensors that give none at all: that is another matter.
        """
        sparse, footprints_m = tuple(one for one in self._sparse if one not in away), self._above.footprints_m
        if not sparse:
            return None
        asked = (sparse, tuple(away), id(footprints_m))
        before, found = self._found
        if before != asked:
            there = {name: polygon for name, polygon in footprints_m.items() if name not in away}
            found = blind_part(there, sparse, along=self._above.along)
            self._found = (asked, found)
        return found

    def _tell(self, sparse: tuple[str, ...]) -> None:
        before, self._sparse = self._sparse, sparse
        found = None if set(sparse) <= set(before) else self.now()
        if found is not None:
            self._warn("part_sparse" if found.loses_fruit else "sensor_sparse", sparse_words(found), sparse)

    def _passing_s(self, name: str, velocity_m_s: F64 | None) -> float:
        """Return how long a fruit is whole in a sensor's view, on its way along the belt; for ever where it stands."""
        speed_m_s = 0.0 if velocity_m_s is None else float(np.linalg.norm(velocity_m_s))
        way_m = self._way_m(name) - WHOLE_FRUIT_M
        return way_m / speed_m_s if way_m > 0.0 and speed_m_s > 0.0 else float("inf")

    def _way_m(self, name: str) -> float:
        footprints_m, ways_m = self._ways_m
        if footprints_m is not self._above.footprints_m:
            footprints_m = self._above.footprints_m
            ways_m = {sensor: mean_way_m(polygon) for sensor, polygon in footprints_m.items()}
            self._ways_m = (footprints_m, ways_m)
        return ways_m.get(name, 0.0)


def mean_way_m(footprint_m: F64) -> float:
    """Return how far a fruit goes through a convex polygon (K, 2) along x, the mean of all lanes that it is wide."""
    if len(footprint_m) < 3:
        return 0.0
    width_m = float(np.ptp(footprint_m[:, 1]))
    return float(cv2.contourArea(footprint_m.astype(np.float32))) / width_m if width_m > 0.0 else 0.0
