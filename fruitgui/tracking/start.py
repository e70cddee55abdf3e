"""Before the belt's motion is known: observations are held back until the fruit show it."""

from __future__ import annotations

import numpy as np

from fruitgui.geometry.rig import Rig
from fruitgui.tracking.belt import BeltMotion
from fruitgui.tracking.estimate import STANDING_M_S, estimate_from
from fruitgui.tracking.measured import Measured

TRY_EVERY_S = 0.25
MOST_HELD_VIEWS = 1500
"""Bounds the memory while nothing is decided: views carry their points."""

UNKNOWN_SPEED_M_S = 0.5


class Start:
    """Holds observations until the belt's first motion is known."""

    def __init__(self, rig: Rig, given: BeltMotion | None, longest_s: float) -> None:
        self._rig = rig
        self._given = given
        self._longest_s = longest_s
        self._held: list[Measured] = []
        self._tried_s = -np.inf

    def hold(self, seen: Measured) -> None:
        """Take one observation; empty ones before the first fruit are not kept."""
        if self._given is not None or len(seen) or self._held:
            self._held.append(seen)

    def release(self) -> list[Measured]:
        """Return what was held, and hold nothing."""
        held, self._held = self._held, []
        return held

    def motion(self) -> BeltMotion | None:
        """Return the motion given or shown by now; after the longest time the likeliest one."""
        if self._given is not None:
            return self._given
        if not self._held or self._held[-1].time_s - self._tried_s < TRY_EVERY_S:
            return None
        self._tried_s = self._held[-1].time_s
        motion = _running(estimate_from(self._shown(), self._rig))
        waited = self._held[-1].time_s - self._held[0].time_s > self._longest_s
        full = sum(len(seen) for seen in self._held) > MOST_HELD_VIEWS
        return self.last_motion() if motion is None and (waited or full) else motion

    def last_motion(self) -> BeltMotion | None:
        """Return the likeliest motion, however unsure; None only if nothing was held."""
        if not self._held:
            return None
        motion = estimate_from(self._shown(), self._rig, clearly=1.0)
        return motion or BeltMotion(np.zeros(3), np.diag([UNKNOWN_SPEED_M_S**2] * 3))

    def _shown(self) -> list[Measured]:
        return [seen for seen in self._held if len(seen)]


def _running(motion: BeltMotion | None) -> BeltMotion | None:
    return motion if motion is not None and motion.speed_m_s > STANDING_M_S else None
