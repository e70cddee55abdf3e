"""MCAP read from front to back, so that a cut or damaged file is used as far as it is sound.

The reader of the mcap package stops with an error at the first thing that is
not as it should be, believes the lengths it meets, and gives up a cut chunk;
this one is bounded by the file's own size and salvages whole messages of a cut
chunk.
"""

from __future__ import annotations

import heapq
import struct
import zlib
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import BinaryIO

from fruitgui.sensors.recordings.mcap_contents import Contents, read_contents
from fruitgui.sensors.recordings.raw import (
    MAX_MESSAGE_BYTES,
    MAX_UNPACKED_BYTES,
    MAX_WHOLE_BYTES,
    MalformedError,
    RawMessage,
    Soundness,
    Wanted,
    plain_type,
)
from fruitgui.sensors.recordings.records import (
    CHANNEL,
    CHUNK,
    DATA_END,
    FOOTER,
    MAGIC,
    MESSAGE,
    METADATA,
    NO_RECORD,
    RECORD_HEAD,
    SCHEMA,
    Fields,
    walk,
    walk_pieces,
)
from fruitgui.sensors.recordings.unpack import Part, pieces, unpack

_MAX_SMALL_RECORD = 4 * 1024 * 1024
_MAX_UNTANGLING_BYTES = 256 * 1024 * 1024
_CHUNK_HEAD_BYTES = 256
_MESSAGE_HEAD = struct.Struct("<HIQQ")
_KEPT = frozenset({SCHEMA, CHANNEL, MESSAGE, METADATA})


