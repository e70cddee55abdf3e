"""Watches whether sensors that run are warm and their light is as it was: a look at the bare belt now and then."""

from __future__ import annotations

import logging
from collections import deque
from dataclasses import dataclass

from fruitgui.calibration.bare_belt import BeltPatch, BeltReading, first_patch, read_belt
from fruitgui.calibration.light_drift import LightDrift, light_drift
from fruitgui.calibration.warmup import NOT_WATCHED, Warmup, warmup
from fruitgui.frame import Frame
from fruitgui.sensors.feed import Feed
from fruitgui.station.looks import Looks

LOOK_S = 6.0
"""Between two looks at one sensor, by its own clock."""

BEGIN_S, REST_S = 5.0, 0.5
"""It begins when sensors have settled and the window is up: finding the belt takes some tenths of a second."""

FIRST_FRAMES = 4
"""So many frames show where the belt is."""

LIGHT_LOOKS = 10
"""The light of so many looks is one light: a minute's."""

MOST_LOOKS = 14_400
"""A day's; the oldest are forgotten."""

MISSED_LOOKS = 20
"""After so many looks at which the belt was not where it was, it is looked for anew."""

log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class Steadiness:
    """How steady one sensor is.

    Attributes:
        warmup: of its depth.
        light: on the belt against what it was at first; None before it can be told.
    """

    warmup: Warmup = NOT_WATCHED
    light: LightDrift | None = None


class SensorSteadiness:
    """Takes frames of one sensor, uncorrected, and says how steady it is. Not for several threads."""

    def __init__(self) -> None:
        self._begin()

    def _begin(self) -> None:
        self._frames: list[Frame] = []
        self._patch: BeltPatch | None = None
        self._times_s: deque[float] = deque(maxlen=MOST_LOOKS)
        self._offs_m: deque[float] = deque(maxlen=MOST_LOOKS)
        self._first_light: list[tuple[float, float, float]] = []
        self._light: deque[tuple[float, float, float]] = deque(maxlen=LIGHT_LOOKS)
        self._looked_s: float | None = None
        self._missed = 0
        self._now = Steadiness()

    @property
    def now(self) -> Steadiness:
        """How steady it is, as of the last look."""
        return self._now

    def see(self, frame: Frame) -> None:
        """Take in a frame; most are let pass. A clock that runs backwards is another run: all begins anew."""
        if self._looked_s is not None and frame.time_s < self._looked_s:
            self._begin()
        if self._patch is None:
            self._find_belt(frame)
        elif self._looked_s is None or frame.time_s >= self._looked_s + LOOK_S:
            self._look(frame, self._patch)

    def _find_belt(self, frame: Frame) -> None:
        waits = self._looked_s is not None and frame.time_s < self._looked_s + (0.0 if self._frames else LOOK_S)
        again = bool(self._frames) and frame.sequence == self._frames[-1].sequence
        if waits or again:
            return
        self._looked_s = frame.time_s
        self._frames.append(frame)
        if len(self._frames) == FIRST_FRAMES:
            self._patch = first_patch(self._frames)
            self._frames = []

    def _look(self, frame: Frame, patch: BeltPatch) -> None:
        self._looked_s = frame.time_s
        reading = read_belt(frame, patch, self._offs_m[-1] if self._offs_m else 0.0)
        if reading is not None:
            self._missed = 0
            self._take(reading, patch)
            return
        self._missed += 1
        if self._missed > MISSED_LOOKS:
            self._begin()

    def _take(self, reading: BeltReading, patch: BeltPatch) -> None:
        self._times_s.append(reading.time_s)
        self._offs_m.append(reading.off_m)
        if reading.light is not None:
            if len(self._first_light) < LIGHT_LOOKS:
                self._first_light.append(reading.light)
            self._light.append(reading.light)
        self._now = Steadiness(
            warmup(self._times_s, self._offs_m, patch.distance_m), light_drift(self._first_light, self._light)
        )


class SteadinessWatch(Looks):
    """Looks at all sensors of a feed."""

    def __init__(self, feed: Feed) -> None:
        super().__init__(name="steadiness", rest_s=REST_S, begin_s=BEGIN_S)
        self._feed = feed
        self._sensors = {sensor: SensorSteadiness() for sensor in feed.sensors}

    def of(self, sensor: str) -> Steadiness:
        """Return how steady a sensor is; from any thread."""
        watched = self._sensors.get(sensor)
        return Steadiness() if watched is None else watched.now

    def look(self) -> None:
        """Show each its newest frame; what goes wrong with one does not keep the others from theirs."""
        for sensor, watched in self._sensors.items():
            frame = self._feed.newest(sensor)
            if frame is None or self.stopping:
                continue
            try:
                watched.see(frame)
            except Exception:
                log.exception("watching how steady sensor %s is", sensor)
