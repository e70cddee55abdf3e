"""What a recording is asked to be, how far it is, and what came of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Any

from fruitgui.sensors.recordings import Split

RESERVE_BYTES = 1_000_000_000
"""What a recording leaves free on the disk, so that the records and the system go on."""


@dataclass(frozen=True, slots=True)
class RecordPlan:
    """What to record.

    Attributes:
        out: the file, or the first of its parts.
        seconds: how long, from the first frame; None until it is stopped.
        split: when another part begins.
        reserve_bytes: so much of the disk stays free.
    """

    out: Path
    seconds: float | None = None
    split: Split = field(default_factory=Split)
    reserve_bytes: int = RESERVE_BYTES


class Ending(StrEnum):
    """Why a recording ended."""

    DONE = "done"
    STOPPED = "stopped"
    DISK_FULL = "disk_full"
    SENSORS_ENDED = "sensors_ended"


@dataclass(frozen=True, slots=True)
class Silence:
    """When a sensor gave nothing: seconds after the first frame; to its end where `until_s` is None."""

    sensor: str
    from_s: float
    until_s: float | None = None


@dataclass(frozen=True, slots=True)
class RecordState:
    """A recording at one moment.

    Attributes:
        seconds: since its first frame; 0 before that.
        share: of the time asked for, 0–1; 0 where none was.
        frames: taken, by sensor.
        lost: frames that came and found no room, by sensor.
        silent: sensors that give nothing now.
        bytes_written: of all parts. parts: how many there are.
        room_bytes: what the disk has left beyond the reserve.
        room_s: how long that lasts at the present rate; None while it is not known.
    """

    seconds: float
    share: float
    frames: Mapping[str, int]
    lost: Mapping[str, int]
    silent: tuple[str, ...]
    bytes_written: int
    parts: int
    room_bytes: int
    room_s: float | None


WatchRecording = Callable[[RecordState], None]


def nobody_watches(_state: RecordState) -> None:
    """Ignore how far it is."""


@dataclass(frozen=True, slots=True)
class Recorded:
    """What was written.

    Attributes:
        parts: the files, in order.
        frames: in them, by sensor.
        seconds: from the first frame to the last.
        ended: why.
        lost: frames that came and are in no file, by sensor.
        missed: frames that the device numbered and that did not come, or came damaged, by sensor.
        silences: when a sensor gave nothing.
        notes: what else a person should know, in words.
        bytes_written: of all parts.
    """

    parts: tuple[Path, ...]
    frames: Mapping[str, int]
    seconds: float
    ended: Ending = Ending.DONE
    lost: Mapping[str, int] = field(default_factory=dict)
    missed: Mapping[str, int] = field(default_factory=dict)
    silences: tuple[Silence, ...] = ()
    notes: tuple[str, ...] = ()
    bytes_written: int = 0

    def warnings(self) -> list[str]:
        """Return what a person should know, in words."""
        lines = []
        if self.ended is Ending.DISK_FULL:
            lines.append("The disk is nearly full: the recording was ended, and is whole up to there.")
        if self.ended is Ending.SENSORS_ENDED:
            lines.append("No sensor gives anything any more: the recording was ended, and is whole up to there.")
        for silence in self.silences:
            until = "its end" if silence.until_s is None else f"{silence.until_s:.1f} s"
            lines.append(f"{silence.sensor} gave no frames from {silence.from_s:.1f} s to {until}.")
        for sensor, count in self.lost.items():
            if count:
                lines.append(f"{count} frames of {sensor} were lost: this computer, or its disk, was too slow.")
        for sensor, count in self.missed.items():
            if count:
                lines.append(f"{count} frames of {sensor} did not come whole from the device: see fruitgui sensors.")
        return [*lines, *self.notes]

    def value(self) -> dict[str, Any]:
        """Return the result as JSON."""
        return {
            "recording": str(self.parts[0]),
            "parts": [str(part) for part in self.parts],
            "frames": dict(self.frames),
            "lost": {sensor: count for sensor, count in self.lost.items() if count},
            "missed": {sensor: count for sensor, count in self.missed.items() if count},
            "seconds": self.seconds,
            "bytes": self.bytes_written,
            "ended": self.ended.value,
            "warnings": self.warnings(),
        }

    def line(self) -> str:
        """Return what to tell a person."""
        each = ", ".join(f"{sensor} {frames}" for sensor, frames in self.frames.items())
        more = f" and {len(self.parts) - 1} more parts" if len(self.parts) > 1 else ""
        total = sum(self.frames.values())
        return f"{self.parts[0]}{more}: {total} frames over {self.seconds:.1f} s ({each})"
