"""What the line leaves for a screen to draw: its newest state and pictures, no oftener than anybody sees."""

from __future__ import annotations

import time
from dataclasses import replace

from fruitgui.perception.view import Observation
from fruitgui.sensors.feed import Arrival
from fruitgui.station.live.following import Following
from fruitgui.station.live.state import LiveState, Phase, Preview

SHOWN_HZ = 25.0
"""States are made no more often: nobody sees more."""


class Showing:
    """Draws what is followed. One thread calls; what it leaves may be read from any.

    Args:
        following: what is drawn.

    Attributes:
        drawn: what is in view as of the last time that it was drawn; nothing else of it is set.
        previews: the newest picture of each sensor, by its id in the feed.
    """

    def __init__(self, following: Following) -> None:
        self._following = following
        self._shown_s = 0.0
        self._due_s: dict[str, float] = {}
        self.previews: dict[str, Preview] = {}
        self.drawn = LiveState(Phase.STOPPED)

    def show(self, arrival: Arrival, observation: Observation) -> None:
        """Draw a frame's picture, and what is in view, if their time has come."""
        now_s, sensor = time.monotonic(), arrival.frame.sensor
        due_s, period_s = self._due_s.get(sensor, 0.0), 1.0 / SHOWN_HZ
        if now_s >= due_s:  # counted from when it was due, or frames nearly as far apart would leave out every other
            self._due_s[sensor] = max(due_s, now_s - period_s) + period_s
            self.previews[sensor] = self._following.preview(arrival, observation.sensor)
        if now_s - self._shown_s >= 1.0 / SHOWN_HZ:
            self._shown_s = now_s
            self.draw(observation.time_s)

    def draw(self, time_s: float | None) -> None:
        """Draw what is in view, as of a time of the reference clock; None for that of the last time."""
        self.drawn = replace(
            self.drawn,
            time_s=self.drawn.time_s if time_s is None else time_s,
            tracks=self._following.tracks_now(),
            footprints_m=self._following.above.footprints_m,
            belt_velocity_m_s=self._following.velocity_m_s,
        )
