# ruff: noqa: ANN401 — the library makes its message types at run time
"""Writes a scene as an MCAP recording with the public libraries alone."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tests.second_rig.camera import Lens
from tests.second_rig.render import DEPTH_CAMERA_SHIFT_M, Renderer, Shot
from tests.second_rig.scene import Eye, Scene


@dataclass(frozen=True, slots=True)
class Style:
    """How a recording is written; every choice is one the contract allows.

    Attributes:
        colour: jpeg, png, rgb8 or bgr8. depth: 16UC1, png, compressedDepth or 32FC1.
        disorder_s: messages are put off by up to this long, so that frames come out of order.
        chunk: zstd, lz4 or none. padded: whether raw image rows have padding.
    """

    colour: str = "jpeg"
    depth: str = "16UC1"
    disorder_s: float = 0.0
    chunk: str = "zstd"
    padded: bool = False


PLAIN = Style()


@dataclass(frozen=True, slots=True)
class Message:
    """One message before it is put into a file."""

    topic: str
    kind: str
    stamp_s: float
    record: Any


@lru_cache(maxsize=1)
def store() -> Any:
    """Return the library's own ROS 2 types."""
    from rosbags.typesys import Stores, get_typestore

    return get_typestore(Stores.ROS2_HUMBLE)


def header(stamp_s: float, frame: str) -> Any:
    """Return a message header."""
    types = store().types
    nanoseconds = round(stamp_s * 1e9)
    stamp = types["builtin_interfaces/msg/Time"](sec=nanoseconds // 10**9, nanosec=nanoseconds % 10**9)
    return types["std_msgs/msg/Header"](stamp=stamp, frame_id=frame)


def raw_image(stamp_s: float, frame: str, encoding: str, pixels: NDArray[Any], padded: bool = False) -> Any:
    """Return a `sensor_msgs/msg/Image`."""
    height, width = pixels.shape[:2]
    rows = np.ascontiguousarray(pixels).view(np.uint8).reshape(height, -1)
    if padded:
        rows = np.pad(rows, ((0, 0), (0, 64)))
    return store().types["sensor_msgs/msg/Image"](
        header=header(stamp_s, frame), height=height, width=width, encoding=encoding, is_bigendian=0,
        step=rows.shape[1], data=rows.reshape(-1),
    )  # fmt: skip


def packed_image(stamp_s: float, frame: str, text: str, data: bytes) -> Any:
    """Return a `sensor_msgs/msg/CompressedImage`."""
    kind = store().types["sensor_msgs/msg/CompressedImage"]
    return kind(header=header(stamp_s, frame), format=text, data=np.frombuffer(data, np.uint8))


def camera_info(stamp_s: float, frame: str, lens: Lens) -> Any:
    """Return a `sensor_msgs/msg/CameraInfo`."""
    types = store().types
    roi = types["sensor_msgs/msg/RegionOfInterest"](x_offset=0, y_offset=0, height=0, width=0, do_rectify=False)
    projection = np.concatenate([lens.matrix, np.zeros((3, 1))], axis=1)
    distortion = np.array(lens.distortion or (0.0,) * 5)
    return types["sensor_msgs/msg/CameraInfo"](
        header=header(stamp_s, frame), height=lens.height, width=lens.width, distortion_model="plumb_bob",
        d=distortion, k=lens.matrix.reshape(-1), r=np.eye(3).reshape(-1), p=projection.reshape(-1),
        binning_x=0, binning_y=0, roi=roi,
    )  # fmt: skip


def messages(scene: Scene, style: Style = PLAIN) -> Iterator[Message]:
    """Render a scene; yield its messages in the order in which they are to be written."""
    waiting: list[tuple[float, list[Message]]] = []
    rng = np.random.default_rng([scene.seed, 9])
    renderer = Renderer(scene)
    for time, sequence, eye in scene.captures():
        shot = renderer.shoot(eye, time, sequence)
        waiting.append(
            (time + float(rng.uniform(0.0, style.disorder_s)), list(shot_messages(scene, eye, time, shot, style)))
        )
        waiting.sort(key=lambda item: item[0])
        while waiting and waiting[0][0] <= time:
            yield from waiting.pop(0)[1]
    for _, late in waiting:
        yield from late


def shot_messages(scene: Scene, eye: Eye, time_s: float, shot: Shot, style: Style) -> Iterator[Message]:
    """Yield what one shot becomes in a recording."""
    stamp, name = scene.stamp_s(eye, time_s), eye.name
    frame = f"{name}_rgb_optical_frame"
    yield Message(f"/{name}/rgb/camera_info", "sensor_msgs/msg/CameraInfo", stamp, camera_info(stamp, frame, eye.lens))
    yield _colour(name, frame, stamp, shot.colour, style)
    if eye.depth_in_own_camera:
        own = f"{name}_depth_optical_frame"
        info = camera_info(stamp, own, eye.lens)
        yield Message(f"/{name}/depth/camera_info", "sensor_msgs/msg/CameraInfo", stamp, info)
        yield Message("/tf_static", "tf2_msgs/msg/TFMessage", stamp, _aside(stamp, frame, own))
        yield _depth(f"/{name}/depth", own, stamp, shot.depth_mm, style)
    else:
        yield _depth(f"/{name}/depth_registered", frame, stamp, shot.depth_mm, style)


def _colour(name: str, frame: str, stamp_s: float, rgb: NDArray[np.uint8], style: Style) -> Message:
    import cv2

    topic = f"/{name}/rgb/image_raw"
    if style.colour in ("jpeg", "png"):
        quality = [cv2.IMWRITE_JPEG_QUALITY, 92] if style.colour == "jpeg" else []
        data = cv2.imencode(".jpg" if style.colour == "jpeg" else ".png", rgb[..., ::-1], quality)[1].tobytes()
        record = packed_image(stamp_s, frame, f"rgb8; {style.colour} compressed bgr8", data)
        return Message(f"{topic}/compressed", "sensor_msgs/msg/CompressedImage", stamp_s, record)
    pixels = rgb if style.colour == "rgb8" else rgb[..., ::-1]
    record = raw_image(stamp_s, frame, style.colour, pixels, style.padded)
    return Message(topic, "sensor_msgs/msg/Image", stamp_s, record)


def _depth(prefix: str, frame: str, stamp_s: float, depth_mm: NDArray[np.uint16], style: Style) -> Message:
    import cv2

    if style.depth in ("16UC1", "32FC1"):
        metres = np.where(depth_mm > 0, depth_mm * np.float32(1e-3), np.float32(np.nan)).astype(np.float32)
        pixels = depth_mm if style.depth == "16UC1" else metres
        record = raw_image(stamp_s, frame, style.depth, pixels, style.padded)
        return Message(f"{prefix}/image_raw", "sensor_msgs/msg/Image", stamp_s, record)
    data = cv2.imencode(".png", depth_mm)[1].tobytes()
    if style.depth == "png":
        record = packed_image(stamp_s, frame, "16UC1; png compressed", data)
    else:  # twelve bytes of settings come before the picture
        record = packed_image(stamp_s, frame, "16UC1; compressedDepth png", bytes(12) + data)
    topic = "compressed" if style.depth == "png" else "compressedDepth"
    return Message(f"{prefix}/image_raw/{topic}", "sensor_msgs/msg/CompressedImage", stamp_s, record)


def _aside(stamp_s: float, frame: str, own: str) -> Any:
    types = store().types
    x, y, z = (float(v) for v in DEPTH_CAMERA_SHIFT_M)
    transform = types["geometry_msgs/msg/Transform"](
        translation=types["geometry_msgs/msg/Vector3"](x=x, y=y, z=z),
        rotation=types["geometry_msgs/msg/Quaternion"](x=0.0, y=0.0, z=0.0, w=1.0),
    )
    stamped = types["geometry_msgs/msg/TransformStamped"](
        header=header(stamp_s, frame), child_frame_id=own, transform=transform
    )
    return types["tf2_msgs/msg/TFMessage"](transforms=[stamped])


def write_mcap(path: Path, stream: Iterator[Message], chunk: str = "zstd") -> Path:
    """Write messages to an MCAP file as ROS 2 tools do; return its path."""
    from mcap.writer import CompressionType, Writer

    compression = {"zstd": CompressionType.ZSTD, "lz4": CompressionType.LZ4, "none": CompressionType.NONE}[chunk]
    with path.open("wb") as sink:
        writer = Writer(sink, compression=compression)
        writer.start(profile="ros2", library="second rig")
        schemas: dict[str, int] = {}
        channels: dict[str, int] = {}
        for message in stream:
            if message.kind not in schemas:
                text = store().generate_msgdef(message.kind, ros_version=2)[0]
                schemas[message.kind] = writer.register_schema(message.kind, "ros2msg", text.encode())
            if message.topic not in channels:
                channels[message.topic] = writer.register_channel(message.topic, "cdr", schemas[message.kind])
            data = bytes(store().serialize_cdr(message.record, message.kind))
            nanoseconds = round(message.stamp_s * 1e9)
            writer.add_message(channels[message.topic], nanoseconds, data, nanoseconds)
        writer.finish()
    return path


def record(scene: Scene, path: Path, style: Style = PLAIN) -> Path:
    """Render a scene into a recording unless it is there already; return its path."""
    if not path.exists():
        half = path.with_suffix(".part")
        write_mcap(half, messages(scene, style), style.chunk).rename(path)
    return path
