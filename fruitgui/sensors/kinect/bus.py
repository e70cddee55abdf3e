"""The Kinects on the USB bus: which there are, in libfreenect's order, and what belongs to each."""

from __future__ import annotations

import ctypes
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from enum import Enum, auto
from types import TracebackType
from typing import Self

from fruitgui.errors import WorldError
from fruitgui.sensors.kinect.library import DeviceDescriptor, Library
from fruitgui.sensors.kinect.models import Model, camera_model, is_microphone, is_motor

_STRING = 256


class Unknown(Enum):
    """Why a serial is not known: the device may not be opened, does not answer, or has none."""

    CLOSED = auto()
    MUTE = auto()
    NONE = auto()


@dataclass(frozen=True, slots=True)
class Camera:
    """A Kinect's camera that is plugged in.

    Attributes:
        index: as libfreenect counts cameras.
        serial: the camera's, or else its microphone's; empty where it is not known.
        model: which Kinect.
        bus: number of the USB bus.
        release: of the device's firmware, as it says.
        unknown: why its serial is not known; None where it is.
    """

    index: int
    serial: str
    model: Model
    bus: int
    release: int
    unknown: Unknown | None = None

    @property
    def firmware(self) -> str:
        """Its release as people write it."""
        return f"{self.release >> 8:x}.{self.release & 0xFF:02x}"


@dataclass(frozen=True, slots=True)
class _Listed:
    """A USB device in a list of them; its address holds as long as the list does."""

    address: int
    parent: int | None
    vendor: int
    product: int
    release: int
    serial_index: int
    bus: int

    @property
    def model(self) -> Model | None:
        """Which Kinect's camera it is; None where it is none."""
        return camera_model(self.vendor, self.product, self.release)


