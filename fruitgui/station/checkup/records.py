"""What a checkup found, as plain records and as the JSON that other programs read."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from fruitgui.sensors.usb.problems import Problem


class SensorState(StrEnum):
    """How a sensor is, in one word."""

    READY = "ready"
    RUNNING = "running"
    SILENT = "silent"
    FAILED = "failed"
    HANGS = "hangs"
    BUSY = "busy"
    NO_ACCESS = "no_access"
    NO_DRIVER = "no_driver"


@dataclass(frozen=True, slots=True)
class UsbPlace:
    """Where a sensor hangs; each part is None where it is not known.

    Attributes:
        bus: its number. controller: the chip that carries it. port: the kernel's name of the place, for example 1-1.4.
        speed_mbps: at which it runs.
    """

    bus: int | None = None
    controller: str | None = None
    port: str | None = None
    speed_mbps: float | None = None


@dataclass(frozen=True, slots=True)
class Measured:
    """How a sensor ran while it was watched.

    Attributes:
        rate_hz: pictures a second, each with colour and depth.
        nominal_hz: that it should give; 0 where unknown.
        frames, lost: pictures that came, and that did not or came damaged.
        late_s: how late this computer was at worst to do what was due, where it was late for too large a share of the
            time; 0 where it was not.
    """

    rate_hz: float
    nominal_hz: float
    frames: int
    lost: int
    late_s: float = 0.0


@dataclass(frozen=True, slots=True)
class CheckedSensor:
    """One sensor.

    Attributes:
        name: its id, the same that connecting it gives.
        make: the word of its driver. model, serial, firmware: empty where unknown.
        state: in one word.
        problems: what is wrong with it. limits: what its model cannot do, a sentence each.
        measured: None where it did not run.
        place: on the USB.
    """

    name: str
    make: str
    model: str
    serial: str
    state: SensorState
    problems: tuple[Problem, ...] = ()
    limits: tuple[str, ...] = ()
    firmware: str = ""
    measured: Measured | None = None
    place: UsbPlace = UsbPlace()

    def value(self) -> dict[str, Any]:
        """Return it as JSON."""
        rate_hz = None if self.measured is None else round(self.measured.rate_hz, 2)
        place = self.place
        return {
            "id": self.name,
            "make": self.make,
            "model": self.model,
            "serial": self.serial,
            "firmware": self.firmware,
            "state": str(self.state),
            "problems": [_value(one) for one in self.problems],
            "limits": list(self.limits),
            "rate_hz": {"color": rate_hz, "depth": rate_hz},
            "lost_frames": None if self.measured is None else self.measured.lost,
            "usb": {
                "bus": place.bus,
                "controller": place.controller,
                "port": place.port,
                "speed_mbps": place.speed_mbps,
            },
        }


@dataclass(frozen=True, slots=True)
class CheckedController:
    """A USB controller.

    Attributes:
        address: of the chip. driver: of the kernel. buses: its own, by number. sensors: the ids of those on it.
        load: share of what it can promise that its Kinects want, 1 is full; None where none is on it.
    """

    address: str
    driver: str
    buses: tuple[int, ...]
    sensors: tuple[str, ...]
    load: float | None = None

    def value(self) -> dict[str, Any]:
        """Return it as JSON."""
        return {
            "controller": self.address,
            "driver": self.driver,
            "buses": list(self.buses),
            "sensors": list(self.sensors),
            "load": None if self.load is None else round(self.load, 2),
            "fits": self.load is None or self.load <= 1.0,
        }


@dataclass(frozen=True, slots=True)
class Checkup:
    """All of it.

    Attributes:
        sensors: found on the USB or by a driver.
        problems: of the system. Each sensor has its own beside them.
        controllers: of the USB; those without a sensor too.
    """

    sensors: tuple[CheckedSensor, ...]
    problems: tuple[Problem, ...] = ()
    controllers: tuple[CheckedController, ...] = ()

    @property
    def all_problems(self) -> tuple[Problem, ...]:
        """The system's and every sensor's."""
        return (*self.problems, *(one for sensor in self.sensors for one in sensor.problems))

    def value(self) -> dict[str, Any]:
        """Return it as JSON."""
        return {
            "sensors": [one.value() for one in self.sensors],
            "problems": [_value(one) for one in self.problems],
            "controllers": [one.value() for one in self.controllers],
        }


def needs_rules(problems: Sequence[Problem]) -> bool:
    """Tell whether installing the udev rules is what helps."""
    return any(one.code in ("no_access", "closed") for one in problems)


def _value(problem: Problem) -> dict[str, str]:
    return {"code": problem.code, "what": problem.what, "remedy": problem.remedy}
