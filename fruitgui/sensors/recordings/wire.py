"""The handful of ROS messages that a recording needs, read straight from their bytes.

The generic deserialisers build every field of every message and trust its
lengths; these read what is used, check every bound and leave images as views
of the message. Wire formats: CDR (OMG DDS-XTYPES 7.4, as ROS 2 writes it,
either byte order) and ROS 1 (no alignment, little-endian).
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import Any

from fruitgui.sensors.recordings.raw import MalformedError, RawMessage

_MAX_TEXT = 4096
_MAX_NUMBERS = 64
_MAX_TRANSFORMS = 4096


class _Reader:
    """Walks through one serialised message."""

    def __init__(self, message: RawMessage) -> None:
        self._data = memoryview(message.data)
        self.ros1 = message.wire == "ros1"
        self._order = "<"
        self._start = self._position = 0
        if not self.ros1:
            self._open_cdr(message.wire)

    def _open_cdr(self, wire: str) -> None:
        if wire != "cdr":
            raise MalformedError(f"messages are encoded as {wire[:20]!r}, which is not supported")
        if len(self._data) < 4 or self._data[0] != 0 or self._data[1] not in (0, 1):
            raise MalformedError("a message is not plain CDR")
        self._order = "<" if self._data[1] else ">"
        self._start = self._position = 4

    def numbers(self, code: str, count: int = 1) -> tuple[Any, ...]:
        width = struct.calcsize("<" + code)
        if not self.ros1:
            self._position += -(self._position - self._start) % width
        try:
            values = struct.unpack_from(f"{self._order}{count}{code}", self._data, self._position)
        except struct.error as error:
            raise MalformedError("a message is too short") from error
        self._position += width * count
        return values

    def integer(self, code: str = "I") -> int:
        return int(self.numbers(code)[0])

    def text(self) -> str:
        length = self.integer()
        if length > _MAX_TEXT:
            raise MalformedError("a text in a message is too long")
        return str(self._taken(length), "utf-8", "replace").rstrip("\0")

    def octets(self) -> memoryview:
        return self._taken(self.integer())

    def floats(self) -> tuple[float, ...]:
        count = self.integer()
        if count > _MAX_NUMBERS:
            raise MalformedError("a list in a message is too long")
        return self.numbers("d", count) if count else ()

    def _taken(self, length: int) -> memoryview:
        end = self._position + length
        if end > len(self._data):
            raise MalformedError("a message claims more data than it holds")
        taken = self._data[self._position : end]
        self._position = end
        return taken

    def stamp_ns(self) -> int:
        if self.ros1:
            self.integer()
            return self.integer() * 1_000_000_000 + self.integer()
        return self.integer("i") * 1_000_000_000 + self.integer()


@dataclass(frozen=True, slots=True)
class Picture:
    """`sensor_msgs/Image` or `CompressedImage`, not decoded.

    Attributes:
        stamp_ns, frame_id: of its header.
        encoding: pixel encoding, or the `format` of a compressed picture.
        compressed: whether `data` is a jpeg, a png or the like.
        height, width, step: rows, columns, bytes per row; 0 where compressed.
        big_endian: byte order of pixels wider than a byte.
        data: a view of the message.
    """

    stamp_ns: int
    frame_id: str
    encoding: str
    compressed: bool
    data: memoryview
    height: int = 0
    width: int = 0
    step: int = 0
    big_endian: bool = False


@dataclass(frozen=True, slots=True)
class CameraInfo:
    """`sensor_msgs/CameraInfo`, as it stands."""

    frame_id: str
    height: int
    width: int
    model: str
    D: tuple[float, ...]
    K: tuple[float, ...]
    P: tuple[float, ...]
    binning: tuple[int, int]
    region: tuple[int, int, int, int]


@dataclass(frozen=True, slots=True)
class Transform:
    """One edge of the tree of frames: a point in `child` is mapped into `parent`."""

    parent: str
    child: str
    translation_m: tuple[float, float, float]
    quaternion_xyzw: tuple[float, float, float, float]


def stamp_ns(message: RawMessage) -> int:
    """Return the header stamp of any message that begins with a header, ns."""
    return _Reader(message).stamp_ns()


def read_picture(message: RawMessage) -> Picture:
    """Read an Image or a CompressedImage. Raises `MalformedError`."""
    reader = _Reader(message)
    stamp, frame_id = reader.stamp_ns(), _frame_name(reader.text())
    if message.type_name == "sensor_msgs/CompressedImage":
        return Picture(stamp, frame_id, reader.text(), compressed=True, data=reader.octets())
    height, width = reader.integer(), reader.integer()
    encoding, big_endian, step = reader.text(), bool(reader.integer("B")), reader.integer()
    return Picture(stamp, frame_id, encoding, False, reader.octets(), height, width, step, big_endian)


def read_camera_info(message: RawMessage) -> CameraInfo:
    """Read a CameraInfo. Raises `MalformedError`."""
    reader = _Reader(message)
    reader.stamp_ns()
    frame_id = _frame_name(reader.text())
    height, width, model = reader.integer(), reader.integer(), reader.text()
    D, K, _, P = reader.floats(), reader.numbers("d", 9), reader.numbers("d", 9), reader.numbers("d", 12)
    binning = (reader.integer(), reader.integer())
    x, y, rows, columns = reader.numbers("I", 4)
    return CameraInfo(frame_id, height, width, model, D, K, P, binning, (x, y, columns, rows))


def read_transforms(message: RawMessage) -> list[Transform]:
    """Read a TFMessage. Raises `MalformedError`."""
    reader = _Reader(message)
    count = reader.integer()
    if count > _MAX_TRANSFORMS:
        raise MalformedError("a message holds too many transforms")
    return [_transform(reader) for _ in range(count)]


def _transform(reader: _Reader) -> Transform:
    reader.stamp_ns()
    parent, child = _frame_name(reader.text()), _frame_name(reader.text())
    x, y, z, *turn = reader.numbers("d", 7)
    return Transform(parent, child, (x, y, z), (turn[0], turn[1], turn[2], turn[3]))


def _frame_name(name: str) -> str:
    """Return a frame's name as tf2 has it: without the leading slash of old."""
    return name.removeprefix("/")
