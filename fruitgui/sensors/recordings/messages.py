"""The messages that a recording is written in, laid out by rosbags; pictures are not copied into them."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import Any, TypeAlias

import cv2
import numpy as np
from numpy.typing import NDArray

from fruitgui.errors import WorldError
from fruitgui.frame import U8, U16, Intrinsics

IMAGE = "sensor_msgs/msg/Image"
COMPRESSED_IMAGE = "sensor_msgs/msg/CompressedImage"
CAMERA_INFO = "sensor_msgs/msg/CameraInfo"

_JPEG_QUALITY = 95
_NOTHING = np.empty(0, np.uint8)

Parts: TypeAlias = tuple[bytes | memoryview, ...]
"""One serialised message, in pieces that belong one after the other."""


@dataclass(frozen=True, slots=True)
class Stamp:
    """What stands at the head of a message: a time in whole nanoseconds, and a frame of reference."""

    time_ns: int
    frame_id: str


class Messages:
    """Makes the serialised messages of a recording; any number of threads may ask at once."""

    def __init__(self) -> None:
        from rosbags.typesys import Stores, get_typestore

        self._store = get_typestore(Stores.ROS2_HUMBLE)

    def definition(self, type_name: str) -> bytes:
        """Return the text of a message definition with all that it needs, as ROS 2 tools expect it."""
        text: str = self._store.generate_msgdef(type_name, ros_version=2)[0]
        return text.encode()

    def depth(self, stamp: Stamp, depth_mm: U16) -> Parts:
        """Return an Image, raw 16UC1, millimetres."""
        rows = np.ascontiguousarray(depth_mm, dtype="<u2")
        height, width = rows.shape
        return self._picture(
            IMAGE, _octets(rows), header=self._header(stamp), height=height, width=width,
            encoding="16UC1", is_bigendian=0, step=2 * width,
        )  # fmt: skip

    def color(self, stamp: Stamp, color: U8) -> Parts:
        """Return a CompressedImage, JPEG.

        Raises:
            WorldError: the picture cannot be packed.
        """
        try:
            bgr = cv2.cvtColor(np.ascontiguousarray(color), cv2.COLOR_RGB2BGR)
            done, packed = cv2.imencode(".jpg", bgr, [cv2.IMWRITE_JPEG_QUALITY, _JPEG_QUALITY])
        except cv2.error:
            done, packed = False, _NOTHING
        if not done:
            raise WorldError("cannot_encode", "A colour picture cannot be packed as JPEG.", "Look at the sensor.")
        return self._picture(COMPRESSED_IMAGE, _octets(packed), header=self._header(stamp), format="jpeg")

    def camera_info(self, stamp: Stamp, camera: Intrinsics) -> Parts:
        """Return a CameraInfo."""
        D = camera.distortion or (0.0,) * 5
        P = np.hstack([camera.matrix, np.zeros((3, 1))])
        whole = self._serialised(
            CAMERA_INFO, header=self._header(stamp), height=camera.height, width=camera.width,
            distortion_model="plumb_bob" if len(D) <= 5 else "rational_polynomial",
            d=np.array(D, dtype=np.float64), k=camera.matrix.reshape(-1), r=np.eye(3).reshape(-1), p=P.reshape(-1),
            binning_x=0, binning_y=0, roi=self._made("sensor_msgs/msg/RegionOfInterest", x_offset=0, y_offset=0,
                                                    height=0, width=0, do_rectify=False),
        )  # fmt: skip
        return (whole,)

    def _picture(self, type_name: str, data: memoryview, **fields: Any) -> Parts:  # noqa: ANN401 - made at run time
        """Return a message whose last field is `data`: serialised without it, its length then put right."""
        empty = self._serialised(type_name, **fields, data=_NOTHING)
        return empty[:-4] + struct.pack("<I", data.nbytes), data

    def _header(self, stamp: Stamp) -> Any:  # noqa: ANN401 - made by rosbags at run time
        seconds, nanoseconds = divmod(stamp.time_ns, 1_000_000_000)
        time = self._made("builtin_interfaces/msg/Time", sec=seconds, nanosec=nanoseconds)
        return self._made("std_msgs/msg/Header", stamp=time, frame_id=stamp.frame_id)

    def _made(self, type_name: str, **fields: Any) -> Any:  # noqa: ANN401 - made by rosbags at run time
        return self._store.types[type_name](**fields)

    def _serialised(self, type_name: str, **fields: Any) -> bytes:  # noqa: ANN401 - made by rosbags at run time
        return bytes(self._store.serialize_cdr(self._made(type_name, **fields), type_name))


def _octets(array: NDArray[Any]) -> memoryview:
    """Return an array's bytes where they are."""
    return array.reshape(-1).view(np.uint8).data
