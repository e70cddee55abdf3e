"""Pictures of one open device brought together: counted on, paired, timed, and kept until they are read."""

from __future__ import annotations

import threading
import time
from collections import deque
from dataclasses import dataclass

from fruitgui.errors import FruitguiError
from fruitgui.sensors.host_clock import HostClock
from fruitgui.sensors.kinect.clock import FRAME_TICKS, TICKS_PER_S, TickCounter
from fruitgui.sensors.kinect.device import Picture
from fruitgui.sensors.kinect.packets import Stream
from fruitgui.sensors.kinect.pairing import ColorPicture, DepthPicture, Pair, Pairing

_KEPT = 4
"""Captures that wait to be read; the oldest give way, and their numbers are missing."""


@dataclass(frozen=True, slots=True, eq=False)
class Capture:
    """A pair with its number and its time.

    Attributes:
        pair: depth with its colour.
        sequence: counts what the device took while its projector was on, from 0.
        time_s: when depth was taken, by the host's monotonic clock.
        clock_leaps: how often the device's clock has leapt by then: whatever is read next tells of it.
        time_sure: whether the time can be believed.
    """

    pair: Pair
    sequence: int
    time_s: float
    clock_leaps: int
    time_sure: bool


class Captures:
    """What one device took. `hear` and `end` are called by the device's thread, everything else by the reader."""

    def __init__(self) -> None:
        self._ticks = TickCounter()
        self._clock = HostClock()
        self._pairing = Pairing()
        self._waiting: deque[Capture] = deque(maxlen=_KEPT)
        self._changed = threading.Condition()
        self._sequence = -1
        self._last: DepthPicture | None = None
        self._failure: FruitguiError | None = None
        self._heard_s: float | None = None

    @property
    def heard_s(self) -> float | None:
        """When the newest picture came, of either stream, by the host's monotonic clock; None before the first."""
        return self._heard_s

    def hear(self, stream: Stream, picture: Picture) -> None:
        """Take in a picture."""
        ticks = self._ticks.count(picture.stamp, picture.arrived_s)
        self._heard_s = time.monotonic()
        with self._changed:
            if stream is Stream.DEPTH:
                depth = DepthPicture(ticks, picture.arrived_s, picture.pixels, picture.whole)  # type: ignore[arg-type]
                pairs = self._pairing.add_depth(depth)
            else:
                self._clock.hear(ticks / TICKS_PER_S, picture.arrived_s)
                pairs = self._pairing.add_color(ColorPicture(ticks, picture.pixels, picture.whole))  # type: ignore[arg-type]
            self._waiting.extend(self._captured(pair) for pair in pairs)
            self._changed.notify_all()

    def begin_anew(self) -> None:
        """Let go of what waits; what comes next is numbered on without a gap, as after the projector was off."""
        with self._changed:
            self._pairing.clear()
            self._waiting.clear()
            self._last = None

    def end(self, failure: FruitguiError | None) -> None:
        """Note that nothing comes any more."""
        with self._changed:
            self._failure = failure
            self._changed.notify_all()

    def next(self, timeout_s: float) -> Capture | None:
        """Return the next capture; None where none comes in time.

        Raises:
            FruitguiError: none will come.
        """
        until_s = time.monotonic() + timeout_s
        with self._changed:
            while not self._waiting:
                if self._failure is not None:
                    raise self._failure
                left_s = until_s - time.monotonic()
                if left_s <= 0.0:
                    return None
                self._changed.wait(left_s)
            return self._waiting.popleft()

    def _captured(self, pair: Pair) -> Capture:
        depth = pair.depth
        self._sequence += 1 if self._last is None else _steps(self._last, depth)
        self._last = depth
        time_s = self._clock.time_s(depth.ticks / TICKS_PER_S, depth.arrived_s)
        return Capture(pair, self._sequence, time_s, self._clock.jumps, self._clock.sure)


def _steps(before: DepthPicture, now: DepthPicture) -> int:
    """Return how many pictures later one is than another; where the device's clock leapt, as they came."""
    by_device = round((now.ticks - before.ticks) / FRAME_TICKS)
    by_host = round((now.arrived_s - before.arrived_s) * TICKS_PER_S / FRAME_TICKS)
    return max(by_host if by_device > by_host + _LATE_STEPS else by_device, 1)


_LATE_STEPS = 15
"""A picture may come half a second late, and the next at once; farther apart only a clock that leapt puts them."""
