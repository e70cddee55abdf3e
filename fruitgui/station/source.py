"""What to read: a recording with the options a person gave."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from fruitgui.sensors.recordings import Recording, open_recording, parse_topics


@dataclass(frozen=True, slots=True)
class RecordingSource:
    """A recording and how to read it.

    Attributes:
        path: of the file.
        topics: texts `S:rgb=/…,info=/…,depth=/…` for sensors whose topics have other names.
        sensors: ids to use; none for all.
        following: further parts of the same recording.
        clock_offsets_s: by sensor, added to its stamps; only those a person gave.
    """

    path: Path
    topics: tuple[str, ...] = ()
    sensors: tuple[str, ...] = ()
    following: tuple[Path, ...] = ()
    clock_offsets_s: Mapping[str, float] = field(default_factory=dict)

    def open(self) -> Recording:
        """Open the recording.

        Raises:
            InputError: an option or the file cannot be used.
        """
        return open_recording(
            self.path,
            topics=parse_topics(self.topics),
            sensors=self.sensors,
            clock_offsets=self.clock_offsets_s,
            following=self.following,
        )
