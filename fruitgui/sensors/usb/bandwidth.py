"""What fits on a USB 2 bus: the time that Kinects reserve in each of its microframes.

A stream of pictures without pause (isochronous) is promised its time beforehand; what does not fit is refused when the
second stream starts, or loses packets. Linux promises 100 of a microframe's 125 µs, and reckons a packet's time with
the worst case of stuffed bits (`HS_NSECS_ISO` in include/linux/usb/hcd.h).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

PROMISED_US = 100.0
"""Of each microframe, for all streams of a bus together."""

COLOUR_BYTES, DEPTH_BYTES = 1920, 1760
"""Of a Kinect v1, in each microframe."""

_BIT_NS = 1000.0 / 480.0
_HOST_DELAY_NS = 5.0


@dataclass(frozen=True, slots=True)
class BusLoad:
    """What the Kinects on one bus want of it.

    Attributes:
        bus: its number.
        kinects: on it, by name.
        wanted_us: of each microframe, with colour and depth of each.
    """

    bus: int
    kinects: tuple[str, ...]
    wanted_us: float

    @property
    def fits(self) -> bool:
        """Whether all run with colour and depth."""
        return self.wanted_us <= PROMISED_US


def stream_us(packet_bytes: int) -> float:
    """Return the time that a stream of such packets takes of each microframe, as Linux reckons it."""
    stuffed_bits = 7 * 8 * packet_bytes / 6
    return (38 * 8 * _BIT_NS + _BIT_NS * (3 + stuffed_bits) + _HOST_DELAY_NS) / 1000.0


KINECT_US = stream_us(COLOUR_BYTES) + stream_us(DEPTH_BYTES)
"""Of a Kinect with colour and depth: one fits on a bus, and not even depth alone of a second beside it."""


def bus_loads(kinects: Iterable[tuple[int, str]]) -> tuple[BusLoad, ...]:
    """Return the load of every bus on which there are Kinects of the first kind.

    Args:
        kinects: the bus and the name of each.
    """
    by_bus: dict[int, list[str]] = {}
    for bus, name in kinects:
        by_bus.setdefault(bus, []).append(name)
    return tuple(BusLoad(bus, tuple(names), len(names) * KINECT_US) for bus, names in sorted(by_bus.items()))
