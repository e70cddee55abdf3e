"""A recording seen through a station: frames in, observations out, with how long it took."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Generator, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from fruitgui.frame import Frame
from fruitgui.geometry.rig import Rig
from fruitgui.perception.view import Observation
from fruitgui.progress import Cancelled, never_cancelled, stop_if
from fruitgui.station.crew import Crew, Task
from fruitgui.station.lineup import line_up
from fruitgui.station.rig_watch import RigWatch
from fruitgui.station.source import RecordingSource
from fruitgui.station.station import Station
from fruitgui.station.timing import Stopwatch

FRAMES_AHEAD = 6
"""Frames that are decoded ahead while others are perceived; each holds 1.5 MB."""


@dataclass(frozen=True, slots=True, eq=False)
class Seen:
    """One frame and what was perceived in it.

    Attributes:
        recorded_as: the sensor's id in the recording.
        frame_time_s: of the frame, in the sensor's own clock.
        observation: of it; sensor has the station's id, time in the reference clock.
        perceived_s: how long perceiving took.
    """

    recorded_as: str
    frame_time_s: float
    observation: Observation
    perceived_s: float


class Watching:
    """A recording opened for a station; its frames are perceived one after the other.

    Attributes:
        rig: of the sensors that are there.
        rig_watch: over what passes.
    """

    def __init__(self, source: RecordingSource, station: Station) -> None:
        """Open the recording.

        Raises:
            InputError: it cannot be used, or has no sensor of the station.
        """
        self._recording = source.open()
        self._lineup = line_up(station, self._recording.sensors.values(), source.clock_offsets_s)
        self._given_s = source.clock_offsets_s
        self._offsets_s = dict(self._lineup.offsets_s)
        self.rig: Rig = self._lineup.rig
        self.rig_watch = RigWatch(self.rig)

    @property
    def share_seen(self) -> float:
        """How much of the recording was read, 0–1."""
        return self._recording.share_read

    def seen(
        self, watch: Stopwatch, cancelled: Cancelled = never_cancelled, known: Iterable[Seen] = ()
    ) -> Generator[Seen, None, None]:
        """Yield every frame in order of the reference clock; each call begins at the beginning.

        Frames are decoded ahead by a thread of their own, and perceived with the help of a process: close the
        generator, or read to the end, to end both.

        Args:
            watch: times reading and perceiving.
            cancelled: asked before every frame.
            known: what was perceived in an earlier call; those frames are not perceived again.

        Raises:
            InputError: not one frame can be read.
        """
        frames = self._recording.frames(
            clock_offsets=self._offsets_s, corrections=self._lineup.corrections, ahead=FRAMES_AHEAD
        )
        by_frame = {(one.recorded_as, one.frame_time_s): one.observation for one in known}
        with contextlib.closing(frames), Crew(self._lineup.eyes) as crew:
            for task in crew.perceived(self._tasks(frames, watch, cancelled, by_frame)):
                frame, observation = task.frame, task.observation
                assert observation is not None  # noqa: S101 - the crew gives it
                watch.add("perceive", task.took_s)
                with watch.stage("watch"):
                    self.rig_watch.see_frame(observation.sensor, frame)
                yield Seen(frame.sensor, frame.time_s, observation, task.took_s)

    def _tasks(
        self,
        frames: Iterator[tuple[float, Frame]],
        watch: Stopwatch,
        cancelled: Cancelled,
        known: dict[tuple[str, float], Observation],
    ) -> Iterator[Task]:
        """Yield the frames of this station's sensors."""
        while True:
            stop_if(cancelled)
            began_s = time.perf_counter()
            try:
                time_s, frame = next(frames)
            except StopIteration:
                return
            watch.add("read", time.perf_counter() - began_s)
            if frame.sensor in self._lineup.eyes:
                before = known.pop((frame.sensor, frame.time_s), None)
                yield Task(time_s, frame, None if before is None else replace(before, time_s=time_s))

    def shift_clocks(self, offsets_s: Mapping[str, float]) -> None:
        """Add offsets (by station id) to the clocks in use, from the next reading on."""
        for sensor, name in self._names():
            self._offsets_s[sensor] += offsets_s.get(name, 0.0)

    def clock_given(self, name: str) -> bool:
        """Tell whether a person gave the clock offset of a station sensor."""
        return name in self._given_s or any(one in self._given_s for one, its in self._names() if its == name)

    def sensors_value(self, frames: Mapping[str, int]) -> list[dict[str, Any]]:
        """Return the report's `sensors`, given how many frames of each station sensor were used."""
        dropped = self._recording.tally.dropped
        return [
            {"id": name, "frames": frames.get(name, 0), "dropped": dropped(sensor)} for sensor, name in self._names()
        ]

    def warnings(self) -> list[str]:
        """Return what a person should know of recording and station."""
        return [*self._lineup.warnings, *self._recording.warnings, *self.rig_watch.warnings]

    def _names(self) -> list[tuple[str, str]]:
        """Return (the recording's id, the station's id) of every sensor in use."""
        return list(self._lineup.station_id.items())
