"""A sensor's seat among those that take turns; one that blinds nobody has a seat that asks for nothing."""

from __future__ import annotations

import time
from typing import Protocol

from fruitgui.sensors.feed.lit import ALWAYS, Lit
from fruitgui.sensors.feed.turn_keeper import Order, TurnKeeper
from fruitgui.sensors.feed.watched import WatchedSensor


class Seat(Protocol):
    """What a reader asks between two frames. One thread calls."""

    def prepare(self) -> None:
        """Before the sensor starts."""

    def sit(self) -> None:
        """Once it has started."""

    def order(self, timeout_s: float) -> Order:
        """Return what to do next: `READ` or `REST`, anything else was done already."""

    def light(self) -> Lit | None:
        """Return how a frame that came just now was lit; None where it is to be let go."""

    def keep(self) -> None:
        """Count a frame that was of use."""

    def rise(self) -> None:
        """Once the device was given back."""

    def be_lost(self) -> None:
        """Once the device was let go though it does not answer."""


class FreeSeat:
    """Of a sensor that takes no turns."""

    def prepare(self) -> None:
        """Do nothing."""

    def sit(self) -> None:
        """Do nothing."""

    def order(self, timeout_s: float) -> Order:  # noqa: ARG002 - it never waits
        """Read on."""
        return Order.READ

    def light(self) -> Lit | None:
        """Return how it is always lit."""
        return ALWAYS

    def keep(self) -> None:
        """Do nothing."""

    def rise(self) -> None:
        """Do nothing."""

    def be_lost(self) -> None:
        """Do nothing."""


class TurnSeat:
    """Of a sensor that takes turns: switches its projector as the keeper says, on the thread that asks."""

    def __init__(self, sensor: WatchedSensor, keeper: TurnKeeper) -> None:
        self._sensor = sensor
        self._name = sensor.info.sensor
        self._keeper = keeper

    def prepare(self) -> None:
        """Let the sensor start in the dark. Raises as it does."""
        self._sensor.projector(False)

    def sit(self) -> None:
        """Take part."""
        self._keeper.admit(self._name, lambda: self._sensor.hangs)

    def order(self, timeout_s: float) -> Order:
        """Switch the projector where it is time to; return what was done, or is to be done. Raises as the sensor does.

        A sensor that was switched gave nothing yet: ask again.
        """
        order = self._keeper.order(self._name, timeout_s)
        if order is Order.ON:
            self._sensor.projector(True)
            self._keeper.shines(self._name)
        elif order is Order.OFF:
            self._sensor.projector(False)
            self._keeper.is_dark(self._name)
        return order

    def light(self) -> Lit | None:
        """Return how a frame that came just now was lit; None where it should be dark."""
        return self._keeper.light(self._name, time.monotonic())

    def keep(self) -> None:
        """Count a frame that was of use."""
        self._keeper.keep(self._name)

    def rise(self) -> None:
        """Leave: the device is dark."""
        self._keeper.dismiss(self._name)

    def be_lost(self) -> None:
        """Leave: the device may shine."""
        self._keeper.lose(self._name)
