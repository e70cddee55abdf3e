"""Files that are cut, damaged, foreign or made to hurt: an InputError that helps, or what is sound; nothing else."""

from __future__ import annotations

import struct
import subprocess
import sys
import zlib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import zstandard
from mcap.writer import CompressionType, Writer

from fruitgui.errors import InputError
from fruitgui.frame import Frame
from fruitgui.sensors.recordings import Recording, open_recording, recover
from tests.unit.sensors import ros_files as ros

MAGIC = b"\x89MCAP0\r\n"
PNG = b"\x89PNG\r\n\x1a\n"
TINY = (6, 8)
TINY_K = np.array([8, 0, 4, 0, 8, 3, 0, 0, 1.0])


def tiny(sensor: str, time_s: float) -> list[ros.Message]:
    """A frame of 8×6 pixels, so that files are small enough to be cut everywhere."""
    return [
        ros.camera_info(f"/{sensor}/rgb/camera_info", time_s, width=8, height=6, k=TINY_K),
        ros.image(f"/{sensor}/rgb/image_raw", time_s, "rgb8", ros.colored(time_s, TINY)),
        ros.image(f"/{sensor}/depth_registered/image_raw", time_s, "16UC1", ros.depth(time_s, TINY)),
    ]


def story(count: int = 8) -> list[ros.Message]:
    return [message for n in range(count) for message in tiny("k1", 10.0 + n / 10)]


def read(path: Path) -> tuple[list[Frame], Recording | None]:
    """Return the frames and the recording; none where an InputError says why, in full."""
    try:
        recording = open_recording(path)
        return [frame for _, frame in recording.frames()], recording
    except InputError as error:
        told = (error.what, error.remedy, error.file == str(path))
    assert all(told)
    return [], None


def same(a: Frame, b: Frame) -> bool:
    return a.time_s == b.time_s and bool((a.color == b.color).all()) and bool((a.depth_mm == b.depth_mm).all())


CONTAINERS: dict[str, Callable[[Path], Path]] = {
    "zstd": lambda path: ros.write_mcap(path, story(), chunk_size=900),
    "lz4": lambda path: ros.write_mcap(path, story(), chunk_size=900, compression=CompressionType.LZ4),
    "none": lambda path: ros.write_mcap(path, story(), chunk_size=900, compression=CompressionType.NONE),
    "no_chunks": lambda path: ros.write_mcap(path, story(), use_chunking=False),
    "no_checksums": lambda path: ros.write_mcap(path, story(), chunk_size=900, enable_crcs=False),
    "bag": lambda path: ros.write_bag(path, story(), chunk=900),
    "bag_bz2": lambda path: ros.write_bag(path, story(), chunk=900, compression="BZ2"),
}


@pytest.mark.parametrize("kind", CONTAINERS)
def test_cut_anywhere_gives_the_beginning(tmp_path: Path, kind: str) -> None:
    whole_path = CONTAINERS[kind](tmp_path / "whole")
    whole, _ = read(whole_path)
    assert len(whole) == 8
    data = whole_path.read_bytes()
    draw = np.random.default_rng(5)
    counts = []
    for length in sorted({0, 1, 7, 8, 9, len(data) - 1, *(int(length) for length in draw.integers(0, len(data), 60))}):
        path = tmp_path / "cut"
        path.write_bytes(data[:length])
        part, recording = read(path)
        assert all(same(a, b) for a, b in zip(part, whole, strict=False)), f"cut at {length}"
        counts.append(len(part))
        if recording is not None and len(part) < len(whole):
            assert any("cut off at byte" in warning for warning in recording.warnings)
    assert counts == sorted(counts), "a longer piece never holds less"
    assert counts[-1] >= 7


def test_a_sensor_that_comes_late_in_a_cut_file_is_told(tmp_path: Path) -> None:
    """Without a table of contents only the first seconds are looked through; made whole, nothing is hidden."""
    camera = {"width": 160, "height": 120, "k": np.array([150, 0, 80, 0, 150, 60, 0, 0, 1.0])}
    noise = np.random.default_rng(0).integers(0, 255, (120, 160, 3), np.uint8)
    messages = []
    for n in range(150):
        for sensor in ("k1", "k2") if n > 120 else ("k1",):
            messages += [
                ros.camera_info(f"/{sensor}/rgb/camera_info", n / 10, **camera),
                ros.image(f"/{sensor}/rgb/image_raw", n / 10, "rgb8", noise),
                ros.image(f"/{sensor}/depth_registered/image_raw", n / 10, "16UC1", ros.depth(1.0, (120, 160))),
            ]
    path = tmp_path / "cut.mcap"
    path.write_bytes(ros.write_mcap(tmp_path / "whole.mcap", messages).read_bytes()[:-3000])
    _, recording = read(path)
    assert recording is not None
    assert list(recording.sensors) == ["k1"]
    assert any("k2 comes only later" in warning for warning in recording.warnings)
    recover(path, tmp_path / "again.mcap")
    assert list(open_recording(tmp_path / "again.mcap").sensors) == ["k1", "k2"]


