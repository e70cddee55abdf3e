"""One wrong byte in a recording loses the chunk that it is in, and nothing else; what was lost is said."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from mcap.reader import make_reader

from fruitgui.frame import Frame, Intrinsics
from fruitgui.sensors.recordings import RecordingWriter, open_recording, recover
from fruitgui.sensors.recordings import writer as writer_module
from fruitgui.sensors.sensor import SensorInfo
from tests.unit.sensors import ros_files as ros

CAMERA = Intrinsics(8, 6, 8.0, 8.0, 4.0, 3.0)
INFOS = [SensorInfo(f"k{n}", "Microsoft", "Kinect 1414", f"A0{n}", CAMERA, 10.0) for n in (1, 2)]
COUNT, IN_A_CHUNK = 24, 4


@pytest.fixture
def path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A recording of our own, of six chunks of four frames."""
    one = frame(0)
    monkeypatch.setattr(writer_module, "CHUNK_BYTES", IN_A_CHUNK * (one.color.nbytes + one.depth_mm.nbytes))
    monkeypatch.setattr(writer_module, "CHUNK_S", 1e9)
    with RecordingWriter(tmp_path / "r.mcap", INFOS) as writer:
        for number in range(COUNT):
            writer.write(frame(number), 10**9 * (100 + number))
    return tmp_path / "r.mcap"


def frame(number: int) -> Frame:
    time_s = 5.0 + number / 10
    color = np.full((6, 8, 3), number * 9, np.uint8)
    return Frame(f"k{1 + number % 2}", number // 2, time_s, color, ros.depth(time_s, (6, 8)), CAMERA)


def times_s(path: Path) -> tuple[list[float], list[str]]:
    recording = open_recording(path)
    return [one.time_s for _, one in recording.frames()], recording.warnings


def chunks(path: Path) -> list[tuple[int, int]]:
    """Return where each chunk begins and ends."""
    with path.open("rb") as file:
        summary = make_reader(file).get_summary()
    assert summary is not None
    return [
        (one.chunk_start_offset, one.chunk_start_offset + one.chunk_length + one.message_index_length)
        for one in summary.chunk_indexes
    ]


ALL_S = [5.0 + number / 10 for number in range(COUNT)]


@pytest.mark.parametrize("tail", ["whole", "cut"])
def test_a_wrong_byte_loses_its_chunk_at_most(path: Path, tail: str) -> None:
    places = chunks(path)
    data = path.read_bytes()[: None if tail == "whole" else places[-1][1] + 5]
    first = places[0][0]
    draw = np.random.default_rng(3)
    heads = [start + byte for start, _ in places[2:4] for byte in range(45)]
    before, after = draw.integers(8, first, 40), draw.integers(first, len(data), 60)
    for at in {*heads, *(int(one) for one in (*before, *after))}:
        changed = bytearray(data)
        changed[at] ^= int(draw.integers(1, 256))
        path.write_bytes(changed)
        try:
            seen, warnings = times_s(path)
        except Exception as error:
            if tail == "cut" and at < first:  # the only definitions that a cut file has
                continue
            raise AssertionError(f"byte {at} of {len(data)}") from error
        if tail == "cut" and at < first:
            continue
        hit = next((n for n, (start, end) in enumerate(places) if start <= at < end), None)
        spared = [time for number, time in enumerate(ALL_S) if hit is None or number // IN_A_CHUNK != hit]
        assert set(spared) <= set(seen), f"byte {at} of {len(data)}, chunk {hit}"
        if len(seen) < COUNT:
            assert warnings, f"byte {at}: frames are missing and nothing is said"


def test_what_was_lost_is_said(path: Path) -> None:
    start, end = chunks(path)[2]
    data = bytearray(path.read_bytes())
    data[(start + end) // 2 - 100] ^= 0x55
    path.write_bytes(data)
    seen, warnings = times_s(path)
    assert seen == ALL_S[:8] + ALL_S[12:]
    assert "lost 2 frames of k1 and 2 frames of k2 between 8.00 s and 11.00 s" in " ".join(warnings)


def _length(data: bytearray, start: int) -> None:
    data[start + 3] ^= 0x40


def _opcode(data: bytearray, start: int) -> None:
    data[start] = 0x0F  # "the data end here"


@pytest.mark.parametrize("damage", [_length, _opcode])
def test_recovering_goes_on_behind_a_damaged_head(
    path: Path, tmp_path: Path, damage: Callable[[bytearray, int], None]
) -> None:
    start = chunks(path)[3][0]
    data = bytearray(path.read_bytes())
    damage(data, start)
    path.write_bytes(data)
    assert (
        "lost 2 frames of k1 and 2 frames of k2 between 12.00 s and 15.00 s"
        in recover(path, tmp_path / "good.mcap").lost
    )
    seen, warnings = times_s(tmp_path / "good.mcap")
    assert seen == ALL_S[:12] + ALL_S[16:]
    assert warnings == []


def test_a_file_whose_first_bytes_are_wrong_is_known_by_its_last(path: Path) -> None:
    data = bytearray(path.read_bytes())
    data[3] ^= 0xFF
    path.write_bytes(data)
    assert times_s(path)[0] == ALL_S
