"""LED, tilt and accelerometer of a Kinect 1414, by requests of our own to the motor that certainly is its own."""

from __future__ import annotations

import ctypes
import struct
from enum import IntEnum

from fruitgui.sensors.kinect.bus import Bus

COUNTS_PER_G = 819.0
GRAVITY_M_S2 = 9.80665
MOST_TILT_DEG = 31.0

_WRITE, _READ = 0x40, 0xC0
_SET_LED, _SET_TILT, _GET_STATE = 0x06, 0x31, 0x32
_STATE = struct.Struct(">2x3hbB")


class Led(IntEnum):
    """What the light at the front shows."""

    OFF = 0
    GREEN = 1
    RED = 2
    YELLOW = 3
    BLINKING_GREEN = 4
    BLINKING_RED = 6


class Motor:
    """The motor of one Kinect, from `open` to `close`. Not thread-safe; every call ends within a quarter of a second.

    Where no motor is certain to be this Kinect's, nothing is done, and calls say so.

    Args:
        bus: not open; closed with the motor.
        serial: of the camera.
    """

    def __init__(self, bus: Bus, serial: str) -> None:
        self._bus, self._serial = bus, serial
        self._handle: ctypes.c_void_p | None = None

    def open(self) -> bool:
        """Open it; tell whether there is one.

        Raises:
            WorldError: USB cannot be used at all.
        """
        self._bus.open()
        self._handle = self._bus.open_motor(self._serial)
        return self._handle is not None

    def light(self, led: Led) -> bool:
        """Set the LED; tell whether it is set."""
        return self._write(_SET_LED, led)

    def tilt(self, angle_deg: float) -> bool:
        """Turn the head to an angle against the horizon; tell whether it turns. Never where it was calibrated."""
        return self._write(_SET_TILT, round(2.0 * min(max(angle_deg, -MOST_TILT_DEG), MOST_TILT_DEG)))

    def felt_m_s2(self) -> tuple[float, float, float] | None:
        """Return what the accelerometer feels now; None where it does not answer."""
        got = None if self._handle is None else self._bus.control(self._handle, _READ, _GET_STATE, 0, _STATE.size)
        if got is None or len(got) != _STATE.size:
            return None
        x, y, z, *_ = (count * GRAVITY_M_S2 / COUNTS_PER_G for count in _STATE.unpack(got))
        return x, y, z

    def close(self) -> None:
        """Let go of it. Any number of times."""
        if self._handle is not None:
            self._bus.close_motor(self._handle)
            self._handle = None
        self._bus.close()

    def _write(self, request: int, value: int) -> bool:
        return self._handle is not None and self._bus.control(self._handle, _WRITE, request, value) is not None
