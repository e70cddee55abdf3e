"""Recordings made by other people's writers (rosbags, mcap), for tests of our readers."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from mcap.writer import CompressionType, Writer
from rosbags.rosbag1 import Writer as BagWriter
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

ROS2 = get_typestore(Stores.ROS2_HUMBLE)
ROS1 = get_typestore(Stores.ROS1_NOETIC)
ROS1.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms", "tf2_msgs/msg/TFMessage"))
WIDTH, HEIGHT = 64, 48
K = (60.0, 0.0, 31.5, 0.0, 61.0, 23.5, 0.0, 0.0, 1.0)


@dataclass(frozen=True)
class Message:
    """One message before it is serialised: topic, type, time at which it is recorded, fields."""

    topic: str
    kind: str
    log_s: float
    fields: dict[str, Any]


def header(store: Typestore, stamp_ns: int, frame_id: str) -> Any:  # noqa: ANN401 - made by rosbags at run time
    seconds, nanoseconds = divmod(stamp_ns, 10**9)
    stamp = store.types["builtin_interfaces/msg/Time"](sec=seconds, nanosec=nanoseconds)
    kind = store.types["std_msgs/msg/Header"]
    return kind(seq=0, stamp=stamp, frame_id=frame_id) if store is ROS1 else kind(stamp=stamp, frame_id=frame_id)


def image(topic: str, time_s: float, encoding: str, pixels: np.ndarray, **fields: int) -> Message:
    """An Image of an array of any type; give `step` to pad the rows."""
    rows = np.ascontiguousarray(pixels).view(np.uint8).reshape(pixels.shape[0], -1)
    step = fields.get("step", rows.shape[1])
    if step > rows.shape[1]:
        rows = np.hstack([rows, np.full((len(rows), step - rows.shape[1]), 0xAB, np.uint8)])
    parts = {
        "stamp_ns": round(time_s * 1e9), "frame_id": topic.split("/")[1] + "_optical", "height": pixels.shape[0],
        "width": pixels.shape[1], "encoding": encoding, "is_bigendian": 0, "step": step, "data": rows.reshape(-1),
    }  # fmt: skip
    return Message(topic, "sensor_msgs/msg/Image", time_s, {**parts, **fields})


def packed(topic: str, time_s: float, form: str, data: bytes) -> Message:
    parts = {
        "stamp_ns": round(time_s * 1e9), "frame_id": topic.split("/")[1] + "_optical", "format": form,
        "data": np.frombuffer(data, np.uint8),
    }  # fmt: skip
    return Message(topic, "sensor_msgs/msg/CompressedImage", time_s, parts)


def camera_info(topic: str, time_s: float, **fields: object) -> Message:
    """A CameraInfo of the small camera; any field may be given otherwise."""
    parts = {
        "stamp_ns": round(time_s * 1e9), "frame_id": topic.split("/")[1] + "_optical", "height": HEIGHT,
        "width": WIDTH, "distortion_model": "plumb_bob", "d": np.zeros(5), "k": np.array(K), "r": np.eye(3).ravel(),
        "p": np.array([*K[:3], 0, *K[3:6], 0, *K[6:], 0]), "binning_x": 0, "binning_y": 0,
    }  # fmt: skip
    return Message(topic, "sensor_msgs/msg/CameraInfo", time_s, {**parts, **fields})


def transforms(*edges: tuple[str, str, Sequence[float], Sequence[float]]) -> Message:
    """A TFMessage of edges (parent, child, translation, quaternion x y z w)."""
    return Message("/tf_static", "tf2_msgs/msg/TFMessage", 0.0, {"edges": edges})


def colored(time_s: float, shape: tuple[int, int] = (HEIGHT, WIDTH)) -> np.ndarray:
    """A picture that tells its time by its red."""
    v, u = np.mgrid[: shape[0], : shape[1]]
    red = np.full(shape, int(time_s * 10) % 250)
    return np.stack([red, u * 2 % 256, v * 3 % 256], axis=-1).astype(np.uint8)


def depth(time_s: float, shape: tuple[int, int] = (HEIGHT, WIDTH)) -> np.ndarray:
    v, u = np.mgrid[: shape[0], : shape[1]]
    mm = (800 + u * 3 + v * 2 + int(time_s * 10) % 500).astype(np.uint16)
    mm[:3, :5] = 0
    return mm


def frameset(sensor: str, time_s: float, **stamp_shift_s: float) -> list[Message]:
    """One frame of the plainest kind: info, rgb8, registered 16UC1."""
    color_s = time_s + stamp_shift_s.get("color", 0.0)
    return [
        camera_info(f"/{sensor}/rgb/camera_info", color_s),
        image(f"/{sensor}/rgb/image_raw", color_s, "rgb8", colored(time_s)),
        image(f"/{sensor}/depth_registered/image_raw", time_s, "16UC1", depth(time_s)),
    ]


def jpeg(color: np.ndarray) -> bytes:
    return bytes(cv2.imencode(".jpg", color[..., ::-1], [cv2.IMWRITE_JPEG_QUALITY, 100])[1])


def png(pixels: np.ndarray) -> bytes:
    return bytes(cv2.imencode(".png", pixels[..., ::-1] if pixels.ndim == 3 else pixels)[1])


def write_mcap(
    path: Path, messages: Iterable[Message], *, compression: CompressionType = CompressionType.ZSTD,
    chunk_size: int = 40_000, wire: str = "cdr", **options: int,
) -> Path:  # fmt: skip
    """Write messages in the order given."""
    with path.open("wb") as file:
        writer = Writer(file, chunk_size=chunk_size, compression=compression, **options)
        writer.start(profile="ros2" if wire == "cdr" else "ros1")
        channels: dict[str, int] = {}
        schemas: dict[str, int] = {}
        for message in messages:
            if message.kind not in schemas:
                name, encoding, text = schema(message.kind, wire)
                schemas[message.kind] = writer.register_schema(name, encoding, text)
            if message.topic not in channels:
                channels[message.topic] = writer.register_channel(message.topic, wire, schemas[message.kind])
            log_ns = max(round(message.log_s * 1e9), 0)
            writer.add_message(channels[message.topic], log_ns, serialised(message, wire), log_ns)
        writer.finish()
    return path


def schema(kind: str, wire: str) -> tuple[str, str, bytes]:
    if wire == "cdr":
        return kind, "ros2msg", ROS2.generate_msgdef(kind, ros_version=2)[0].encode()
    return kind.replace("/msg/", "/"), "ros1msg", ROS1.generate_msgdef(kind, ros_version=1)[0].encode()


def serialised(message: Message, wire: str = "cdr") -> bytes:
    store = ROS2 if wire == "cdr" else ROS1
    record = _record(store, message)
    if wire == "cdr":
        return bytes(store.serialize_cdr(record, message.kind))
    return bytes(store.serialize_ros1(record, message.kind))


def write_bag(path: Path, messages: Iterable[Message], *, compression: str = "", chunk: int = 40_000) -> Path:
    """Write a ROS 1 bag."""
    bag = BagWriter(path)
    if compression:
        bag.set_compression(BagWriter.CompressionFormat[compression])
    bag.chunk_threshold = chunk
    with bag:
        connections: dict[str, Any] = {}
        for message in messages:
            if message.topic not in connections:
                connections[message.topic] = bag.add_connection(message.topic, message.kind, typestore=ROS1)
            data = serialised(message, "ros1")
            bag.write(connections[message.topic], max(round(message.log_s * 1e9), 0), data)
    return path


def _record(store: Typestore, message: Message) -> Any:  # noqa: ANN401 - made by rosbags at run time
    fields = dict(message.fields)
    if message.kind == "tf2_msgs/msg/TFMessage":
        return store.types[message.kind](transforms=[_edge(store, *edge) for edge in fields["edges"]])
    fields["header"] = header(store, fields.pop("stamp_ns"), fields.pop("frame_id"))
    if message.kind == "sensor_msgs/msg/CameraInfo":
        if store is ROS1:
            fields |= {name.upper(): fields.pop(name) for name in "dkrp"}
        region = fields.pop("roi", {})
        empty = {"x_offset": 0, "y_offset": 0, "height": 0, "width": 0, "do_rectify": False}
        fields["roi"] = store.types["sensor_msgs/msg/RegionOfInterest"](**{**empty, **region})
    return store.types[message.kind](**fields)


def _edge(store: Typestore, parent: str, child: str, translation: Sequence[float], quaternion: Sequence[float]) -> Any:  # noqa: ANN401 - made by rosbags at run time
    types = store.types
    transform = types["geometry_msgs/msg/Transform"](
        translation=types["geometry_msgs/msg/Vector3"](*map(float, translation)),
        rotation=types["geometry_msgs/msg/Quaternion"](*map(float, quaternion)),
    )
    return types["geometry_msgs/msg/TransformStamped"](
        header=header(store, 0, parent), child_frame_id=child, transform=transform
    )
