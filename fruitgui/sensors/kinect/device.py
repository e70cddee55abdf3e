"""An open Kinect as the library gives it: opened by serial, its pictures, its streams. One thread makes all calls."""

from __future__ import annotations

import ctypes
import itertools
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from fruitgui.frame import U8, U16
from fruitgui.sensors.kinect import library as lib
from fruitgui.sensors.kinect.bus import Camera, meant
from fruitgui.sensors.kinect.cameras import HEIGHT, WIDTH
from fruitgui.sensors.kinect.depth_table import ZeroPlane
from fruitgui.sensors.kinect.factory import Factory
from fruitgui.sensors.kinect.faults import not_obeyed, not_opened, not_there, usb_full
from fruitgui.sensors.kinect.packets import PacketLog, Stream

_TRIES = 3
_ANEW_S, _LOOK_S = 3.0, 0.1
"""How long a part that was reset may take to be there again, and how often one looks."""
_FAILURES = 100
"""The library fails to handle events now and then, as when a signal comes; so often in a row it is broken."""


_DEPTH_BUFFER = ctypes.c_uint16 * WIDTH * HEIGHT
_COLOR_BUFFER = ctypes.c_uint8 * 3 * WIDTH * HEIGHT


@dataclass(frozen=True, slots=True)
class Opened:
    """What an open device says of itself."""

    camera: Camera
    factory: Factory


@dataclass(frozen=True, slots=True, eq=False)
class Picture:
    """A picture as it came from the device.

    Attributes:
        stamp: of the device, 32 bits.
        arrived_s: by the host's monotonic clock.
        pixels: (height, width) uint16 raw depth, or (height, width, 3) uint8 RGB.
        whole: all of it arrived.
    """

    stamp: int
    arrived_s: float
    pixels: U16 | U8
    whole: bool


class CameraBus(Protocol):
    """Where cameras are found, in the order in which the library counts them."""

    @property
    def context(self) -> ctypes.c_void_p:
        """What the library shares."""

    def open(self) -> None:
        """Begin."""

    def close(self) -> None:
        """End."""

    def cameras(self) -> list[Camera]:
        """Return what is plugged in."""


Hear = Callable[[Stream, Picture], None]


