"""The records of an MCAP file, within bounds. Format: https://mcap.dev/spec."""

from __future__ import annotations

import struct
from collections.abc import Iterable, Iterator

from fruitgui.sensors.recordings.raw import MalformedError

MAGIC = b"\x89MCAP0\r\n"
NO_RECORD = 0x00
HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK = 0x01, 0x02, 0x03, 0x04, 0x05, 0x06
MESSAGE_INDEX, CHUNK_INDEX, STATISTICS, METADATA, DATA_END = 0x07, 0x08, 0x0B, 0x0C, 0x0F
RECORD_HEAD = struct.Struct("<BQ")


def walk(view: memoryview) -> Iterator[tuple[int, memoryview]]:
    """Yield (opcode, content) of the whole records in `view`, up to the first that is none or does not fit."""
    position = 0
    while position + RECORD_HEAD.size <= len(view):
        opcode, length = RECORD_HEAD.unpack_from(view, position)
        position += RECORD_HEAD.size
        if opcode == NO_RECORD or position + length > len(view):
            return
        yield opcode, view[position : position + length]
        position += length


def walk_pieces(pieces: Iterable[bytes], longest: int) -> Iterator[tuple[int, memoryview]]:
    """Yield (opcode, content) of the records in bytes that come piece by piece.

    Records longer than `longest` are passed over without being held.
    """
    held, skip = b"", 0
    for piece in pieces:
        passed = min(skip, len(piece))
        skip -= passed
        held += piece[passed:]
        position = 0
        while position + RECORD_HEAD.size <= len(held):
            opcode, length = RECORD_HEAD.unpack_from(held, position)
            end = position + RECORD_HEAD.size + length
            if opcode == NO_RECORD:
                return
            if end > len(held):
                if length <= longest:
                    break
                skip = end - len(held)
            elif length <= longest:
                yield opcode, memoryview(held)[position + RECORD_HEAD.size : end]
            position = end
        held = held[position:]


class Fields:
    """Reads the fields of one record, little-endian, within its bounds."""

    def __init__(self, record: memoryview) -> None:
        self._record = record
        self.position = 0

    def number(self, code: str) -> int:
        """Return the next number of `struct` code `code`."""
        try:
            value: int = struct.unpack_from("<" + code, self._record, self.position)[0]
        except struct.error as error:
            raise MalformedError("a record is too short") from error
        self.position += struct.calcsize("<" + code)
        return value

    def text(self) -> str:
        """Return the next text."""
        return str(self.octets(), "utf-8", "replace")

    def octets(self) -> bytes:
        """Return the next bytes, whose length stands before them."""
        end = self.number("I") + self.position
        if end > len(self._record):
            raise MalformedError("a part of a record is longer than the record")
        octets = bytes(self._record[self.position : end])
        self.position = end
        return octets

    def rest(self) -> bytes:
        """Return everything from here on."""
        return bytes(self._record[self.position :])

    def table(self) -> dict[str, str]:
        """Return the next table of texts."""
        end = self.number("I") + self.position
        pairs = {}
        while self.position < min(end, len(self._record)):
            key = self.text()
            pairs[key] = self.text()
        return pairs
