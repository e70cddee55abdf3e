"""Captures of one Kinect on their way to the reader."""

from __future__ import annotations

import numpy as np

from fruitgui.sensors.kinect.capture import Captures
from fruitgui.sensors.kinect.clock import FRAME_TICKS, TICKS_PER_S
from fruitgui.sensors.kinect.device import Picture
from fruitgui.sensors.kinect.packets import Stream

RAW, COLOR = np.zeros((1, 1), np.uint16), np.zeros((1, 1, 3), np.uint8)


def hear(captures: Captures, numbers: range, leapt_s: float) -> None:
    """Let a device take pictures, whose clock is off by so much."""
    for number in numbers:
        stamp = number * FRAME_TICKS + round(leapt_s * TICKS_PER_S)
        arrived_s = 100.0 + number / 30.0
        captures.hear(Stream.DEPTH, Picture(stamp, arrived_s, RAW, whole=True))
        captures.hear(Stream.VIDEO, Picture(stamp, arrived_s, COLOR, whole=True))


def test_a_leap_of_the_clock_is_told_by_whatever_is_read_after_it() -> None:
    captures = Captures()
    hear(captures, range(1, 4), 0.0)
    first = captures.next(0.0)
    hear(captures, range(4, 34), 20.0)
    after = captures.next(0.0)  # those at which it leapt have given way long ago
    hear(captures, range(34, 64), 3.0)
    again = captures.next(0.0)
    assert [one and one.clock_leaps for one in (first, after, again)] == [0, 1, 2]
