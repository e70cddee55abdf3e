# ruff: noqa: ANN401 — the library makes its message types at run time
"""Files that nobody should be able to hurt the product with: recordings, stations, models, labels."""

from __future__ import annotations

import copy
import io
import json
import struct
import zipfile
import zlib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from tests.second_rig.camera import LENSES, Lens
from tests.second_rig.mcap_files import Message, camera_info, packed_image, raw_image, store, write_mcap

SMALL = Lens(64, 48, 52.5, 52.5, 31.5, 23.5)
MAGIC = b"\x89MCAP0\r\n"
Stream = Iterator[Message]


def flat_messages(frames: int = 4, *, sensor: str = "k1", colour: bool = True, depth: bool = True, info: bool = True,
                  change: Callable[[str, Any], Any] = lambda _what, record: record) -> Stream:  # fmt: skip
    """Yield a flat belt at 1 m seen by a tiny camera, `change` applied to every record ("info", "colour", "depth")."""
    rgb = np.full((48, 64, 3), 120, np.uint8)
    millimetres = np.full((48, 64), 1000, np.uint16)
    for n in range(frames):
        t = 100.0 + 0.2 * n
        if info:
            record = change("info", camera_info(t, sensor, SMALL))
            yield Message(f"/{sensor}/rgb/camera_info", "sensor_msgs/msg/CameraInfo", t, record)
        if colour:
            record = change("colour", raw_image(t, sensor, "rgb8", rgb))
            yield Message(f"/{sensor}/rgb/image_raw", "sensor_msgs/msg/Image", t, record)
        if depth:
            record = change("depth", raw_image(t, sensor, "16UC1", millimetres))
            yield Message(f"/{sensor}/depth_registered/image_raw", "sensor_msgs/msg/Image", t, record)


def _changed(target: str, **fields: Any) -> Callable[[str, Any], Any]:
    def change(what: str, record: Any) -> Any:
        for name, value in fields.items() if what == target else ():
            object.__setattr__(record, name, value)
        return record

    return change


def _no_pixels(what: str, record: Any) -> Any:
    if what == "info":
        return _changed("info", width=0, height=0)(what, record)
    return _changed(what, width=0, height=0, step=0, data=np.zeros(0, np.uint8))(what, record)


def _k(*values: float) -> Callable[[str, Any], Any]:
    return _changed("info", k=np.array(values))


def packed_messages(colour: bytes | None, depth: bytes | None) -> Stream:
    """Yield frames whose pictures are the given bytes, said to be JPEG and PNG."""
    for message in flat_messages(3):
        what = "colour" if "rgb/image" in message.topic else "depth" if "depth" in message.topic else "info"
        data = {"colour": colour, "depth": depth, "info": None}[what]
        if data is None:
            yield message
            continue
        text = "rgb8; jpeg compressed bgr8" if what == "colour" else "16UC1; png compressed"
        record = packed_image(message.stamp_s, "k1", text, data)
        yield Message(f"{message.topic}/compressed", "sensor_msgs/msg/CompressedImage", message.stamp_s, record)


def png_of_zeros(width: int, height: int) -> bytes:
    """Return a valid 16-bit grey PNG of a size that no sensor has, small on disk."""
    packer = zlib.compressobj(1)
    row = bytes(1 + 2 * width)
    body = b"".join(packer.compress(row) for _ in range(height)) + packer.flush()
    chunks = [(b"IHDR", struct.pack(">IIBBBBB", width, height, 16, 0, 0, 0, 0)), (b"IDAT", body), (b"IEND", b"")]
    parts = [struct.pack(">I", len(d)) + name + d + struct.pack(">I", zlib.crc32(name + d)) for name, d in chunks]
    return b"\x89PNG\r\n\x1a\n" + b"".join(parts)


def _record(opcode: int, content: bytes, length: int | None = None) -> bytes:
    return bytes([opcode]) + struct.pack("<Q", len(content) if length is None else length) + content


def _text(value: str) -> bytes:
    return struct.pack("<I", len(value.encode())) + value.encode()


def _chunk(size: int, compression: str, records: bytes, length: int | None = None) -> bytes:
    head = struct.pack("<QQQI", 1, 2, size, 0) + _text(compression)
    return _record(6, head + struct.pack("<Q", len(records) if length is None else length) + records)


