"""What was read of a recording and what was left out, and why."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from fruitgui.sensors.recordings.raw import Soundness
from fruitgui.sensors.recordings.topics import sensor_of


@dataclass(slots=True)
class Tally:
    """Counts of one reading; complete once the last frame was given.

    Attributes:
        frames: frames given, by sensor.
        left_out: frames left out, by sensor and cause.
        last_s: stamp of the last frame given, any sensor's own clock, seconds.
        soundness: how far the file was sound.
        too_late: sensors that came only after the first look at a file without a table of contents.
    """

    frames: dict[str, int] = field(default_factory=dict)
    left_out: dict[str, dict[str, int]] = field(default_factory=dict)
    last_s: float = 0.0
    soundness: Soundness = field(default_factory=Soundness)
    too_late: set[str] = field(default_factory=set)

    def read(self, sensor: str, time_ns: int) -> None:
        """Count one frame given."""
        self.frames[sensor] = self.frames.get(sensor, 0) + 1
        self.last_s = time_ns / 1_000_000_000

    def undecodable(self, sensor: str, cause: str) -> None:
        """Count one frame that could not be decoded."""
        self.leave_out(sensor, {cause: 1})

    def leave_out(self, sensor: str, causes: Mapping[str, int]) -> None:
        """Count frames left out."""
        counts = self.left_out.setdefault(sensor, {})
        for cause, count in causes.items():
            if count:
                counts[cause] = counts.get(cause, 0) + count

    def dropped(self, sensor: str) -> int:
        """Return how many frames of a sensor were left out."""
        return sum(self.left_out.get(sensor, {}).values())

    def warnings(self, path: Path) -> list[str]:
        """Return the tally in words, one line for each cause."""
        lines = []
        if self.soundness.cut_at is not None:
            lines.append(
                f"{path.name} is cut off at byte {self.soundness.cut_at}: used up to {self.last_s:.3f} s, "
                f"{self.soundness.bytes_unread} bytes unread."
            )
        for cause, count in self.soundness.damaged.items():
            lines.append(f"{path.name}: {count} damaged part{'s' * (count > 1)} left out: {cause}.")
        if self.soundness.lost_ns is not None:
            lines.append(f"{path.name}: {lost_text(self.soundness)}.")
        for sensor in sorted(self.too_late):
            lines.append(
                f"{path.name}: {sensor} comes only later in this recording, which has no table of contents, and is "
                f"left out. Make the file whole with record --recover and read that."
            )
        for sensor, causes in self.left_out.items():
            for cause, count in causes.items():
                lines.append(f"{path.name}: {count} frame{'s' * (count > 1)} of {sensor} left out: {cause}.")
        return lines


def lost_text(soundness: Soundness) -> str:
    """Return what was in the chunks that were left out; empty where none was, or nothing is known of them."""
    if soundness.lost_ns is None:
        return ""
    first_ns, last_ns = soundness.lost_ns
    frames: dict[str, int] = {}
    for topic, count in soundness.lost.items():
        sensor = sensor_of(topic)
        if sensor is not None:
            frames[sensor] = max(frames.get(sensor, 0), count)
    what = " and ".join(f"{count} frame{'s' * (count > 1)} of {sensor}" for sensor, count in sorted(frames.items()))
    began_ns = first_ns if soundness.began_ns is None else soundness.began_ns
    begin_s, end_s = (first_ns - began_ns) * 1e-9, (last_ns - began_ns) * 1e-9
    return f"lost {what or 'what was recorded'} between {begin_s:.2f} s and {end_s:.2f} s after its beginning"
