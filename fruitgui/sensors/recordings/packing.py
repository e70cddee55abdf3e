"""Frames packed into chunks of an MCAP file: a pure function of frames, so that any thread can do it.

What takes time here (JPEG, the checksum, zstd) lets go of Python's lock, and no picture is copied on its way.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from fruitgui.frame import Frame
from fruitgui.sensors.recordings.messages import CAMERA_INFO, COMPRESSED_IMAGE, IMAGE, Messages, Parts, Stamp
from fruitgui.sensors.recordings.records import MESSAGE, RECORD_HEAD

COLOR_INFO, COLOR = "rgb/camera_info", "rgb/image_raw/compressed"
DEPTH_INFO, DEPTH = "depth_registered/camera_info", "depth_registered/image_raw"
TYPES: Mapping[str, str] = {COLOR_INFO: CAMERA_INFO, COLOR: COMPRESSED_IMAGE, DEPTH_INFO: CAMERA_INFO, DEPTH: IMAGE}
"""Type of message by the part of a sensor's topics, in the order in which a frame's messages stand."""

PACKING = "zstd"
_LEVEL = 1
_MESSAGE_HEAD = struct.Struct("<HIQQ")

Channels: TypeAlias = Mapping[tuple[str, str], int]
"""Number of the channel by sensor and part."""


@dataclass(frozen=True, slots=True, eq=False)
class Stamped:
    """A frame with the times that it is stored under, in whole nanoseconds.

    Attributes:
        stamp_ns: in the sensor's clock. log_time_ns: when it came, in the host's.
    """

    frame: Frame
    stamp_ns: int
    log_time_ns: int

    @property
    def raw_bytes(self) -> int:
        """How much there is to pack."""
        return self.frame.color.nbytes + self.frame.depth_mm.nbytes


@dataclass(frozen=True, slots=True, eq=False)
class Chunk:
    """Messages packed together.

    Attributes:
        packed: with `PACKING`.
        unpacked_bytes, crc: of what comes out of it.
        first_ns, last_ns: earliest and latest time of recording in it.
        index: of each channel, (time of recording, byte of the unpacked content where it stands) of its messages.
    """

    packed: bytes
    unpacked_bytes: int
    crc: int
    first_ns: int
    last_ns: int
    index: Mapping[int, Sequence[tuple[int, int]]]


def pack(frames: Sequence[Stamped], channels: Channels, messages: Messages) -> Chunk:
    """Return frames, one at least, as one chunk.

    Raises:
        WorldError: a picture cannot be packed.
    """
    import zstandard

    pieces: list[bytes | memoryview] = []
    index: dict[int, list[tuple[int, int]]] = {}
    size = 0
    for one in frames:
        for part, message in _messages(one, messages):
            channel = channels[one.frame.sensor, part]
            index.setdefault(channel, []).append((one.log_time_ns, size))
            head = _MESSAGE_HEAD.pack(channel, one.frame.sequence & 0xFFFFFFFF, one.log_time_ns, max(one.stamp_ns, 0))
            length = len(head) + sum(len(piece) for piece in message)
            pieces += (RECORD_HEAD.pack(MESSAGE, length) + head, *message)
            size += RECORD_HEAD.size + length
    packer = zstandard.ZstdCompressor(level=_LEVEL).compressobj(size=size)
    crc, packed = 0, []
    for piece in pieces:
        crc = zlib.crc32(piece, crc)
        packed.append(packer.compress(piece))
    packed.append(packer.flush())
    times_ns = [one.log_time_ns for one in frames]
    return Chunk(b"".join(packed), size, crc, min(times_ns), max(times_ns), index)


def _messages(one: Stamped, messages: Messages) -> tuple[tuple[str, Parts], ...]:
    frame = one.frame
    stamp = Stamp(one.stamp_ns, f"{frame.sensor}_rgb_optical_frame")
    info = messages.camera_info(stamp, frame.intrinsics)
    return (
        (COLOR_INFO, info),
        (COLOR, messages.color(stamp, frame.color)),
        (DEPTH_INFO, info),
        (DEPTH, messages.depth(stamp, frame.depth_mm)),
    )
