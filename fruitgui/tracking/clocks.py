"""How far the sensors' clocks disagree, judged by the fruit that two of them see.

With known poses, a clock that is wrong by δ shifts everything its sensor sees
by V·δ along the belt. Each sensor's fruit are followed by themselves; the times
at which they pass one line across the belt form a pattern, with places across
the belt, sizes and colours; the offset is where the patterns fit. Evenly spaced
fruit that look alike fit at several offsets: then nothing is decided.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F64, Bools
from fruitgui.geometry.rig import Rig
from fruitgui.perception.view import Observation
from fruitgui.tracking.belt import BeltMotion
from fruitgui.tracking.field import FieldOfView
from fruitgui.tracking.measured import look_distance, measured
from fruitgui.tracking.track import Track
from fruitgui.tracking.tracker import Tracker
from fruitgui.tracking.voting import CommonShift, common_shift

LARGEST_S = 2.0
PLACE_STD_M = 0.010
COMMON_STD_M = 0.003
"""What the poses and the side that is seen shift all fruit of one sensor by."""

SLOWEST_M_S = 0.02
SAME_LANE_M = 0.04
OTHER_SIDE = 0.3
"""How much a difference of looks counts between two sensors: they see opposite sides."""

LEAST_FRUIT = 3
RIVAL_SHARE = 0.65


@dataclass(frozen=True, slots=True)
class OffsetEstimate:
    """How far one sensor's clock is off.

    Attributes:
        offset_s: to be added to the sensor's times.
        std_s: standard deviation of it.
        decided: whether the fruit decide it; offset 0 and std of the whole range where not.
    """

    offset_s: float
    std_s: float
    decided: bool


UNDECIDED = OffsetEstimate(0.0, LARGEST_S, decided=False)


@dataclass(frozen=True, slots=True, eq=False)
class _Passing:
    """When n fruit of one sensor pass the line: time (n,), place across (n,), looks (n, 5)."""

    time_s: F64
    across_m: F64
    looks: F64


def estimate_clock_offsets(
    observations: Sequence[Observation], rig: Rig, belt: BeltMotion
) -> Mapping[str, OffsetEstimate]:
    """Return how far each sensor's clock is off the reference sensor's, within ±2 s, by sensor id.

    Args:
        observations: of some seconds, times as the sensors gave them.
        rig: with known poses.
        belt: the motion; a speed that any one sensor shows will do.
    """
    sensors = list(rig.mounts)
    if belt.speed_m_s < SLOWEST_M_S:
        return {sensor: _reference() if sensor == rig.reference else UNDECIDED for sensor in sensors}
    tracks = {sensor: _followed(observations, sensor, rig, belt) for sensor in sensors}
    return {
        sensor: _reference() if sensor == rig.reference else _offset(tracks[sensor], tracks[rig.reference], rig, belt)
        for sensor in sensors
    }


def _reference() -> OffsetEstimate:
    return OffsetEstimate(0.0, 0.0, decided=True)


def _followed(observations: Sequence[Observation], sensor: str, rig: Rig, belt: BeltMotion) -> list[Track]:
    """Return the fruit of one sensor alone, in its own clock."""
    tracker = Tracker(rig, belt)
    own = sorted((one for one in observations if one.sensor == sensor), key=lambda one: one.time_s)
    finished = [track for observation in own for track in tracker.update(observation)]
    return [track for track in finished + tracker.finish() if len(track.path) >= LEAST_FRUIT]


def _offset(own: list[Track], reference: list[Track], rig: Rig, belt: BeltMotion) -> OffsetEstimate:
    if min(len(own), len(reference)) < LEAST_FRUIT:
        return UNDECIDED
    along = belt.velocity_m_s / belt.speed_m_s
    across = np.cross(rig.belt().normal, along)
    field = FieldOfView.of(rig)
    line_m = 0.5 * (_middle_m(own, along) + _middle_m(reference, along))
    ours, theirs = (_passing(tracks, line_m, along, across, rig, belt, field) for tracks in (own, reference))
    best, rival = _best_two(ours, theirs, PLACE_STD_M / belt.speed_m_s)
    if best is None or len(best.tracks) < LEAST_FRUIT or rival > RIVAL_SHARE * best.votes:
        return UNDECIDED
    if len(best.tracks) < 0.5 * _could_agree(ours, theirs, best):
        return UNDECIDED
    std_s = float(np.hypot(best.std_m, COMMON_STD_M / belt.speed_m_s))
    return OffsetEstimate(float(best.shift_m[0]), std_s, decided=True)


def _middle_m(tracks: Sequence[Track], along: F64) -> float:
    """Return where on the way a sensor's sightings are, on average."""
    return float(np.mean([point.position_m @ along for track in tracks for point in track.path]))


