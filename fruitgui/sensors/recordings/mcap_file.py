"""MCAP read from front to back, so that a cut or damaged file is used as far as it is sound.

The reader of the mcap package stops with an error at the first thing that is
not as it should be, believes the lengths it meets, and gives up a cut chunk;
this one is bounded by the file's own size and salvages whole messages of a cut
chunk.
"""

from __future__ import annotations

import heapq
import operator
import struct
import zlib
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import BinaryIO

from fruitgui.sensors.recordings.mcap_contents import ChunkPlace, Contents, read_contents
from fruitgui.sensors.recordings.mcap_walk import ChunkHead, McapWalk, Outer, chunk_head, counted
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
    MESSAGE,
    MESSAGE_INDEX,
    METADATA,
    RECORD_HEAD,
    SCHEMA,
    Fields,
    walk,
    walk_pieces,
)
from fruitgui.sensors.recordings.unpack import Part, pieces, unpack

_MAX_SMALL_RECORD = 4 * 1024 * 1024
_MAX_UNTANGLING_BYTES = 256 * 1024 * 1024
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
        self._bytes_read = 0
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

    @property
    def bytes_read(self) -> int:
        """How much of the file the latest reading has come past."""
        return self._bytes_read

    @property
    def size(self) -> int:
        """Bytes of the file."""
        return self._size

    def messages(self, wanted: Wanted) -> Iterator[RawMessage]:
        """Yield the messages of wanted topics.

        In the order of the file; in the order of their log times where the
        chunks of the file do not follow those.
        """
        self._schemas = {}
        # What a checked table of contents says of channels holds, whatever the file's own records say.
        self._channels = {key: channel for key, channel in self._contents.channels.items() if wanted(channel[0])}
        records = self._untangled() if self._contents.tangled else self.records()
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
        for file, outer in self._outer():
            yield from self._content(file, outer)

    def head(self) -> Iterator[tuple[int, memoryview]]:
        """Yield (opcode, content) of what stands before the first chunk and the first message."""
        for file, outer in self._outer():
            if outer.opcode in (CHUNK, MESSAGE):
                return
            yield from self._content(file, outer)

    def _outer(self) -> Iterator[tuple[BinaryIO, Outer]]:
        """Yield each outer record of the file, which is open meanwhile."""
        chunks = self._contents.chunks
        self._soundness = Soundness(began_ns=min((chunk.first_ns for chunk in chunks), default=None))
        self._bytes_read = lost_before = 0
        with self._path.open("rb") as file:
            for outer in McapWalk(file, self._size, self._contents, self._soundness):
                if outer.opcode != MESSAGE_INDEX:
                    lost_before = self._soundness.lost_chunks
                elif self._soundness.lost_chunks > lost_before:
                    self._note_lost(file, outer)
                self._bytes_read = outer.start
                yield file, outer

    def _note_lost(self, file: BinaryIO, outer: Outer) -> None:
        """Count the messages that were in a chunk that was left out."""
        file.seek(outer.start)
        for channel, count in counted(memoryview(file.read(min(outer.length, _MAX_SMALL_RECORD)))).items():
            known = self._contents.channels.get(channel) or self._channels.get(channel)
            if known is not None:
                self._soundness.lost[known[0]] += count

    def _content(self, file: BinaryIO, outer: Outer) -> Iterator[tuple[int, memoryview]]:
        try:
            if outer.opcode == CHUNK:
                yield from self._cut_chunk(file, outer) if outer.cut else self._chunk(file, outer)
            elif outer.opcode in _KEPT:
                if outer.length <= (MAX_MESSAGE_BYTES if outer.opcode == MESSAGE else _MAX_SMALL_RECORD):
                    file.seek(outer.start)
                    yield outer.opcode, memoryview(file.read(outer.length))
                else:
                    self._soundness.skip("a record is too long")
        except MalformedError as error:
            self._soundness.skip(str(error))

    def _chunk(self, file: BinaryIO, outer: Outer) -> Iterator[tuple[int, memoryview]]:
        times_ns = None if outer.known is None else (outer.known.first_ns, outer.known.last_ns)
        try:
            head = chunk_head(file, outer)
            times_ns = times_ns or (head.first_ns, head.last_ns)
            return self._unpacked(file, head)
        except MalformedError:
            self._soundness.lose_chunk(times_ns)
            raise

    def _unpacked(self, file: BinaryIO, head: ChunkHead) -> Iterator[tuple[int, memoryview]]:
        if self._soundness.began_ns is None:
            self._soundness.began_ns = head.first_ns
        part = Part(file, head.packed)
        if head.claimed > MAX_WHOLE_BYTES:
            return walk_pieces(_bounded(pieces(head.kind, part), head.claimed), MAX_MESSAGE_BYTES)
        content = unpack(head.kind, part, head.claimed)
        if head.crc and zlib.crc32(content) != head.crc:
            raise MalformedError("a chunk's checksum does not fit its content")
        return walk(memoryview(content))

    def _cut_chunk(self, file: BinaryIO, outer: Outer) -> Iterator[tuple[int, memoryview]]:
        """Yield what the last, incomplete chunk of a cut file still holds."""
        try:
            head = chunk_head(file, outer)
            unpacked = pieces(head.kind, Part(file, head.packed))
            yield from walk_pieces(_bounded(unpacked, head.claimed), MAX_MESSAGE_BYTES)
        except MalformedError:
            return

    def _untangled(self) -> Iterator[tuple[int, memoryview]]:
        """Yield the records with messages in order of their log times, by the table of contents."""
        waiting: list[tuple[int, int, memoryview]] = []
        held_bytes, count = 0, 0
        for file, outer in self._outer():
            if outer.opcode != CHUNK:
                yield from self._content(file, outer)
        self._bytes_read = 0
        with self._path.open("rb") as file:
            for chunk in sorted(self._contents.chunks, key=operator.attrgetter("first_ns", "start")):
                while waiting and (waiting[0][0] < chunk.first_ns or held_bytes > _MAX_UNTANGLING_BYTES):
                    message = heapq.heappop(waiting)[2]
                    held_bytes -= len(message)
                    yield MESSAGE, message
                for message in self._messages_of_chunk(file, chunk):
                    count += 1
                    held_bytes += len(message)
                    heapq.heappush(waiting, (_MESSAGE_HEAD.unpack_from(message)[2], count, message))
        while waiting:
            yield MESSAGE, heapq.heappop(waiting)[2]

    def _messages_of_chunk(self, file: BinaryIO, chunk: ChunkPlace) -> Iterator[memoryview]:
        start = chunk.start + RECORD_HEAD.size
        if chunk.end > self._size or chunk.end < start:
            self._soundness.skip("the table of contents names a chunk that is not there")
            return
        self._bytes_read = max(start, self._bytes_read)
        for inner, record in self._content(file, Outer(CHUNK, start, chunk.end - start, known=chunk)):
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
            if wanted(topic) and channel_id not in self._contents.channels:
                self._channels[channel_id] = (topic, self._schemas.get(schema_id, ""), wire)
        else:
            name = fields.text()
            self._metadata[name] = fields.table()


def _bounded(unpacked: Iterable[bytes], claimed: int) -> Iterator[bytes]:
    """Yield pieces up to what the chunk claims to hold, at most `MAX_UNPACKED_BYTES`."""
    left = min(claimed, MAX_UNPACKED_BYTES)
    for piece in unpacked:
        yield piece[:left]
        left -= len(piece)
        if left <= 0:
            return
