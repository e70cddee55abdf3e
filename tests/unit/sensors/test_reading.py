"""Every kind of recording that the contract names, written by other people's writers, read by ours."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import pytest
from mcap.writer import CompressionType

from fruitgui.errors import InputError
from fruitgui.frame import Frame
from fruitgui.sensors.recordings import open_recording, parse_topics
from fruitgui.sensors.recordings.container import open_container
from tests.unit.sensors import ros_files as ros

TIMES = (100.0, 100.1, 100.2)


def frames(path: Path, **options: object) -> list[tuple[float, Frame]]:
    return list(open_recording(path, **options).frames())  # type: ignore[arg-type]


def plain(*sensors: str, times: tuple[float, ...] = TIMES) -> list[ros.Message]:
    return [message for time_s in times for sensor in sensors for message in ros.frameset(sensor, time_s)]


def check_plain(read: list[tuple[float, Frame]], times: tuple[float, ...] = TIMES) -> None:
    assert [time_s for time_s, _ in read] == list(times)
    for number, (time_s, frame) in enumerate(read):
        assert frame.time_s == time_s
        assert frame.sequence == number
        np.testing.assert_array_equal(frame.color, ros.colored(time_s))
        np.testing.assert_array_equal(frame.depth_mm, ros.depth(time_s))


@pytest.mark.parametrize("compression", list(CompressionType))
def test_mcap_with_every_chunk_packing(tmp_path: Path, compression: CompressionType) -> None:
    path = ros.write_mcap(tmp_path / "r.mcap", plain("k1"), compression=compression)
    recording = open_recording(path)
    check_plain(list(recording.frames()))
    assert recording.warnings == []
    assert recording.sensors["k1"].rate_hz == pytest.approx(10.0)
    camera = recording.sensors["k1"].intrinsics
    assert (camera.fx, camera.fy, camera.cx, camera.cy, camera.distortion) == (60.0, 61.0, 31.5, 23.5, ())


@pytest.mark.parametrize(
    "options",
    [{"use_chunking": False}, {"repeat_channels": False}, {"use_statistics": False, "enable_crcs": False},
     {"enable_data_crcs": True}, {"chunk_size": 10_000_000}, {"chunk_size": 1}],
)  # fmt: skip
def test_mcap_without_what_is_optional(tmp_path: Path, options: dict[str, int]) -> None:
    check_plain(frames(ros.write_mcap(tmp_path / "r.mcap", plain("k1"), **options)))


def test_mcap_with_ros1_messages(tmp_path: Path) -> None:
    check_plain(frames(ros.write_mcap(tmp_path / "r.mcap", plain("k1"), wire="ros1")))


@pytest.mark.parametrize("compression", ["", "BZ2", "LZ4"])
def test_ros1_bag(tmp_path: Path, compression: str) -> None:
    recording = open_recording(ros.write_bag(tmp_path / "r.bag", plain("k1"), compression=compression))
    check_plain(list(recording.frames()))
    assert recording.warnings == []


def test_a_sensor_that_comes_late_in_a_bag(tmp_path: Path) -> None:
    messages = [m for n in range(80) for s in ("k1", "k2") if s == "k1" or n > 70 for m in ros.frameset(s, n / 5)]
    path = ros.write_bag(tmp_path / "r.bag", messages)
    assert "/k2/rgb/image_raw" in (open_container(path).topics or {}), "known before the bag is read"
    recording = open_recording(path)
    assert list(recording.sensors) == ["k1", "k2"]
    assert sum(frame.sensor == "k2" for _, frame in recording.frames()) == 9


def test_ros1_bag_that_was_never_closed(tmp_path: Path) -> None:
    """As `rosbag record` leaves it when killed: no index, no count."""
    path = ros.write_bag(tmp_path / "r.bag", plain("k1"))
    data = path.read_bytes()
    header = data.index(b"index_pos=")
    start = struct.unpack("<Q", data[header + 10 : header + 18])[0]
    (tmp_path / "open.bag").write_bytes(data[: header + 10] + bytes(8) + data[header + 18 : start])
    recording = open_recording(tmp_path / "open.bag")
    check_plain(list(recording.frames()))
    assert "cut off" in " ".join(recording.warnings)


def color_message(encoding: str, pixels: np.ndarray, **fields: int) -> list[ros.Message]:
    return [
        ros.camera_info("/k1/rgb/camera_info", 1.0),
        ros.image("/k1/rgb/image_raw", 1.0, encoding, pixels, **fields),
        ros.image("/k1/depth_registered/image_raw", 1.0, "16UC1", ros.depth(1.0)),
    ]


RGB = ros.colored(1.0)
ALPHA = np.full((*RGB.shape[:2], 1), 7, np.uint8)
GREY = RGB[..., 1]


@pytest.mark.parametrize(
    ("encoding", "pixels", "expected", "fields"),
    [
        ("rgb8", RGB, RGB, {}),
        ("rgb8", RGB, RGB, {"step": 200}),
        ("bgr8", RGB[..., ::-1], RGB, {}),
        ("8UC3", RGB[..., ::-1], RGB, {"step": 193}),
        ("rgba8", np.concatenate([RGB, ALPHA], -1), RGB, {}),
        ("bgra8", np.concatenate([RGB[..., ::-1], ALPHA], -1), RGB, {}),
        ("mono8", GREY, np.repeat(GREY[..., None], 3, -1), {"step": 70}),
    ],
)
def test_raw_colour(
    tmp_path: Path, encoding: str, pixels: np.ndarray, expected: np.ndarray, fields: dict[str, int]
) -> None:
    path = ros.write_mcap(tmp_path / "r.mcap", color_message(encoding, pixels, **fields))
    np.testing.assert_array_equal(frames(path)[0][1].color, expected)


def test_bayer_and_yuv_give_the_right_colours(tmp_path: Path) -> None:
    flat = np.empty((48, 64, 3), np.uint8)
    flat[:] = (200, 100, 50)
    odd_row, odd_column = np.arange(48)[:, None] % 2, np.arange(64) % 2
    bayer = np.where(odd_row, np.where(odd_column, 50, 100), np.where(odd_column, 100, 200))
    read = frames(ros.write_mcap(tmp_path / "b.mcap", color_message("bayer_rggb8", bayer.astype(np.uint8))))
    np.testing.assert_allclose(read[0][1].color[4:-4, 4:-4], flat[4:-4, 4:-4], atol=2)
    y, u, v = 123, 91, 175  # BT.601, studio range, of (200, 100, 50)
    uyvy = np.tile(np.array([u, y, v, y], np.uint8), (48, 32)).reshape(48, 64, 2)
    read = frames(ros.write_mcap(tmp_path / "y.mcap", color_message("yuv422", uyvy)))
    np.testing.assert_allclose(read[0][1].color, flat, atol=6)


@pytest.mark.parametrize(
    ("form", "pack", "tolerance"), [("jpeg", ros.jpeg, 8), ("rgb8; png compressed bgr8", ros.png, 0)]
)
def test_packed_colour(tmp_path: Path, form: str, pack: object, tolerance: int) -> None:
    messages = [
        ros.camera_info("/k1/rgb/camera_info", 1.0),
        ros.packed("/k1/rgb/image_raw/compressed", 1.0, form, pack(RGB)),  # type: ignore[operator]
        ros.image("/k1/depth_registered/image_raw", 1.0, "16UC1", ros.depth(1.0)),
    ]
    read = frames(ros.write_mcap(tmp_path / "r.mcap", messages))
    np.testing.assert_allclose(read[0][1].color.astype(int), RGB, atol=tolerance)


DEPTH = ros.depth(1.0)
METRES = np.where(DEPTH == 0, np.nan, DEPTH / 1000.0).astype(np.float32)


def odd_metres() -> np.ndarray:
    odd = METRES.copy()
    odd[10, 10:16] = (np.inf, -np.inf, -1.0, 0.0, 100.0, np.nan)
    return odd


def depth_frame(tmp_path: Path, message: ros.Message) -> Frame:
    messages = [
        ros.camera_info("/k1/rgb/camera_info", 1.0), ros.image("/k1/rgb/image_raw", 1.0, "rgb8", RGB), message,
    ]  # fmt: skip
    return frames(ros.write_mcap(tmp_path / "r.mcap", messages))[0][1]


RAW_DEPTH = "/k1/depth_registered/image_raw"


@pytest.mark.parametrize(
    ("encoding", "pixels", "fields"),
    [
        ("16UC1", DEPTH, {}),
        ("mono16", DEPTH, {"step": 150}),
        ("16UC1", DEPTH.astype(">u2"), {"is_bigendian": 1}),
        ("16UC1", np.where(DEPTH == 0, 65535, DEPTH).astype(np.uint16), {}),
        ("32FC1", METRES, {}),
        ("32FC1", METRES.astype(">f4"), {"is_bigendian": 1, "step": 260}),
    ],
)
def test_raw_depth(tmp_path: Path, encoding: str, pixels: np.ndarray, fields: dict[str, int]) -> None:
    frame = depth_frame(tmp_path, ros.image(RAW_DEPTH, 1.0, encoding, pixels, **fields))
    np.testing.assert_array_equal(frame.depth_mm, DEPTH)


def test_metres_that_are_no_reading(tmp_path: Path) -> None:
    frame = depth_frame(tmp_path, ros.image(RAW_DEPTH, 1.0, "32FC1", odd_metres()))
    expected = DEPTH.copy()
    expected[10, 10:16] = 0
    np.testing.assert_array_equal(frame.depth_mm, expected)


@pytest.mark.parametrize(
    ("topic", "form", "data"),
    [
        ("/compressed", "16UC1; png compressed ", ros.png(DEPTH)),
        ("/compressedDepth", "16UC1; compressedDepth png", bytes(12) + ros.png(DEPTH)),
        ("/compressedDepth", "16UC1; compressedDepth", bytes(12) + ros.png(DEPTH)),
    ],
)
def test_packed_depth(tmp_path: Path, topic: str, form: str, data: bytes) -> None:
    np.testing.assert_array_equal(depth_frame(tmp_path, ros.packed(RAW_DEPTH + topic, 1.0, form, data)).depth_mm, DEPTH)


def test_packed_depth_in_metres(tmp_path: Path) -> None:
    """compressed_depth_image_transport quantises inverse depth: v = a/z + b with a = q (q+1), b = 1 − q/z_max + …"""
    a, b = 100.0 * 101.0, 1.0 - 101.0 / 10.0 * 10.0
    values = np.where(np.isnan(METRES), 0, np.rint(a / METRES + b)).astype(np.uint16)
    data = struct.pack("<iff", 0, a, b) + ros.png(values)
    message = ros.packed(RAW_DEPTH + "/compressedDepth", 1.0, "32FC1; compressedDepth png", data)
    read = depth_frame(tmp_path, message).depth_mm.astype(float)
    step_mm = (DEPTH / 1000.0) ** 2 / a * 1000.0
    np.testing.assert_array_equal(read == 0, DEPTH == 0)
    assert (np.abs(read - DEPTH) <= 0.5 + 0.5 * step_mm + 1e-3).all()


def test_several_sensors_come_in_order_of_time_and_can_be_chosen(tmp_path: Path) -> None:
    messages = [m for n in range(6) for m in ros.frameset(("k1", "k2")[n % 2], 5.0 + n / 30)]
    path = ros.write_mcap(tmp_path / "r.mcap", messages)
    read = frames(path)
    assert [frame.sensor for _, frame in read] == ["k1", "k2"] * 3
    assert [time_s for time_s, _ in read] == sorted(time_s for time_s, _ in read)
    assert {frame.sensor for _, frame in frames(path, sensors=["k2"])} == {"k2"}
    with pytest.raises(InputError, match="no sensor k9"):
        open_recording(path, sensors=["k9"])


def test_clock_offsets_change_the_order_but_not_the_stamps(tmp_path: Path) -> None:
    path = ros.write_mcap(tmp_path / "r.mcap", plain("k1", "k2"))
    read = frames(path, clock_offsets={"k2": -0.15})
    assert [(frame.sensor, round(time_s, 6)) for time_s, frame in read] == [
        ("k2", 99.85), ("k2", 99.95), ("k1", 100.0), ("k2", 100.05), ("k1", 100.1), ("k1", 100.2),
    ]  # fmt: skip
    assert [frame.time_s for _, frame in read if frame.sensor == "k2"] == list(TIMES)


def test_reading_twice_gives_the_same(tmp_path: Path) -> None:
    recording = open_recording(ros.write_mcap(tmp_path / "r.mcap", plain("k1")))
    check_plain(list(recording.frames()))
    check_plain(list(recording.frames()))
    assert recording.tally.frames == {"k1": 3}


def test_a_file_written_topic_by_topic_is_untangled(tmp_path: Path) -> None:
    times = tuple(100.0 + n / 4 for n in range(40))
    messages = sorted(plain("k1", "k2", times=times), key=lambda message: message.topic)
    recording = open_recording(ros.write_mcap(tmp_path / "r.mcap", messages))
    assert [time_s for time_s, _ in recording.frames()] == sorted([*times, *times])
    assert recording.warnings == []


def test_other_topic_names(tmp_path: Path) -> None:
    messages = [
        ros.camera_info("/cam/color/info", 1.0),
        ros.image("/cam/color/image", 1.0, "rgb8", RGB),
        ros.image("/cam/aligned/image", 1.0, "16UC1", DEPTH),
    ]
    path = ros.write_mcap(tmp_path / "r.mcap", messages)
    with pytest.raises(InputError, match="no sensor"):
        open_recording(path)
    topics = parse_topics(["left:rgb=/cam/color/image,info=/cam/color/info,depth=/cam/aligned/image"])
    read = frames(path, topics=topics)
    assert read[0][1].sensor == "left"
    np.testing.assert_array_equal(read[0][1].depth_mm, DEPTH)


def test_a_named_topic_may_be_the_base_of_a_packed_one(tmp_path: Path) -> None:
    messages = [
        ros.camera_info("/cam/color/camera_info", 1.0),
        ros.packed("/cam/color/image/compressed", 1.0, "jpeg", ros.jpeg(RGB)),
        ros.packed(
            "/cam/depth_registered/i/compressedDepth", 1.0, "16UC1; compressedDepth", bytes(12) + ros.png(DEPTH)
        ),
    ]
    topics = parse_topics(["k:rgb=/cam/color/image,depth=/cam/depth_registered/i"])
    assert len(frames(ros.write_mcap(tmp_path / "r.mcap", messages), topics=topics)) == 1


@pytest.mark.parametrize(
    "option",
    [
        "",
        "k1",
        "k1:",
        "k1:rgb",
        "k1:rgb=",
        "k1:rgb=x",
        "k1:red=/x",
        ":rgb=/x",
        "k 1:rgb=/x",
        "k1:rgb=/x,rgb=/y",
        "1:rgb=/x",
    ],
)
def test_topics_that_cannot_be_understood(option: str) -> None:
    with pytest.raises(InputError, match="--topics") as caught:
        parse_topics([option])
    assert caught.value.where == "--topics"


def test_registered_depth_of_half_the_resolution(tmp_path: Path) -> None:
    """Each reading covers the four colour pixels that its own pixel covers; nothing is lost inside."""
    small = np.full((24, 32), 1000, np.uint16)
    frame = depth_frame(tmp_path, ros.image(RAW_DEPTH, 1.0, "16UC1", small))
    assert frame.depth_mm.shape == (48, 64)
    assert (frame.depth_mm[2:-2, 2:-2] == 1000).all()


def test_a_thing_in_depth_of_half_the_resolution_lies_where_colour_shows_it(tmp_path: Path) -> None:
    small = np.full((24, 32), 1000, np.uint16)
    small[5:12, 7:20], small[15:18, 22:27] = 800, 0
    wanted = small.repeat(2, axis=0).repeat(2, axis=1)
    frame = depth_frame(tmp_path, ros.image(RAW_DEPTH, 1.0, "16UC1", small))
    assert np.array_equal(frame.depth_mm[2:-2, 2:-2], wanted[2:-2, 2:-2])


def test_registered_depth_of_another_shape_is_refused_with_a_remedy(tmp_path: Path) -> None:
    other = np.full((20, 32), 1000, np.uint16)
    with pytest.raises(InputError, match="not registered to colour") as caught:
        depth_frame(tmp_path, ros.image(RAW_DEPTH, 1.0, "16UC1", other))
    assert caught.value.where == RAW_DEPTH
    assert "camera_info" in caught.value.remedy


def test_metadata_names_the_device(tmp_path: Path) -> None:
    from mcap.writer import Writer

    path = tmp_path / "r.mcap"
    ros.write_mcap(path, plain("k1"))
    copy = tmp_path / "named.mcap"
    with copy.open("wb") as file:
        writer = Writer(file)
        writer.start(profile="ros2")
        writer.add_metadata("sensor/k1", {"make": "Microsoft", "model": "Kinect", "serial": "A007"})
        for message in plain("k1"):
            kind, encoding, text = ros.schema(message.kind, "cdr")
            channel = writer.register_channel(message.topic, "cdr", writer.register_schema(kind, encoding, text))
            writer.add_message(channel, round(message.log_s * 1e9), ros.serialised(message), 0)
        writer.finish()
    info = open_recording(copy).sensors["k1"]
    assert (info.make, info.model, info.serial) == ("Microsoft", "Kinect", "A007")
