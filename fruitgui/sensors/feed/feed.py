"""Connected sensors running."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from fruitgui.frame import Frame
from fruitgui.sensors.feed.health import Running, SensorHealth
from fruitgui.sensors.feed.order import Order
from fruitgui.sensors.feed.reader import Ears, Reader
from fruitgui.sensors.feed.subscription import Arrival, DropOldest, Room, Subscription
from fruitgui.sensors.feed.turn_keeper import TurnKeeper
from fruitgui.sensors.sensor import Sensor, SensorInfo
from fruitgui.sensors.turns import Schedule, lights_of, turns

STOP_S = 2.0
"""Stopping takes no longer, whatever the drivers do."""


class Feed:
    """Runs sensors, one thread each, from `start` to `stop`; one owner calls both.

    Constructing starts nothing. Everything else may be called from any thread and never waits. Frames reach nobody
    that were damaged, or captured outside of their sensor's own turn.
    """

    def __init__(self, sensors: Sequence[Sensor], schedule: Schedule | None = None) -> None:
        """Prepare.

        Args:
            sensors: to run.
            schedule: of the turns of those that blind each other; each alone unless given.

        Raises:
            ValueError: two sensors have one name.
        """
        self._sensors = tuple(sensors)
        infos = [sensor.info for sensor in sensors]
        if len({info.sensor for info in infos}) != len(sensors):
            raise ValueError("two sensors have one name")
        self._schedule = turns(lights_of(infos), None) if schedule is None else schedule
        self._keeper = TurnKeeper(self._schedule)
        self._rehearsal: Subscription | None = None
        ears = Ears(self._hear, self._miss, self._end)
        self._readers = {sensor.info.sensor: Reader(sensor, self._keeper, ears) for sensor in sensors}
        self._subscriptions: tuple[Subscription, ...] = ()
        self._lock = threading.Lock()
        self._stopped = False

    @property
    def infos(self) -> dict[str, SensorInfo]:
        """Who the sensors are, by name, in order; of some more is known once they were opened."""
        infos = [sensor.info for sensor in self._sensors]
        return {info.sensor: info for info in infos}

    @property
    def sensors(self) -> tuple[str, ...]:
        """The sensors' names, in order."""
        return tuple(self._readers)

    def start(self) -> None:
        """Start every sensor. Once only: a stopped feed is not started again, make a new one."""
        for reader in self._readers.values():
            reader.start()

    def stop(self) -> tuple[str, ...]:
        """Stop every sensor within two seconds; return the names of those whose driver hangs and was left behind."""
        until_s = time.monotonic() + STOP_S
        with self._lock:
            self._stopped = True
            subscriptions = self._subscriptions
        for reader in self._readers.values():
            reader.ask_to_stop()
        for subscription in subscriptions:
            subscription.close()
        return tuple(name for name, one in self._readers.items() if not one.wait(until_s - time.monotonic()))

    @property
    def schedule(self) -> Schedule:
        """How the projectors take turns."""
        return self._schedule

    def take_turns(self, schedule: Schedule) -> None:
        """Let the projectors take turns by another schedule from now on."""
        with self._lock:
            self._schedule = schedule
            if self._rehearsal is None:
                self._keeper.keep_to(schedule)

    @contextmanager
    def rehearsal(self, schedule: Schedule, room: int) -> Iterator[Subscription]:
        """Try the projectors by another schedule: give a queue of what comes of it, settled or not.

        Nobody else hears of the sensors that take turns meanwhile.

        Args:
            schedule: to try; a sensor in no slot of it shines all the time.
            room: frames kept of each sensor while the oldest give way.

        Raises:
            ValueError: another rehearsal goes on.
        """
        heard = Subscription(self.sensors, DropOldest(room))
        with self._lock:
            if self._rehearsal is not None:
                raise ValueError("one rehearsal at a time")
            self._rehearsal = heard
            self._keeper.keep_to(schedule, rehearsed=True)
        try:
            yield heard
        finally:
            with self._lock:
                self._rehearsal = None
                self._keeper.keep_to(self._schedule)
            heard.close()

    def try_again(self, sensor: str) -> None:
        """Open a sensor that failed now: it is said to be back. Raises `KeyError` for a name that is not here."""
        self._readers[sensor].try_again()

    def newest(self, sensor: str) -> Frame | None:
        """Return a sensor's newest frame; None before its first. Raises `KeyError` for a name that is not here."""
        return self._readers[sensor].newest

    def health(self, sensor: str) -> SensorHealth:
        """Return how a sensor is. Raises `KeyError` for a name that is not here."""
        return self._readers[sensor].health()

    @property
    def ended(self) -> bool:
        """Whether every sensor has given its last frame."""
        return all(reader.health().state is Running.ENDED for reader in self._readers.values())

    def subscribe(self, room: Room | int, order: Order | None = None) -> Subscription:
        """Return a queue of all frames from now on; close it when done.

        Args:
            room: frames kept of each sensor while the oldest give way, or what else happens where they do not fit.
            order: in which they leave; as they came unless given.
        """
        subscription = Subscription(self.sensors, DropOldest(room) if isinstance(room, int) else room, order)
        with self._lock:
            kept = tuple(one for one in self._subscriptions if not one.closed)
            self._subscriptions = (*kept, subscription)
            stopped = self._stopped
        for name, reader in self._readers.items():
            if reader.health().state is Running.ENDED:
                subscription.end(name)
        if stopped:
            subscription.close()
        return subscription

    def _hear(self, arrival: Arrival) -> None:
        rehearsal = self._rehearsal
        if arrival.lit.rehearsed:
            if rehearsal is not None:
                rehearsal.put(arrival)
            return
        for subscription in self._subscriptions:
            subscription.put(arrival)

    def _miss(self, sensor: str) -> None:
        for subscription in self._subscriptions:
            subscription.absent(sensor)

    def _end(self, sensor: str) -> None:
        for subscription in self._subscriptions:
            subscription.end(sensor)
