"""libfreenect 0.5 and libusb as they are called: types and prototypes, nothing else.

libfreenect's headers are libfreenect.h and libfreenect_registration.h of 0.5.3.
Everything of libusb goes through the process's own symbols, and only those are
called that libfreenect itself calls: whatever stands in for libusb for one
stands in for the other.
"""

from __future__ import annotations

import ctypes
from ctypes import CFUNCTYPE, POINTER, Structure, c_char_p, c_double, c_float, c_int, c_int32, c_uint16, c_void_p
from ctypes import c_int8 as i8
from ctypes import c_int16 as i16
from ctypes import c_uint8 as u8
from ctypes import c_uint32 as u32
from typing import Any

from fruitgui.errors import WorldError
from fruitgui.sensors.kinect.factory import FIELDS

LIBFREENECT, LIBUSB = "libfreenect.so.0.5", "libusb-1.0.so.0"

CAMERA_ONLY = 2
MEDIUM, RGB, DEPTH_11BIT = 1, 0, 0
LOG_EVERY_PICTURE = 6
"""The level at which the library says of every picture how many of its packets arrived."""
AUTO_EXPOSURE, AUTO_WHITE_BALANCE = 1 << 14, 1 << 1

LOG_CALLBACK = CFUNCTYPE(None, c_void_p, c_int, c_char_p)
PICTURE_CALLBACK = CFUNCTYPE(None, c_void_p, c_void_p, u32)


class FrameMode(Structure):
    """`freenect_frame_mode`, 24 bytes, passed by value."""

    _fields_ = [
        ("reserved", u32), ("resolution", c_int32), ("format", c_int32), ("bytes", c_int32), ("width", i16),
        ("height", i16), ("data_bits", i8), ("padding_bits", i8), ("rate_hz", i8), ("is_valid", i8),
    ]  # fmt: skip


class ZeroPlaneInfo(Structure):
    """`freenect_zero_plane_info`."""

    _fields_ = [("emitter_cm", c_float), ("rgb_cm", c_float), ("reference_cm", c_float), ("pixel_cm", c_float)]


class RegistrationInfo(Structure):
    """`freenect_registration`: what the factory wrote, and tables made of it."""

    _fields_ = [
        ("info", c_int32 * len(FIELDS)), ("start_lines", c_uint16), ("end_lines", c_uint16),
        ("cropping_lines", c_uint16), ("zero_plane", ZeroPlaneInfo), ("const_shift", c_double),
        ("raw_to_mm", POINTER(c_uint16)), ("depth_to_rgb", POINTER(c_int32)), ("table", POINTER(c_int32 * 2)),
    ]  # fmt: skip


class TimeVal(Structure):
    """`struct timeval`."""

    _fields_ = [("seconds", ctypes.c_long), ("microseconds", ctypes.c_long)]


class DeviceDescriptor(Structure):
    """`libusb_device_descriptor`."""

    _fields_ = [
        ("length", u8), ("kind", u8), ("usb", c_uint16), ("device_class", u8), ("subclass", u8), ("protocol", u8),
        ("packet_size", u8), ("vendor", c_uint16), ("product", c_uint16), ("device", c_uint16), ("manufacturer", u8),
        ("product_name", u8), ("serial", u8), ("configurations", u8),
    ]  # fmt: skip


