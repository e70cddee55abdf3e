"""What tracking gives: one fruit, followed through all sensors' views until it left."""

from __future__ import annotations

from dataclasses import dataclass

from fruitgui.frame import F64
from fruitgui.perception.view import FruitView


@dataclass(frozen=True, slots=True, eq=False)
class PathPoint:
    """Where a fruit's centre of volume was at one of its views, reference frame.

    Attributes:
        time_s: capture time, reference clock.
        position_m: (3,).
        covariance_m2: (3, 3), pose errors of the rig included.
    """

    time_s: float
    position_m: F64
    covariance_m2: F64


@dataclass(frozen=True, slots=True, eq=False)
class Sighting:
    """One view that belongs to a track, with its time in the reference clock."""

    time_s: float
    view: FruitView


@dataclass(frozen=True, slots=True, eq=False)
class Track:
    """One finished fruit: counted once, however many sensors and captures saw it.

    Attributes:
        track: number, unique within its tracker, from 1.
        sightings: its views in order of time.
        path: the fused position at the times of its views, same order.
        velocity_m_s: (3,) the belt's mean velocity while it was in view.
    """

    track: int
    sightings: tuple[Sighting, ...]
    path: tuple[PathPoint, ...]
    velocity_m_s: F64