def _zeros_zstd(megabytes: int) -> bytes:
    import zstandard

    packer = zstandard.ZstdCompressor(level=3).compressobj()
    block = bytes(1 << 20)
    return b"".join(packer.compress(block) for _ in range(megabytes)) + packer.flush()


def raw_recordings() -> dict[str, Callable[[], bytes]]:
    """Return makers of whole files, by what is wrong with them; none holds a readable frame."""
    ending = _record(0x0F, struct.pack("<I", 0))
    start = MAGIC + _record(1, _text("ros2") + _text("hostile"))
    return {
        "empty": lambda: b"",
        "text": lambda: b"hello, this is not a recording\n" * 40,
        "picture": lambda: png_of_zeros(20, 20),
        "zeros": lambda: bytes(100_000),
        "magic_only": lambda: MAGIC,
        "magic_and_noise": lambda: MAGIC + np.random.default_rng(1).bytes(50_000),
        "header_only": lambda: start,
        "finished_empty": lambda: start + _record(0x0F, struct.pack("<I", 0)) + _record(2, bytes(20)) + MAGIC,
        "record_length_lies": lambda: start + _record(5, b"abc", length=2**62),
        "record_length_negative": lambda: start + _record(5, b"abc", length=2**64 - 1),
        "string_length_lies": lambda: start + _record(3, struct.pack("<H", 1) + struct.pack("<I", 2**32 - 1) + b"abc"),
        "chunk_size_lies": lambda: start + _chunk(2**62, "", b"abc"),
        "chunk_records_lie": lambda: start + _chunk(3, "", b"abc", length=2**60),
        "chunk_of_unknown_packing": lambda: start + _chunk(3, "brotli", b"abc"),
        "chunk_zstd_noise": lambda: start + _chunk(1000, "zstd", b"(\xb5/\xfd" + bytes(40)),
        "chunk_zstd_bomb": lambda: start + _chunk(1 << 30, "zstd", _zeros_zstd(1024)),
        "chunk_zstd_bomb_that_lies": lambda: start + _chunk(1000, "zstd", _zeros_zstd(1024)),
        "summary_offset_lies": lambda: start + ending + _record(2, struct.pack("<QQI", 2**60, 2**61, 7)) + MAGIC,
        "ros1_magic_only": lambda: b"#ROSBAG V2.0\n",
        "ros1_noise": lambda: b"#ROSBAG V2.0\n" + np.random.default_rng(2).bytes(5000),
        "ros1_length_lies": lambda: b"#ROSBAG V2.0\n" + struct.pack("<I", 2**32 - 1) + b"op=\x03",
        "sqlite": lambda: b"SQLite format 3\x00" + bytes(4096),
    }  # fmt: skip


def unreadable_streams() -> dict[str, Callable[[], Stream]]:
    """Return messages of recordings in which no frame can be read."""
    big = np.zeros(10, np.uint8)
    return {
        "no_depth": lambda: flat_messages(depth=False),
        "no_colour": lambda: flat_messages(colour=False),
        "no_camera_info": lambda: flat_messages(info=False),
        "size_zero": lambda: flat_messages(change=_no_pixels),
        "colour_size_lies": lambda: flat_messages(change=_changed("colour", width=2**31, height=2**31, step=2**32 - 1)),
        "depth_data_too_short": lambda: flat_messages(change=_changed("depth", data=big)),
        "depth_step_lies": lambda: flat_messages(change=_changed("depth", step=3)),
        "depth_encoding_unknown": lambda: flat_messages(change=_changed("depth", encoding="bayer_rggb8")),
        "colour_encoding_unknown": lambda: flat_messages(change=_changed("colour", encoding="../../etc/passwd")),
        "focal_zero": lambda: flat_messages(change=_k(*[0.0] * 9)),
        "focal_nan": lambda: flat_messages(change=_k(*[float("nan")] * 9)),
        "focal_infinite": lambda: flat_messages(change=_k(float("inf"), 0, 31.5, 0, float("inf"), 23.5, 0, 0, 1)),
        "pictures_are_noise": lambda: packed_messages(b"\xff\xd8\xff noise", b"\x89PNG\r\n\x1a\n noise"),
        "pictures_are_empty": lambda: packed_messages(b"", b""),
        "depth_png_bomb": lambda: packed_messages(None, png_of_zeros(16_000, 16_000)),
        "other_messages_only": lambda: iter([Message("/k1/rgb/camera_info", "sensor_msgs/msg/CameraInfo", 1.0,
                                                     camera_info(1.0, "k1", LENSES["640x480"]))]),
        "ten_thousand_topics": ten_thousand_topics,
        "message_too_short": lambda: flat_messages(change=_changed("colour", data=big)),
    }  # fmt: skip