def test_the_warning_names_the_last_time_and_what_is_unread(tmp_path: Path) -> None:
    data = CONTAINERS["none"](tmp_path / "whole").read_bytes()
    path = tmp_path / "cut.mcap"
    path.write_bytes(data[: len(data) // 2])
    frames, recording = read(path)
    assert recording is not None
    soundness = recording.tally.soundness
    assert soundness.cut_at is not None
    assert soundness.bytes_unread == len(data) // 2 - soundness.cut_at
    warning = recording.warnings[0]
    assert f"{frames[-1].time_s:.3f} s" in warning
    assert f"{soundness.bytes_unread} bytes unread" in warning


@pytest.mark.parametrize("kind", CONTAINERS)
def test_any_changed_byte_is_survived(tmp_path: Path, kind: str) -> None:
    whole = CONTAINERS[kind](tmp_path / "whole").read_bytes()
    draw = np.random.default_rng(6)
    for _ in range(60):
        data = bytearray(whole)
        for _ in range(draw.choice((1, 1, 4))):
            data[draw.integers(len(data))] = draw.choice((0, 1, 127, 128, 255))
        path = tmp_path / "changed"
        path.write_bytes(data)
        read(path)


@pytest.mark.parametrize("kind", [CompressionType.ZSTD, CompressionType.LZ4, CompressionType.NONE])
def test_a_chunk_too_large_to_be_unpacked_whole(tmp_path: Path, kind: CompressionType) -> None:
    """One chunk of 36 MB, mostly a topic that nobody wants."""
    noise = np.random.default_rng(0).bytes(3_000_000)
    path = tmp_path / "r.mcap"
    with path.open("wb") as file:
        writer = Writer(file, chunk_size=10**9, compression=kind)
        writer.start(profile="ros2")
        schema = writer.register_schema("std_msgs/msg/String", "ros2msg", b"string data")
        other = writer.register_channel("/other", "cdr", schema)
        for message in story(4):
            kind_, encoding, text = ros.schema(message.kind, "cdr")
            channel = writer.register_channel(message.topic, "cdr", writer.register_schema(kind_, encoding, text))
            writer.add_message(channel, round(message.log_s * 1e9), ros.serialised(message), 1)
            writer.add_message(other, round(message.log_s * 1e9), noise, 1)
        writer.finish()
    frames, _ = read(path)
    assert len(frames) == 4
    data = path.read_bytes()
    path.write_bytes(data[: len(data) // 2])
    frames, recording = read(path)
    assert len(frames) <= 2
    assert recording is None or "cut off" in recording.warnings[0]


def test_a_damaged_chunk_is_left_out_and_the_rest_used(tmp_path: Path) -> None:
    path = tmp_path / "r.mcap"
    data = bytearray(ros.write_mcap(path, story(30), chunk_size=2000, compression=CompressionType.NONE).read_bytes())
    middle = data.index(b"rgb8", len(data) // 3) + 20
    data[middle] ^= 0xFF
    path.write_bytes(data)
    frames, recording = read(path)
    assert 20 <= len(frames) < 30
    assert recording is not None
    assert any("checksum" in warning for warning in recording.warnings)


@pytest.mark.parametrize(("at", "options"), [(b"rgb8", {}), (b"rgb8", {"repeat_channels": False})])
def test_where_all_is_damaged_the_damage_is_the_reason_given(
    tmp_path: Path, at: bytes, options: dict[str, bool]
) -> None:
    path = ros.write_mcap(tmp_path / "r.mcap", story(3), compression=CompressionType.NONE, **options)
    data = bytearray(path.read_bytes())
    data[data.index(at) + 20] ^= 0xFF
    (tmp_path / "r.mcap").write_bytes(data)
    with pytest.raises(InputError) as caught:
        open_recording(tmp_path / "r.mcap")
    assert "checksum" in caught.value.what
    assert "again" in caught.value.remedy


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("empty.mcap", b""),
        ("foreign.mcap", b"PK\x03\x04" + bytes(500)),
        ("azure.mkv", b"\x1aE\xdf\xa3" + bytes(500)),
        ("realsense.db3", b"SQLite format 3\0" + bytes(500)),
        ("text.bag", b"hello, world\n" * 50),
        ("magic.mcap", MAGIC),
        ("two_magics.mcap", MAGIC + MAGIC),
        ("zeros.mcap", MAGIC + bytes(4096)),
        ("ones.mcap", MAGIC + b"\xff" * 4096),
        ("long_record.mcap", MAGIC + struct.pack("<BQ", 6, 2**63) + bytes(64)),
        ("long_message.mcap", MAGIC + struct.pack("<BQ", 5, 2**40)),
        ("bag_magic.bag", b"#ROSBAG V2.0\n"),
        ("bag_zeros.bag", b"#ROSBAG V2.0\n" + bytes(4096)),
        ("bag_ones.bag", b"#ROSBAG V2.0\n" + b"\xff" * 4096),
        ("old.bag", b"#ROSBAG V1.2\n" + bytes(100)),
    ],
)
def test_what_is_no_recording_is_refused(tmp_path: Path, name: str, content: bytes) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    assert read(path) == ([], None)


def test_no_file_no_permission_no_folder(tmp_path: Path) -> None:
    assert read(tmp_path / "missing.mcap") == ([], None)
    assert read(tmp_path) == ([], None)


def chunk(kind: str, claimed: int, packed: bytes, *, packed_claimed: int | None = None, crc: int = 0) -> bytes:
    name = kind.encode()
    body = struct.pack("<QQQII", 0, 1, claimed, crc, len(name)) + name
    body += struct.pack("<Q", len(packed) if packed_claimed is None else packed_claimed) + packed
    return struct.pack("<BQ", 6, len(body)) + body


def record(opcode: int, content: bytes) -> bytes:
    return struct.pack("<BQ", opcode, len(content)) + content


BOMB = zstandard.ZstdCompressor(level=3).compress(bytes(64 * 1024 * 1024))


@pytest.mark.parametrize(
    "hurt",
    [
        chunk("zstd", 1000, BOMB),
        chunk("zstd", 2**62, BOMB),
        chunk("zstd", 2**30, BOMB),
        chunk("lz4", 2**40, bytes(100)),
        chunk("", 2**40, bytes(100)),
        chunk("zstd", 100, b"not zstd at all"),
        chunk("brotli", 100, bytes(100)),
        chunk("none", 100, bytes(100), packed_claimed=2**60),
        chunk("", 40, record(5, bytes(10)) + record(5, b"")),
        chunk("", 27, struct.pack("<BQ", 5, 2**60) + bytes(18)),
        chunk("", 60, zlib.compress(bytes(60)).ljust(60), crc=12345),
        record(3, b"\xff" * 40),
        record(4, b"\xff" * 40),
        record(4, struct.pack("<HHI", 1, 1, 2**31)),
        record(12, struct.pack("<I", 2**31)),
        record(12, struct.pack("<II", 0, 2**31) + bytes(20)),
        record(5, b""),
        record(9, bytes(100)),
        record(0x7F, bytes(100)),
        record(0xFF, bytes(100)),
    ],
)
def test_a_part_that_lies_does_not_keep_the_rest_from_being_read(tmp_path: Path, hurt: bytes) -> None:
    whole = ros.write_mcap(tmp_path / "whole", story(3)).read_bytes()
    path = tmp_path / "hurt.mcap"
    path.write_bytes(MAGIC + hurt + whole[len(MAGIC) :])
    frames, _ = read(path)
    assert len(frames) == 3


def bad(**fields: object) -> Callable[[ros.Message], ros.Message]:
    return lambda message: ros.Message(message.topic, message.kind, message.log_s, {**message.fields, **fields})


INFO, COLOR, DEPTH = "camera_info", "/rgb/image_raw", "/depth_registered/image_raw"
NAN_K = np.array([np.nan, 0, 4, 0, 8, 3, 0, 0, 1.0])


@pytest.mark.parametrize(
    ("part", "change", "says"),
    [
        (INFO, bad(k=np.zeros(9)), "focal length"),
        (INFO, bad(k=NAN_K), "not finite"),
        (INFO, bad(k=-np.array([8, 0, 4, 0, 8, 3, 0, 0, 1.0])), "focal length"),
        (INFO, bad(k=np.array([8, 0, 1e9, 0, 8, 3, 0, 0, 1.0])), "principal point"),
        (INFO, bad(d=np.full(5, np.inf)), "not finite"),
        (INFO, bad(d=np.ones(7)), "7 lens coefficients"),
        (INFO, bad(d=np.ones(65)), "too long"),
        (INFO, bad(distortion_model="equidistant", d=np.ones(4)), "equidistant"),
        (INFO, bad(width=2**32 - 1, height=2**32 - 1), "claims"),
        (INFO, bad(width=16, height=6), "16×6"),
        (COLOR, bad(width=0, height=0), "0×0"),
        (COLOR, bad(width=2**31, height=2**31), "2147483648"),
        (COLOR, bad(width=4096, height=4096, step=0), "4096×4096"),
        (COLOR, bad(step=2), "fewer bytes"),
        (COLOR, bad(encoding="jpg2000"), "jpg2000"),
        (DEPTH, bad(height=0), "8×0"),
        (DEPTH, bad(encoding="64FC1"), "64FC1"),
        (DEPTH, bad(data=np.zeros(3, np.uint8)), "fewer bytes"),
    ],
)
def test_a_recording_of_bad_messages_says_what_is_bad(
    tmp_path: Path, part: str, change: Callable[[ros.Message], ros.Message], says: str
) -> None:
    messages = [change(message) if message.topic.endswith(part) else message for message in story()]
    with pytest.raises(InputError) as caught:
        list(open_recording(ros.write_mcap(tmp_path / "r.mcap", messages)).frames())
    assert says in caught.value.what
    assert caught.value.remedy


@pytest.mark.parametrize(("part", "says"), [(INFO, "camera_info"), (COLOR, "colour"), (DEPTH, "depth")])
def test_a_recording_that_lacks_a_part_says_which(tmp_path: Path, part: str, says: str) -> None:
    messages = [message for message in story() if not message.topic.endswith(part)]
    with pytest.raises(InputError) as caught:
        open_recording(ros.write_mcap(tmp_path / "r.mcap", messages))
    assert says in caught.value.what
    assert "/k1" in str(caught.value.where)


def test_a_sensor_that_cannot_be_used_is_left_out_and_the_others_read(tmp_path: Path) -> None:
    messages = [m for n in range(4) for m in (*tiny("k1", n / 10), *tiny("k2", n / 10)[1:])]
    recording = open_recording(ros.write_mcap(tmp_path / "r.mcap", messages))
    assert list(recording.sensors) == ["k1"]
    assert len(list(recording.frames())) == 4
    assert "/k2/rgb" in " ".join(recording.warnings)


@pytest.mark.parametrize(
    ("part", "change", "cause"),
    [
        (COLOR, bad(width=0), "pixels"),
        (COLOR, bad(encoding="x"), "'x'"),
        (DEPTH, bad(width=4, step=8), "another size"),
        (DEPTH, bad(data=np.zeros(0, np.uint8)), "fewer bytes"),
    ],
)
def test_one_bad_frame_is_dropped_and_counted(
    tmp_path: Path, part: str, change: Callable[[ros.Message], ros.Message], cause: str
) -> None:
    messages = story()
    place = next(n for n, message in enumerate(messages) if message.topic.endswith(part) and n > 9)
    messages[place] = change(messages[place])
    recording = open_recording(ros.write_mcap(tmp_path / "r.mcap", messages))
    frames = [frame for _, frame in recording.frames()]
    assert len(frames) == 7
    assert [frame.sequence for frame in frames] == list(range(7))
    assert recording.tally.dropped("k1") == 1
    assert cause in recording.warnings[0]


def test_a_first_picture_that_lies_about_its_size_does_not_spoil_the_rest(tmp_path: Path) -> None:
    messages = story()
    for place in (1, 2):
        messages[place] = bad(width=16, height=12, step=48)(messages[place])
    frames, recording = read(ros.write_mcap(tmp_path / "r.mcap", messages))
    assert len(frames) == 7
    assert recording is not None
    assert recording.tally.dropped("k1") == 1


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"\xff\xd8\xff",
        PNG,
        ros.jpeg(ros.colored(1.0, TINY))[:-40],
        ros.png(ros.colored(1.0, TINY))[:-30],
        b"\xff\xd8\xff\xc0\x00\x11\x08\xff\xff\xff\xff" + bytes(40),
        PNG + struct.pack(">I4sII", 13, b"IHDR", 2**31, 2**31),
        b"RIFF....WEBP" + bytes(100),
    ],
)
def test_packed_pictures_that_are_damaged_are_dropped(tmp_path: Path, data: bytes) -> None:
    good = ros.jpeg(ros.colored(1.0, TINY))
    messages = []
    for n in range(6):
        info, _, depth = tiny("k1", n / 10)
        messages += [info, ros.packed("/k1/rgb/image_raw/compressed", n / 10, "jpeg", data if n == 3 else good), depth]
    recording = open_recording(ros.write_mcap(tmp_path / "r.mcap", messages))
    assert len(list(recording.frames())) == 5
    assert recording.tally.dropped("k1") == 1


@pytest.mark.parametrize("topic", ["/t{}/rgb/camera_info", "/t{}/rgb/image_raw", "/t{}/other"])
def test_ten_thousand_topics_do_not_hide_the_one_sensor(tmp_path: Path, topic: str) -> None:
    kind = "sensor_msgs/msg/CameraInfo" if topic.endswith("info") else "sensor_msgs/msg/Image"
    path = tmp_path / "r.mcap"
    with path.open("wb") as file:
        writer = Writer(file)
        writer.start(profile="ros2")
        schema = writer.register_schema(kind, "ros2msg", b"")
        for n in range(10_000):
            writer.add_message(writer.register_channel(topic.format(n), "cdr", schema), 1, b"", 1)
        writer.finish()
    many = path.read_bytes()
    many = many[: many.rindex(record(15, bytes(4)))]
    path.write_bytes(many + ros.write_mcap(path, story(3)).read_bytes()[len(MAGIC) :])
    recording = open_recording(path)
    assert list(recording.sensors) == ["k1"]
    assert len(list(recording.frames())) == 3
    assert len(recording.warnings) < 20


def test_a_name_of_a_sensor_that_is_no_name(tmp_path: Path) -> None:
    messages = [ros.Message(m.topic.replace("k1", "../../x y"), m.kind, m.log_s, m.fields) for m in story(2)]
    assert read(ros.write_mcap(tmp_path / "r.mcap", messages)) == ([], None)


MEASURE = """
import resource, sys
from pathlib import Path
from fruitgui.errors import InputError
from fruitgui.sensors.recordings import open_recording
try:
    sum(1 for _ in open_recording(Path(sys.argv[1])).frames())
except InputError:
    pass
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024)
"""


def peak_mb(path: Path) -> int:
    done = subprocess.run([sys.executable, "-c", MEASURE, str(path)], check=True, capture_output=True, text=True)
    return int(done.stdout)


def test_files_made_to_hurt_take_no_more_memory_than_a_good_one(tmp_path: Path) -> None:
    good = peak_mb(ros.write_mcap(tmp_path / "good.mcap", story(8)))
    whole = (tmp_path / "good.mcap").read_bytes()[len(MAGIC) :]
    bombs = tmp_path / "bombs.mcap"
    bombs.write_bytes(MAGIC + (chunk("zstd", 1000, BOMB) + chunk("zstd", 2**40, BOMB)) * 20 + whole)
    assert peak_mb(bombs) < good + 24
    honest = tmp_path / "honest.mcap"
    honest.write_bytes(MAGIC + chunk("zstd", 64 * 1024 * 1024, BOMB) * 4 + whole)
    assert peak_mb(honest) < good + 24
    lies = tmp_path / "lies.mcap"
    lies.write_bytes(MAGIC + struct.pack("<BQ", 6, 2**35) + whole)
    assert peak_mb(lies) < good + 24


def test_memory_does_not_grow_with_the_length_of_the_recording(tmp_path: Path) -> None:
    """Two seconds of messages wait; four times the length takes no more."""
    color, depth = np.zeros((120, 160, 3), np.uint8), np.ones((120, 160), np.uint16)
    camera = {"width": 160, "height": 120, "k": np.array([150, 0, 80, 0, 150, 60, 0, 0, 1.0])}

    def long(seconds: int) -> list[ros.Message]:
        return [
            message
            for n in range(seconds * 30)
            for message in (
                ros.camera_info("/k1/rgb/camera_info", n / 30, **camera),
                ros.image("/k1/rgb/image_raw", n / 30, "rgb8", color),
                ros.image("/k1/depth_registered/image_raw", n / 30, "16UC1", depth),
            )
        ]

    short_mb = peak_mb(ros.write_mcap(tmp_path / "short.mcap", long(6), chunk_size=10**6))
    long_mb = peak_mb(ros.write_mcap(tmp_path / "long.mcap", long(24), chunk_size=10**6))
    assert long_mb < short_mb + 8
