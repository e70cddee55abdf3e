"""The table of contents at the end of a whole MCAP file."""

from __future__ import annotations

import itertools
import operator
import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import BinaryIO

from fruitgui.sensors.recordings.raw import MalformedError, plain_type
from fruitgui.sensors.recordings.records import (
    CHANNEL,
    CHUNK_INDEX,
    FOOTER,
    MAGIC,
    RECORD_HEAD,
    SCHEMA,
    STATISTICS,
    Fields,
    walk,
)

_FOOTER_BYTES = 9 + 20 + len(MAGIC)
_CHECKED_FOOTER_BYTES = 9 + 16
_MAX_SUMMARY_BYTES = 64 * 1024 * 1024


@dataclass(frozen=True, slots=True)
class ChunkPlace:
    """Where a chunk stands.

    Attributes:
        first_ns, last_ns: earliest and latest time of recording in it.
        start, end: bytes of its record in the file, from its head to what comes after it.
    """

    first_ns: int
    last_ns: int
    start: int
    end: int


@dataclass(slots=True)
class Contents:
    """What the end of a file says is in it.

    Attributes:
        types: type name by topic, of the topics that have messages.
        channels: (topic, type name, wire) by channel id.
        chunks: in the order of the file.
    """

    types: dict[str, str] = field(default_factory=dict)
    channels: dict[int, tuple[str, str, str]] = field(default_factory=dict)
    chunks: list[ChunkPlace] = field(default_factory=list)

    @property
    def tangled(self) -> bool:
        """Whether the chunks do not stand in the order of their times, as where a file was written topic by topic."""
        return any(after.first_ns < before.first_ns for before, after in itertools.pairwise(self.chunks))


def read_contents(file: BinaryIO, size: int) -> Contents | None:
    """Return the table of contents, or None where the file has none that is sound."""
    if size < _FOOTER_BYTES + len(MAGIC):
        return None
    file.seek(size - _FOOTER_BYTES)
    footer = file.read(_FOOTER_BYTES)
    opcode, length, start, _, crc = struct.unpack_from("<BQQQI", footer)
    if opcode != FOOTER or length != 20 or footer[-len(MAGIC) :] != MAGIC:
        return None
    if not 0 < start <= size - _FOOTER_BYTES or size - start > _MAX_SUMMARY_BYTES:
        return None
    file.seek(start)
    summary = file.read(size - _FOOTER_BYTES - start)
    if crc and zlib.crc32(footer[:_CHECKED_FOOTER_BYTES], zlib.crc32(summary)) != crc:
        return None
    try:
        return _read(summary)
    except MalformedError:
        return None


def _read(summary: bytes) -> Contents | None:
    contents = Contents()
    schemas: dict[int, str] = {}
    counts: dict[int, int] = {}
    for opcode, record in walk(memoryview(summary)):
        fields = Fields(record)
        if opcode == SCHEMA:
            schema = fields.number("H")
            schemas[schema] = plain_type(fields.text())
        elif opcode == CHANNEL:
            channel, schema = fields.number("H"), fields.number("H")
            contents.channels[channel] = (fields.text(), schemas.get(schema, ""), fields.text())
        elif opcode == STATISTICS:
            counts = _counts(fields)
        elif opcode == CHUNK_INDEX:
            first_ns, last_ns = fields.number("Q"), fields.number("Q")
            start, length = fields.number("Q"), fields.number("Q")
            if length > RECORD_HEAD.size:
                contents.chunks.append(ChunkPlace(first_ns, last_ns, start, start + length))
    if not contents.channels:
        return None
    contents.chunks.sort(key=operator.attrgetter("start"))
    contents.types = {
        topic: kind for channel, (topic, kind, _) in contents.channels.items() if counts.get(channel, not counts)
    }
    return contents


def _counts(fields: Fields) -> dict[int, int]:
    for code in "QHIIIIQQ":
        fields.number(code)
    return dict(_pairs(fields, fields.number("I") // 10))


def _pairs(fields: Fields, count: int) -> Iterator[tuple[int, int]]:
    for _ in range(min(count, 65536)):
        yield fields.number("H"), fields.number("Q")
