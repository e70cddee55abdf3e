"""What is read ahead on a thread comes in order, and the thread ends with whoever reads."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from fruitgui.errors import InputError
from fruitgui.sensors.ahead import ReadAhead
from fruitgui.sensors.recordings import open_recording
from tests.unit.sensors import ros_files as ros


def numbers(count: int, ended: threading.Event) -> Iterator[int]:
    try:
        yield from range(count)
    finally:
        ended.set()


def test_reading_ahead_gives_the_same_in_order() -> None:
    ended = threading.Event()
    with ReadAhead(numbers(100, ended), 3) as ahead:
        assert list(ahead) == list(range(100))
        assert list(ahead) == []
    assert ended.wait(1.0)


def test_no_more_is_drawn_ahead_than_asked() -> None:
    taken, drawn = [0], [0]
    farthest = [0]
    full = threading.Event()

    def source() -> Iterator[int]:
        for number in range(100):
            drawn[0] = number + 1
            farthest[0] = max(farthest[0], drawn[0] - taken[0])
            if farthest[0] >= 4:
                full.set()
            yield number

    with ReadAhead(source(), 4) as ahead:
        next(ahead)
        taken[0] += 1
        assert full.wait(5.0)
        for _ in ahead:
            taken[0] += 1
    # Four wait, one is in the thread's hand and one in ours.
    assert 4 <= farthest[0] <= 6
    assert drawn == [100]


def test_closing_in_the_middle_ends_the_thread_at_once_and_the_source_with_it() -> None:
    ended = threading.Event()
    ahead = ReadAhead(numbers(10**9, ended), 2)
    next(iter(ahead))
    began = time.monotonic()
    ahead.close()
    ahead.close()
    assert time.monotonic() - began < 2.0
    assert ended.is_set()
    assert "read-ahead" not in {thread.name for thread in threading.enumerate()}
    assert list(ahead) == []


def test_an_error_comes_where_its_item_would_have() -> None:
    def source() -> Iterator[int]:
        yield 1
        raise InputError("x", "broken", "mend it")

    with ReadAhead(source()) as ahead:
        assert next(ahead) == 1
        with pytest.raises(InputError, match="broken"):
            next(ahead)
        assert list(ahead) == []


def test_a_recording_read_ahead_is_the_same_recording(tmp_path: Path) -> None:
    messages = [m for n in range(5) for sensor in ("k1", "k2") for m in ros.frameset(sensor, 1.0 + n / 10)]
    recording = open_recording(ros.write_mcap(tmp_path / "r.mcap", messages))
    plain = [(time_s, frame.sensor, frame.sequence) for time_s, frame in recording.frames()]
    assert [(time_s, frame.sensor, frame.sequence) for time_s, frame in recording.frames(ahead=3)] == plain
    assert recording.tally.frames == {"k1": 5, "k2": 5}
    frames = recording.frames(ahead=3)
    next(frames)
    frames.close()
    assert "read-ahead" not in {thread.name for thread in threading.enumerate()}
