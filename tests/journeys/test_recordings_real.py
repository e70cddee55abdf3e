"""Recordings of real sensors, read as the commands read them. Figures are printed: run with -s to see them."""

from __future__ import annotations

import csv
import json
import time
from pathlib import Path

import cv2
import numpy as np
import pytest

from fruitgui.cli import main
from fruitgui.frame import Frame
from fruitgui.sensors.recordings import Recording, RecordingWriter, open_recording, recover
from tests.real_data import real_data

pytestmark = pytest.mark.real

RECORDINGS = {"apples_rolling.mcap": 37, "two_xtions_chocapics.mcap": 22, "kitchen_poses.mcap": 25}
STILL_FRAMES = range(6, 22)
BARE_FRAMES = range(8, 21)
"""Of those, the ones in which no hand nor bag reaches into the picture."""


def say(figure: str) -> None:
    print(figure)  # noqa: T201 - figures are for people


def frames(recording: Recording) -> list[Frame]:
    return [frame for _, frame in recording.frames()]


@pytest.mark.parametrize(("name", "count"), RECORDINGS.items())
def test_every_frame_is_read_in_order(name: str, count: int) -> None:
    recording = open_recording(real_data(name))
    began = time.process_time()
    read = list(recording.frames())
    spent_ms = (time.process_time() - began) * 1e3 / count
    filled = np.mean([(frame.depth_mm > 0).mean() for _, frame in read])
    say(f"{name}: {dict(recording.tally.frames)} frames, {spent_ms:.1f} ms each, {filled:.0%} of pixels have depth")
    assert len(read) == count
    assert [time_s for time_s, _ in read] == sorted(time_s for time_s, _ in read)
    assert recording.warnings == []
    for _, frame in read:
        assert frame.color.shape == (*frame.depth_mm.shape, 3) == (480, 640, 3)
    assert filled > 0.5


def edge_agreement(frame: Frame, depth_mm: np.ndarray) -> dict[int, float]:
    """Return how strongly colour changes along the depth edges, by how far those are moved sideways, pixels."""
    grey = cv2.GaussianBlur(cv2.cvtColor(frame.color, cv2.COLOR_RGB2GRAY), (3, 3), 0).astype(np.float32)
    change = np.abs(cv2.Sobel(grey, cv2.CV_32F, 1, 0))
    z = cv2.medianBlur(depth_mm, 5).astype(np.float32)
    edges = (np.abs(np.diff(z, axis=1, prepend=z[:, :1])) > 0.03 * z) & (z > 0)
    edges &= np.roll(z, 1, axis=1) > 0
    edges[:, :40] = edges[:, -40:] = False
    return {shift: float(change[np.roll(edges, shift, axis=1)].mean()) for shift in range(-30, 31)}


def test_registered_depth_edges_lie_on_colour_edges() -> None:
    """The table with laptop and books stands still: moved sideways, the depth edges fit the colours less well.

    Structured light widens edges by up to two pixels to either side, so the best place is within three.
    """
    recording = open_recording(real_data("apples_rolling.mcap"))
    still = [frame for frame in frames(recording) if frame.sequence in STILL_FRAMES]
    agreement = {shift: np.mean([edge_agreement(f, f.depth_mm)[shift] for f in still]) for shift in range(-30, 31)}
    best = max(agreement, key=lambda shift: agreement[shift])
    say(f"apples_rolling: depth edges fit the colour edges best when moved by {best} px")
    assert abs(best) <= 3


def test_two_sensors_come_together() -> None:
    recording = open_recording(real_data("two_xtions_chocapics.mcap"))
    read = frames(recording)
    first, second = ([frame for frame in read if frame.sensor == name] for name in ("xtion_1", "xtion_2"))
    assert [frame.time_s for frame in first] == [frame.time_s for frame in second]
    assert len(first) == 11


def test_every_pose_has_its_frame() -> None:
    with real_data("kitchen_poses.csv").open() as file:
        stamps = [float(row["time_s"]) for row in csv.DictReader(file)]
    read = frames(open_recording(real_data("kitchen_poses.mcap")))
    assert [frame.time_s for frame in read] == pytest.approx(stamps)


@pytest.mark.parametrize("name", RECORDINGS)
def test_cut_off_it_is_used_up_to_the_cut_and_can_be_recovered(tmp_path: Path, name: str) -> None:
    data = real_data(name).read_bytes()
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(data[: int(len(data) * 0.6)])
    recording = open_recording(cut)
    read = frames(recording)
    say(f"{name} cut at 60 %: {len(read)} of {RECORDINGS[name]} frames; {recording.warnings[0]}")
    assert 0.4 * RECORDINGS[name] < len(read) < RECORDINGS[name]
    assert "cut off" in recording.warnings[0]
    recover(cut, tmp_path / "whole.mcap")
    again = frames(open_recording(tmp_path / "whole.mcap"))
    assert [frame.time_s for frame in again] == [frame.time_s for frame in read]
    np.testing.assert_array_equal(again[-1].depth_mm, read[-1].depth_mm)


def test_what_is_read_can_be_recorded_again(tmp_path: Path) -> None:
    """Depth to the bit, colour to what JPEG loses."""
    source = open_recording(real_data("two_xtions_chocapics.mcap"))
    with RecordingWriter(tmp_path / "r.mcap", source.sensors.values()) as writer:
        for _, frame in source.frames():
            writer.write(frame)
    for one, other in zip(frames(source), frames(open_recording(tmp_path / "r.mcap")), strict=True):
        assert (one.sensor, one.time_s, one.intrinsics) == (other.sensor, other.time_s, other.intrinsics)
        np.testing.assert_array_equal(one.depth_mm, other.depth_mm)
        assert np.abs(one.color.astype(int) - other.color).mean() < 4


def test_rolling_apples_are_counted_where_the_table_was_seen_bare(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """No belt, blurred pictures four times a second, laptop and books beside: all of it is a record, apples in size."""
    source = open_recording(real_data("apples_rolling.mcap"))
    still, station, report = tmp_path / "still.mcap", tmp_path / "station.json", tmp_path / "report.json"
    with RecordingWriter(still, source.sensors.values()) as writer:
        for frame in frames(source):
            if frame.sequence in BARE_FRAMES:
                writer.write(frame)
    assert main(["calibrate", str(still), "--station", str(station)]) == 0
    assert "1 sensor." in capsys.readouterr().out
    arguments = ["run", str(real_data("apples_rolling.mcap")), "--station", str(station), "--report", str(report)]
    assert main(arguments) == 0
    fruit = json.loads(report.read_text(encoding="utf-8"))["fruit"]
    poured = [one for one in fruit if one["first_seen_s"] > 1005.5]
    say("apples_rolling, after the bag: " + ", ".join(f"{one['diameter_mm']:.0f} mm" for one in poured))
    assert len(fruit) >= 8
    assert sum(50 < one["diameter_mm"] < 100 for one in poured) >= 3
    assert all(np.isfinite([one["volume_ml"], one["volume_std_ml"]]).all() for one in fruit)


def test_the_whole_recording_of_the_apples_is_refused_for_its_motion(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    station = tmp_path / "station.json"
    assert main(["calibrate", str(real_data("apples_rolling.mcap")), "--station", str(station), "--json"]) == 3
    assert [one["code"] for one in json.loads(capsys.readouterr().out)["reasons"]] == ["scene_moved"]
    assert not station.exists()