class Device:
    """A Kinect's camera. Only its camera: the library may take another Kinect's motor for its own.

    Args:
        freenect: the library.
        bus: not open; closed with the device.
        serial: of the device; empty for the only one that is plugged in, where it has none.
        hear: is called for each picture, in the thread that calls `pump`; its pixels are its own.
        now_s: the host's clock.
    """

    def __init__(
        self,
        freenect: lib.Library,
        bus: CameraBus,
        serial: str,
        hear: Hear,
        now_s: Callable[[], float] = time.monotonic,
    ) -> None:
        self._freenect, self._bus, self._serial, self._hear, self._now_s = freenect, bus, serial, hear, now_s
        self._context, self._device = ctypes.c_void_p(), ctypes.c_void_p()
        self._log = PacketLog()
        self._failures = 0
        self._running: set[Stream] = set()
        self._callbacks = (
            lib.LOG_CALLBACK(lambda _context, level, line: self._log.hear(level, line.decode("utf-8", "replace"))),
            lib.PICTURE_CALLBACK(lambda _device, data, stamp: self._take(Stream.DEPTH, data, stamp)),
            lib.PICTURE_CALLBACK(lambda _device, data, stamp: self._take(Stream.VIDEO, data, stamp)),
        )

    @property
    def handle(self) -> ctypes.c_void_p:
        """The library's own."""
        return self._device

    @property
    def gone(self) -> bool:
        """Whether the device was unplugged."""
        return self._log.gone or self._failures > _FAILURES

    def open(self) -> Opened:
        """Open it.

        Raises:
            WorldError: it is not there, may not be opened, is used by another program, or does not answer.
        """
        self._bus.open()
        if self._freenect.init(ctypes.byref(self._context), self._bus.context) < 0:
            raise not_opened(self._serial, self._log.errors)
        log, depth, video = self._callbacks
        self._freenect.set_log_level(self._context, lib.LOG_EVERY_PICTURE)
        self._freenect.set_log_callback(self._context, log)
        self._freenect.select_subdevices(self._context, lib.CAMERA_ONLY)
        camera = self._open_by_serial()
        self._freenect.set_video_mode(self._device, self._freenect.find_video_mode(lib.MEDIUM, lib.RGB))
        self._freenect.set_depth_mode(self._device, self._freenect.find_depth_mode(lib.MEDIUM, lib.DEPTH_11BIT))
        self._freenect.set_depth_callback(self._device, depth)
        self._freenect.set_video_callback(self._device, video)
        return Opened(camera, self._read_factory())

    def pump(self, timeout_s: float) -> None:
        """Wait for pictures at most so long, and take in those that came."""
        wait = lib.TimeVal(int(timeout_s), round(timeout_s % 1.0 * 1e6))
        failed = self._freenect.process_events_timeout(self._context, ctypes.byref(wait)) < 0
        self._failures = self._failures + 1 if failed else 0
        if self.gone:
            self._running.clear()  # the library has stopped them

    def switch(self, stream: Stream, on: bool) -> None:
        """Start or stop a stream; the projector shines as long as depth streams.

        Raises:
            WorldError: the device did not obey, or no room is left on its USB controller.
        """
        if on == (stream in self._running):
            return
        self._log.forget()
        name = f"{'start' if on else 'stop'}_{stream}"
        failed = getattr(self._freenect, name)(self._device) < 0
        (self._running.add if on else self._running.discard)(stream)
        if on and self._log.no_room:
            self.switch(stream, on=False)
            raise usb_full(self._serial)
        if failed or self._log.not_done():
            raise not_obeyed(self._serial, self._log.errors)

    def stop(self) -> None:
        """Stop both streams, depth first: the projector goes out.

        Raises:
            WorldError: the device did not obey.
        """
        try:
            self.switch(Stream.DEPTH, on=False)
        finally:
            self.switch(Stream.VIDEO, on=False)

    def lock_color(self, on: bool) -> bool:
        """Hold exposure and white balance as they are, or let them follow the light; tell whether it could be done."""
        if not hasattr(self._freenect, "set_flag"):
            return False
        flags = (lib.AUTO_EXPOSURE, lib.AUTO_WHITE_BALANCE)
        return all(self._freenect.set_flag(self._device, flag, int(not on)) >= 0 for flag in flags)

    def close(self) -> None:
        """Give everything back. Any number of times."""
        for stream in list(self._running):
            self._running.discard(stream)
            getattr(self._freenect, f"stop_{stream}")(self._device)
        if self._device:
            self._freenect.close_device(self._device)
            self._device = ctypes.c_void_p()
        if self._context:
            self._freenect.shutdown(self._context)
            self._context = ctypes.c_void_p()
        self._bus.close()

    def _open_by_serial(self) -> Camera:
        """Open the camera at the place that its serial has, and see that no place changed meanwhile.

        The library's own way to a serial counts only cameras that may be opened, but opens by counting all.
        """
        for _ in range(_TRIES):
            before = self._bus.cameras()
            mine = meant(self._serial, before)
            if mine is None:
                raise not_there(self._serial, before)
            self._log.forget()
            if self._freenect.open_device(self._context, ctypes.byref(self._device), mine.index) < 0:
                raise not_opened(self._serial, self._log.errors)
            if self._have_their_places([one.serial for one in before]):
                return mine
            self._freenect.close_device(self._device)
            self._device = ctypes.c_void_p()
        raise not_opened(self._serial, ("devices came and went",))

    def _have_their_places(self, serials: list[str]) -> bool:
        """Tell whether every camera has its place still.

        Opening some models resets their microphone: where it starts anew, it is waited for, to know the serial by it.
        """
        until_s = time.monotonic() + _ANEW_S
        while True:
            now = [one.serial for one in self._bus.cameras()]
            if now == serials:
                return True
            places = itertools.zip_longest(now, serials, fillvalue="none")
            if any(one.strip("0") and one != other for one, other in places) or time.monotonic() > until_s:
                return False
            time.sleep(_LOOK_S)

    def _read_factory(self) -> Factory:
        if not hasattr(self._freenect, "copy_registration"):
            return Factory()
        says = self._freenect.copy_registration(self._device)
        plane = says.zero_plane
        zero_plane = ZeroPlane(plane.emitter_cm, plane.reference_cm, plane.pixel_cm, says.const_shift)
        registration = tuple(int(value) for value in says.info)
        start_lines = int(says.start_lines)
        self._freenect.destroy_registration(ctypes.byref(says))
        return Factory(zero_plane if zero_plane.is_plausible else ZeroPlane(), registration, start_lines)

    def _take(self, stream: Stream, data: int, stamp: int) -> None:
        held = (_DEPTH_BUFFER if stream is Stream.DEPTH else _COLOR_BUFFER).from_address(data)
        pixels = np.ctypeslib.as_array(held).copy()
        self._hear(stream, Picture(stamp, self._now_s(), pixels, self._log.is_whole(stream)))
