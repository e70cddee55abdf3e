"""Captures of one Kinect on their way to the reader."""

from __future__ import annotations

import time

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


def test_colour_alone_is_heard_too() -> None:
    captures = Captures()
    assert captures.heard_s is None
    began_s = time.monotonic()
    captures.hear(Stream.VIDEO, Picture(0, 100.0, COLOR, whole=True))
    assert captures.heard_s is not None
    assert began_s <= captures.heard_s <= time.monotonic()


def test_pictures_that_were_lost_leave_a_gap_and_a_clock_that_leapt_leaves_none() -> None:
    captures = Captures()
    sequences = []
    for numbers, leapt_s in ((range(1, 4), 0.0), (range(10, 12), 0.0), (range(12, 14), 20.0), (range(400, 402), 20.0)):
        hear(captures, numbers, leapt_s)
        while (capture := captures.next(0.0)) is not None:
            sequences.append(capture.sequence)
    assert sequences == [0, 1, 2, 9, 10, 11, 12, 399, 400]


def test_a_picture_that_came_late_hides_none_that_were_lost_after_it() -> None:
    captures = Captures()
    for number, late in ((1, 0), (2, 12), (13, 1)):
        arrived_s = 100.0 + (number + late) / 30.0
        for stream, pixels in ((Stream.DEPTH, RAW), (Stream.VIDEO, COLOR)):
            captures.hear(stream, Picture(number * FRAME_TICKS, arrived_s, pixels, whole=True))
    assert [one and one.sequence for one in (captures.next(0.0) for _ in range(3))] == [0, 1, 12]
