"""What a test asks of the emulated USB bus of its own process."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import IntEnum

import numpy as np

from fruitgui.frame import U8, U16
from fruitgui.sensors.kinect.depth_table import ZeroPlane
from tests.emulated_usb.factory_made import registration_bytes

MODEL_1414, MODEL_1473, MODEL_K4W = range(3)
NO_SERIAL = "0000000000000000"
WAIT_MS = 5000
"""A picture that finds no room is lost at once at a real device's pace; flat out it waits so long."""

DEPTH_ON, DEPTH_REGISTER, VIDEO_REGISTER = 2, 0x06, 0x05
LED, TILT, CMOS = 0x20006, 0x20031, 0x10000
"""Numbers in the register log of what is no register of the camera."""


class Hang(IntEnum):
    """What of a device never comes back: nothing, its control requests, its events, or any byte of an answer."""

    NOTHING = 0
    CONTROL = 1
    EVENTS = 2
    EMPTY = 3


class Garbage(IntEnum):
    """What some of a stream's packets are."""

    NONE = 0
    NO_HEADER = 1
    ODD_FLAG = 2
    SHORT = 3
    NOISE = 4


@dataclass(frozen=True, slots=True)
class Kinect:
    """A Kinect to be plugged in.

    Attributes:
        serial: of its camera; models other than the 1414 have none, and give that of their microphone.
        model: which. bus: number of its USB bus; one of its own unless given.
        zero_plane: what it says of its depth.
        registration: what the factory wrote into it, 116 bytes; a usual Kinect's unless given.
    """

    serial: str
    model: int = MODEL_1414
    bus: int | None = None
    zero_plane: ZeroPlane = ZeroPlane()  # noqa: RUF009 - frozen
    registration: bytes = field(default_factory=registration_bytes)


@dataclass(frozen=True, slots=True)
class Written:
    """A register that was written: when (seconds, monotonic), of which Kinect, which, and what."""

    time_s: float
    kinect: int
    register: int
    value: int


class _LogEntry(ctypes.Structure):
    _fields_ = [("t_ns", ctypes.c_int64), ("kinect", ctypes.c_int), ("register", ctypes.c_int), ("value", ctypes.c_int)]


