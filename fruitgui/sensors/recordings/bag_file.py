"""ROS 1 bags (version 2.0) read from front to back, with or without an index, whole or cut.

Format: http://wiki.ros.org/Bags/Format/2.0. The reader of rosbags needs the
index at the end of the file, which a bag that was cut or never closed lacks.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

from fruitgui.sensors.recordings.raw import (
    MAX_MESSAGE_BYTES,
    MalformedError,
    RawMessage,
    Soundness,
    Wanted,
    plain_type,
)
from fruitgui.sensors.recordings.unpack import Part, unpack

BAG_MAGIC = b"#ROSBAG V2.0\n"
_MESSAGE, _BAG_HEADER, _CHUNK, _CONNECTION = 2, 3, 5, 7
_MAX_HEADER_BYTES = 1024 * 1024
_LENGTH = struct.Struct("<I")


class BagFile:
    """The messages of one bag; see `raw.Container`."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._size = path.stat().st_size
        self._connections: dict[int, tuple[str, str]] = {}
        self._wanted: Wanted = _none
        self._soundness = Soundness()
        self._bytes_read = 0
        with path.open("rb") as file:
            self._topics = self._indexed_topics(file)

    @property
    def metadata(self) -> dict[str, dict[str, str]]:
        """A bag holds none."""
        return {}

    @property
    def topics(self) -> dict[str, str] | None:
        """Type name by topic, where the bag was closed: its index names them."""
        return self._topics

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

    def _indexed_topics(self, file: BinaryIO) -> dict[str, str] | None:
        """Return the topics that the index at the end of the bag names, None where there is no sound index."""
        first = self._record_head(file, len(BAG_MAGIC))
        if first is None:
            return None
        self._wanted = _every
        position = int.from_bytes(first[0].get(b"index_pos", b""), "little")
        while 0 < position < self._size and (head := self._record_head(file, position)) is not None:
            fields, start, length = head
            if fields[b"op"][0] != _CONNECTION or start + length > min(self._size, start + _MAX_HEADER_BYTES):
                break
            try:
                self._connection(fields, file.read(length))
            except MalformedError:
                return None
            position = start + length
        return dict(self._connections.values()) or None

    def messages(self, wanted: Wanted) -> Iterator[RawMessage]:
        """Yield the messages of wanted topics in the order of the file."""
        self._soundness = Soundness()
        self._wanted, self._connections = wanted, {}
        with self._path.open("rb") as file:
            yield from self._front_to_back(file)

    def _front_to_back(self, file: BinaryIO) -> Iterator[RawMessage]:
        position, closed = len(BAG_MAGIC), False
        while position < self._size:
            self._bytes_read = position
            head = self._record_head(file, position)
            if head is None:
                self._soundness.cut(position, self._size)
                return
            fields, start, length = head
            op = fields[b"op"][0]
            closed |= op == _BAG_HEADER and fields.get(b"index_pos", b"").strip(b"\0") != b""
            if start + length > self._size:
                self._soundness.cut(position, self._size)
                if op == _CHUNK:
                    yield from self._record(file, op, fields, self._size - start, cut=True)
                return
            yield from self._record(file, op, fields, length)
            position = start + length
        if not closed:
            self._soundness.cut(position, self._size)

    def _record_head(self, file: BinaryIO, position: int) -> tuple[dict[bytes, bytes], int, int] | None:
        """Return (header fields, where the data start, their length), None where there is no whole header."""
        file.seek(position)
        header_length = _read_length(file)
        if header_length is None or not 0 < header_length <= min(_MAX_HEADER_BYTES, self._size - position):
            return None
        try:
            fields = _fields(file.read(header_length))
        except MalformedError:
            return None
        length = _read_length(file)
        return None if length is None or not fields.get(b"op") else (fields, file.tell(), length)

    def _record(
        self, file: BinaryIO, op: int, fields: dict[bytes, bytes], length: int, *, cut: bool = False
    ) -> Iterator[RawMessage]:
        try:
            if op == _CHUNK:
                yield from self._chunk(file, fields, length, cut=cut)
            elif op == _CONNECTION and length <= _MAX_HEADER_BYTES:
                self._connection(fields, file.read(length))
            elif op == _MESSAGE and length <= MAX_MESSAGE_BYTES:
                yield from self._message(fields, memoryview(file.read(length)))
        except MalformedError as error:
            self._soundness.skip(str(error))

    def _chunk(self, file: BinaryIO, fields: dict[bytes, bytes], length: int, *, cut: bool) -> Iterator[RawMessage]:
        kind = fields.get(b"compression", b"none").decode("ascii", "replace")
        claimed = _number(fields, b"size", "<I")
        yield from self._records(memoryview(unpack(kind, Part(file, length), claimed, cut=cut)), cut=cut)

    def _records(self, view: memoryview, *, cut: bool) -> Iterator[RawMessage]:
        position = 0
        while position < len(view):
            try:
                header, position = _sized(view, position)
                data, position = _sized(view, position)
            except MalformedError:
                if cut:
                    return
                raise
            fields = _fields(header)
            op = _number(fields, b"op", "<B")
            if op == _CONNECTION:
                self._connection(fields, data)
            elif op == _MESSAGE:
                yield from self._message(fields, data)

    def _connection(self, fields: dict[bytes, bytes], data: bytes | memoryview) -> None:
        topic = "/" + fields.get(b"topic", b"").decode("utf-8", "replace").strip("/")
        if self._wanted(topic):
            kind = _fields(data).get(b"type", b"").decode("utf-8", "replace")
            self._connections[_number(fields, b"conn", "<I")] = (topic, _ros2_name(kind))

    def _message(self, fields: dict[bytes, bytes], data: memoryview) -> Iterator[RawMessage]:
        connection = self._connections.get(_number(fields, b"conn", "<I"))
        if connection is not None:
            seconds, nanoseconds = struct.unpack("<II", _exactly(fields, b"time", 8))
            yield RawMessage(*connection, "ros1", seconds * 1_000_000_000 + nanoseconds, bytes(data))


def _none(_topic: str) -> bool:
    return False


def _every(_topic: str) -> bool:
    return True


def _ros2_name(kind: str) -> str:
    return plain_type("tf2_msgs/TFMessage" if kind == "tf/tfMessage" else kind)


def _read_length(file: BinaryIO) -> int | None:
    data = file.read(_LENGTH.size)
    return int(_LENGTH.unpack(data)[0]) if len(data) == _LENGTH.size else None


def _sized(view: memoryview, position: int) -> tuple[memoryview, int]:
    """Return the bytes whose length stands at `position`, and where they end."""
    start = position + _LENGTH.size
    if start > len(view):
        raise MalformedError("a record of a chunk is cut off")
    end = start + int(_LENGTH.unpack_from(view, position)[0])
    if end > len(view):
        raise MalformedError("a record of a chunk is longer than the chunk")
    return view[start:end], end


def _fields(header: bytes | memoryview) -> dict[bytes, bytes]:
    """Return the fields of a record's header."""
    view, position = memoryview(header), 0
    fields = {}
    while position < len(view):
        field, position = _sized(view, position)
        name, equals, value = bytes(field).partition(b"=")
        if not equals:
            raise MalformedError("a record's header is damaged")
        fields[name] = value
    return fields


def _number(fields: dict[bytes, bytes], name: bytes, code: str) -> int:
    return int(struct.unpack(code, _exactly(fields, name, struct.calcsize(code)))[0])


def _exactly(fields: dict[bytes, bytes], name: bytes, length: int) -> bytes:
    value = fields.get(name, b"")
    if len(value) != length:
        raise MalformedError("a record's header is damaged")
    return value