def ten_thousand_topics() -> Stream:
    """Yield one camera_info of each of 10 000 sensors, and nothing that is a picture."""
    for n in range(10_000):
        yield Message(f"/s{n}/rgb/camera_info", "sensor_msgs/msg/CameraInfo", 1.0, camera_info(1.0, "x", SMALL))


def with_many_topics(stream: Stream) -> Stream:
    """Yield the camera_info of 10 000 sensors, then a good recording."""
    yield from ten_thousand_topics()
    yield from stream


def cdr_with_lying_lengths(folder: Path) -> Path:
    """Write a recording whose colour messages say that 4 GB follow."""
    from mcap.writer import Writer

    path = folder / "cdr_lies.mcap"
    with path.open("wb") as sink:
        writer = Writer(sink)
        writer.start(profile="ros2")
        schema = writer.register_schema("sensor_msgs/msg/Image", "ros2msg", b"")
        for topic in ("/k1/rgb/image_raw", "/k1/depth_registered/image_raw"):
            channel = writer.register_channel(topic, "cdr", schema)
            good = bytearray(
                store().serialize_cdr(
                    raw_image(1.0, "k1", "rgb8", np.zeros((8, 8, 3), np.uint8)), "sensor_msgs/msg/Image"
                )
            )
            for lie in (
                good[:12] + b"\xff\xff\xff\xff" + good[16:],
                good[:-196] + b"\xff\xff\xff\x7f" + good[-192:],
                good[:20],
                b"",
            ):
                writer.add_message(channel, 1, bytes(lie), 1)
        writer.finish()
    return path


def stations(good: dict[str, Any]) -> dict[str, str]:
    """Return texts of stations that must be refused, by what is wrong with them."""
    name = good["reference_sensor"]
    other = next(key for key in good["sensors"] if key != name)

    def altered(*path: str, value: Any) -> str:
        changed = copy.deepcopy(good)
        place: Any = changed
        for step in path[:-1]:
            place = place[step]
        place[path[-1]] = value
        return json.dumps(changed)

    pose, surface = ("sensors", other, "pose"), ("sensors", other, "surface")
    nan, turn = float("nan"), np.array(good["sensors"][other]["pose"]["rotation"])
    return {
        "not_json": "this is no station {",
        "nothing": "",
        "list": "[]",
        "null": "null",
        "deep": "[" * 200_000,
        "schema_of_tomorrow": altered("schema", value="fruitgui.station/2"),
        "schema_of_another": altered("schema", value="fruitgui.model/1"),
        "no_sensors": altered("sensors", value={}),
        "reference_unknown": altered("reference_sensor", value="nobody"),
        "pose_nan": altered(*pose, "translation_m", value=[nan, 0.0, 0.0]),
        "pose_huge_number": altered(*pose, "translation_m", value=[0.0, 0.0, 0.0]).replace(
            "[0.0, 0.0, 0.0]", "[1e999, 0, 0]"
        ),
        "rotation_nan": altered(*pose, "rotation", value=[[nan] * 3] * 3),
        "rotation_scaled": altered(*pose, "rotation", value=(turn * 1.01).tolist()),
        "rotation_mirrored": altered(*pose, "rotation", value=(turn @ np.diag([1.0, 1.0, -1.0])).tolist()),
        "rotation_of_zeros": altered(*pose, "rotation", value=np.zeros((3, 3)).tolist()),
        "rotation_2x3": altered(*pose, "rotation", value=turn[:2].tolist()),
        "rotation_text": altered(*pose, "rotation", value="identity"),
        "pose_null": altered(*pose, value=None),
        "covariance_nan": altered(*pose, "covariance", value=np.full((6, 6), nan).tolist()),
        "covariance_negative": altered(*pose, "covariance", value=(-np.eye(6)).tolist()),
        "covariance_3x3": altered(*pose, "covariance", value=np.eye(3).tolist()),
        "normal_zero": altered(*surface, "normal", value=[0.0, 0.0, 0.0]),
        "normal_nan": altered(*surface, "normal", value=[nan, 0.0, 1.0]),
        "offset_text": altered(*surface, "offset_m", value="one metre"),
        "offset_infinite": altered(*surface, "offset_m", value=float("inf")),
        "region_nan": altered(*surface, "region", value=[[nan, 0, 1], [1, 0, 1], [1, 1, 1]]),
        "region_of_two": altered(*surface, "region", value=[[0, 0, 1], [1, 0, 1]]),
        "clock_nan": altered("sensors", other, "clock_offset_s", value=nan),
        "velocity_nan": altered("belt", "velocity_m_s", value=[nan, 0.0, 0.0]),
        "velocity_of_two": altered("belt", "velocity_m_s", value=[0.1, 0.0]),
        "reference_pose_moved": json.dumps(_moved_reference(good, name)),
        "sensor_is_list": altered("sensors", other, value=[1, 2, 3]),
    }


