"""A first look at a recording: how the belt runs and whether the sensors' clocks agree."""

from __future__ import annotations

from collections.abc import Collection, Generator, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from fruitgui.geometry.rig import Rig
from fruitgui.perception.view import Observation
from fruitgui.progress import Cancelled, never_cancelled
from fruitgui.station.observing import Seen, Watching
from fruitgui.station.station import Station
from fruitgui.station.timing import Stopwatch
from fruitgui.tracking.belt import BeltMotion
from fruitgui.tracking.clocks import estimate_clock_offsets
from fruitgui.tracking.estimate import estimate_belt

LOOK_S = 15.0
LOOK_FRAMES = 240
"""How much is held back for a first look, from the first fruit on: some fruit have crossed, and memory is small."""

LEAST_OFFSET_S = 0.02
"""A smaller clock offset moves a fruit on a fast belt by less than its centre is known."""


@dataclass(frozen=True, slots=True, eq=False)
class Prelude:
    """What the first look found, and the recording from its beginning.

    Attributes:
        watching: the recording, clocks put right.
        seen: all of its frames, the ones looked at included; to be closed.
        belt: its motion, where a person gave it; None where the tracks are to tell.
        warnings: what a person should know.
    """

    watching: Watching
    seen: Generator[Seen, None, None]
    belt: BeltMotion | None
    warnings: tuple[str, ...]


def look_ahead(
    watching: Watching,
    station: Station,
    belt_speed_m_s: float | None,
    watch: Stopwatch,
    cancelled: Cancelled = never_cancelled,
) -> Prelude:
    """Look at the first frames with fruit; put clocks right where the fruit say how.

    Raises:
        InputError: the recording cannot be used.
    """
    seen = watching.seen(watch, cancelled)
    held = _hold_back(seen)
    observations = [one.observation for one in held]
    motion = belt_of_one_sensor(observations, watching.rig)
    given = [sensor for sensor in watching.rig.mounts if watching.clock_given(sensor)]
    offsets_s = decided_offsets_s(observations, watching.rig, motion, given)
    belt = known_belt(station, belt_speed_m_s, motion)
    if not offsets_s:
        return Prelude(watching, _again(held, seen), belt, ())
    seen.close()
    watching.shift_clocks(offsets_s)
    return Prelude(watching, watching.seen(watch, cancelled, held), belt, tuple(_told(offsets_s)))


def _again(held: list[Seen], seen: Generator[Seen, None, None]) -> Generator[Seen, None, None]:
    """Yield what was held back, then the rest; what was given out is not held any longer."""
    while held:
        yield held.pop(0)
    yield from seen


def _hold_back(seen: Iterator[Seen]) -> list[Seen]:
    held: list[Seen] = []
    first_s: float | None = None
    for one in seen:
        held.append(one)
        if first_s is None and one.observation.views:
            first_s = one.observation.time_s
        if len(held) >= LOOK_FRAMES or (first_s is not None and one.observation.time_s - first_s >= LOOK_S):
            break
    return held


def belt_of_one_sensor(observations: Sequence[Observation], rig: Rig) -> BeltMotion | None:
    """Return the belt's motion by the first sensor that tells it alone: no clock but its own is asked."""
    for sensor in rig.mounts:
        motion = estimate_belt([one for one in observations if one.sensor == sensor], rig)
        if motion is not None:
            return motion
    return None


def decided_offsets_s(
    observations: Sequence[Observation], rig: Rig, motion: BeltMotion | None, given: Collection[str] = ()
) -> dict[str, float]:
    """Return the clock offsets (by station id) that the fruit decide and that matter; none of those `given`."""
    if motion is None or len(rig.mounts) < 2:
        return {}
    estimates = estimate_clock_offsets(observations, rig, motion)
    return {
        sensor: estimate.offset_s
        for sensor, estimate in estimates.items()
        if estimate.decided
        and sensor not in given
        and abs(estimate.offset_s) > max(LEAST_OFFSET_S, 3.0 * estimate.std_s)
    }


def known_belt(station: Station, belt_speed_m_s: float | None, motion: BeltMotion | None) -> BeltMotion | None:
    """Return the belt's motion as far as a person gave it: the direction may come from the fruit."""
    direction = station.velocity_m_s if station.velocity_m_s is not None else None
    if belt_speed_m_s is None:
        return None if direction is None else BeltMotion(direction)
    if direction is None or not np.linalg.norm(direction) > 0:
        direction = None if motion is None else motion.velocity_m_s
    if direction is None or not np.linalg.norm(direction) > 0:
        return None
    return BeltMotion(direction / np.linalg.norm(direction) * belt_speed_m_s)


def _told(offsets_s: Mapping[str, float]) -> Iterator[str]:
    for sensor, offset_s in offsets_s.items():
        yield (
            f"The clock of sensor {sensor} is off by {offset_s:+.3f} s, judged by the fruit that both sensors saw; "
            f"it was put right. Give --clock-offset {sensor}=SECONDS to say it yourself."
        )
