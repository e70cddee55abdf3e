"""The seam of makes: how devices that are plugged in are found, and made into sensors."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import Protocol

from fruitgui.errors import WorldError
from fruitgui.sensors.sensor import Sensor


@dataclass(frozen=True, slots=True)
class PluggedDevice:
    """A device that is plugged in now.

    Attributes:
        make: the word of its driver.
        model: for people, for example `Kinect 1414`.
        serial: under which it is opened again after it was unplugged; empty where it may not be asked, or where
            another device has it too: such a device cannot be opened, and its limits say why.
        firmware: as the device says; empty where it does not.
        limits: what this model cannot do, a sentence each.
        bus, address: of the USB device; None where the driver cannot tell.
        hindrance: why it cannot be opened, the code of a problem of `sensors.usb.problems`; empty where it can.
        port_path: the ports from the bus on to it, for example `(1, 4)`; empty where the driver cannot tell.
    """

    make: str
    model: str
    serial: str
    firmware: str = ""
    limits: tuple[str, ...] = ()
    bus: int | None = None
    address: int | None = None
    port_path: tuple[int, ...] = ()
    hindrance: str = ""


class Driver(Protocol):
    """One make of devices. May be called from any thread."""

    @property
    def make(self) -> str:
        """One lower-case word, for example `kinect`."""

    def problem(self) -> WorldError | None:
        """Return why no device of this make can be used here, for example a missing library; None where they can."""

    def devices(self) -> Sequence[PluggedDevice]:
        """Return what is plugged in now, used or not. Quick; nothing where nothing is there, never an error."""

    def sensor(self, serial: str) -> Sensor:
        """Return the sensor of a serial, which need not be plugged in.

        Nothing is opened or started yet; `open` raises a `WorldError` with a remedy as long as the device is not
        there, and can be tried again.
        """


@cache
def known_drivers() -> tuple[Driver, ...]:
    """Return the drivers of all makes, one each for the whole process: a driver owns its library.

    Making them loads no library.
    """
    from fruitgui.sensors.kinect.driver import KinectDriver
    from fruitgui.sensors.oak import OAK
    from fruitgui.sensors.orbbec import ORBBEC
    from fruitgui.sensors.realsense import REALSENSE

    return (KinectDriver(), REALSENSE, ORBBEC, OAK)
