"""Several files read as one: the parts of a recording, one after the other."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from fruitgui.sensors.recordings.container import open_container
from fruitgui.sensors.recordings.raw import Container, RawMessage, Soundness, Wanted


class Chained:
    """The messages of several containers in their order; see `raw.Container`.

    Args:
        paths: one at least.

    Raises:
        InputError: one of them cannot be opened.
    """

    def __init__(self, paths: Sequence[Path]) -> None:
        self._parts: list[tuple[str, Container]] = [(path.name, open_container(path)) for path in paths]
        self._read = 0

    @property
    def metadata(self) -> Mapping[str, Mapping[str, str]]:
        """Of the first part, as far as they were met."""
        return self._parts[0][1].metadata

    @property
    def topics(self) -> Mapping[str, str] | None:
        """Type name by topic; None where a part has no sound table of contents."""
        topics: dict[str, str] = {}
        for _, part in self._parts:
            if part.topics is None:
                return None
            topics |= part.topics
        return topics

    @property
    def soundness(self) -> Soundness:
        """Of the latest reading, of the parts that it came to; what is wrong with one is said under its name."""
        whole = Soundness()
        for name, part in self._parts[: self._read]:
            one = part.soundness
            for cause, count in one.damaged.items():
                whole.damaged[f"{cause} ({name})"] = count
            if one.cut_at is not None:
                whole.skip(f"{name} is cut off at byte {one.cut_at}, {one.bytes_unread} bytes unread")
            if one.lost_ns is not None:
                whole.lose_chunk(one.lost_ns)
            whole.lost_chunks += one.lost_chunks - (one.lost_ns is not None)
            whole.lost += one.lost
            whole.began_ns = one.began_ns if whole.began_ns is None else whole.began_ns
        return whole

    @property
    def bytes_read(self) -> int:
        """How much of all parts the latest reading has come past."""
        return sum(part.bytes_read for _, part in self._parts[: self._read])

    @property
    def size(self) -> int:
        """Bytes of all parts."""
        return sum(part.size for _, part in self._parts)

    def messages(self, wanted: Wanted) -> Iterator[RawMessage]:
        """Yield the messages of wanted topics, part by part.

        Raises:
            InputError: a part cannot be opened any more.
        """
        self._read = 0
        for _, part in self._parts:
            self._read += 1
            yield from part.messages(wanted)