def _passing(
    tracks: Sequence[Track], line_m: float, along: F64, across: F64, rig: Rig, belt: BeltMotion, field: FieldOfView
) -> _Passing:
    times, places, looks = [], [], []
    for track in tracks:
        time_s = np.array([point.time_s for point in track.path])
        way_m = np.array([point.position_m @ along for point in track.path])
        times.append(_crossing_s(time_s, way_m, line_m, belt.speed_m_s))
        places.append(float(np.median([point.position_m @ across for point in track.path])))
        looks.append(_look(track, rig, field))
    return _Passing(np.array(times), np.array(places), np.array(looks))


def _crossing_s(time_s: F64, way_m: F64, line_m: float, speed_m_s: float) -> float:
    """Return when a fruit crosses the line: between its sightings, or as the belt carries it before or after them."""
    if way_m.min() <= line_m <= way_m.max():
        return float(np.interp(line_m, np.maximum.accumulate(way_m), time_s))
    nearest = int(np.argmin(np.abs(way_m - line_m)))
    return float(time_s[nearest] + (line_m - way_m[nearest]) / speed_m_s)


def _look(track: Track, rig: Rig, field: FieldOfView) -> F64:
    views = tuple(sighting.view for sighting in track.sightings)
    seen = measured(Observation(views[0].sensor, 0, track.path[0].time_s, views), rig, field)
    clear = ~seen.cut if (~seen.cut).any() else np.ones(len(seen), dtype=bool)
    return np.asarray(np.median(seen.looks[clear], axis=0))


def _best_two(ours: _Passing, theirs: _Passing, std_s: float) -> tuple[CommonShift | None, float]:
    """Return the shift of our times on which most fruit agree, and the votes of the next best one apart from it."""
    shift = theirs.time_s[None] - ours.time_s[:, None]
    residual = np.stack([shift, np.zeros_like(shift)], axis=2)
    likeness = np.exp(-0.5 * OTHER_SIDE * look_distance(ours.looks, theirs.looks))
    lane = np.abs(ours.across_m[:, None] - theirs.across_m[None]) < SAME_LANE_M
    allowed = lane & (np.abs(shift) <= LARGEST_S + 2.0 * std_s)
    std = np.full(shift.shape, std_s)
    best = common_shift(residual, std, likeness, allowed)
    if best is None:
        return None, 0.0
    other = common_shift(residual, std, likeness, allowed & (np.abs(shift - best.shift_m[0]) > 3.0 * std_s))
    return best, 0.0 if other is None else other.votes


def _could_agree(ours: _Passing, theirs: _Passing, best: CommonShift) -> int:
    """Return how many of the fruit of either sensor passed while the other one's were passing too."""
    moved = ours.time_s + best.shift_m[0]
    first, last = max(moved.min(), theirs.time_s.min()), min(moved.max(), theirs.time_s.max())
    both = [_between(moved, first, last).sum(), _between(theirs.time_s, first, last).sum()]
    return int(min(both))


def _between(time_s: F64, first_s: float, last_s: float) -> Bools:
    return np.asarray((time_s >= first_s - 0.05) & (time_s <= last_s + 0.05))
