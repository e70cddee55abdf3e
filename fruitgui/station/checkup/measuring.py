"""How well sensors run: all of them together for some seconds, as they would on the line."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

from fruitgui.errors import FruitguiError
from fruitgui.progress import Cancelled, Progress, stop_if
from fruitgui.sensors.feed import LOST_SHARE, Feed, Running, SensorHealth
from fruitgui.sensors.sensor import Sensor
from fruitgui.sensors.turns import Schedule
from fruitgui.station.checkup.records import Measured, SensorState

START_S = 10.0
"""How long sensors may take to give their first pictures."""

FIRST_FRAMES = 8
"""Pictures that are not counted: with the first one tables are made, and some are lost meanwhile."""

LOOK_S = 0.05

HELD_S = 0.032
"""So long the USB keeps pictures for who does not come to take them: libfreenect has 16 transfers of 16 packets of
1/8 ms on their way. Whoever looks later than that would have lost some."""

ALL_SHINE = Schedule()
"""Nobody takes turns: what counts is what the USB carries, not what the projectors spoil for each other."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """How a sensor did.

    Attributes:
        state: running, silent, failed or hangs.
        measured: None where no picture came.
        error: why it failed.
    """

    state: SensorState
    measured: Measured | None = None
    error: FruitguiError | None = None


class Watching(Protocol):
    """How sensors are run and watched."""

    def __call__(
        self, sensors: Sequence[Sensor], seconds: float, progress: Progress, cancelled: Cancelled
    ) -> Mapping[str, Outcome]:
        """Return how each did, by id."""


def measure(
    sensors: Sequence[Sensor], seconds: float, progress: Progress, cancelled: Cancelled
) -> Mapping[str, Outcome]:
    """Run sensors together and watch them for so many seconds; return how each did, by id.

    They are stopped within two seconds whatever happens; one whose driver hangs is left behind.

    Raises:
        CancelledByUserError: it was cancelled; the sensors are stopped.
    """
    if not sensors:
        return {}
    feed = Feed(sensors, ALL_SHINE)
    hung: tuple[str, ...] = ()
    try:
        feed.start()
        _wait_for_first(feed, progress, cancelled)
        outcomes = watch(feed, seconds, progress, cancelled)
    finally:
        hung = feed.stop()
    return {name: Outcome(SensorState.HANGS) if name in hung else one for name, one in outcomes.items()}


@dataclass(frozen=True, slots=True, eq=False)
class MeasuringBeside:
    """Watches sensors that run already where they run, and runs only the others.

    Attributes:
        feed: of sensors that run, known by their serials.
        others: what is done with those that do not run; None leaves them idle, as while a lot runs.
    """

    feed: Feed
    others: Watching | None

    def __call__(
        self, sensors: Sequence[Sensor], seconds: float, progress: Progress, cancelled: Cancelled
    ) -> Mapping[str, Outcome]:
        """Return how each did, by id. Raises `CancelledByUserError` where it was cancelled."""
        running = {info.serial: name for name, info in self.feed.infos.items() if info.serial}
        idle = [one for one in sensors if one.info.serial not in running]
        outcomes = dict(self.others(idle, seconds, progress, cancelled)) if idle and self.others else {}
        watched = {one.info.sensor: running[one.info.serial] for one in sensors if one.info.serial in running}
        if watched:
            seen = watch(self.feed, seconds, progress, cancelled)
            outcomes |= {name: seen[as_named] for name, as_named in watched.items()}
        return outcomes


def watch(feed: Feed, seconds: float, progress: Progress, cancelled: Cancelled) -> dict[str, Outcome]:
    """Watch sensors that run for so many seconds; return how each did, by id.

    Raises:
        CancelledByUserError: it was cancelled.
    """
    began_s = time.monotonic()
    before = {name: feed.health(name) for name in feed.sensors}
    late_s: list[float] = []
    while (passed_s := time.monotonic() - began_s) < seconds:
        stop_if(cancelled)
        progress(0.3 + 0.7 * passed_s / seconds, "Watching the sensors run")
        slept_s = time.monotonic()
        time.sleep(LOOK_S)
        late_s.append(time.monotonic() - slept_s - LOOK_S)
    passed_s, worst_s = time.monotonic() - began_s, _worst(late_s)
    return {name: _outcome(before[name], feed.health(name), passed_s, worst_s) for name in feed.sensors}


def _worst(late_s: Sequence[float]) -> float:
    """Return how late a wait ended at worst, where that would have lost as many pictures as are a problem; else 0."""
    too_late = [one for one in late_s if one > HELD_S]
    return max(too_late) if len(too_late) > LOST_SHARE * len(late_s) else 0.0


def _wait_for_first(feed: Feed, progress: Progress, cancelled: Cancelled) -> None:
    """Wait until every sensor has given its first pictures or failed, not for ever."""
    began_s = time.monotonic()
    while (passed_s := time.monotonic() - began_s) < START_S:
        stop_if(cancelled)
        health = [feed.health(name) for name in feed.sensors]
        if all(
            one.frames + one.damaged >= FIRST_FRAMES or one.state in (Running.FAILED, Running.ENDED) for one in health
        ):
            return
        progress(0.1 + 0.2 * passed_s / START_S, "Starting the sensors")
        time.sleep(LOOK_S)


def _outcome(before: SensorHealth, after: SensorHealth, seconds: float, late_s: float) -> Outcome:
    frames = after.frames - before.frames
    lost = after.drops - before.drops + after.damaged - before.damaged
    measured = Measured(frames / seconds, after.nominal_hz, frames, lost, late_s) if frames or lost else None
    if after.hangs:
        return Outcome(SensorState.HANGS, measured)
    if after.state is Running.FAILED or (after.error is not None and not after.frames):
        return Outcome(SensorState.FAILED, measured, after.error)
    if not frames or after.state is Running.SILENT:
        return Outcome(SensorState.SILENT, measured, after.error)
    return Outcome(SensorState.RUNNING, measured)