class McapFile:
    """The messages of one MCAP file; see `raw.Container`."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._schemas: dict[int, str] = {}
        self._channels: dict[int, tuple[str, str, str]] = {}
        self._metadata: dict[str, dict[str, str]] = {}
        self._soundness = Soundness()
        with path.open("rb") as file:
            self._size = path.stat().st_size
            self._contents = read_contents(file, self._size) or Contents()

    @property
    def metadata(self) -> dict[str, dict[str, str]]:
        """Named records of text, as far as they were met."""
        return self._metadata

    @property
    def topics(self) -> dict[str, str] | None:
        """Type name by topic, where the file has a table of contents."""
        return self._contents.types or None

    @property
    def soundness(self) -> Soundness:
        """Of the latest reading."""
        return self._soundness

    def messages(self, wanted: Wanted) -> Iterator[RawMessage]:
        """Yield the messages of wanted topics.

        In the order of the file; in the order of their log times where the
        chunks of the file do not follow those.
        """
        self._schemas, self._channels = {}, {}
        records = self.records()
        if self._contents.tangled:
            records = self._untangled()
            self._channels = {key: channel for key, channel in self._contents.channels.items() if wanted(channel[0])}
        for opcode, record in records:
            try:
                if opcode == MESSAGE:
                    yield from self._message(record)
                else:
                    self._define(opcode, Fields(record), wanted)
            except MalformedError as error:
                self._soundness.skip(str(error))

    def records(self) -> Iterator[tuple[int, memoryview]]:
        """Yield (opcode, content) of schemas, channels, messages and metadata, as far as the file is sound."""
        self._soundness = Soundness()
        with self._path.open("rb") as file:
            for opcode, length in self._front_to_back(file):
                yield from self._content(file, opcode, length)

    def _front_to_back(self, file: BinaryIO) -> Iterator[tuple[int, int]]:
        """Yield (opcode, length) of each outer record, the file standing at its content."""
        position = len(MAGIC)
        while True:
            file.seek(position)
            head = file.read(RECORD_HEAD.size)
            opcode, length = RECORD_HEAD.unpack(head) if len(head) == RECORD_HEAD.size else (NO_RECORD, 0)
            if opcode in (DATA_END, FOOTER):
                return
            end = position + RECORD_HEAD.size + length
            if opcode == NO_RECORD or end > self._size:
                self._soundness.cut(position, self._size)
                if opcode == CHUNK:
                    yield opcode, -1
                return
            yield opcode, length
            position = end

    def _content(self, file: BinaryIO, opcode: int, length: int) -> Iterator[tuple[int, memoryview]]:
        try:
            if opcode == CHUNK:
                yield from self._cut_chunk(file) if length < 0 else self._chunk(file, length)
            elif opcode in _KEPT:
                if length <= (MAX_MESSAGE_BYTES if opcode == MESSAGE else _MAX_SMALL_RECORD):
                    yield opcode, memoryview(file.read(length))
                else:
                    self._soundness.skip("a record is too long")
        except MalformedError as error:
            self._soundness.skip(str(error))

    def _chunk(self, file: BinaryIO, length: int) -> Iterator[tuple[int, memoryview]]:
        claimed, crc, kind, packed_length = _chunk_head(file, length)
        part = Part(file, packed_length)
        if claimed > MAX_WHOLE_BYTES:
            return walk_pieces(_bounded(pieces(kind, part), claimed), MAX_MESSAGE_BYTES)
        content = unpack(kind, part, claimed)
        if crc and zlib.crc32(content) != crc:
            raise MalformedError("a chunk's checksum does not fit its content")
        return walk(memoryview(content))

    def _cut_chunk(self, file: BinaryIO) -> Iterator[tuple[int, memoryview]]:
        """Yield what the last, incomplete chunk of a cut file still holds."""
        try:
            claimed, _, kind, packed_length = _chunk_head(file, None)
            yield from walk_pieces(_bounded(pieces(kind, Part(file, packed_length)), claimed), MAX_MESSAGE_BYTES)
        except MalformedError:
            return

    def _untangled(self) -> Iterator[tuple[int, memoryview]]:
        """Yield the records with messages in order of their log times, by the table of contents."""
        self._soundness = Soundness()
        waiting: list[tuple[int, int, memoryview]] = []
        held_bytes, count = 0, 0
        with self._path.open("rb") as file:
            yield from self._outside_chunks(file)
            for starts_ns, position in sorted(self._contents.chunks):
                while waiting and (waiting[0][0] < starts_ns or held_bytes > _MAX_UNTANGLING_BYTES):
                    message = heapq.heappop(waiting)[2]
                    held_bytes -= len(message)
                    yield MESSAGE, message
                for message in self._messages_of_chunk(file, position):
                    count += 1
                    held_bytes += len(message)
                    heapq.heappush(waiting, (_MESSAGE_HEAD.unpack_from(message)[2], count, message))
        while waiting:
            yield MESSAGE, heapq.heappop(waiting)[2]

    def _outside_chunks(self, file: BinaryIO) -> Iterator[tuple[int, memoryview]]:
        for opcode, length in self._front_to_back(file):
            if opcode != CHUNK:
                yield from self._content(file, opcode, length)

    def _messages_of_chunk(self, file: BinaryIO, position: int) -> Iterator[memoryview]:
        if position + RECORD_HEAD.size > self._size:
            return
        file.seek(position)
        opcode, length = RECORD_HEAD.unpack(file.read(RECORD_HEAD.size))
        if opcode != CHUNK or position + RECORD_HEAD.size + length > self._size:
            self._soundness.skip("the table of contents names a chunk that is not there")
            return
        for inner, record in self._content(file, opcode, length):
            if inner == MESSAGE and len(record) >= _MESSAGE_HEAD.size:
                yield memoryview(bytes(record))

    def _message(self, record: memoryview) -> Iterator[RawMessage]:
        if len(record) < _MESSAGE_HEAD.size:
            raise MalformedError("a message is too short")
        channel_id, _, log_time_ns, _ = _MESSAGE_HEAD.unpack_from(record)
        channel = self._channels.get(channel_id)
        if channel is not None:
            yield RawMessage(*channel, log_time_ns, bytes(record[_MESSAGE_HEAD.size :]))

    def _define(self, opcode: int, fields: Fields, wanted: Wanted) -> None:
        if opcode == SCHEMA:
            schema_id = fields.number("H")
            self._schemas[schema_id] = plain_type(fields.text())
        elif opcode == CHANNEL:
            channel_id, schema_id = fields.number("H"), fields.number("H")
            topic, wire = fields.text(), fields.text()
            if wanted(topic):
                self._channels[channel_id] = (topic, self._schemas.get(schema_id, ""), wire)
        else:
            name = fields.text()
            self._metadata[name] = fields.table()


def _chunk_head(file: BinaryIO, length: int | None) -> tuple[int, int, str, int]:
    """Return (unpacked size, checksum, packing, packed size) of a chunk, the file then standing at its content.

    Raises `MalformedError` where the chunk's head is not one, or does not fit the chunk's length.
    """
    start = file.tell()
    fields = Fields(memoryview(file.read(_CHUNK_HEAD_BYTES)))
    fields.number("Q")
    fields.number("Q")
    claimed, crc, kind, packed = fields.number("Q"), fields.number("I"), fields.text(), fields.number("Q")
    if length is not None and packed != length - fields.position:
        raise MalformedError("a chunk's length is not the length of what it holds")
    file.seek(start + fields.position)
    return claimed, crc, kind, packed


def _bounded(unpacked: Iterable[bytes], claimed: int) -> Iterator[bytes]:
    """Yield pieces up to what the chunk claims to hold, at most `MAX_UNPACKED_BYTES`."""
    left = min(claimed, MAX_UNPACKED_BYTES)
    for piece in unpacked:
        yield piece[:left]
        left -= len(piece)
        if left <= 0:
            return
