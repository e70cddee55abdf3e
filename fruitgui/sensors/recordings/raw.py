"""What every container of recorded messages gives, whatever its format."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Protocol

Wanted = Callable[[str], bool]
"""Tells whether the messages of a topic are wanted."""

MAX_MESSAGE_BYTES = 64 * 1024 * 1024
"""No picture that this program reads is larger; a longer message is skipped unread."""

MAX_WHOLE_BYTES = 32 * 1024 * 1024
"""Chunks up to this size are unpacked whole and checked before they are used, larger ones as they are read."""

MAX_UNPACKED_BYTES = 8 * 1024 * 1024 * 1024
"""No chunk is followed farther than this, whatever it claims."""


class MalformedError(ValueError):
    """Bytes that are not what they claim to be. Never leaves the recordings."""


@dataclass(frozen=True, slots=True)
class RawMessage:
    """One message as stored.

    Attributes:
        topic: with its leading slash.
        type_name: like `sensor_msgs/Image`, without `/msg/`.
        wire: `cdr` (ROS 2) or `ros1`.
        log_time_ns: when it was recorded, host clock.
        data: the serialised message.
    """

    topic: str
    type_name: str
    wire: str
    log_time_ns: int
    data: bytes


@dataclass(slots=True)
class Soundness:
    """How far a file was sound; filled while it is read.

    Attributes:
        cut_at: byte at which reading had to stop before the end, or None.
        bytes_unread: from there to the end of the file.
        damaged: chunks and messages that were left out, by cause.
        lost_chunks: how many of those were chunks whose content is known to be there and cannot be had.
        lost: messages that were in the chunks left out, by topic, as far as the file tells.
        lost_ns: earliest and latest time of recording of those chunks; None where none is lost.
        began_ns: the file's earliest time of recording, as far as known.
    """

    cut_at: int | None = None
    bytes_unread: int = 0
    damaged: dict[str, int] = field(default_factory=dict)
    lost_chunks: int = 0
    lost: Counter[str] = field(default_factory=Counter)
    lost_ns: tuple[int, int] | None = None
    began_ns: int | None = None

    def skip(self, cause: str) -> None:
        """Count one part left out for `cause`."""
        self.damaged[cause] = self.damaged.get(cause, 0) + 1

    def lose_chunk(self, times_ns: tuple[int, int] | None) -> None:
        """Note that a chunk is lost, and its earliest and latest time of recording where they are known."""
        self.lost_chunks += 1
        if times_ns is not None:
            before = self.lost_ns or times_ns
            self.lost_ns = min(before[0], times_ns[0]), max(before[1], times_ns[1])

    def cut(self, position: int, size: int) -> None:
        """Note that reading stopped at `position` of a file of `size` bytes."""
        self.cut_at = position
        self.bytes_unread = max(size - position, 0)


class Container(Protocol):
    """A file of recorded messages. Each call of `messages` reads it anew."""

    @property
    def metadata(self) -> Mapping[str, Mapping[str, str]]:
        """Named records of text, as far as they were met (writers put them first)."""

    @property
    def topics(self) -> Mapping[str, str] | None:
        """Type name by topic where the file has a sound table of contents, else None."""

    @property
    def soundness(self) -> Soundness:
        """Of the latest reading."""

    @property
    def bytes_read(self) -> int:
        """How much of the file the latest reading has come past."""

    @property
    def size(self) -> int:
        """Bytes of the file."""

    def messages(self, wanted: Wanted) -> Iterator[RawMessage]:
        """Yield the messages of wanted topics in the order of the file, as far as it is sound.

        Raises:
            InputError: the file cannot be opened or is not of this format.
        """


def plain_type(name: str) -> str:
    """Return `package/Type` of a ROS 1 or ROS 2 type name."""
    parts = name.split("/")
    return f"{parts[0]}/{parts[-1]}" if len(parts) > 1 else name
