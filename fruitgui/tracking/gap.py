"""What the belt did while nobody looked: after a gap, what should be seen and is not counts as much as what agrees.

A vote alone misleads there. Where the belt carried all fruit of before out of sight, nothing agrees on the truth, and
one new fruit that happens to lie in an old one's lane agrees on a belt that stood.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F64, Bools
from fruitgui.tracking.field import FieldOfView, SensorField

GAP_S = 0.8
"""Without a capture for so long, a belt that may gain or lose speed may have put a fruit where its neighbour was."""

ON_VOTES, STOOD_VOTES = 1.5, 1.0
"""Belts mostly go on as they did: one fruit that looks like an old one and lies in its lane does not say otherwise, two
do. One that lies exactly where it lay does, too: sensors and belt lose their power together."""

ON_SHARE, PLACE_STD_M = 0.05, 0.01
"""A belt that goes on keeps its speed to this share; where it carries a fruit is known to so much besides."""

INSIDE_M = 0.05
"""So far inside of a sensor's field a fruit is seen whole."""

SAME_STD = 3.0
"""A view so many standard deviations from where a fruit should be is that fruit."""


@dataclass(frozen=True, slots=True, eq=False)
class Gap:
    """The first capture after a gap beside what was known before it. Shifts are mispredicted displacements on the belt.

    Attributes:
        field: of all sensors. sensor: whose capture it is.
        back: (3, 2), turns a displacement on the belt into the reference frame's.
        way_m: (2,) that the belt was predicted to go since it was last measured.
        tracks_m: (n, 3) predicted places of fruit. views_m: (m, 3) of what is seen now; reference frame.
        residual_m: (n, m, 2) view minus track on the belt. std_m: (n, m) of it for one and the same fruit, per axis.
        alike: (n, m) pairs that look like one fruit.
    """

    field: FieldOfView
    sensor: str
    back: F64
    way_m: F64
    tracks_m: F64
    views_m: F64
    residual_m: F64
    std_m: F64
    alike: Bools

    def prior(self, shifts_m: F64) -> F64:
        """Return the votes (k,) for shifts (k, 2) that no agreement of fruit gives: may be negative."""
        far = np.hypot(*self.way_m)
        on_std_m = ON_SHARE * far + PLACE_STD_M
        on = ON_VOTES * _bell(np.hypot(*shifts_m.T) / on_std_m)
        stood = STOOD_VOTES * _bell(np.hypot(*(shifts_m + self.way_m).T) / PLACE_STD_M)
        return np.asarray(np.maximum(on, stood) - self._unaccounted(shifts_m))

    def _unaccounted(self, shifts_m: F64) -> F64:
        """Return how many fruit should be seen and are not, or are seen and should have been before, (k,)."""
        apart = np.linalg.norm(self.residual_m[None] - shifts_m[:, None, None], axis=3)
        same = (apart < SAME_STD * self.std_m) & self.alike
        shift = (shifts_m @ self.back.T)[:, None]
        due = _inside(self.field.sensors[self.sensor], self.tracks_m + shift)
        before = _inside(self.field, self.views_m - self.back @ self.way_m - shift)
        gone, new = due & ~same.any(axis=2), before & ~same.any(axis=1)
        return np.asarray(gone.sum(axis=1) + new.sum(axis=1), dtype=np.float64)


def _inside(field: FieldOfView | SensorField, places_m: F64) -> Bools:
    """Tell which places (k, n, 3) lie well inside, (k, n)."""
    return np.asarray(field.depth_m(places_m.reshape(-1, 3)).reshape(places_m.shape[:2]) > INSIDE_M)


def _bell(deviations: F64) -> F64:
    return np.asarray(np.exp(-0.5 * deviations**2))
