"""Trying the projectors of running sensors: each alone, then every two together."""

from __future__ import annotations

import time
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field, replace
from datetime import datetime
from itertools import combinations

from fruitgui.calibration.projectors.glimpse import Glimpse, glimpse
from fruitgui.calibration.projectors.interference import interference
from fruitgui.calibration.projectors.settling import LEAST_PICTURES, Settled, settling_of, whole_of
from fruitgui.errors import InputError, WorldError
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress, stop_if
from fruitgui.sensors.feed import Arrival, Feed
from fruitgui.sensors.sensor import Sensor
from fruitgui.sensors.turns import Schedule, lights_of
from fruitgui.station.tried import Pair, Tried, worth_keeping

TRIALS = 5
"""Times that each projector is switched on alone and seen from then on."""

MOST_TRIALS = 10
"""Times that it is switched on where a busy computer, or a bad cable, lets pictures at their beginning be missed."""

VIEWS = 36
"""Pictures of each: a second and a fifth, of which a light that takes half a second leaves enough that are steady."""

TOGETHER = 20
"""Pictures of each of two that shine together, once both are steady."""

LONGEST_SILENCE_S = 12.0
"""A sensor of which nothing of use comes for so long, though the others had their turns, is not waited for."""

ROOM = 64
TAKE_S = 0.1
ALONE = 0.6
"""Share of the time that trying each alone takes, as the person is told."""


def try_projectors(
    feed: Feed, when: datetime, progress: Progress = no_progress, cancelled: Cancelled = never_cancelled
) -> Tried:
    """Switch the projectors of a running feed's sensors on and off, and look what that does to a still scene.

    Nobody else hears of these sensors meanwhile; afterwards, however it ends, they take turns as before.

    Args:
        feed: that runs.
        when: it is done, with its zone.
        progress: told which sensors are tried.
        cancelled: asked between any two pictures.

    Raises:
        InputError: there are no two sensors whose projectors disturb others and can be switched.
        WorldError: a sensor gave nothing of use for too long.
        CancelledByUserError: `cancelled` said so.
    """
    lights = lights_of(feed.infos.values())
    if len(lights) < 2:
        raise InputError(
            "no_turns", "No two of these sensors have to take turns.", "There is nothing to measure; go on."
        )
    stage = _Stage(feed, Schedule(lights=lights, views=VIEWS), progress, cancelled)
    trials = stage.alone()
    alone = {sensor: settling_of(trials[sensor]) for sensor in lights}
    told = {sensor: one for sensor, one in alone.items() if isinstance(one, Settled)}
    couples = list(combinations(told, 2))
    pairs = []
    for number, couple in enumerate(couples):
        pictures = stage.together(couple, told, number / len(couples))
        first, second = (interference(told[one].steady, pictures[one]) for one in couple)
        pairs.append(Pair(couple, None if first is None or second is None else (first, second)))
    return Tried(alone, tuple(pairs), worth_keeping(told, pairs, {n: i.serial for n, i in feed.infos.items()}, when))


def lasts_s(feed: Feed) -> float:
    """Return about how long trying the projectors of a feed's sensors takes."""
    lights = lights_of(feed.infos.values())
    turns_s = {sensor: light.turn_s(VIEWS) for sensor, light in lights.items()}
    pairs_s = [
        light.turn_s(TOGETHER) + light.settling.settle_s + (max(turns_s.values()) if len(lights) > 2 else 0.0)
        for light, _ in combinations(lights.values(), 2)
    ]
    return (TRIALS + 1) * sum(turns_s.values()) + sum(pairs_s)


@dataclass(slots=True, eq=False)
class _Trials:
    """The times that one projector was on alone."""

    whole: list[list[Glimpse]] = field(default_factory=list)
    now: list[Glimpse] = field(default_factory=list)
    frames: int = -1

    def take(self, arrival: Arrival) -> None:
        """Take a picture; one that counts fewer than the last begins another time."""
        lit = arrival.lit
        if lit.frames <= self.frames:
            self.end()
        self.frames = lit.frames
        if not lit.others:
            self.now.append(glimpse(arrival.frame.depth_mm, lit.since_s, lit.frames))

    def end(self) -> None:
        """Let a time be over."""
        if len(self.now) >= LEAST_PICTURES:
            self.whole.append(self.now)
        self.now, self.frames = [], -1

    @property
    def done(self) -> float:
        """The share of the times that are needed which there are."""
        return max(len(whole_of(self.whole)) / TRIALS, len(self.whole) / MOST_TRIALS)


