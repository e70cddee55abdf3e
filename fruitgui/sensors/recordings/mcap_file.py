"""MCAP read from front to back, so that a cut or damaged file is used as far as it is sound.

The reader of the mcap package stops with an error at the first thing that is
not as it should be, believes the lengths it meets, and gives up a cut chunk;
this one is bounded by the file's own size and salvages whole messages of a cut
chunk.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

from fruitgui.sensors.recordings.mcap_contents import read_contents
from fruitgui.sensors.recordings.raw import (
    MAX_CHUNK_BYTES,
    MAX_MESSAGE_BYTES,
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
    RECORD_HEAD,
    SCHEMA,
    Fields,
    walk,
)
from fruitgui.sensors.recordings.unpack import unpack

_MAX_SMALL_RECORD = 4 * 1024 * 1024
_MESSAGE_HEAD = struct.Struct("<HIQQ")


class McapFile:
    """The messages of one MCAP file; see `raw.Container`."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._schemas: dict[int, str] = {}
        self._channels: dict[int, tuple[str, str, str]] = {}
        self._wanted: Wanted = _none
        self._metadata: dict[str, dict[str, str]] = {}
        self._soundness = Soundness()
        with path.open("rb") as file:
            self._size = path.stat().st_size
            contents = read_contents(file, self._size)
        self._topics = None if contents is None else contents.types

    @property
    def metadata(self) -> dict[str, dict[str, str]]:
        """Named records of text, as far as they were met."""
        return self._metadata

    @property
    def topics(self) -> dict[str, str] | None:
        """Type name by topic, where the file has a table of contents."""
        return self._topics

    @property
    def soundness(self) -> Soundness:
        """Of the latest reading."""
        return self._soundness

    def messages(self, wanted: Wanted) -> Iterator[RawMessage]:
        """Yield the messages of wanted topics in the order of the file."""
        self._soundness = Soundness()
        self._wanted, self._schemas, self._channels = wanted, {}, {}
        with self._path.open("rb") as file:
            yield from self._front_to_back(file)

    def _front_to_back(self, file: BinaryIO) -> Iterator[RawMessage]:
        position = len(MAGIC)
        while True:
            file.seek(position)
            head = file.read(RECORD_HEAD.size)
            if len(head) < RECORD_HEAD.size:
                self._soundness.cut(position, self._size)
                return
            opcode, length = RECORD_HEAD.unpack(head)
            if opcode in (DATA_END, FOOTER):
                return
            end = position + RECORD_HEAD.size + length
            if opcode == 0 or end > self._size:
                self._soundness.cut(position, self._size)
                if opcode == CHUNK:
                    yield from self._cut_chunk(file)
                return
            yield from self._record(file, opcode, length)
            position = end

    def _record(self, file: BinaryIO, opcode: int, length: int) -> Iterator[RawMessage]:
        try:
            if opcode == CHUNK:
                yield from self._chunk(file, length)
            elif opcode == MESSAGE:
                yield from self._loose_message(file, length)
            elif opcode in (SCHEMA, CHANNEL, METADATA) and length <= _MAX_SMALL_RECORD:
                self._definition(opcode, memoryview(file.read(length)))
        except MalformedError as error:
            self._soundness.skip(str(error))

    def _loose_message(self, file: BinaryIO, length: int) -> Iterator[RawMessage]:
        if length > MAX_MESSAGE_BYTES:
            raise MalformedError("a message is too long to be one picture")
        yield from self._message(memoryview(file.read(length)))

    def _chunk(self, file: BinaryIO, length: int) -> Iterator[RawMessage]:
        if length > MAX_CHUNK_BYTES:
            raise MalformedError(f"a chunk is {length} bytes long")
        chunk = file.read(length)
        claimed, crc, kind, start, packed_length = _chunk_head(chunk)
        if packed_length != length - start:
            raise MalformedError("a chunk's length is not the length of what it holds")
        records = unpack(kind, chunk[start:], claimed)
        if crc and zlib.crc32(records) != crc:
            raise MalformedError("a chunk's checksum does not fit its content")
        yield from self._records_of_chunk(records)

    def _cut_chunk(self, file: BinaryIO) -> Iterator[RawMessage]:
        """Yield what the last, incomplete chunk of a cut file still holds."""
        try:
            chunk = file.read(MAX_CHUNK_BYTES)
            claimed, _, kind, start, packed_length = _chunk_head(chunk)
            if len(chunk) - start <= packed_length:
                yield from self._records_of_chunk(unpack(kind, chunk[start:], claimed, cut=True))
        except MalformedError:
            return

    def _records_of_chunk(self, records: bytes) -> Iterator[RawMessage]:
        for opcode, record in walk(memoryview(records)):
            if opcode == MESSAGE:
                yield from self._message(record)
            elif opcode in (SCHEMA, CHANNEL):
                self._definition(opcode, record)

    def _message(self, record: memoryview) -> Iterator[RawMessage]:
        if len(record) < _MESSAGE_HEAD.size:
            raise MalformedError("a message is too short")
        channel_id, _, log_time_ns, _ = _MESSAGE_HEAD.unpack_from(record)
        channel = self._channels.get(channel_id)
        if channel is not None:
            yield RawMessage(*channel, log_time_ns, bytes(record[_MESSAGE_HEAD.size :]))

    def _definition(self, opcode: int, record: memoryview) -> None:
        fields = Fields(record)
        if opcode == SCHEMA:
            schema_id = fields.number("H")
            self._schemas[schema_id] = plain_type(fields.text())
        elif opcode == CHANNEL:
            channel_id, schema_id = fields.number("H"), fields.number("H")
            topic, wire = fields.text(), fields.text()
            if self._wanted(topic):
                self._channels[channel_id] = (topic, self._schemas.get(schema_id, ""), wire)
        else:
            name = fields.text()
            self._metadata[name] = fields.table()


def _none(_topic: str) -> bool:
    return False


def _chunk_head(chunk: bytes) -> tuple[int, int, str, int, int]:
    """Return (unpacked size, checksum, packing, where the packed bytes start, how many they are)."""
    fields = Fields(memoryview(chunk))
    fields.number("Q")
    fields.number("Q")
    claimed, crc, kind, packed = fields.number("Q"), fields.number("I"), fields.text(), fields.number("Q")
    return claimed, crc, kind, fields.position, packed
