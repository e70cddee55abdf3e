"""Pictures decoded: colour as RGB, depth as millimetres. Every size is checked before memory is taken."""

from __future__ import annotations

import struct
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from fruitgui.frame import U8, U16
from fruitgui.sensors.recordings.raw import MalformedError
from fruitgui.sensors.recordings.wire import Picture

MAX_PIXELS = 4096 * 3072
_MAX_SIDE = 16384
_PNG = b"\x89PNG\r\n\x1a\n"
_JPEG = b"\xff\xd8\xff"
_JPEG_END = b"\xff\xd9"
_JPEG_SIZE_MARKERS = frozenset(range(0xC0, 0xD0)) - {0xC4, 0xC8, 0xCC}
_COMPRESSED_DEPTH_HEAD = struct.Struct("<iff")

_CHANNELS = {
    "rgb8": 3, "bgr8": 3, "8uc3": 3, "rgba8": 4, "bgra8": 4, "8uc4": 4, "mono8": 1, "8uc1": 1,
    "yuv422": 2, "uyvy": 2, "yuv422_yuy2": 2, "yuyv": 2,
    "bayer_rggb8": 1, "bayer_bggr8": 1, "bayer_gbrg8": 1, "bayer_grbg8": 1,
}  # fmt: skip
_TO_RGB = {
    "bgr8": cv2.COLOR_BGR2RGB, "8uc3": cv2.COLOR_BGR2RGB,
    "rgba8": cv2.COLOR_RGBA2RGB, "bgra8": cv2.COLOR_BGRA2RGB, "8uc4": cv2.COLOR_BGRA2RGB,
    "mono8": cv2.COLOR_GRAY2RGB, "8uc1": cv2.COLOR_GRAY2RGB,
    "yuv422": cv2.COLOR_YUV2RGB_UYVY, "uyvy": cv2.COLOR_YUV2RGB_UYVY,
    "yuv422_yuy2": cv2.COLOR_YUV2RGB_YUY2, "yuyv": cv2.COLOR_YUV2RGB_YUY2,
    "bayer_rggb8": cv2.COLOR_BayerBG2RGB, "bayer_bggr8": cv2.COLOR_BayerRG2RGB,
    "bayer_gbrg8": cv2.COLOR_BayerGR2RGB, "bayer_grbg8": cv2.COLOR_BayerGB2RGB,
}  # fmt: skip


def picture_size(picture: Picture) -> tuple[int, int]:
    """Return (width, height) without decoding. Raises `MalformedError` where the size is none or too large."""
    width, height = _packed_size(_packed_bytes(picture)) if picture.compressed else (picture.width, picture.height)
    if not (0 < width <= _MAX_SIDE and 0 < height <= _MAX_SIDE and width * height <= MAX_PIXELS):
        raise MalformedError(f"a picture of {width}×{height} pixels")
    return width, height


def decode_color(picture: Picture) -> U8:
    """Return (height, width, 3) RGB. Raises `MalformedError`."""
    picture_size(picture)
    if picture.compressed:
        return _decode_packed_color(picture)
    encoding = picture.encoding.lower()
    if encoding not in _CHANNELS:
        raise MalformedError(f"colour is encoded as {picture.encoding[:20]!r}, which is not supported")
    pixels = _rows(picture, _CHANNELS[encoding])
    conversion = _TO_RGB.get(encoding)
    if conversion is None:
        return np.ascontiguousarray(pixels)
    try:
        return np.asarray(cv2.cvtColor(np.ascontiguousarray(pixels), conversion), dtype=np.uint8)
    except cv2.error as error:
        raise MalformedError("a picture's size does not suit its encoding") from error


def decode_depth(picture: Picture) -> U16:
    """Return (height, width) millimetres, 0 = no reading. Raises `MalformedError`."""
    picture_size(picture)
    if picture.compressed:
        return _decode_packed_depth(picture)
    encoding = picture.encoding.lower()
    order = ">" if picture.big_endian else "<"
    if encoding in ("16uc1", "mono16"):
        rows = _rows(picture, 2)
        return _whole_mm(np.ascontiguousarray(rows).view(f"{order}u2")[..., 0])
    if encoding == "32fc1":
        rows = _rows(picture, 4)
        return _mm_from_metres(np.ascontiguousarray(rows).view(f"{order}f4")[..., 0])
    raise MalformedError(f"depth is encoded as {picture.encoding[:20]!r}, which is not supported")


