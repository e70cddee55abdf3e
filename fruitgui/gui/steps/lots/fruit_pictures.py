"""A fruit with its pictures, and its way over the belt as seen from above; no widgets."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F64
from fruitgui.geometry.pose import Pose
from fruitgui.gui.view_pictures import ViewPictures
from fruitgui.records.correcting import Correction
from fruitgui.records.fruit_record import FruitRecord
from fruitgui.station.live.above import spreads_of
from fruitgui.station.live.state import Spread
from fruitgui.station.station import Station
from fruitgui.tracking.track import PathPoint


@dataclass(frozen=True, slots=True, eq=False)
class Way:
    """A fruit's path from above: x along the belt's motion, y to its left, metres.

    Attributes:
        spreads: an ellipse of 95 % for each point, in order of time.
        duration_s: from the first to the last.
    """

    spreads: tuple[Spread, ...]
    duration_s: float

    @property
    def length_m(self) -> float:
        """How far the fruit went from the first to the last point."""
        first, last = self.spreads[0], self.spreads[-1]
        return float(np.hypot(last.x - first.x, last.y - first.y))


def way(path: Sequence[PathPoint], station: Station | None) -> Way | None:
    """Return a path from above; None where there are fewer than two points.

    Args:
        path: reference frame.
        station: that the lot ran on. Without it, the plane is the one in which the path itself lies.
    """
    if len(path) < 2:
        return None
    places_m = np.array([point.position_m for point in path])
    pose = _from_above(places_m, station)
    flat = pose.apply(places_m)[:, :2]
    flat = flat - flat.mean(axis=0)
    R = pose.rotation[:2]
    covariances_m2 = np.array([point.covariance_m2 for point in path])
    return Way(tuple(spreads_of(flat, R @ covariances_m2 @ R.T)), path[-1].time_s - path[0].time_s)


def _from_above(places_m: F64, station: Station | None) -> Pose:
    """Return the pose into a frame seen from above, x along the way."""
    if station is None:
        _, _, axes = np.linalg.svd(places_m - places_m.mean(axis=0))
        belt = Pose(axes if np.linalg.det(axes) > 0 else axes * np.array([[1.0], [1.0], [-1.0]]), np.zeros(3))
    else:
        belt = station.sensors[station.reference].surface.plane.frame()
    along = belt.turn(places_m[-1] - places_m[0])
    angle = np.arctan2(along[1], along[0])
    cosine, sine = np.cos(angle), np.sin(angle)
    turn = np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    return Pose(turn @ belt.rotation, turn @ belt.translation_m)


@dataclass(frozen=True, slots=True, eq=False)
class ShownFruit:
    """One fruit with all that is shown of it."""

    fruit: FruitRecord
    corrections: Sequence[Correction]
    views: Sequence[ViewPictures]
    way: Way | None
