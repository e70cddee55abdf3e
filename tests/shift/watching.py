"""What was said of the sensors during a shift, and whether it was all that happened."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import dataclass

from fruitgui.sensors.feed import Feed, Running
from tests.shift.fast_time import FastTime
from tests.shift.mishaps import RECOVERY_S, Mishap

LOOK_S = 0.02


@dataclass(frozen=True, slots=True)
class Said:
    """What the feed said of one sensor at one moment, where that was anything but well."""

    time_s: float
    kinect: int
    state: Running
    code: str
    damaged: int
    drops: int
    leaps: int


class Watcher:
    """Looks at a feed's health all the time, and notes whatever is new and not well."""

    def __init__(self, feed: Feed, time: FastTime, began_s: float) -> None:
        self._feed, self._time, self._began_s = feed, time, began_s
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._watch, name="watcher", daemon=True)
        self.said: list[Said] = []

    def start(self) -> None:
        """Begin."""
        self._thread.start()

    def stop(self) -> None:
        """End."""
        self._stop.set()
        self._thread.join()

    def _watch(self) -> None:
        before: dict[str, tuple[Running, str, int, int, int]] = {}
        while not self._stop.is_set():
            for kinect, sensor in enumerate(self._feed.sensors):
                health = self._feed.health(sensor)
                code = health.error.code if health.error else ""
                now = (health.state, code, health.damaged, health.drops, health.clock_leaps)
                if now != before.get(sensor):
                    before[sensor] = now
                    self.said.append(Said(self._time.now_s() - self._began_s, kinect, *now))
            self._time.really_sleep(LOOK_S)


def unsaid(mishaps: Sequence[Mishap], said: Sequence[Said]) -> list[Mishap]:
    """Return the mishaps of which nothing was said.

    Args:
        mishaps: what happened.
        said: what was said, in order.
    """
    return [one for one in mishaps if not all(_was_said(one, kinect, said) for kinect in one.kinects)]


def _was_said(mishap: Mishap, kinect: int, said: Sequence[Said]) -> bool:
    until_s = mishap.to_s + RECOVERY_S
    before = [one for one in said if one.kinect == kinect and one.time_s < mishap.from_s]
    during = [one for one in said if one.kinect == kinect and mishap.from_s <= one.time_s <= until_s]
    if mishap.what == "clock_jump":
        return bool(during and before) and during[-1].leaps > before[-1].leaps
    troubled = any(one.state in (Running.SILENT, Running.FAILED) for one in during)
    if mishap.what in ("loss", "garbage") and during and before:
        last, first = during[-1], before[-1]
        return troubled or last.damaged > first.damaged or last.drops > first.drops
    return troubled
