"""A bounded queue of what sensors give: either the oldest give way, counted, or the sensors wait."""

from __future__ import annotations

import threading
import time
from collections import Counter, deque
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from typing import Protocol

from fruitgui.frame import Frame
from fruitgui.sensors.feed.lit import ALWAYS, Lit
from fruitgui.sensors.feed.order import ByArrival, Order

LOOK_S = 0.1


@dataclass(frozen=True, slots=True, eq=False)
class Arrival:
    """A frame, when it came by the host's monotonic clock, seconds, and how it was lit."""

    frame: Frame
    arrived_s: float
    lit: Lit = ALWAYS


class Room(Protocol):
    """What happens where a sensor's queue is full."""

    def make(self, queue: deque[Arrival], changed: threading.Condition, closed: Callable[[], bool]) -> int:
        """Make room for one frame, with the lock held; return how many gave way for it."""


@dataclass(frozen=True, slots=True)
class DropOldest:
    """For live sensors: the oldest frame of the same sensor gives way.

    Attributes:
        capacity: frames kept of each sensor.
    """

    capacity: int

    def make(self, queue: deque[Arrival], changed: threading.Condition, closed: Callable[[], bool]) -> int:  # noqa: ARG002
        """Drop the oldest."""
        if len(queue) < self.capacity:
            return 0
        queue.popleft()
        return 1


@dataclass(frozen=True, slots=True)
class WaitForRoom:
    """For recordings played flat out: their sensors wait until the reader has taken something. Nothing is lost.

    Attributes:
        capacity: frames kept of each sensor.
    """

    capacity: int

    def make(self, queue: deque[Arrival], changed: threading.Condition, closed: Callable[[], bool]) -> int:
        """Wait."""
        while len(queue) >= self.capacity and not closed():
            changed.wait(LOOK_S)
        return 0


class Subscription:
    """Frames of several sensors for one reader. Made by `Feed.subscribe`; close it when done.

    Args:
        sensors: whose frames come.
        room: what happens where a queue is full.
        order: in which frames leave; as they came unless given.
    """

    def __init__(self, sensors: Collection[str], room: Room, order: Order | None = None) -> None:
        self._queues: dict[str, deque[Arrival]] = {sensor: deque() for sensor in sensors}
        self._room = room
        self._order = order or ByArrival()
        self._running = set(sensors)
        self._ended: set[str] = set()
        self._dropped: Counter[str] = Counter()
        self._changed = threading.Condition()
        self._closed = False

    def put(self, arrival: Arrival) -> None:
        """Take in a frame, if it has a place in the order; called by the sensor's own thread."""
        sensor = arrival.frame.sensor
        with self._changed:
            if self._closed or not self._order.takes(arrival):
                return
            self._running.add(sensor)
            self._dropped[sensor] += self._room.make(self._queues[sensor], self._changed, lambda: self._closed)
            self._queues[sensor].append(arrival)
            self._changed.notify_all()

    def absent(self, sensor: str) -> None:
        """Note that a sensor gives nothing for now: it failed or fell silent."""
        with self._changed:
            self._running.discard(sensor)
            self._changed.notify_all()

    def end(self, sensor: str) -> None:
        """Note that a sensor will give nothing any more."""
        with self._changed:
            self._running.discard(sensor)
            self._ended.add(sensor)
            self._changed.notify_all()

    def take(self, timeout_s: float) -> Arrival | None:
        """Return the next frame; None where none can leave in time, or ever."""
        until_s = time.monotonic() + timeout_s
        with self._changed:
            while True:
                sensor, wait_s = self._next(time.monotonic())
                if sensor is not None:
                    taken = self._queues[sensor].popleft()
                    self._changed.notify_all()
                    return taken
                left_s = until_s - time.monotonic()
                if left_s <= 0.0 or self._is_over():
                    return None
                self._changed.wait(min(left_s, wait_s))

    @property
    def over(self) -> bool:
        """Whether nothing waits and nothing will come: every sensor has ended, or this was closed."""
        with self._changed:
            return self._is_over()

    @property
    def closed(self) -> bool:
        """Whether this was closed."""
        return self._closed

    @property
    def dropped(self) -> Mapping[str, int]:
        """Frames that gave way, by sensor."""
        return Counter(self._dropped)

    @property
    def waiting(self) -> int:
        """How many frames wait to be taken."""
        return sum(len(queue) for queue in list(self._queues.values()))

    def shift(self, offsets_s: Mapping[str, float]) -> None:
        """Let the frames of sensors leave from now on as if they had been captured later by so many seconds."""
        with self._changed:
            self._order.shift(offsets_s)
            self._changed.notify_all()

    def clear(self) -> int:
        """Let go of everything that waits; return how many frames that were."""
        with self._changed:
            count = sum(len(queue) for queue in self._queues.values())
            for queue in self._queues.values():
                queue.clear()
            self._changed.notify_all()
            return count

    def close(self) -> None:
        """Take nothing more in. What waits can still be taken. Any number of times."""
        with self._changed:
            self._closed = True
            self._running.clear()
            self._ended.update(self._queues)
            self._changed.notify_all()

    def _next(self, now_s: float) -> tuple[str | None, float]:
        heads = {sensor: queue[0] for sensor, queue in self._queues.items() if queue}
        if not heads:
            return None, LOOK_S
        absent = [sensor for sensor in self._running if sensor not in heads]
        return self._order.next(heads, absent, now_s)

    def _is_over(self) -> bool:
        return len(self._ended) == len(self._queues) and not any(self._queues.values())