class Bus:
    """A context of libusb: `open` it, or use it in a `with`. Not thread-safe.

    Raises:
        WorldError: USB cannot be used at all.
    """

    def __init__(self, usb: Library) -> None:
        self._usb = usb
        self._context = ctypes.c_void_p()

    def __enter__(self) -> Self:
        self.open()
        return self

    def __exit__(
        self, _kind: type[BaseException] | None, _error: BaseException | None, _trace: TracebackType | None
    ) -> None:
        self.close()

    @property
    def context(self) -> ctypes.c_void_p:
        """The context, for libfreenect to share, so that both count devices in one order."""
        return self._context

    def open(self) -> None:
        """Begin."""
        if self._usb.init(ctypes.byref(self._context)) < 0:
            raise WorldError("no_usb", "USB cannot be used on this computer.", "Check that it is switched on.")

    def close(self) -> None:
        """End. Any number of times."""
        if self._context:
            self._usb.exit(self._context)
            self._context = ctypes.c_void_p()

    def cameras(self) -> list[Camera]:
        """Return the cameras in libfreenect's order, with those that may not be opened."""
        with self._listed() as devices:
            return [camera for _, camera in self._named(devices)]

    def open_motor(self, serial: str) -> ctypes.c_void_p | None:
        """Open the motor that belongs to a camera, until `close_motor`; None where none certainly does.

        Camera and motor of one Kinect hang on one hub inside of it. libfreenect 0.5 takes the motor that has the
        camera's place in the list, which may be another Kinect's.
        """
        with self._listed() as devices:
            mine = [device for device, camera in self._named(devices) if camera.serial == serial]
            motor = _part_of(mine[0], devices, is_motor) if len(mine) == 1 else None
            handle = None if motor is None else self._open(motor)
            if handle is not None and self._usb.claim_interface(handle, 0) < 0:
                self._usb.close(handle)
                return None
            return handle

    def close_motor(self, handle: ctypes.c_void_p) -> None:
        """Let go of a motor."""
        self._usb.release_interface(handle, 0)
        self._usb.close(handle)

    def control(self, handle: ctypes.c_void_p, kind: int, request: int, value: int, length: int = 0) -> bytes | None:
        """Send a control request; return what came back, or None where it failed within a quarter of a second."""
        buffer = ctypes.create_string_buffer(max(length, 1))
        got = self._usb.control_transfer(handle, kind, request, value & 0xFFFF, 0, buffer, length, 250)
        return buffer.raw[:got] if got >= 0 else None

    def _named(self, devices: list[_Listed]) -> list[tuple[_Listed, Camera]]:
        """Return the cameras in their order, each as listed and as known.

        All are asked for their serials at once: each that does not answer costs a second, and several no more than one.
        """
        cameras = [(one, model) for one in devices if (model := one.model) is not None]
        serials: dict[int, tuple[str, Unknown | None]] = {}

        def ask(place: int) -> None:
            serials[place] = self._serial_of(cameras[place][0], devices)

        others = [
            threading.Thread(target=ask, args=(place,), name=f"kinect {place} asked", daemon=True)
            for place in range(1, len(cameras))
        ]
        for thread in others:
            thread.start()
        if cameras:
            ask(0)
        for thread in others:
            thread.join()
        return [
            (one, Camera(place, serials[place][0], model, one.bus, one.release, serials[place][1]))
            for place, (one, model) in enumerate(cameras)
        ]

    def _serial_of(self, camera: _Listed, devices: list[_Listed]) -> tuple[str, Unknown | None]:
        """Return a camera's serial, and why it is not known where it is empty."""
        serial, unknown = self._string(camera)
        if serial.strip("0") or unknown in (Unknown.CLOSED, Unknown.MUTE):
            return serial, unknown
        ear = _part_of(camera, devices, is_microphone)
        heard, deaf = ("", Unknown.NONE) if ear is None else self._string(ear)
        return (serial, unknown) if deaf is Unknown.NONE else (heard, deaf)

    def _open(self, device: _Listed) -> ctypes.c_void_p | None:
        handle = ctypes.c_void_p()
        return handle if self._usb.open(device.address, ctypes.byref(handle)) == 0 else None

    def _string(self, device: _Listed) -> tuple[str, Unknown | None]:
        """Return a device's own serial, and why it is not known where it is empty."""
        handle = self._open(device)
        if handle is None:
            return "", Unknown.CLOSED
        buffer = ctypes.create_string_buffer(_STRING)
        index = device.serial_index
        got = self._usb.get_string_descriptor_ascii(handle, index, buffer, _STRING) if index else 0
        self._usb.close(handle)
        serial = buffer.raw[: max(got, 0)].decode("ascii", "replace").strip("\0 ")
        return serial, None if serial else Unknown.MUTE if got < 0 else Unknown.NONE

    @contextmanager
    def _listed(self) -> Iterator[list[_Listed]]:
        addresses = ctypes.POINTER(ctypes.c_void_p)()
        count = self._usb.get_device_list(self._context, ctypes.byref(addresses))
        try:
            devices = [self._describe(addresses[number]) for number in range(max(count, 0))]
            yield [device for device in devices if device is not None]
        finally:
            if count >= 0:
                self._usb.free_device_list(addresses, 1)

    def _describe(self, address: int) -> _Listed | None:
        says = DeviceDescriptor()
        if self._usb.get_device_descriptor(address, ctypes.byref(says)) < 0:
            return None
        parent, bus = self._usb.get_parent(address), self._usb.get_bus_number(address)
        return _Listed(address, parent, says.vendor, says.product, says.device, says.serial, bus)


def _part_of(camera: _Listed, devices: list[_Listed], is_part: Callable[[int, int], bool]) -> _Listed | None:
    """Return the part that certainly is this camera's: both are the only ones of their kind on one hub.

    Where hubs are not told, or are not the Kinects' own, as in a virtual machine, all of a bus hang together.
    """
    beside = [one for one in devices if (one.bus, one.parent) == (camera.bus, camera.parent)]
    cameras = [one for one in beside if one.model is not None]
    parts = [one for one in beside if is_part(one.vendor, one.product)]
    return parts[0] if len(cameras) == len(parts) == 1 else None


def meant(serial: str, cameras: list[Camera]) -> Camera | None:
    """Return the camera of a serial; of none, the only one that is plugged in where it has none."""
    if not serial:
        return cameras[0] if len(cameras) == 1 and cameras[0].unknown is Unknown.NONE else None
    return next((camera for camera in told_apart(cameras) if camera.serial == serial), None)


def told_apart(cameras: list[Camera]) -> list[Camera]:
    """Return those that can be opened by serial: the serial is known, and no other has it."""
    serials = [camera.serial for camera in cameras]
    return [camera for camera in cameras if camera.serial and serials.count(camera.serial) == 1]