_FREENECT: dict[str, tuple[Any, list[Any]]] = {
    "init": (c_int, [POINTER(c_void_p), c_void_p]),
    "shutdown": (c_int, [c_void_p]),
    "select_subdevices": (None, [c_void_p, c_int]),
    "set_log_level": (None, [c_void_p, c_int]),
    "set_log_callback": (None, [c_void_p, LOG_CALLBACK]),
    "process_events_timeout": (c_int, [c_void_p, POINTER(TimeVal)]),
    "open_device": (c_int, [c_void_p, POINTER(c_void_p), c_int]),
    "close_device": (c_int, [c_void_p]),
    "find_video_mode": (FrameMode, [c_int, c_int]),
    "find_depth_mode": (FrameMode, [c_int, c_int]),
    "set_video_mode": (c_int, [c_void_p, FrameMode]),
    "set_depth_mode": (c_int, [c_void_p, FrameMode]),
    "set_video_callback": (None, [c_void_p, PICTURE_CALLBACK]),
    "set_depth_callback": (None, [c_void_p, PICTURE_CALLBACK]),
    "start_video": (c_int, [c_void_p]),
    "stop_video": (c_int, [c_void_p]),
    "start_depth": (c_int, [c_void_p]),
    "stop_depth": (c_int, [c_void_p]),
}
_FREENECT_MORE: dict[str, tuple[Any, list[Any]]] = {
    "copy_registration": (RegistrationInfo, [c_void_p]),
    "destroy_registration": (c_int, [POINTER(RegistrationInfo)]),
    "set_flag": (c_int, [c_void_p, c_int, c_int]),
}
"""Not every build has these."""

_USB: dict[str, tuple[Any, list[Any]]] = {
    "init": (c_int, [POINTER(c_void_p)]),
    "exit": (None, [c_void_p]),
    "get_device_list": (ctypes.c_ssize_t, [c_void_p, POINTER(POINTER(c_void_p))]),
    "free_device_list": (None, [POINTER(c_void_p), c_int]),
    "get_device_descriptor": (c_int, [c_void_p, POINTER(DeviceDescriptor)]),
    "get_bus_number": (u8, [c_void_p]),
    "get_parent": (c_void_p, [c_void_p]),
    "open": (c_int, [c_void_p, POINTER(c_void_p)]),
    "close": (None, [c_void_p]),
    "get_string_descriptor_ascii": (c_int, [c_void_p, u8, ctypes.c_char_p, c_int]),
    "claim_interface": (c_int, [c_void_p, c_int]),
    "release_interface": (c_int, [c_void_p, c_int]),
    "control_transfer": (
        c_int,
        [c_void_p, u8, u8, c_uint16, c_uint16, ctypes.c_char_p, c_uint16, ctypes.c_uint],
    ),
}


class Library:
    """Functions of a shared library by their names without the prefix; made by `libfreenect` and `libusb`."""

    def __init__(self, library: ctypes.CDLL, prefix: str, prototypes: dict[str, tuple[Any, list[Any]]]) -> None:
        self._library, self._prefix = library, prefix
        for name, (result, arguments) in prototypes.items():
            function = getattr(library, prefix + name)
            function.restype, function.argtypes = result, arguments

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401 - functions of C are of any type
        """Return a function."""
        return getattr(self._library, self._prefix + name)


def libfreenect(path: str = LIBFREENECT) -> Library:
    """Load libfreenect.

    Raises:
        WorldError: it is not installed.
    """
    try:
        library = ctypes.CDLL(path)
        more = {name: types for name, types in _FREENECT_MORE.items() if hasattr(library, f"freenect_{name}")}
        return Library(library, "freenect_", {**_FREENECT, **more})
    except (OSError, AttributeError) as error:
        raise WorldError(
            "no_libfreenect",
            "Kinects need the library libfreenect 0.5, and it is not installed.",
            "Install it: sudo apt-get install libfreenect0.5",
        ) from error


def libusb() -> Library:
    """Return the process's libusb, loaded where nothing stands in for it.

    Raises:
        WorldError: it is not installed.
    """
    try:
        if not hasattr(ctypes.CDLL(None), "libusb_init"):
            ctypes.CDLL(LIBUSB, mode=ctypes.RTLD_GLOBAL)
        return Library(ctypes.CDLL(None), "libusb_", _USB)
    except (OSError, AttributeError) as error:
        raise WorldError(
            "no_libusb",
            "Kinects need the library libusb 1.0, and it is not installed.",
            "Install it: sudo apt-get install libusb-1.0-0",
        ) from error
