"""A recording that behaves like its sensors: at its own pace or another, once or for ever."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Protocol

from fruitgui.frame import Frame
from fruitgui.sensors.ahead import ReadAhead
from fruitgui.sensors.recordings import Recording, open_recording, parts_after
from fruitgui.sensors.shared import SharedSensor, SharedStream

FRAMES_AHEAD = 4
LONGEST_LAG_S = 0.5
"""A pace that falls farther behind slips: what was missed is not hurried after."""


class Pace(Protocol):
    """When a frame is due."""

    def begin(self) -> None:
        """Begin anew."""

    def wait(self, time_s: float, timeout_s: float) -> bool:
        """Wait until a time of the recording, at most `timeout_s`; tell whether it has come."""


class FlatOut:
    """As fast as frames can be read."""

    def begin(self) -> None:
        """Do nothing."""

    def wait(self, time_s: float, timeout_s: float) -> bool:  # noqa: ARG002 - it is always time
        """Tell that the time has come."""
        return True


class AtSpeed:
    """As fast as it was recorded, times `speed`; a machine that is too slow makes time slip, not frames pile up."""

    def __init__(self, speed: float = 1.0) -> None:
        if not speed > 0:
            raise ValueError(f"the speed must be positive, not {speed}")
        self._speed = speed
        self._zero_s: float | None = None

    def begin(self) -> None:
        """Let the next frame be due at once."""
        self._zero_s = None

    def wait(self, time_s: float, timeout_s: float) -> bool:
        """Wait until a time of the recording."""
        now_s = time.monotonic()
        if self._zero_s is None:
            self._zero_s = now_s - time_s / self._speed
        due_s = self._zero_s + time_s / self._speed
        if now_s - due_s > LONGEST_LAG_S:
            self._zero_s += now_s - due_s
        time.sleep(max(min(due_s - now_s, timeout_s), 0.0))
        return due_s <= now_s + timeout_s


class _Playing:
    """The stream of a recording's frames.

    One thread reads them, however many rounds: the C library gives each new thread a heap in turn, and the room of some
    sixty frames lay free in each.
    """

    def __init__(self, recording: Recording, pace: Pace, looped: bool) -> None:
        self._recording = recording
        self._pace = pace
        self._looped = looped
        self._frames: ReadAhead[tuple[float, Frame]] | None = None
        self._next: tuple[float, Frame] | None = None

    def begin(self) -> None:
        self.end()
        self._pace.begin()
        self._frames = ReadAhead(_rounds(self._recording, self._looped), FRAMES_AHEAD)

    def draw(self, timeout_s: float) -> Frame | None:
        if self._next is None:
            if self._frames is None:
                raise StopIteration
            self._next = next(self._frames)
        time_s, frame = self._next
        if not self._pace.wait(time_s, timeout_s):
            return None
        self._next = None
        return frame

    def end(self) -> None:
        if self._frames is not None:
            self._frames.close()
            self._frames = self._next = None


def _rounds(recording: Recording, looped: bool) -> Iterator[tuple[float, Frame]]:
    """Give a recording's frames, once or for ever, with times and numbers that go on."""
    place = _Round()
    for time_s, frame in recording.frames():
        yield place.placed(time_s, frame)
    while looped:
        place.again()
        for time_s, frame in recording.frames():
            yield place.placed(time_s, frame)


class _Round:
    """Times and numbers that go on where a recording begins again."""

    def __init__(self) -> None:
        self._shift_s = 0.0
        self._first_s: float | None = None
        self._last_s = 0.0
        self._count: Counter[str] = Counter()
        self._frames = 0

    def placed(self, time_s: float, frame: Frame) -> tuple[float, Frame]:
        """Return a frame with its time and number in the endless row."""
        if self._first_s is None:
            self._first_s = time_s
        self._last_s = max(self._last_s, time_s) if self._frames else time_s
        self._frames += 1
        number = self._count[frame.sensor]
        self._count[frame.sensor] += 1
        return time_s + self._shift_s, replace(frame, time_s=frame.time_s + self._shift_s, sequence=number)

    def again(self) -> None:
        """Begin another round, one mean distance of frames after the last."""
        first_s = self._last_s if self._first_s is None else self._first_s
        lasted_s = self._last_s - first_s
        self._shift_s += lasted_s + lasted_s / max(self._frames - 1, 1)
        self._first_s, self._frames = None, 0


def recorded_sensors(path: Path | str, pace: Pace | None = None, *, looped: bool = False) -> list[SharedSensor]:
    """Return the sensors of a recording, which play it together.

    Args:
        path: of the recording; where it goes on in further files, these are played too.
        pace: its own speed unless given.
        looped: begin again at the end, stamps and numbers going on.

    Raises:
        InputError: it cannot be used.
    """
    recording = open_recording(path, following=parts_after(Path(path)))
    playing = _Playing(recording, AtSpeed() if pace is None else pace, looped)
    return SharedStream(playing, recording.sensors.values()).sensors()
