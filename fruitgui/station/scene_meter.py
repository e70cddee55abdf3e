"""What is on the belt before calibrating: enough for the sensors to find each other, or what to add.

Cheap, and no promise: who overlaps with whom is only known once calibrating has found it. What can be told before is
whether each sensor sees a belt and how many things on it, whether they differ, and how many of one sensor's things
look like one of another's.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from itertools import combinations

import numpy as np

from fruitgui.calibration.still import average
from fruitgui.calibration.surface import fit_belt
from fruitgui.frame import F64, Frame
from fruitgui.perception.perceiver import Perceiver
from fruitgui.perception.view import FruitView

ENOUGH_THINGS, FEW_THINGS = 10, 5
"""Things that calibrating asks for, and below which it hardly ever succeeds."""

TALLEST_APART_M, SIZE_APART, COLOUR_APART = 0.010, 0.25, 25.0
"""Two views are alike within so much height, so much of their size, and so much of each colour."""

VARIED = 3
"""So many sorts of things at least make a pattern that fits in one way only."""


class Verdict(StrEnum):
    """What is to be said of a sensor or of a pair, the worst first."""

    NO_BELT = "no_belt"
    FEW_THINGS = "few_things"
    NOTHING_ALIKE = "nothing_alike"
    ALL_ALIKE = "all_alike"
    MORE_WOULD_HELP = "more_would_help"
    ENOUGH = "enough"


@dataclass(frozen=True, slots=True)
class SensorView:
    """What one sensor sees on the belt.

    Attributes:
        verdict: on it.
        things: standing on the belt.
        sorts: of things that differ in height, size or colour.
        area_share: of the picture, covered by things.
    """

    verdict: Verdict
    things: int = 0
    sorts: int = 0
    area_share: float = 0.0


@dataclass(frozen=True, slots=True)
class PairView:
    """What two sensors may have in common.

    Attributes:
        sensors: the two.
        verdict: on them.
        alike: things of one that look like a thing of the other, each used once: the most that can be common.
    """

    sensors: tuple[str, str]
    verdict: Verdict
    alike: int


@dataclass(frozen=True, slots=True)
class SceneView:
    """What all sensors see."""

    sensors: Mapping[str, SensorView]
    pairs: tuple[PairView, ...]


def look_at_scene(frames: Mapping[str, Sequence[Frame]]) -> SceneView:
    """Return what is to be said of a scene, given a few frames of each sensor (three are enough)."""
    seen = {sensor: _views(few) for sensor, few in frames.items()}
    looks = {sensor: _looks(views or ()) for sensor, views in seen.items()}
    sensors = {sensor: _sensor_view(views, looks[sensor], frames[sensor][0]) for sensor, views in seen.items()}
    pairs = tuple(_pair_view(pair, sensors, looks) for pair in combinations(frames, 2))
    return SceneView(sensors, pairs)


def _views(frames: Sequence[Frame]) -> tuple[FruitView, ...] | None:
    """Return what stands on the belt in the last frame; None where there is no belt."""
    belt = fit_belt(average(frames))
    if belt is None:
        return None
    last = frames[-1]
    perceiver = Perceiver(last.sensor, last.intrinsics, belt.surface)
    return perceiver.observe(last, last.time_s).views


def _looks(views: Sequence[FruitView]) -> F64:
    """Return height, log size and colour of each view in units of what makes two of them alike, (n, 5)."""
    rows = []
    for view in views:
        size_m = np.sqrt(view.area_px) * view.centre_m[2]
        middle = view.patch[14:26, 14:26].reshape(-1, 3).mean(axis=0)
        rows.append([view.height_m / TALLEST_APART_M, np.log(size_m) / SIZE_APART, *(middle / COLOUR_APART)])
    return np.array(rows, dtype=np.float64).reshape(-1, 5)


def _apart(first: F64, second: F64) -> F64:
    """Return the largest difference of two lists of looks, in units of what makes them alike, (n, m)."""
    return np.asarray(np.abs(first[:, None] - second[None]).max(axis=2))


def _sensor_view(views: tuple[FruitView, ...] | None, looks: F64, frame: Frame) -> SensorView:
    if views is None:
        return SensorView(Verdict.NO_BELT)
    sorts = 0
    left = np.ones(len(looks), dtype=bool)
    while left.any():
        sorts += 1
        left &= _apart(looks[np.flatnonzero(left)[:1]], looks)[0] >= 1.0
    share = sum(view.area_px for view in views) / frame.depth_mm.size
    return SensorView(_verdict(len(views), sorts), len(views), sorts, share)


def _verdict(things: int, sorts: int) -> Verdict:
    if things < FEW_THINGS:
        return Verdict.FEW_THINGS
    if sorts < VARIED:
        return Verdict.ALL_ALIKE
    return Verdict.ENOUGH if things >= ENOUGH_THINGS else Verdict.MORE_WOULD_HELP


def _pair_view(pair: tuple[str, str], sensors: Mapping[str, SensorView], looks: Mapping[str, F64]) -> PairView:
    from scipy.optimize import linear_sum_assignment

    apart = _apart(looks[pair[0]], looks[pair[1]])
    rows, columns = linear_sum_assignment(np.minimum(apart, 2.0))
    alike = int((apart[rows, columns] < 1.0).sum())
    worst = min((sensors[one].verdict for one in pair), key=list(Verdict).index)
    if list(Verdict).index(worst) > list(Verdict).index(Verdict.FEW_THINGS) and alike < FEW_THINGS:
        worst = Verdict.NOTHING_ALIKE
    return PairView(pair, worst, alike)