@dataclass(frozen=True, slots=True, eq=False)
class _Stage:
    """The sensors while they are tried.

    Attributes:
        feed: that runs.
        usual: whose lights and views every trial has.
        progress, cancelled: see `try_projectors`.
    """

    feed: Feed
    usual: Schedule
    progress: Progress
    cancelled: Cancelled

    def alone(self) -> Mapping[str, Sequence[Sequence[Glimpse]]]:
        """Return the times that each was on alone."""
        trials = {sensor: _Trials() for sensor in self.usual.lights}
        slots = tuple((sensor,) for sensor in trials)
        for arrival in self._heard(slots, trials, lambda one: trials[one].done >= 1.0):
            trials[arrival.frame.sensor].take(arrival)
            done = sum(min(one.done, 1.0) for one in trials.values())
            self.progress(ALONE * done / len(trials), f"{arrival.frame.sensor}")
        return {sensor: one.whole for sensor, one in trials.items()}

    def together(
        self, couple: tuple[str, str], told: Mapping[str, Settled], share: float
    ) -> Mapping[str, Sequence[Glimpse]]:
        """Return pictures of each of two while both lights are steady."""
        rest = tuple(sensor for sensor in self.usual.lights if sensor not in couple)
        slots = (couple, rest) if rest else (couple,)
        pictures: dict[str, list[Glimpse]] = {sensor: [] for sensor in couple}
        steady_s = max(told[sensor].settle_s for sensor in couple)
        since_s: dict[str, float | None] = dict.fromkeys(couple)
        self.progress(ALONE + (1.0 - ALONE) * share, " + ".join(couple))
        for arrival in self._heard(slots, couple, lambda one: len(pictures[one]) >= TOGETHER):
            sensor, lit = arrival.frame.sensor, arrival.lit
            if not set(couple) >= {sensor, *lit.others} or not lit.others:
                since_s[sensor] = None
                continue
            began_s = since_s[sensor]
            since_s[sensor] = began_s = arrival.arrived_s if began_s is None else began_s
            if lit.since_s > steady_s and arrival.arrived_s - began_s > steady_s:
                pictures[sensor].append(glimpse(arrival.frame.depth_mm, lit.since_s, lit.frames))
        return pictures

    def _heard(
        self, slots: tuple[tuple[str, ...], ...], wanted: Collection[str], enough: Callable[[str], bool]
    ) -> Iterator[Arrival]:
        """Yield what sensors give while slots are tried, until there is enough of each that is wanted."""
        schedule = replace(self.usual, slots=slots)
        heard_s = dict.fromkeys(wanted, time.monotonic())
        with self.feed.rehearsal(schedule, ROOM) as queue:
            while not all(map(enough, wanted)):
                stop_if(self.cancelled)
                arrival = queue.take(TAKE_S)
                if arrival is not None and arrival.frame.sensor in wanted:
                    heard_s[arrival.frame.sensor] = arrival.arrived_s
                    yield arrival
                silent = [one for one in wanted if not enough(one) and _is_silent(heard_s[one], schedule.cycle_s)]
                if silent:
                    raise _silence(silent[0])


def _is_silent(heard_s: float, cycle_s: float) -> bool:
    return time.monotonic() - heard_s > LONGEST_SILENCE_S + cycle_s


def _silence(sensor: str) -> WorldError:
    return WorldError(
        "projector_not_seen",
        f"Sensor {sensor} gave no picture in its turns for {LONGEST_SILENCE_S:.0f} s.",
        "Check its cable and power, or leave it out, and measure again.",
        values={"sensor": sensor},
    )


def _hear_all(feed: Feed, cancelled: Cancelled) -> None:
    """Wait until every sensor that is to be tried has given a picture: its first may be late for other reasons."""
    lights = lights_of(feed.infos.values())
    missing, since_s = set(lights), time.monotonic()
    with closing(feed.subscribe(ROOM)) as queue:
        while missing:
            stop_if(cancelled)
            arrival = queue.take(TAKE_S)
            if arrival is not None:
                missing.discard(arrival.frame.sensor)
            if missing and _is_silent(since_s, feed.schedule.cycle_s):
                raise _silence(min(missing))


def try_devices(
    sensors: Sequence[Sensor], schedule: Schedule, when: datetime, progress: Progress, cancelled: Cancelled
) -> Tried:
    """Run sensors that nobody runs, try their projectors, and stop them again.

    Args:
        sensors: closed.
        schedule: by which they take turns before and after.
        when, progress, cancelled: see `try_projectors`, which says what is raised, too.
    """
    feed = Feed(sensors, schedule)
    feed.start()
    try:
        _hear_all(feed, cancelled)
        return try_projectors(feed, when, progress, cancelled)
    finally:
        feed.stop()