def _rows(picture: Picture, pixel_bytes: int) -> U8:
    """Return (height, width, pixel_bytes), the padding at the end of the rows left out."""
    used = picture.width * pixel_bytes
    step = picture.step or used
    if step < used or step * (picture.height - 1) + used > len(picture.data):
        raise MalformedError("a picture holds fewer bytes than its size needs")
    if step * picture.height <= len(picture.data):
        flat = np.frombuffer(picture.data, np.uint8, step * picture.height)
        rows = flat.reshape(picture.height, step)[:, :used]
    else:
        rows = np.lib.stride_tricks.as_strided(
            np.frombuffer(picture.data, np.uint8), (picture.height, used), (step, 1), writeable=False
        )
    return rows.reshape(picture.height, picture.width, pixel_bytes)


def _whole_mm(values: NDArray[np.uint16]) -> U16:
    depth_mm = values.astype(np.uint16, copy=True)
    depth_mm[depth_mm == 65535] = 0
    return depth_mm


def _mm_from_metres(values_m: NDArray[np.float32]) -> U16:
    mm = np.nan_to_num(values_m.astype(np.float32) * np.float32(1000.0), nan=0.0, posinf=0.0, neginf=0.0)
    return np.where((mm >= 0.5) & (mm < 65534.5), np.rint(mm), np.float32(0.0)).astype(np.uint16)


def _decode_packed_color(picture: Picture) -> U8:
    data = _packed_bytes(picture)
    if bytes(data[:3]) == _JPEG and _JPEG_END not in bytes(data[-1024:]):
        raise MalformedError("a jpeg picture is cut off")
    pixels = _decoded(data, cv2.IMREAD_COLOR | cv2.IMREAD_IGNORE_ORIENTATION)
    return np.asarray(cv2.cvtColor(pixels, cv2.COLOR_BGR2RGB), dtype=np.uint8)


def _decode_packed_depth(picture: Picture) -> U16:
    pixels = _decoded(_packed_bytes(picture), cv2.IMREAD_UNCHANGED)
    if pixels.ndim != 2 or pixels.dtype != np.uint16:
        raise MalformedError("packed depth is not a 16-bit grey png")
    if _is_compressed_depth(picture) and picture.encoding.lower().startswith("32fc1"):
        return _from_inverse_depth(pixels, *_COMPRESSED_DEPTH_HEAD.unpack_from(picture.data)[1:])
    return _whole_mm(pixels)


def _from_inverse_depth(values: NDArray[np.uint16], gain: float, offset: float) -> U16:
    """Return millimetres of the inverse depth of ROS compressed_depth_image_transport: z = a / (v − b)."""
    with np.errstate(divide="ignore", invalid="ignore"):
        metres = np.float32(gain) / (values.astype(np.float32) - np.float32(offset))
    return _mm_from_metres(np.where(values == 0, np.float32(np.nan), metres).astype(np.float32))


def _decoded(data: memoryview, flags: int) -> NDArray[Any]:
    try:
        pixels = cv2.imdecode(np.frombuffer(data, np.uint8), flags)
    except cv2.error as error:
        raise MalformedError("a packed picture is damaged") from error
    if pixels is None:
        raise MalformedError("a packed picture is damaged")
    return np.asarray(pixels)


def _is_compressed_depth(picture: Picture) -> bool:
    return "compresseddepth" in picture.encoding.lower()


def _packed_bytes(picture: Picture) -> memoryview:
    """Return the jpeg or png itself, without the head of compressedDepth."""
    if "rvl" in picture.encoding.lower():
        raise MalformedError("depth is packed as rvl, which is not supported")
    return picture.data[_COMPRESSED_DEPTH_HEAD.size :] if _is_compressed_depth(picture) else picture.data


def _packed_size(data: memoryview) -> tuple[int, int]:
    head = bytes(data[:24])
    if head.startswith(_PNG) and len(head) == 24:
        width, height = struct.unpack_from(">II", head, 16)
        return int(width), int(height)
    if head.startswith(_JPEG):
        return _jpeg_size(data)
    raise MalformedError("a packed picture is neither jpeg nor png")


def _jpeg_size(data: memoryview) -> tuple[int, int]:
    position = 2
    while position + 9 <= len(data) and data[position] == 0xFF:
        marker = data[position + 1]
        if marker in _JPEG_SIZE_MARKERS:
            height, width = struct.unpack_from(">HH", data, position + 5)
            return int(width), int(height)
        if marker == 0xFF:
            position += 1
        else:
            position += 2 + int(struct.unpack_from(">H", data, position + 2)[0])
    raise MalformedError("a jpeg picture does not say its size")
