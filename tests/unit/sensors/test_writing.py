"""What the product records: whole or not at all, and readable by the tools of others."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from mcap.reader import make_reader
from rosbags.highlevel import AnyReader

from fruitgui.errors import InputError, WorldError
from fruitgui.frame import Frame, Intrinsics
from fruitgui.sensors.recordings import RecordingWriter, open_recording, recover
from fruitgui.sensors.sensor import SensorInfo
from tests.unit.sensors import ros_files as ros

CAMERA = Intrinsics(ros.WIDTH, ros.HEIGHT, 60.0, 61.0, 31.5, 23.5, (0.1, -0.2, 0.001, 0.002, 0.05))
INFOS = [SensorInfo(f"k{n}", "Microsoft", "Kinect 1414", f"A0070000{n}", CAMERA, 30.0) for n in (1, 2)]
START = 1_700_000_000.25


def smooth(time_s: float) -> np.ndarray:
    """A picture that JPEG keeps well."""
    picture: np.ndarray = np.full((ros.HEIGHT, ros.WIDTH, 3), (int(time_s * 10) % 200, 90, 160), np.uint8)
    return picture


def frame(sensor: str, number: int) -> Frame:
    time_s = START + number / 30
    return Frame(sensor, number, time_s, smooth(time_s), ros.depth(time_s), CAMERA)


def write(path: Path, count: int = 6, sensors: tuple[str, ...] = ("k1", "k2")) -> Path:
    with RecordingWriter(path, INFOS) as writer:
        for number in range(count):
            for sensor in sensors:
                writer.write(frame(sensor, number))
    return path


def test_what_is_written_is_read_back(tmp_path: Path) -> None:
    recording = open_recording(write(tmp_path / "r.mcap"))
    assert [replace(info, rate_hz=round(info.rate_hz, 1)) for info in recording.sensors.values()] == INFOS
    got = [one for _, one in recording.frames()]
    expected = [frame(info.sensor, number) for number in range(6) for info in INFOS]
    assert [(f.sensor, f.sequence, f.time_s) for f in got] == [(f.sensor, f.sequence, f.time_s) for f in expected]
    for one, other in zip(got, expected, strict=True):
        np.testing.assert_array_equal(one.depth_mm, other.depth_mm)
        assert np.abs(one.color.astype(int) - other.color).max() <= 3
        assert one.intrinsics == CAMERA
    assert recording.warnings == []
    assert [path.name for path in tmp_path.iterdir()] == ["r.mcap"]


def test_ros_tools_read_it_too(tmp_path: Path) -> None:
    path = write(tmp_path / "r.mcap")
    with AnyReader([path]) as reader:
        counts = {connection.topic: connection.msgcount for connection in reader.connections}
        assert counts["/k1/depth_registered/image_raw"] == 6
        for connection, _, data in reader.messages():
            message = reader.deserialize(data, connection.msgtype)
            assert message.header.stamp.sec == int(START)
            assert message.header.frame_id.endswith("_rgb_optical_frame")
            if connection.msgtype == "sensor_msgs/msg/Image":
                assert (message.encoding, message.step) == ("16UC1", 2 * ros.WIDTH)
            if connection.msgtype == "sensor_msgs/msg/CameraInfo":
                np.testing.assert_allclose(message.d, CAMERA.distortion)
                np.testing.assert_allclose(message.k.reshape(3, 3), CAMERA.matrix)


def test_the_file_says_what_it_is(tmp_path: Path) -> None:
    with write(tmp_path / "r.mcap").open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        assert reader.get_header().profile == "ros2"
        metadata = {one.name: one.metadata for one in reader.iter_metadata()}
        assert metadata["sensor/k1"]["serial"] == "A00700001"
        summary = reader.get_summary()
        assert summary is not None
        assert {schema.encoding for schema in summary.schemas.values()} == {"ros2msg"}
        assert all(schema.data for schema in summary.schemas.values())
        assert {chunk.compression for chunk in summary.chunk_indexes} == {"zstd"}
        assert sum(1 for _ in reader.iter_messages()) == 48


def test_an_error_leaves_nothing_behind(tmp_path: Path) -> None:
    path = tmp_path / "r.mcap"
    path.write_bytes(b"the last good one")
    with pytest.raises(InputError, match="k9"):
        write(path, sensors=("k1", "k9"))
    assert [one.name for one in tmp_path.iterdir()] == ["r.mcap"]
    assert path.read_bytes() == b"the last good one"


def test_closing_twice_is_closing(tmp_path: Path) -> None:
    writer = RecordingWriter(tmp_path / "r.mcap", INFOS)
    writer.write(frame("k1", 0))
    assert writer.bytes_written >= 0
    writer.close()
    writer.close()
    writer.discard()
    assert (tmp_path / "r.mcap").exists()


def test_a_folder_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(WorldError, match="Cannot write"):
        RecordingWriter(tmp_path / "no" / "r.mcap", INFOS)


@pytest.mark.parametrize("time_s", [float("nan"), float("inf"), 1e12])
def test_times_that_cannot_be_stamped(tmp_path: Path, time_s: float) -> None:
    with pytest.raises(InputError, match="time"), RecordingWriter(tmp_path / "r.mcap", INFOS) as writer:
        writer.write(Frame("k1", 0, time_s, smooth(0.0), ros.depth(0.0), CAMERA))
    assert not list(tmp_path.iterdir())


def cut(path: Path, part: float) -> Path:
    data = path.read_bytes()
    short = path.with_name("cut.mcap")
    short.write_bytes(data[: int(len(data) * part)])
    return short


@pytest.mark.parametrize("part", [0.3, 0.6, 0.97])
def test_a_cut_recording_is_made_whole(tmp_path: Path, part: float) -> None:
    messages = [m for n in range(20) for m in ros.frameset("k1", 5.0 + n / 10)]
    short = cut(ros.write_mcap(tmp_path / "whole.mcap", messages), part)
    recovered = recover(short, tmp_path / "out.mcap")
    assert recovered.bytes_unread >= 0
    expected = [one for _, one in open_recording(short).frames()]
    whole = open_recording(tmp_path / "out.mcap")
    got = [one for _, one in whole.frames()]
    assert "cut off" not in " ".join(whole.warnings)
    assert [one.time_s for one in got] == [one.time_s for one in expected]
    assert recovered.messages >= 3 * len(got) > 0
    with AnyReader([tmp_path / "out.mcap"]) as reader:
        assert sum(1 for _ in reader.messages()) == recovered.messages
    with (tmp_path / "out.mcap").open("rb") as file:
        assert make_reader(file, validate_crcs=True).get_summary() is not None


def test_recovering_keeps_who_the_sensors_are(tmp_path: Path) -> None:
    short = cut(write(tmp_path / "whole.mcap", 30), 0.7)
    recover(short, tmp_path / "out.mcap")
    assert open_recording(tmp_path / "out.mcap").sensors["k2"].serial == "A00700002"


def test_a_file_is_not_recovered_into_itself(tmp_path: Path) -> None:
    path = write(tmp_path / "whole.mcap")
    before = path.read_bytes()
    with pytest.raises(InputError, match="is the file"):
        recover(path, tmp_path / "." / "whole.mcap")
    assert path.read_bytes() == before


def test_nothing_sound_is_not_recovered(tmp_path: Path) -> None:
    short = cut(write(tmp_path / "whole.mcap"), 0.01)
    with pytest.raises(InputError, match="not one whole message"):
        recover(short, tmp_path / "out.mcap")
    with pytest.raises(InputError, match="ROS 1"):
        recover(ros.write_bag(tmp_path / "r.bag", ros.frameset("k1", 1.0)), tmp_path / "out.mcap")
    assert not (tmp_path / "out.mcap").exists()
