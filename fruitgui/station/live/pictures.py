"""Where a line's frames come from: a feed, or what another process hands over of one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from fruitgui.sensors.feed import Arrival, Order, Room, SensorHealth
from fruitgui.sensors.sensor import SensorInfo


class Arrivals(Protocol):
    """Frames of several sensors for one reader, see `Subscription`."""

    def take(self, timeout_s: float) -> Arrival | None:
        """Return the next frame; None where none can leave in time, or ever."""

    def shift(self, offsets_s: Mapping[str, float]) -> None:
        """Let the frames of sensors leave from now on as if they had been captured later by so many seconds."""

    def close(self) -> None:
        """Take nothing more in. What waits can still be taken. Any number of times."""

    @property
    def over(self) -> bool:
        """Whether nothing waits and nothing will come."""

    @property
    def waiting(self) -> int:
        """How many frames wait to be taken."""

    @property
    def dropped(self) -> Mapping[str, int]:
        """Frames that gave way, by sensor."""


class Pictures(Protocol):
    """Running sensors, as far as a line looks at them, see `Feed`."""

    @property
    def infos(self) -> Mapping[str, SensorInfo]:
        """Who the sensors are, by name, in order."""

    @property
    def sensors(self) -> tuple[str, ...]:
        """The sensors' names, in order."""

    def health(self, sensor: str) -> SensorHealth:
        """Return how a sensor is."""

    def subscribe(self, room: Room, order: Order) -> Arrivals:
        """Return a queue of all frames from now on; close it when done."""
