"""Recording what running sensors give, beside whatever else takes their frames."""

from __future__ import annotations

import contextlib
import math
import shutil
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

from fruitgui.errors import CancelledByUserError, WorldError
from fruitgui.progress import Cancelled, never_cancelled
from fruitgui.sensors.feed import Arrival, DropOldest, Feed, Running, Subscription
from fruitgui.sensors.recordings import SeriesWriter
from fruitgui.sensors.sensor import Sensor
from fruitgui.sensors.turns import Schedule
from fruitgui.station.disk_watch import DiskUsage, DiskWatch
from fruitgui.station.record_state import (
    Ending,
    Recorded,
    RecordPlan,
    RecordState,
    Silence,
    WatchRecording,
    nobody_watches,
)

PACKERS = 2
"""Threads that pack: more than the machine needs, so that one may stand still while the disk does."""

HELD_BYTES = 400_000_000
FRAMES_HELD = (30, 300)
"""Frames that wait while the disk is busy: of each sensor so many, and of all together no more than this memory."""

TAKE_S = 0.1
TELL_EVERY_S = 0.25

FIRST_FRAME_S = 30.0
"""So long after its start a sensor may still be starting; where none gives anything, nothing is recorded."""


def record_feed(
    feed: Feed,
    plan: RecordPlan,
    watch: WatchRecording = nobody_watches,
    cancelled: Cancelled = never_cancelled,
    usage: DiskUsage = shutil.disk_usage,
) -> Recorded:
    """Record until the time is up, a person stops it, no sensor gives anything any more, or the disk is nearly full.

    Depth is written as the devices read it. Whatever ends the recording, what was recorded so far is whole and kept.
    The feed may serve others meanwhile; nothing waits for the recording but its own queue.

    Args:
        feed: of running sensors.
        plan: what to record.
        watch: is told several times a second how far it is, on this thread.
        cancelled: being cancelled is how a recording without a length is ended.
        usage: asks the disk.

    Raises:
        CancelledByUserError: before the first frame; there is no file.
        WorldError: no frame came, or the file cannot be written; what could be written lies beside, sound.
    """
    with _set_up(feed, plan, usage) as recording:
        return recording.go(watch, cancelled)


def record_sensors(
    sensors: Sequence[Sensor],
    schedule: Schedule | None,
    plan: RecordPlan,
    watch: WatchRecording = nobody_watches,
    cancelled: Cancelled = never_cancelled,
    usage: DiskUsage = shutil.disk_usage,
) -> Recorded:
    """Start sensors, record them from their first frames on as `record_feed` does, and stop them.

    Args:
        sensors: closed.
        schedule: how their projectors take turns, see `Feed`.
        plan, watch, cancelled, usage: as for `record_feed`.

    Raises:
        CancelledByUserError, WorldError: as `record_feed`.
    """
    feed = Feed(sensors, schedule)
    with _set_up(feed, plan, usage) as recording:
        feed.start()
        try:
            done = recording.go(watch, cancelled)
        finally:
            hung = feed.stop()
    return replace(done, notes=tuple(f"The driver of {sensor} hangs and was left behind." for sensor in hung))


@contextlib.contextmanager
def _set_up(feed: Feed, plan: RecordPlan, usage: DiskUsage) -> Iterator[_Recording]:
    """Give a recording that hears everything the feed gives from now on."""
    disk = DiskWatch(plan.out.resolve().parent, plan.reserve_bytes, usage)
    disk.check(time.monotonic())
    with (
        contextlib.closing(feed.subscribe(DropOldest(_frames_held(feed)))) as queue,
        ThreadPoolExecutor(PACKERS, thread_name_prefix="packing") as hands,
    ):
        writer = SeriesWriter(plan.out, tuple(feed.infos.values()), plan.split, hands)
        yield _Recording(feed, plan, queue, writer, disk)


