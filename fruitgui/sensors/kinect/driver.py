"""Kinects that are plugged in, found and made into sensors."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence

from fruitgui.errors import FruitguiError, WorldError
from fruitgui.sensors.drivers import PluggedDevice
from fruitgui.sensors.kinect import library
from fruitgui.sensors.kinect.bus import Bus, Camera, Unknown, told_apart
from fruitgui.sensors.kinect.device import Device, Hear
from fruitgui.sensors.kinect.motor import Motor
from fruitgui.sensors.kinect.sensor import KinectSensor
from fruitgui.sensors.kinect.session import LeftBehind

MAKE = "kinect"

_LOOK_S = 0.5
"""Who asks what is plugged in waits no longer; on a bus that is slow to answer, they hear what was found before."""

_NOT_ALLOWED = "This user may not open it: install the USB rules (fruitgui sensors --install-udev-rules)."
_NOT_TOLD_APART = "It cannot be told apart from another one that has the same serial: plug in only one of them."
_HINDRANCES = {
    Unknown.CLOSED: ("closed", _NOT_ALLOWED),
    Unknown.MUTE: ("hangs", "It does not answer: unplug its USB cable and its power supply, and plug both in again."),
    Unknown.NONE: ("no_serial", "It cannot be told apart from another one: it has no serial."),
    None: ("no_serial", _NOT_TOLD_APART),
}
"""Why a Kinect cannot be opened: a problem's code, and a sentence."""


class KinectDriver:
    """The driver of Kinects v1. Loads its libraries when it is first asked for something.

    Args:
        now_s: the host's clock, in which frames have their times.
    """

    def __init__(self, now_s: Callable[[], float] = time.monotonic) -> None:
        self._now_s = now_s
        self._lock = threading.Lock()
        self._bus: Bus | None = None
        self._looking: threading.Thread | None = None
        self._found: tuple[PluggedDevice, ...] = ()
        self._left = LeftBehind()

    @property
    def make(self) -> str:
        """`kinect`."""
        return MAKE

    def problem(self) -> WorldError | None:
        """Return which library is missing; None where none is."""
        try:
            library.libusb()
            library.libfreenect()
        except WorldError as error:
            return error
        return None

    def devices(self) -> Sequence[PluggedDevice]:
        """Return the Kinects that are plugged in, used or not; never raises, never waits long."""
        with self._lock:
            if self._looking is None or not self._looking.is_alive():
                self._looking = threading.Thread(target=self._look, name="kinects plugged in", daemon=True)
                self._looking.start()
            looking = self._looking
        looking.join(_LOOK_S)
        return self._found

    def sensor(self, serial: str) -> KinectSensor:
        """Return the sensor of a serial, which need not be plugged in."""

        def device(hear: Hear) -> Device:
            return Device(library.libfreenect(), Bus(library.libusb()), serial, hear, self._now_s)

        return KinectSensor(serial, device, self._left, lambda: Motor(Bus(library.libusb()), serial))

    def _look(self) -> None:
        """Ask the bus; one thread does so at a time."""
        try:
            if self._bus is None:
                bus = Bus(library.libusb())
                bus.open()
                self._bus = bus
            cameras = self._bus.cameras()
        except FruitguiError:
            cameras = []
        known = told_apart(cameras)
        self._found = tuple(_plugged(camera, camera in known) for camera in cameras)


def _plugged(camera: Camera, known: bool) -> PluggedDevice:
    code, sentence = ("", "") if known else _HINDRANCES[camera.unknown]
    serial = camera.serial if known else ""
    limits = (*camera.model.limits, sentence) if sentence else camera.model.limits
    return PluggedDevice(MAKE, camera.model.name, serial, camera.firmware, limits, camera.bus, hindrance=code)
