"""The messages that a recording is written in, serialised by rosbags."""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np

from fruitgui.errors import WorldError
from fruitgui.frame import U8, U16, Intrinsics

IMAGE = "sensor_msgs/msg/Image"
COMPRESSED_IMAGE = "sensor_msgs/msg/CompressedImage"
CAMERA_INFO = "sensor_msgs/msg/CameraInfo"

_JPEG_QUALITY = 95


class Messages:
    """Makes the serialised messages of a recording."""

    def __init__(self) -> None:
        from rosbags.typesys import Stores, get_typestore

        self._store = get_typestore(Stores.ROS2_HUMBLE)

    def definition(self, type_name: str) -> bytes:
        """Return the text of a message definition with all that it needs, as ROS 2 tools expect it."""
        text: str = self._store.generate_msgdef(type_name, ros_version=2)[0]
        return text.encode()

    def depth(self, stamp_ns: int, frame_id: str, depth_mm: U16) -> bytes:
        """Return an Image, raw 16UC1, millimetres."""
        rows = np.ascontiguousarray(depth_mm, dtype="<u2")
        height, width = rows.shape
        return self._serialised(
            IMAGE, header=self._header(stamp_ns, frame_id), height=height, width=width, encoding="16UC1",
            is_bigendian=0, step=2 * width, data=rows.view(np.uint8).reshape(-1),
        )  # fmt: skip

    def color(self, stamp_ns: int, frame_id: str, color: U8) -> bytes:
        """Return a CompressedImage, JPEG."""
        bgr = cv2.cvtColor(np.ascontiguousarray(color), cv2.COLOR_RGB2BGR)
        done, packed = cv2.imencode(".jpg", bgr, [cv2.IMWRITE_JPEG_QUALITY, _JPEG_QUALITY])
        if not done:
            raise WorldError("cannot_encode", "A colour picture cannot be packed as JPEG.", "Look at the sensor.")
        header = self._header(stamp_ns, frame_id)
        return self._serialised(COMPRESSED_IMAGE, header=header, format="jpeg", data=packed.reshape(-1))

    def camera_info(self, stamp_ns: int, frame_id: str, camera: Intrinsics) -> bytes:
        """Return a CameraInfo."""
        D = camera.distortion or (0.0,) * 5
        P = np.hstack([camera.matrix, np.zeros((3, 1))])
        return self._serialised(
            CAMERA_INFO, header=self._header(stamp_ns, frame_id), height=camera.height, width=camera.width,
            distortion_model="plumb_bob" if len(D) <= 5 else "rational_polynomial",
            d=np.array(D, dtype=np.float64), k=camera.matrix.reshape(-1), r=np.eye(3).reshape(-1), p=P.reshape(-1),
            binning_x=0, binning_y=0, roi=self._made("sensor_msgs/msg/RegionOfInterest", x_offset=0, y_offset=0,
                                                    height=0, width=0, do_rectify=False),
        )  # fmt: skip

    def _header(self, stamp_ns: int, frame_id: str) -> Any:  # noqa: ANN401 - made by rosbags at run time
        seconds, nanoseconds = divmod(stamp_ns, 1_000_000_000)
        stamp = self._made("builtin_interfaces/msg/Time", sec=seconds, nanosec=nanoseconds)
        return self._made("std_msgs/msg/Header", stamp=stamp, frame_id=frame_id)

    def _made(self, type_name: str, **fields: Any) -> Any:  # noqa: ANN401 - made by rosbags at run time
        return self._store.types[type_name](**fields)

    def _serialised(self, type_name: str, **fields: Any) -> bytes:  # noqa: ANN401 - made by rosbags at run time
        return bytes(self._store.serialize_cdr(self._made(type_name, **fields), type_name))