def _frames_held(feed: Feed) -> int:
    cameras = [info.intrinsics for info in feed.infos.values()]
    all_bytes = sum(5 * camera.width * camera.height for camera in cameras)
    least, most = FRAMES_HELD
    return min(max(HELD_BYTES // max(all_bytes, 1), least), most)


class _Recording:
    """One recording while it is being made."""

    def __init__(
        self, feed: Feed, plan: RecordPlan, queue: Subscription, writer: SeriesWriter, disk: DiskWatch
    ) -> None:
        self._feed = feed
        self._plan = plan
        self._queue = queue
        self._writer = writer
        self._disk = disk
        self._frames: Counter[str] = Counter(dict.fromkeys(feed.sensors, 0))
        self._missed_before = self._missed()
        self._asked_s = time.monotonic()
        self._wall_ns = time.time_ns() - time.monotonic_ns()
        self._first_s: float | None = None
        self._last_s = 0.0
        self._told_s = -math.inf
        self._refused = False
        self._silent_s: dict[str, float] = {}
        self._silences: list[Silence] = []

    def go(self, watch: WatchRecording, cancelled: Cancelled) -> Recorded:
        """Record to the end."""
        try:
            ended = self._take_all(watch, cancelled)
            self._queue.close()
            ended = self._drain(ended)
        finally:  # whatever happened: what is stored becomes whole
            self._writer.finish()
        if self._first_s is None:
            raise self._nothing(ended)
        return self._recorded(ended)

    def _take_all(self, watch: WatchRecording, cancelled: Cancelled) -> Ending:
        while not cancelled():
            now_s = time.monotonic()
            if self._disk.room_bytes(now_s) <= 0:
                return Ending.DISK_FULL
            if self._first_s is None and now_s - self._asked_s > FIRST_FRAME_S:
                return Ending.SENSORS_ENDED
            self._tell(watch, now_s)
            arrival = self._queue.take(TAKE_S)
            if arrival is None and self._queue.over:
                return Ending.SENSORS_ENDED
            if self._is_late(arrival):
                return Ending.DONE
            if not self._store(arrival):
                return Ending.DISK_FULL
        return Ending.STOPPED

    def _is_late(self, arrival: Arrival | None) -> bool:
        """Tell whether the time is up; with an empty queue, now."""
        if self._plan.seconds is None or self._first_s is None:
            return False
        came_s = time.monotonic() if arrival is None else arrival.arrived_s
        return came_s - self._first_s >= self._plan.seconds

    def _store(self, arrival: Arrival | None) -> bool:
        """Store a frame, or what waits meanwhile; false where the disk has no room for it."""
        try:
            if arrival is None:
                self._writer.flush()
            else:
                if self._first_s is None:
                    self._first_s = arrival.arrived_s
                    self._writer.identify(tuple(self._feed.infos.values()))
                self._last_s = arrival.arrived_s
                self._writer.write(arrival.frame, round(arrival.arrived_s * 1e9) + self._wall_ns)
                self._frames[arrival.frame.sensor] += 1
        except WorldError as error:
            if error.code != "disk_full":
                raise
            self._refused = True
        return not self._refused

    def _drain(self, ended: Ending) -> Ending:
        """Store what came in time and still waits; it is little, and the disk's reserve has room for it."""
        while not self._refused and (arrival := self._queue.take(0.0)) is not None and not self._is_late(arrival):
            self._store(arrival)
        if self._refused:
            return Ending.DISK_FULL
        try:
            self._writer.close()
        except WorldError as error:
            if error.code != "disk_full":
                raise
            return Ending.DISK_FULL
        return ended

    def _tell(self, watch: WatchRecording, now_s: float) -> None:
        if now_s - self._told_s < TELL_EVERY_S:
            return
        self._told_s = now_s
        self._listen(now_s)
        seconds = 0.0 if self._first_s is None else now_s - self._first_s
        written, room = self._writer.bytes_written, self._disk.room_bytes(now_s)
        watch(
            RecordState(
                seconds=seconds,
                share=0.0 if self._plan.seconds is None else min(seconds / self._plan.seconds, 1.0),
                frames=dict(self._frames),
                lost=self._queue.dropped,
                silent=tuple(self._silent_s),
                bytes_written=written,
                parts=len(self._writer.parts),
                room_bytes=room,
                room_s=room * seconds / written if written and seconds > 2.0 else None,
            )
        )

    def _listen(self, now_s: float) -> None:
        """Note who fell silent, and who is back."""
        zero_s = self._asked_s if self._first_s is None else self._first_s
        for sensor in self._feed.sensors:
            silent = self._is_silent(sensor, now_s)
            if silent and sensor not in self._silent_s:
                age_s = self._feed.health(sensor).age_s
                self._silent_s[sensor] = max(now_s - (age_s or 0.0) - zero_s, 0.0)
            elif not silent and sensor in self._silent_s:
                self._silences.append(Silence(sensor, self._silent_s.pop(sensor), now_s - zero_s))

    def _is_silent(self, sensor: str, now_s: float) -> bool:
        state = self._feed.health(sensor).state
        late = now_s - self._asked_s > FIRST_FRAME_S / 3.0 and not self._frames[sensor]
        return state in (Running.SILENT, Running.FAILED) or (state is Running.STARTING and late)

    def _missed(self) -> dict[str, int]:
        """Return how many frames of each sensor did not come whole since the feed was started."""
        health = [self._feed.health(sensor) for sensor in self._feed.sensors]
        return {one.sensor: one.drops + one.damaged for one in health}

    def _nothing(self, ended: Ending) -> Exception:
        if ended is Ending.STOPPED:
            return CancelledByUserError()
        if ended is Ending.DISK_FULL:
            return WorldError(
                "disk_full", f"The disk of {self._plan.out} is full.", "Make room, or record to another disk.",
                file=self._plan.out,
            )  # fmt: skip
        health = [self._feed.health(sensor) for sensor in self._feed.sensors]
        error = next((one.error for one in health if one.error is not None), None)
        why = "" if error is None else f" {error.what}"
        remedy = "Check that the sensors run." if error is None else error.remedy
        return WorldError("no_frames", f"No sensor gave a frame; nothing was recorded.{why}", remedy)

    def _recorded(self, ended: Ending) -> Recorded:
        stored = self._writer.frames_stored
        lost = {
            sensor: self._queue.dropped.get(sensor, 0) + taken - stored[sensor]
            for sensor, taken in self._frames.items()
        }
        open_silences = [Silence(sensor, from_s) for sensor, from_s in self._silent_s.items()]
        return Recorded(
            parts=self._writer.kept,
            frames={sensor: stored[sensor] for sensor in self._feed.sensors},
            seconds=self._last_s - (self._first_s or 0.0),
            ended=ended,
            lost=lost,
            missed={sensor: count - self._missed_before[sensor] for sensor, count in self._missed().items()},
            silences=(*self._silences, *open_silences),
            bytes_written=self._writer.bytes_written,
        )
