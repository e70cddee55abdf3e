"""An MCAP file as it is being written: after each step, what stands on the disk is sound up to its end.

The writer of the mcap package packs on the thread that writes, gives a chunk to the file only when it is full however
long that takes, and cannot go back once a disk is full. Its records are used here as they are.
"""

from __future__ import annotations

import contextlib
import io
import struct
import zlib
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from mcap import records
from mcap.data_stream import RecordBuilder
from mcap.opcode import Opcode

from fruitgui.sensors.recordings.packing import PACKING, Chunk
from fruitgui.sensors.recordings.part_file import is_full
from fruitgui.sensors.recordings.records import CHUNK, MAGIC, RECORD_HEAD

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer
_INDEX_BYTES, _PLACE_BYTES, _CONTENTS_BYTES = 96, 10, 1024
"""What a chunk takes in the table of contents, each channel in it takes more, and what else stands there, at most."""


@dataclass(frozen=True, slots=True)
class Definitions:
    """What stands at the head of a file.

    Attributes:
        schemas, channels: by the numbers that they carry themselves.
        metadata: named records of text.
    """

    schemas: Sequence[records.Schema]
    channels: Sequence[records.Channel]
    metadata: Mapping[str, Mapping[str, str]]


class McapOutput:
    """Writes a file's head (`begin`), then chunks, then its table of contents.

    Args:
        file: open for writing, empty, unbuffered: what was written is with the system.

    Raises:
        OSError: from every method, where the disk is full or gone; the file then ends with the last whole chunk.
    """

    def __init__(self, file: io.FileIO) -> None:
        self._file = file
        self._definitions = Definitions((), (), {})
        self._end = 0
        self._chunks: list[tuple[records.ChunkIndex, Mapping[int, int]]] = []
        self._metadata: list[records.MetadataIndex] = []
        self._contents_bytes = 0

    @property
    def size(self) -> int:
        """Bytes of the file that are sound."""
        return self._end

    @property
    def size_finished(self) -> int:
        """How large the file would be if it were finished now; never less than it then is."""
        return self._end + self._contents_bytes

    @property
    def counts(self) -> Counter[int]:
        """Messages in the file, by channel."""
        counts: Counter[int] = Counter()
        for _, messages in self._chunks:
            counts.update(messages)
        return counts

    @property
    def times_ns(self) -> tuple[int, int]:
        """The earliest and the latest time of recording in the file; zeros where it is empty."""
        chunks = [chunk for chunk, _ in self._chunks]
        first = min((chunk.message_start_time for chunk in chunks), default=0)
        return first, max((chunk.message_end_time for chunk in chunks), default=0)

    @property
    def begun(self) -> bool:
        """Whether the head was written."""
        return self._end > 0

    def begin(self, definitions: Definitions) -> None:
        """Write the head: the definitions of everything that will come."""
        self._definitions = definitions
        self._metadata = []
        self._write(self._head())
        self._contents_bytes = self._end + _CONTENTS_BYTES

    def append(self, chunk: Chunk) -> None:
        """Write a chunk, and where its messages stand in it."""
        start = self._end
        head = _chunk_head(chunk)
        at = start + len(head) + len(chunk.packed)
        tables, places = RecordBuilder(), {}
        for channel, entries in chunk.index.items():
            places[channel] = at + tables.count
            records.MessageIndex(channel, list(entries)).write(tables)
        table = tables.end()
        self._write(head, chunk.packed, table)
        index = records.ChunkIndex(
            chunk_length=at - start, chunk_start_offset=start, compression=PACKING, compressed_size=len(chunk.packed),
            message_end_time=chunk.last_ns, message_index_length=len(table), message_index_offsets=places,
            message_start_time=chunk.first_ns, uncompressed_size=chunk.unpacked_bytes,
        )  # fmt: skip
        self._contents_bytes += _INDEX_BYTES + _PLACE_BYTES * len(places)
        self._chunks.append((index, {channel: len(entries) for channel, entries in chunk.index.items()}))

    def finish(self) -> None:
        """Write the table of contents; where there is no room for it, in the place of the last chunks."""
        while True:
            try:
                self._write(self._contents())
            except OSError as error:
                if not is_full(error) or not self._chunks:
                    raise
                self._end = self._chunks.pop()[0].chunk_start_offset
                self._go_back()
            else:
                return

    def _write(self, *parts: ReadableBuffer) -> None:
        written = 0
        try:
            for part in parts:
                left = memoryview(part)
                while left:
                    count = self._file.write(left)
                    written += count
                    left = left[count:]
        except OSError:
            self._go_back()
            raise
        self._end += written

    def _go_back(self) -> None:
        """Let the file end where it is sound; a disk that is gone cannot even do that, and readers cope with it."""
        with contextlib.suppress(OSError):
            self._file.seek(self._end)
            self._file.truncate()

    def _head(self) -> bytes:
        builder = RecordBuilder()
        builder.write(MAGIC)
        records.Header(profile="ros2", library="fruitgui").write(builder)
        for definition in (*self._definitions.schemas, *self._definitions.channels):
            definition.write(builder)
        for name, content in self._definitions.metadata.items():
            start = builder.count
            records.Metadata(name=name, metadata=dict(content)).write(builder)
            self._metadata.append(records.MetadataIndex(offset=start, length=builder.count - start, name=name))
        return bytes(builder.end())

    def _contents(self) -> bytes:
        """Return everything that stands after the last chunk."""
        before = RecordBuilder()
        records.DataEnd(0).write(before)
        data_end = before.end()
        start = self._end + len(data_end)
        builder = RecordBuilder()
        offsets = []
        for opcode, group in (
            (Opcode.SCHEMA, self._definitions.schemas),
            (Opcode.CHANNEL, self._definitions.channels),
            (Opcode.STATISTICS, [self._statistics()]),
            (Opcode.CHUNK_INDEX, [index for index, _ in self._chunks]),
            (Opcode.METADATA_INDEX, self._metadata),
        ):
            begins = builder.count
            for record in group:
                record.write(builder)
            if builder.count > begins:
                offsets.append(records.SummaryOffset(opcode, start + begins, builder.count - begins))
        offsets_start = start + builder.count
        for offset in offsets:
            offset.write(builder)
        summary = builder.end()
        footer = struct.pack("<BQQQ", Opcode.FOOTER, 8 + 8 + 4, start, offsets_start)
        crc = zlib.crc32(footer, zlib.crc32(summary))
        return b"".join((data_end, summary, footer, struct.pack("<I", crc), MAGIC))

    def _statistics(self) -> records.Statistics:
        counts = self.counts
        first_ns, last_ns = self.times_ns
        return records.Statistics(
            attachment_count=0, channel_count=len(self._definitions.channels), channel_message_counts=dict(counts),
            chunk_count=len(self._chunks), message_count=counts.total(), message_end_time=last_ns,
            message_start_time=first_ns, metadata_count=len(self._metadata),
            schema_count=len(self._definitions.schemas),
        )  # fmt: skip


def _chunk_head(chunk: Chunk) -> bytes:
    """Return a chunk's record up to what is packed in it."""
    fields = struct.pack("<QQQI", chunk.first_ns, chunk.last_ns, chunk.unpacked_bytes, chunk.crc)
    kind = PACKING.encode()
    fields += struct.pack("<I", len(kind)) + kind + struct.pack("<Q", len(chunk.packed))
    return RECORD_HEAD.pack(CHUNK, len(fields) + len(chunk.packed)) + fields
