"""In which order the frames of several sensors leave a queue."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from fruitgui.sensors.feed.subscription import Arrival

Heads = Mapping[str, "Arrival"]
"""The oldest waiting frame of each sensor that has one."""


class Order(Protocol):
    """Says whose frame leaves next. Called with the queue's lock held."""

    def takes(self, arrival: Arrival) -> bool:
        """Tell whether a frame has a place in this order."""

    def next(self, heads: Heads, absent: Collection[str], now_s: float) -> tuple[str | None, float]:
        """Return (the sensor whose oldest frame leaves now, 0), or (None, how long to wait before asking again).

        Args:
            heads: at least one.
            absent: sensors without a waiting frame that still run.
            now_s: the host's monotonic clock.
        """

    def shift(self, offsets_s: Mapping[str, float]) -> None:
        """Take the stamps of sensors for later by so much, from the next frame on."""


class ByArrival:
    """As they came."""

    def takes(self, arrival: Arrival) -> bool:  # noqa: ARG002 - stamps say nothing here
        """Take every frame."""
        return True

    def shift(self, offsets_s: Mapping[str, float]) -> None:
        """Do nothing: stamps say nothing here."""

    def next(self, heads: Heads, absent: Collection[str], now_s: float) -> tuple[str | None, float]:  # noqa: ARG002
        """Return the sensor whose frame came first."""
        return min(heads, key=lambda sensor: heads[sensor].arrived_s), 0.0


class ByCapture:
    """In the order in which they were captured; a late sensor is waited for, a silent one is not.

    A frame leaves when no sensor that runs can still bring an earlier one, at the latest `patience_s` after it came.
    Frames of one sensor stay in their order. One whose time is not sure has no place: its fruit would be elsewhere.

    Args:
        offsets_s: by sensor, added to its stamps gives the common clock; 0 where not named.
        patience_s: how long a frame waits for the other sensors. A sensor that gave nothing for so long is silent.
    """

    def __init__(self, offsets_s: Mapping[str, float], patience_s: float = 0.5) -> None:
        self._offsets_s = dict(offsets_s)
        self._patience_s = patience_s
        self._newest_s: dict[str, float] = {}
        self._heard_s: dict[str, float] = {}
        self._left_s = -math.inf
        self.late = 0

    def takes(self, arrival: Arrival) -> bool:
        """Take frames whose times are sure."""
        return arrival.frame.time_sure

    def time_s(self, arrival: Arrival) -> float:
        """Return a frame's capture time in the common clock."""
        return arrival.frame.time_s + self._offsets_s.get(arrival.frame.sensor, 0.0)

    def shift(self, offsets_s: Mapping[str, float]) -> None:
        """Add to the offsets, from the next frame on."""
        for sensor, offset_s in offsets_s.items():
            self._offsets_s[sensor] = self._offsets_s.get(sensor, 0.0) + offset_s

    def next(self, heads: Heads, absent: Collection[str], now_s: float) -> tuple[str | None, float]:
        """Return the sensor whose frame was captured first, once that is certain or its time is up."""
        sensor = min(heads, key=lambda one: self.time_s(heads[one]))
        head, time_s = heads[sensor], self.time_s(heads[sensor])
        patience_s = min(self._patience_s + head.arrived_s - now_s, self._longest_wait_s(absent, time_s, now_s))
        if patience_s > 0.0:
            return None, patience_s
        self._note(sensor, head, time_s)
        return sensor, 0.0

    def _longest_wait_s(self, absent: Collection[str], time_s: float, now_s: float) -> float:
        """Return how long, at most, a sensor without a waiting frame may still bring one captured before a time."""
        heard_s = [
            self._heard_s.setdefault(sensor, now_s)
            for sensor in absent
            if self._newest_s.get(sensor, -math.inf) < time_s
        ]
        return max(heard_s, default=-math.inf) + self._patience_s - now_s

    def _note(self, sensor: str, head: Arrival, time_s: float) -> None:
        self._newest_s[sensor] = max(self._newest_s.get(sensor, -math.inf), time_s)
        self._heard_s[sensor] = head.arrived_s
        self.late += time_s < self._left_s
        self._left_s = max(self._left_s, time_s)
