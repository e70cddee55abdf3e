"""The way through the outer records of an MCAP file, past what is damaged.

Lengths chain the records: one wrong byte in one of them, and everything behind it would be out of reach. Where the
file has a table of contents, the next chunk that it names is gone on from; where it has none, the next place that
looks like the head of a chunk through and through.
"""

from __future__ import annotations

import bisect
from collections import Counter
from collections.abc import Generator, Iterator
from dataclasses import dataclass, replace
from typing import BinaryIO

from fruitgui.sensors.recordings.mcap_contents import ChunkPlace, Contents
from fruitgui.sensors.recordings.raw import MalformedError, Soundness
from fruitgui.sensors.recordings.records import (
    CHUNK,
    DATA_END,
    FOOTER,
    MAGIC,
    NO_RECORD,
    RECORD_HEAD,
    Fields,
)

CHUNK_HEAD_BYTES = 256
_STEP_BYTES = 1 << 20
_KIND_AT = RECORD_HEAD.size + 8 + 8 + 8 + 4
_KINDS = tuple(len(kind).to_bytes(4, "little") + kind for kind in (b"zstd", b"lz4"))


@dataclass(frozen=True, slots=True)
class Outer:
    """One outer record.

    Attributes:
        opcode: what it is.
        start: byte where its content begins. length: of the content.
        cut: the file ends within it; only chunks are given then.
        known: what the table of contents says of it, where it is a chunk.
    """

    opcode: int
    start: int
    length: int
    cut: bool = False
    known: ChunkPlace | None = None


class McapWalk:
    """Yields the outer records of a file up to its end, noting where they are not sound.

    Args:
        file: open for reading.
        size: of the file.
        contents: its table of contents, empty where there is none.
        soundness: is told of what is damaged.
    """

    def __init__(self, file: BinaryIO, size: int, contents: Contents, soundness: Soundness) -> None:
        self._file = file
        self._size = size
        self._contents = contents
        self._soundness = soundness
        self._sound_to = len(MAGIC)
        self._starts = [chunk.start for chunk in contents.chunks]

    def __iter__(self) -> Iterator[Outer]:
        position = len(MAGIC)
        while True:
            record = self._record(position)
            known = self._next_known(position)
            if record is None or not self._fits(record, position, known):
                position = yield from self._past_damage(position, known)
                if position < 0:
                    return
            elif record.opcode in (DATA_END, FOOTER):
                return
            else:
                yield record if record.opcode != CHUNK else replace(record, known=known)
                position = record.start + record.length
                if record.opcode == CHUNK:
                    self._sound_to = position

    def _record(self, position: int) -> Outer | None:
        """Return the record at a place; None where none can be there."""
        self._file.seek(position)
        head = self._file.read(RECORD_HEAD.size)
        if len(head) < RECORD_HEAD.size:
            return None
        opcode, length = RECORD_HEAD.unpack(head)
        start = position + RECORD_HEAD.size
        return None if opcode == NO_RECORD or start + length > self._size else Outer(opcode, start, length)

    def _next_known(self, position: int) -> ChunkPlace | None:
        """Return the first chunk at or after a place that the table of contents names."""
        at = bisect.bisect_left(self._starts, position)
        return self._contents.chunks[at] if at < len(self._starts) else None

    def _fits(self, record: Outer, position: int, known: ChunkPlace | None) -> bool:
        """Tell whether a record can be, with the next chunk of the table of contents where it is."""
        if known is not None:
            return _agree(record, position, known)
        return record.opcode != CHUNK or bool(self._starts) or self._is_chunk(record)

    def _past_damage(self, position: int, known: ChunkPlace | None) -> Generator[Outer, None, int]:
        """Find where sound records go on, yielding a chunk that the file's end cuts; return the place, or −1."""
        if known is not None and known.start == position:  # the chunk's own head is what is damaged
            self._soundness.skip("the head of a chunk is damaged")
            self._soundness.lose_chunk((known.first_ns, known.last_ns))
            return known.end
        if known is not None:
            self._soundness.skip("records between chunks are damaged")
            return known.start
        if self._starts and self._starts[-1] < position:
            return -1  # everything that the table names was met
        found = self._search(self._sound_to + 1)  # what led here may be what is wrong
        if found is not None:
            self._soundness.skip("the head of a record is damaged")
            return found
        self._soundness.cut(position, self._size)
        self._file.seek(position)
        head = self._file.read(RECORD_HEAD.size)
        if len(head) == RECORD_HEAD.size and RECORD_HEAD.unpack(head)[0] == CHUNK:
            start = position + RECORD_HEAD.size
            yield Outer(CHUNK, start, self._size - start, cut=True)
        return -1

    def _search(self, position: int) -> int | None:
        """Return the first place from `position` on where a chunk begins; None where there is none."""
        while position + CHUNK_HEAD_BYTES < self._size:
            self._file.seek(position)
            piece = self._file.read(_STEP_BYTES + CHUNK_HEAD_BYTES)
            for at in sorted(_kinds_in(piece)):
                place = position + at - _KIND_AT
                if place >= position and self._is_chunk(self._record(place)):
                    return place
            position += _STEP_BYTES
        return None

    def _is_chunk(self, record: Outer | None) -> bool:
        if record is None or record.opcode != CHUNK:
            return False
        try:
            chunk_head(self._file, record)
        except MalformedError:
            return False
        return True


def _kinds_in(piece: bytes) -> Iterator[int]:
    for kind in _KINDS:
        at = piece.find(kind)
        while at >= 0:
            yield at
            at = piece.find(kind, at + 1)


def _agree(record: Outer, position: int, known: ChunkPlace) -> bool:
    """Tell whether a record can be, with the next chunk of the table of contents where it is."""
    end = record.start + record.length
    if position == known.start:
        return record.opcode == CHUNK and end == known.end
    return record.opcode not in (DATA_END, FOOTER, CHUNK) and end <= known.start


@dataclass(frozen=True, slots=True)
class ChunkHead:
    """What a chunk says of itself, the file then standing at what is packed.

    Attributes:
        first_ns, last_ns: earliest and latest time of recording in it.
        claimed: unpacked size. crc: of what comes out, 0 where none was made.
        kind: of packing. packed: size.
    """

    first_ns: int
    last_ns: int
    claimed: int
    crc: int
    kind: str
    packed: int


def chunk_head(file: BinaryIO, record: Outer) -> ChunkHead:
    """Return the head of a chunk.

    Raises:
        MalformedError: it is none, or does not fit the chunk's length.
    """
    file.seek(record.start)
    fields = Fields(memoryview(file.read(CHUNK_HEAD_BYTES)))
    first_ns, last_ns = fields.number("Q"), fields.number("Q")
    claimed, crc, kind, packed = fields.number("Q"), fields.number("I"), fields.text(), fields.number("Q")
    if not record.cut and packed != record.length - fields.position:
        raise MalformedError("a chunk's length is not the length of what it holds")
    file.seek(record.start + fields.position)
    return ChunkHead(first_ns, last_ns, claimed, crc, kind, packed)


def counted(index: memoryview) -> Counter[int]:
    """Return how many messages of a channel a message index names; nothing where it is damaged."""
    try:
        fields = Fields(index)
        channel, entry_bytes = fields.number("H"), fields.number("I")
    except MalformedError:
        return Counter()
    return Counter({channel: min(entry_bytes, len(index)) // 16})
