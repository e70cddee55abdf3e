"""A lesson: the line watches, counts nothing, and every fruit that left is kept to be named."""

from __future__ import annotations

import queue
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from fruitgui.errors import InputError
from fruitgui.progress import Cancelled, Progress
from fruitgui.records.store import Store
from fruitgui.records.taught import Sample, TaughtFruit
from fruitgui.records.teaching import Teachable, Teaching
from fruitgui.sensors.feed import Feed
from fruitgui.sensors.player import FlatOut, recorded_sensors
from fruitgui.station.live import FLAT_OUT, LIVE, Counting, Finished, Intake, LineApart, Phase
from fruitgui.station.live.state import LiveWarning
from fruitgui.station.station import Station
from fruitgui.station.waiting import BufferedSink

LOOK_S = 0.2

Doing = Callable[[int, int], str]
"""What to say while a lesson goes on, given the number of frames and of fruit that came in."""


@dataclass(frozen=True, slots=True)
class Lesson:
    """What a lesson came to.

    Attributes:
        source: the recording or the line, for people.
        fruit: that were kept.
        known: that were kept already, from an earlier lesson on the same recording.
        warnings: what a person should know.
    """

    source: str
    fruit: int
    known: int
    warnings: tuple[LiveWarning, ...] = ()


def teachable(finished: Finished, source: str) -> Teachable:
    """Return a fruit that left as one that waits to be named, with its crops."""
    crops = {(crop.sensor, crop.time_s, crop.content): crop.number for crop in finished.crops}
    samples = tuple(
        Sample(
            one.sensor, one.time_s, one.u_px, one.v_px, one.radius_px,
            *(crops.get((one.sensor, one.time_s, content)) for content in ("colour", "depth", "outline")),
        )
        for one in finished.spots
    )  # fmt: skip
    # The time makes it the same fruit whenever the same recording is watched, and another in any other one.
    name = f"{finished.fruit.fruit} at {finished.fruit.first_seen_s:.3f} s"
    fruit = TaughtFruit(source, name, finished.sensors, finished.evidence, finished.fruit.size, samples)
    return fruit, finished.crops


class Gathering:
    """Takes fruit from a line's thread, and keeps them from another, which may wait for the disk.

    Args:
        teaching: keeps them.
        source: where they come from, for people.
    """

    def __init__(self, teaching: Teaching, source: str) -> None:
        self._teaching = teaching
        self._source = source
        self._waiting: queue.SimpleQueue[Finished] = queue.SimpleQueue()
        self.fruit = self.known = 0

    def take(self, finished: Finished) -> None:
        """Take one; never waits, never raises: a `Teacher`."""
        self._waiting.put(finished)

    def keep(self) -> None:
        """Keep all that were taken.

        Raises:
            WorldError: one cannot be kept.
        """
        while not self._waiting.empty():
            try:
                self._teaching.add([teachable(self._waiting.get(), self._source)])
                self.fruit += 1
            except InputError:
                self.known += 1


def watch_line(
    store: Store, feed: Feed, station: Station, source: str, doing: Doing, progress: Progress, cancelled: Cancelled
) -> Lesson:
    """Keep every fruit that leaves a line of running sensors, until a person says that it is enough.

    Raises:
        InputError: the station has none of the sensors.
        WorldError: a fruit cannot be kept; those before it are.
    """
    return _watch(store, feed, station, source, LIVE, doing, progress, cancelled)


def watch_recording(
    store: Store, path: Path, station: Station, doing: Doing, progress: Progress, cancelled: Cancelled
) -> Lesson:
    """Keep every fruit of a recording; one that is watched again, even if the first time was stopped, adds none twice.

    Raises:
        InputError: the recording cannot be used, or the station has none of its sensors.
        WorldError: a fruit cannot be kept; those before it are.
    """
    feed = Feed(recorded_sensors(path, FlatOut()))
    try:
        return _watch(store, feed, station, path.name, FLAT_OUT, doing, progress, cancelled, feed.start)
    finally:
        feed.stop()


def _watch(
    store: Store,
    feed: Feed,
    station: Station,
    source: str,
    intake: Intake,
    doing: Doing,
    progress: Progress,
    cancelled: Cancelled,
    begin: Callable[[], None] = lambda: None,
) -> Lesson:
    gathering = Gathering(store.teaching, source)
    line = LineApart(feed, station, None, Counting(BufferedSink(store), gathering.take), None, intake)
    line.start()
    try:
        begin()
        while not cancelled() and line.state.phase is Phase.RUNNING:
            gathering.keep()
            progress(0.0, doing(line.state.frames, gathering.fruit))
            time.sleep(LOOK_S)
    finally:
        line.stop()
    gathering.keep()
    return Lesson(source, gathering.fruit, gathering.known, line.warnings)
