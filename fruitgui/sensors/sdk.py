"""Sensors that are read through their maker's own SDK: what is the same for all of them.

A make is one file beside this: a `Camera` that says how its SDK is asked, and a driver
that lists its devices.
"""

from __future__ import annotations

import contextlib
import importlib
import logging
import re
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any, Protocol

from fruitgui.errors import FruitguiError, WorldError
from fruitgui.frame import U8, U16, Frame, Intrinsics
from fruitgui.sensors.drivers import PluggedDevice
from fruitgui.sensors.host_clock import DeviceClock, HostClock
from fruitgui.sensors.registration import Registration
from fruitgui.sensors.sensor import Projector, SensorInfo, SensorTimeoutError
from fruitgui.sensors.usb.plugged import is_plugged

log = logging.getLogger(__name__)

Sdk = Any
"""An SDK's module, or what it makes: none of them tells its types."""

RATE_HZ = 30.0
USUAL = Intrinsics(640, 480, 610.0, 610.0, 319.5, 239.5)
"""A usual colour camera, until a device has told of its own."""


@dataclass(frozen=True, slots=True)
class Opened:
    """What a camera tells of itself once it streams.

    Attributes:
        model: for people.
        color: its colour camera.
        registration: how its depth comes into the colour picture; None where it is there already.
        firmware: as it says; empty where it does not.
    """

    model: str
    color: Intrinsics
    registration: Registration | None = None
    firmware: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Shot:
    """One capture as an SDK gives it; the pictures may be views of the SDK's own memory.

    Attributes:
        number: of the depth picture, as the device counts.
        device_s: when depth was taken, by the device's clock.
        color: RGB. depth_mm: 0 = no reading.
    """

    number: int
    device_s: float
    color: U8
    depth_mm: U16


class Camera(Protocol):
    """One device in its SDK's hands. What an SDK raises may pass through: `SdkSensor` puts it into words."""

    def start(self) -> Opened:
        """Take the device and begin to stream."""

    def next(self, timeout_s: float) -> Shot | None:
        """Return the next capture; None where none comes in time. Raises `FruitguiError` where none will come."""

    def lock_color(self, on: bool) -> bool:
        """Hold exposure and white balance, or let them follow the light; tell whether it could be done."""

    def stop(self) -> None:
        """End streaming and give the device back. Any number of times."""


class SdkSensor:
    """One device; follows the `Sensor` protocol. Constructing touches no device and loads no SDK.

    Frames have the host's monotonic clock.

    Args:
        make: the driver's word. maker: for people. serial: of the device.
        camera: makes it, not yet started; loads the SDK.
        projector: what its light does to others; none of these is switched.
        clock: makes what brings the device's times to another clock; to the host's unless given.
    """

    def __init__(
        self,
        make: str,
        maker: str,
        serial: str,
        camera: Callable[[], Camera],
        projector: Projector,
        clock: Callable[[], DeviceClock] = HostClock,
    ) -> None:
        self._name = f"{make}_" + re.sub(r"\W", "_", serial, flags=re.ASCII)
        self._maker, self._serial = maker, serial
        self._make_camera, self._make_clock = camera, clock
        self._projector = projector
        self._opened = Opened(maker, USUAL)
        self._camera: Camera | None = None
        self._runs = False
        self._clock = clock()
        self._last_number, self._sequence = -1, -1

    @property
    def info(self) -> SensorInfo:
        """Who this is; its cameras are a usual one's until it has run."""
        opened = self._opened
        return SensorInfo(
            self._name, self._maker, opened.model, self._serial, opened.color, RATE_HZ, projector=self._projector,
            firmware=opened.firmware,
        )  # fmt: skip

    def open(self) -> None:
        """Load the SDK. Raises `WorldError` where it is not installed, or the device is not there."""
        self.close()
        self._camera = self._make_camera()

    def start(self) -> None:
        """Take the device and begin to capture. Raises `WorldError` where it cannot be had."""
        camera = self._taken()
        with self._in_words(), contextlib.ExitStack() as undo:
            undo.callback(camera.stop)
            self._opened = camera.start()
            undo.pop_all()
        self._runs, self._clock = True, self._make_clock()
        self._last_number, self._sequence = -1, -1

    def read(self, timeout_s: float) -> Frame:
        """Return the next frame.

        Raises:
            SensorTimeoutError: none came in time.
            WorldError: it was not started, or is gone.
        """
        camera = self._taken()
        until_s = time.monotonic() + timeout_s
        while self._runs:
            with self._in_words():
                shot = camera.next(max(until_s - time.monotonic(), 1e-3))
            if shot is not None and shot.number > self._last_number:
                return self._frame(shot)
            if time.monotonic() >= until_s:
                raise SensorTimeoutError(self._name, timeout_s)
        raise WorldError("sensor_not_started", f"Sensor {self._name} is not running.", "Start it first.")

    def projector(self, on: bool) -> None:
        """Do nothing: none is switched."""

    def lock_color(self, on: bool) -> bool:
        """Hold exposure and white balance, or let them follow the light; tell whether it could be done."""
        with self._in_words():
            return self._taken().lock_color(on)

    def stop(self) -> None:
        """End capturing."""
        self._runs = False
        if self._camera is not None:
            self._camera.stop()

    def close(self) -> None:
        """Give the device back."""
        self.stop()
        self._camera = None

    def _frame(self, shot: Shot) -> Frame:
        """Return a frame of its own memory; numbers that the device left out are missing in its sequence too."""
        skipped = 0 if self._last_number < 0 else shot.number - self._last_number - 1
        self._last_number, self._sequence = shot.number, self._sequence + 1 + skipped
        time_s = self._clock.time_s(shot.device_s, time.monotonic())
        registration = self._opened.registration
        depth_mm = shot.depth_mm.copy() if registration is None else registration.apply(shot.depth_mm)
        return Frame(
            self._name, self._sequence, time_s, shot.color.copy(), depth_mm, self._opened.color,
            clock_leaps=self._clock.jumps, time_sure=self._clock.sure,
        )  # fmt: skip

    def _taken(self) -> Camera:
        if self._camera is None:
            raise WorldError("sensor_not_open", f"The sensor {self._name} is not open.", "Open it first.")
        return self._camera

    @contextlib.contextmanager
    def _in_words(self) -> Iterator[None]:
        """Put what the SDK raises into words; each has errors of its own, which all are `Exception`s."""
        try:
            yield
        except FruitguiError:
            raise
        except Exception as error:
            raise WorldError(
                "sensor_failed",
                f"Sensor {self._name} failed: {str(error)[:120]}.",
                "Check its USB 3 cable and that no other program uses it; it is opened again by itself.",
                values={"sensor": self._name},
            ) from error


