"""Drivers asked for what is plugged in, each on a thread of its own: one that hangs is left behind."""

from __future__ import annotations

import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass, field

from fruitgui.errors import FruitguiError
from fruitgui.sensors.drivers import Driver, PluggedDevice
from fruitgui.sensors.sensor import Sensor
from fruitgui.sensors.usb.problems import Problem, problem, problem_of

ANSWER_S = 10.0
"""After so long a driver that has said nothing hangs."""


PATIENCE_S = 5.0
"""So long a driver may look before what it found so far is taken."""

WHOLE_S = 0.4
"""A driver whose bus is slow says after a while what it found before; what it says sooner is all there is."""


@dataclass(frozen=True, slots=True)
class Answer:
    """What a driver said.

    Attributes:
        make: its word.
        found: what is plugged in, with a sensor for each, closed.
        unusable: why no device of this make can be used here; None where they can.
        problem: that the driver itself has.
    """

    make: str
    found: tuple[tuple[PluggedDevice, Sensor], ...] = ()
    unusable: Problem | None = None
    problem: Problem | None = None


@dataclass(slots=True)
class _Asked:
    driver: Driver
    answer: Answer | None = None
    thread: threading.Thread = field(init=False)

    def __post_init__(self) -> None:
        self.thread = threading.Thread(target=self._ask, name=f"asks {self.driver.make}", daemon=True)

    def _ask(self) -> None:
        try:
            self.answer = _answer(self.driver)
        except FruitguiError as error:
            self.answer = Answer(self.driver.make, problem=problem_of(error))
        except Exception as error:  # noqa: BLE001 - a driver's bug is said, and the others are asked all the same
            why = f"{type(error).__name__}: {error}"
            self.answer = Answer(self.driver.make, problem=problem("driver_failed", make=self.driver.make, why=why))


def ask(drivers: Sequence[Driver], within_s: float = ANSWER_S) -> tuple[Answer, ...]:
    """Return what each driver says, in their order, after `within_s` at the latest."""
    until_s = time.monotonic() + within_s
    asked = [_Asked(driver) for driver in drivers]
    for one in asked:
        one.thread.start()
    for one in asked:
        one.thread.join(max(until_s - time.monotonic(), 0.0))
    return tuple(
        one.answer or Answer(one.driver.make, problem=problem("driver_hangs", make=one.driver.make)) for one in asked
    )


def _answer(driver: Driver) -> Answer:
    error = driver.problem()
    if error is not None:
        return Answer(driver.make, unusable=problem_of(error))
    devices = all_devices(driver)
    return Answer(driver.make, tuple((device, driver.sensor(device.serial)) for device in devices))


def all_devices(driver: Driver) -> Sequence[PluggedDevice]:
    """Return what is plugged in; where the bus is slow, as with a device that does not answer, after some seconds."""
    until_s = time.monotonic() + PATIENCE_S
    while True:
        asked_s = time.monotonic()
        devices = driver.devices()
        if time.monotonic() - asked_s < WHOLE_S or time.monotonic() > until_s:
            return devices