class Emulation:
    """The bus. May be called from any thread; what blocks does so without Python's lock."""

    def __init__(self) -> None:
        self._usb = ctypes.CDLL(None)
        assert hasattr(self._usb, "emulated_reset"), "this process has a real USB bus"
        self.kinects: tuple[Kinect, ...] = ()
        self._usb.emulated_reset(0)

    def plug_in(self, *kinects: Kinect) -> None:
        """Let these be plugged in, and no others; they are numbered from 0."""
        self.kinects = kinects
        self._usb.emulated_reset(len(kinects))
        self.no_hubs(on=False)
        for number, one in enumerate(kinects):
            camera = one.serial if one.model == MODEL_1414 else NO_SERIAL
            self._usb.emulated_serial(number, camera.encode(), one.serial.encode())
            plane = one.zero_plane
            floats = np.array([plane.emitter_cm, 2.3, plane.reference_cm, plane.pixel_cm], np.float32).tobytes()
            self._usb.emulated_factory(number, one.registration, floats, 0, int(plane.const_shift_px))
            if one.bus is not None:
                self._usb.emulated_bus(number, one.bus)
            if one.model != MODEL_1414:
                self._usb.emulated_model(number, one.model)

    def plug(self, number: int, on: bool) -> None:
        """Unplug or plug in."""
        self._usb.emulated_plug(number, int(on))

    def push_depth(self, number: int, raw: U16, ticks: int, wait_ms: int = WAIT_MS) -> int:
        """Send a picture (480, 640) of raw depth; return how many packets were lost, -1 where depth is off."""
        buffer = np.ascontiguousarray(raw, dtype=np.uint16)
        return int(self._usb.emulated_push_depth(number, _address(buffer), ticks & 0xFFFFFFFF, wait_ms))

    def push_video(self, number: int, bayer: U8, ticks: int, wait_ms: int = WAIT_MS) -> int:
        """Send a picture (480, 640) of the colour camera's raw pixels, as `push_depth`."""
        buffer = np.ascontiguousarray(bayer, dtype=np.uint8)
        return int(self._usb.emulated_push_video(number, _address(buffer), ticks & 0xFFFFFFFF, wait_ms))

    def lose_every(self, number: int, packets: int) -> None:
        """Lose every so-manieth packet on the way; none where 0."""
        self._usb.emulated_lose_every(number, ctypes.c_long(packets))

    def lose(self, number: int, first: int, count: int) -> None:
        """Lose some packets of the next picture of depth, which has 242."""
        self._usb.emulated_lose(number, first, count)

    def garbage(self, number: int, kind: Garbage) -> None:
        """Spoil some packets of both streams from now on."""
        for stream in range(2):
            self._usb.emulated_garbage(number, stream, int(kind))

    def hang(self, number: int, what: Hang) -> None:
        """Let calls for this device never come back, or come back again."""
        self._usb.emulated_hang(number, int(what))

    def stall(self, number: int, on: bool) -> None:
        """Let the device refuse all control requests."""
        self._usb.emulated_stall(number, int(on))

    def busy(self, number: int, on: bool) -> None:
        """Let another program use the device."""
        self._usb.emulated_busy(number, int(on))

    def restarts(self, number: int, looks: int) -> None:
        """Let its microphone be away after each reset, for so many looks at what is plugged in."""
        self._usb.emulated_restarts(number, looks)

    def no_hubs(self, on: bool) -> None:
        """Let the system not say which devices hang on one hub."""
        self._usb.emulated_no_hubs(int(on))

    def denied(self, number: int, on: bool) -> None:
        """Let nobody open the device."""
        self._usb.emulated_denied(number, int(on))

    def no_bandwidth(self, number: int, on: bool) -> None:
        """Let no room be left on the device's controller."""
        self._usb.emulated_no_bandwidth(number, int(on))

    def kernel_driver(self, number: int, on: bool, *, stays: bool = False) -> None:
        """Let the kernel's own webcam driver have taken the camera, and let go of it when asked to, or not."""
        self._usb.emulated_kernel_driver(number, 2 if stays else int(on))

    def motor_order(self, order: Sequence[int]) -> None:
        """List the motors in another order than the cameras."""
        self._usb.emulated_motor_order((ctypes.c_int * len(order))(*order))

    def accelerate(self, number: int, x: int, y: int, z: int) -> None:
        """Set what the accelerometer reads, counts."""
        self._usb.emulated_accel(number, x, y, z)

    def led(self, number: int) -> int:
        """Return how the LED was set last."""
        return int(self._usb.emulated_led(number))

    def register(self, number: int, register: int) -> int:
        """Return a register's value."""
        return int(self._usb.emulated_register(number, register))

    def cmos(self, number: int, register: int) -> int:
        """Return the value of a register of the colour camera's chip."""
        return int(self._usb.emulated_cmos(number, register))

    def shines(self, number: int) -> bool:
        """Tell whether the projector is on."""
        return self.register(number, DEPTH_REGISTER) == DEPTH_ON

    def log(self) -> list[Written]:
        """Return the newest 65 536 registers that were written, oldest first."""
        entries = (_LogEntry * 65536)()
        count = self._usb.emulated_log(entries, len(entries))
        return [Written(one.t_ns * 1e-9, one.kinect, one.register, one.value) for one in entries[:count]]

    @property
    def left_open(self) -> tuple[int, int, int]:
        """How many device handles, contexts and transfers are in use."""
        return (
            int(self._usb.emulated_open_handles()),
            int(self._usb.emulated_contexts()),
            int(self._usb.emulated_transfers()),
        )


def _address(buffer: U16 | U8) -> ctypes.c_void_p:
    return ctypes.c_void_p(buffer.ctypes.data)