def _moved_reference(good: dict[str, Any], name: str) -> dict[str, Any]:
    changed = copy.deepcopy(good)
    changed["sensors"][name]["pose"]["translation_m"] = [1.0, 0.0, 0.0]
    return changed


def models(good: bytes, name: str) -> bytes:
    """Return a model file that must be refused, made from a good one; `name` says what is wrong with it."""
    with zipfile.ZipFile(io.BytesIO(good)) as archive:
        entries = {entry: archive.read(entry) for entry in archive.namelist()}
    array = next(entry for entry in entries if entry.endswith(".npy"))
    main = next(entry for entry in entries if b"fruitgui.model/1" in entries[entry])
    shape = np.load(io.BytesIO(entries[array])).shape
    makers: dict[str, Callable[[], bytes]] = {
        "empty": lambda: b"",
        "text": lambda: b"no zip at all",
        "cut": lambda: good[: len(good) // 2],
        "empty_zip": lambda: _zip({}),
        "version_of_tomorrow": lambda: _zip(entries | {main: entries[main].replace(b"model/1", b"model/2")}),
        "pickle_inside": lambda: _zip(entries | {array: _npy(np.array([{"a": 1}], dtype=object))}),
        "nan_weights": lambda: _zip(entries | {array: _npy(np.full(shape, np.nan))}),
        "array_shape_lies": lambda: _zip(entries | {array: _npy_that_lies((10**9, 10**4))}),
        "array_is_text": lambda: _zip(entries | {array: b"hello"}),
        "array_missing": lambda: _zip({entry: data for entry, data in entries.items() if entry != array}),
        "bomb": lambda: _zip(entries | {array: bytes(400 << 20)}),
        "json_bomb": lambda: _zip(entries | {main: b" " * (400 << 20) + entries[main]}),
        "manifest_not_json": lambda: _zip(entries | {main: b"{"}),
        "manifest_list": lambda: _zip(entries | {main: b"[]"}),
        "flipped_bits": lambda: good[:200] + bytes(b ^ 0x55 for b in good[200:300]) + good[300:],
    }  # fmt: skip
    return makers[name]()


def _npy(values: np.ndarray) -> bytes:
    sink = io.BytesIO()
    np.save(sink, values, allow_pickle=True)
    return sink.getvalue()


def _npy_that_lies(shape: tuple[int, ...]) -> bytes:
    text = f"{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}".ljust(117) + "\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(text)) + text.encode() + bytes(100)


def _zip(entries: dict[str, bytes]) -> bytes:
    sink = io.BytesIO()
    with zipfile.ZipFile(sink, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        for name, data in entries.items():
            archive.writestr(name, data)
    return sink.getvalue()


def labels() -> dict[str, bytes]:
    """Return labels files of which no row can be used."""
    head = b"sensor,time_s,u_px,v_px,kind,volume_ml\n"
    return {
        "empty": b"",
        "header_only": head,
        "picture": png_of_zeros(10, 10),
        "columns_missing": b"sensor,time_s\neast,1.0\n",
        "nan_times": head + b"east,nan,10,10,lemon,\n",
        "no_numbers": head + b"east,soon,left,top,lemon,\n",
        "times_far_away": head + b"east,12.5,100,100,lemon,\n" * 5,
        "sensor_unknown": head + b"nobody,1700000003.0,100,100,lemon,\n",
        "zero_bytes": bytes(3000),
        "one_huge_field": head + b'east,1,1,1,"' + b"x" * 300_000,
    }


__all__ = ["MAGIC", "cdr_with_lying_lengths", "flat_messages", "labels", "models", "raw_recordings", "stations",
           "unreadable_streams", "with_many_topics", "write_mcap"]  # fmt: skip
