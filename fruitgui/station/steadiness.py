"""Watches whether sensors that run are warm and their light is as it was: a look at the bare belt now and then."""

from __future__ import annotations

import logging
from collections import deque
from dataclasses import dataclass, replace

from fruitgui.calibration.bare_belt import BeltPatch, first_patch, read_belt
from fruitgui.calibration.light_drift import LightDrift, light_drift
from fruitgui.calibration.warmup import NOT_WATCHED, Warmth, Warmup, warmup
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
"""After so many looks at which the belt was nowhere that it was before, it is looked for anew."""

MOST_PLACES = 4
"""Places from which a sensor is remembered to have seen the belt: it is raised to measure its depth, and put back."""

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


class _Place:
    """From where a sensor sees the belt, and how the belt looked from there: lengths and light of two places differ."""

    def __init__(self, patch: BeltPatch) -> None:
        self._patch = patch
        self._times_s: deque[float] = deque(maxlen=MOST_LOOKS)
        self._offs_m: deque[float] = deque(maxlen=MOST_LOOKS)
        self._first_light: list[tuple[float, float, float]] = []
        self._light: deque[tuple[float, float, float]] = deque(maxlen=LIGHT_LOOKS)

    def sees(self, frame: Frame) -> bool:
        """Take in a frame, unless the belt is not seen from here."""
        reading = read_belt(frame, self._patch, self._offs_m[-1] if self._offs_m else 0.0)
        if reading is None:
            return False
        self._times_s.append(reading.time_s)
        self._offs_m.append(reading.off_m)
        if reading.light is not None:
            if len(self._first_light) < LIGHT_LOOKS:
                self._first_light.append(reading.light)
            self._light.append(reading.light)
        return True

    def warmup(self) -> Warmup:
        """Return how depth moved, seen from here."""
        return warmup(self._times_s, self._offs_m, self._patch.distance_m)

    def light(self) -> LightDrift | None:
        """Return the light on the belt against what it was from here at first."""
        return light_drift(self._first_light, self._light)


class SensorSteadiness:
    """Takes frames of one sensor, uncorrected, and says how steady it is. Not for several threads.

    A device is as warm wherever it hangs: where it is raised, what was known of its warmth holds until more is.
    """

    def __init__(self) -> None:
        self._begin()

    def _begin(self) -> None:
        self._frames: list[Frame] = []
        self._places: list[_Place] = []
        self._looked_s: float | None = None
        self._missed = MISSED_LOOKS
        self._known, self._known_s = NOT_WATCHED, 0.0
        self._now = Steadiness()

    @property
    def now(self) -> Steadiness:
        """How steady it is, as of the last look."""
        return self._now

    def see(self, frame: Frame) -> None:
        """Take in a frame; most are let pass. A clock that runs backwards is another run: all begins anew."""
        if self._looked_s is not None and frame.time_s < self._looked_s:
            self._begin()
        if self._frames:
            self._find_belt(frame)
        elif self._looked_s is None or frame.time_s >= self._looked_s + LOOK_S:
            self._look(frame)

    def _find_belt(self, frame: Frame) -> None:
        """Gather frames that show where the belt is now."""
        if self._frames and frame.sequence == self._frames[-1].sequence:
            return
        self._looked_s = frame.time_s
        self._frames.append(frame)
        if len(self._frames) == FIRST_FRAMES:
            patch = first_patch(self._frames)
            self._frames = []
            if patch is not None:
                self._hangs_at(_Place(patch), frame.time_s)

    def _look(self, frame: Frame) -> None:
        """Look from where it hung last, or else from where it hung before; find the belt where that goes on failing."""
        seen_from = next((place for place in self._places if place.sees(frame)), None)
        if seen_from is None and self._missed >= MISSED_LOOKS:
            self._find_belt(frame)
            return
        self._looked_s = frame.time_s
        if seen_from is None:
            self._missed += 1
            return
        if seen_from is not self._places[0]:
            self._hangs_at(seen_from, frame.time_s)
        known = _still_known(seen_from.warmup(), self._known, frame.time_s - self._known_s)
        self._missed, self._now = 0, Steadiness(known, seen_from.light())

    def _hangs_at(self, place: _Place, time_s: float) -> None:
        """Go on from a place; what was known until now goes with it."""
        others = [one for one in self._places if one is not place]
        self._places = [place, *others[: MOST_PLACES - 1]]
        self._known, self._known_s, self._missed = self._now.warmup, time_s, 0


def _still_known(seen: Warmup, known: Warmup, ago_s: float) -> Warmup:
    """Return how warm a device is: as seen from where it hangs, and until that tells, as was known `ago_s` before."""
    since_s = known.since_s + ago_s if known.state is Warmth.STEADY else 0.0
    if seen.state is Warmth.UNKNOWN and known.state is not Warmth.UNKNOWN:
        return replace(known, watched_s=known.watched_s + ago_s, since_s=since_s)
    if seen.state is Warmth.STEADY and seen.since_s >= seen.watched_s:
        return replace(seen, since_s=max(seen.since_s, since_s))
    return seen


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