def gone(maker: str, serial: str) -> WorldError:
    """A device is not plugged in any more, or not yet."""
    return WorldError(
        "sensor_gone",
        f"The {maker} sensor {serial} is not plugged in.",
        "Check its USB cable; it starts by itself when it returns.",
        values={"sensor": serial},
    )


class SdkDriver:
    """A make whose SDK is installed by those who have such devices; it is loaded once one is plugged in.

    Args:
        make: the driver's word. maker: for people. module: the SDK's. install: the command that installs it.
        listed: returns the devices that the loaded SDK lists.
        camera: returns the camera of a serial in the loaded SDK.
        projector: what the light of such a sensor does to others.
        plugged: tells whether the USB shows such a device.
    """

    def __init__(
        self,
        make: str,
        maker: str,
        module: str,
        install: str,
        listed: Callable[[Sdk], Sequence[PluggedDevice]],
        camera: Callable[[Sdk, str], Camera],
        projector: Projector,
        plugged: Callable[[str], bool] = is_plugged,
    ) -> None:
        self._make, self._maker, self._module, self._install = make, maker, module, install
        self._listed, self._camera, self._plugged = listed, camera, plugged
        self._projector = projector

    @property
    def make(self) -> str:
        """The driver's word."""
        return self._make

    def problem(self) -> WorldError | None:
        """Return that the SDK is not installed; None where it is."""
        if find_spec(self._module) is not None:
            return None
        return WorldError(
            "sdk_missing",
            f"{self._maker} sensors need a library that is not installed.",
            f"Install it with: {self._install}",
            values={"maker": self._maker},
        )

    def devices(self) -> Sequence[PluggedDevice]:
        """Return what is plugged in; the SDK is not loaded for nothing."""
        if self.problem() is not None or not self._plugged(self._make):
            return ()
        try:
            return self._listed(self._sdk())
        except Exception:  # an SDK raises what it likes; opening by serial says why
            log.exception("%s cannot list its devices", self._module)
            return ()

    def sensor(self, serial: str) -> SdkSensor:
        """Return the sensor of a serial, which need not be plugged in."""
        return SdkSensor(self._make, self._maker, serial, lambda: self._found(serial), self._projector)

    def _found(self, serial: str) -> Camera:
        """Return the camera of a serial. Raises `WorldError` where it is not plugged in, or the SDK cannot be used."""
        sdk = self._sdk()
        if serial not in {one.serial for one in self._listed(sdk)}:
            raise gone(self._maker, serial)
        return self._camera(sdk, serial)

    def _sdk(self) -> Sdk:
        """Return the loaded SDK. Raises `WorldError` where it cannot be loaded."""
        missing = self.problem()
        if missing is not None:
            raise missing
        try:
            with contextlib.redirect_stdout(sys.stderr):  # some greet everybody who imports them
                return importlib.import_module(self._module)
        except (ImportError, OSError) as error:
            raise WorldError(
                "sdk_broken",
                f"The library of {self._maker} sensors cannot be loaded: {str(error)[:120]}.",
                f"Install it again with: {self._install} --force-reinstall",
                values={"maker": self._maker},
            ) from error
