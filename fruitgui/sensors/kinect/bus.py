"""The Kinects on the USB bus: which there are, in libfreenect's order, and what belongs to each."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from types import TracebackType
from typing import Self

from fruitgui.errors import WorldError
from fruitgui.sensors.kinect.library import DeviceDescriptor, Library
from fruitgui.sensors.kinect.models import Model, camera_model, is_microphone, is_motor

_STRING = 256


@dataclass(frozen=True, slots=True)
class Camera:
    """A Kinect's camera that is plugged in.

    Attributes:
        index: as libfreenect counts cameras.
        serial: the camera's, or else its microphone's; empty where it may not be asked.
        model: which Kinect.
        bus: number of the USB bus.
        release: of the device's firmware, as it says.
    """

    index: int
    serial: str
    model: Model
    bus: int
    release: int


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
            return list(self._cameras(devices))

    def open_motor(self, serial: str) -> ctypes.c_void_p | None:
        """Open the motor that belongs to a camera, until `close_motor`; None where none certainly does.

        Camera and motor of one Kinect hang on one hub inside of it. libfreenect 0.5 takes the motor that has the
        camera's place in the list, which may be another Kinect's.
        """
        with self._listed() as devices:
            cameras = [one for one in devices if camera_model(one.vendor, one.product, one.release) is not None]
            mine = [one for one in cameras if self._serial_of(one, devices) == serial]
            motors = [
                one for one in devices if is_motor(one.vendor, one.product) and mine and _on_one_hub(one, mine[0])
            ]
            handle = self._open(motors[0]) if len(mine) == len(motors) == 1 else None
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

    def _cameras(self, devices: list[_Listed]) -> Iterator[Camera]:
        index = 0
        for device in devices:
            model = camera_model(device.vendor, device.product, device.release)
            if model is not None:
                yield Camera(index, self._serial_of(device, devices), model, device.bus, device.release)
                index += 1

    def _serial_of(self, camera: _Listed, devices: list[_Listed]) -> str:
        serial = self._string(camera)
        if not serial or serial.strip("0"):
            return serial
        ears = [one for one in devices if is_microphone(one.vendor, one.product) and _on_one_hub(one, camera)]
        return (self._string(ears[0]) if len(ears) == 1 else "") or serial

    def _open(self, device: _Listed) -> ctypes.c_void_p | None:
        handle = ctypes.c_void_p()
        return handle if self._usb.open(device.address, ctypes.byref(handle)) == 0 else None

    def _string(self, device: _Listed) -> str:
        """Return a device's serial; empty where it has none, may not be opened, or does not answer."""
        handle = self._open(device) if device.serial_index else None
        if handle is None:
            return ""
        buffer = ctypes.create_string_buffer(_STRING)
        got = self._usb.get_string_descriptor_ascii(handle, device.serial_index, buffer, _STRING)
        self._usb.close(handle)
        return buffer.raw[:got].decode("ascii", "replace").strip("\0 ") if got > 0 else ""

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


def _on_one_hub(one: _Listed, other: _Listed) -> bool:
    return one.parent is not None and one.parent == other.parent and one.bus == other.bus


def told_apart(cameras: list[Camera]) -> list[Camera]:
    """Return those that can be opened by serial: the serial is known, and no other has it."""
    serials = [camera.serial for camera in cameras]
    return [camera for camera in cameras if camera.serial and serials.count(camera.serial) == 1]
