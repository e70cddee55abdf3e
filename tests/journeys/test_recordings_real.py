"""Recordings of real sensors, read as the commands read them. Figures are printed: run with -s to see them."""

from __future__ import annotations

import csv
import time
from pathlib import Path

import cv2
import numpy as np
import pytest

from fruitgui.frame import Frame
from fruitgui.sensors.recordings import Recording, RecordingWriter, open_recording, recover
from tests.real_data import real_data

pytestmark = pytest.mark.real

RECORDINGS = {"apples_rolling.mcap": 37, "two_xtions_chocapics.mcap": 22, "kitchen_poses.mcap": 25}
STILL_FRAMES = range(6, 22)


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
