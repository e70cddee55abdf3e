"""Recordings in parts: each whole in itself, all of them together one."""

from __future__ import annotations

import errno
import io
import resource
import threading
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from mcap.reader import make_reader

from fruitgui.errors import InputError, WorldError
from fruitgui.frame import Frame, Intrinsics
from fruitgui.sensors.recordings import RecordingWriter, SeriesWriter, Split, open_recording, parts_after, recover
from fruitgui.sensors.recordings.packing import Chunk
from fruitgui.sensors.recordings.part_file import unfinished
from fruitgui.sensors.recordings.series import part_of
from fruitgui.sensors.sensor import SensorInfo

CAMERA = Intrinsics(64, 48, 60.0, 60.0, 32.0, 24.0)
INFOS = [SensorInfo(f"k{n}", "Microsoft", "Kinect 1414", f"A0{n}", CAMERA, 10.0) for n in (1, 2)]
NOISE = np.random.default_rng(4).integers(500, 4000, (8, 48, 64), np.uint16)

pytestmark = pytest.mark.usefixtures("no_leaked_threads")


def frame(number: int) -> Frame:
    """Frames that hardly pack: what a file takes is what they hold."""
    color = np.full((48, 64, 3), number % 200, np.uint8)
    return Frame(f"k{1 + number % 2}", number // 2, 5.0 + number / 20, color, NOISE[number % 8], CAMERA)


def written(path: Path, split: Split, count: int = 80, hands: ThreadPoolExecutor | None = None) -> SeriesWriter:
    writer = SeriesWriter(path, INFOS, split, hands)
    for number in range(count):
        writer.write(frame(number), 10**9 * 1000 + number * 50_000_000)
    writer.close()
    return writer


def stamps_s(path: Path, *following: Path) -> list[float]:
    return [one.time_s for _, one in open_recording(path, following=following).frames()]


ALL_S = [frame(number).time_s for number in range(80)]


@pytest.mark.parametrize("split", [Split(most_s=1.0), Split(most_bytes=160_000)])
@pytest.mark.parametrize("threads", [0, 2])
def test_every_part_is_whole_and_all_are_one(tmp_path: Path, split: Split, threads: int) -> None:
    path = tmp_path / "r.mcap"
    if threads:
        with ThreadPoolExecutor(threads) as hands:
            writer = written(path, split, hands=hands)
    else:
        writer = written(path, split)
    assert len(writer.parts) >= 3
    assert writer.parts[:2] == (path, tmp_path / "r_0002.mcap")
    assert sorted(tmp_path.iterdir()) == sorted(writer.parts)
    assert sum(writer.frames_stored.values()) == 80
    assert [time_s for part in writer.parts for time_s in stamps_s(part)] == ALL_S
    assert parts_after(path) == writer.parts[1:]
    assert parts_after(writer.parts[1]) == writer.parts[2:]
    assert stamps_s(path, *parts_after(path)) == ALL_S
    for part in writer.parts:
        if split.most_bytes is not None:
            assert part.stat().st_size <= split.most_bytes
        with part.open("rb") as file:
            reader = make_reader(file, validate_crcs=True)
            assert sum(1 for _ in reader.iter_messages()) == 4 * len(stamps_s(part))
            assert {one.name for one in reader.iter_metadata()} == {"recording", "sensor/k1", "sensor/k2"}
    if split.most_s is not None:
        assert [len(stamps_s(part)) for part in writer.parts] == [20] * 4


def test_a_part_says_that_it_goes_on(tmp_path: Path) -> None:
    written(tmp_path / "r.mcap", Split(most_s=1.0))
    warnings = open_recording(tmp_path / "r.mcap").warnings
    assert "goes on in r_0002.mcap to r_0004.mcap" in warnings[0]
    assert open_recording(tmp_path / "r_0004.mcap").warnings == []


def test_parts_of_another_recording_are_not_mixed_in(tmp_path: Path) -> None:
    written(tmp_path / "r.mcap", Split(most_s=2.0))
    (tmp_path / "old").mkdir()
    written(tmp_path / "old" / "r.mcap", Split(most_s=1.0))
    (tmp_path / "old" / "r_0003.mcap").rename(tmp_path / "r_0003.mcap")
    assert parts_after(tmp_path / "r.mcap") == (tmp_path / "r_0002.mcap",)
    assert part_of(tmp_path / "nothing.mcap") is None


def test_nothing_that_is_there_is_written_over_by_a_part(tmp_path: Path) -> None:
    (tmp_path / "r_0002.mcap").write_text("mine")
    with pytest.raises(InputError) as caught:
        SeriesWriter(tmp_path / "r.mcap", INFOS, Split(most_s=1.0))
    assert caught.value.code == "parts_there"
    assert [one.name for one in tmp_path.iterdir()] == ["r_0002.mcap"]


def test_while_it_is_made_it_lies_under_another_name_and_is_sound(tmp_path: Path) -> None:
    path = tmp_path / "r.mcap"
    writer = RecordingWriter(path, INFOS)
    for number in range(8):
        writer.write(frame(number))
    writer.store_all()
    assert [one.name for one in tmp_path.iterdir()] == ["r.mcap.part"]
    assert recover(unfinished(path), tmp_path / "saved.mcap").messages == 32
    assert stamps_s(tmp_path / "saved.mcap") == ALL_S[:8]
    with pytest.raises(InputError) as caught:
        RecordingWriter(path, INFOS)
    assert caught.value.code == "unfinished_recording"
    assert "--recover r.mcap.part" in caught.value.remedy
    writer.close()
    assert stamps_s(path) == ALL_S[:8]
    assert not unfinished(path).exists()


def test_a_link_stays_one(tmp_path: Path) -> None:
    (tmp_path / "disk").mkdir()
    link = tmp_path / "r.mcap"
    link.symlink_to(tmp_path / "disk" / "real.mcap")
    with RecordingWriter(link, INFOS) as writer:
        writer.write(frame(0))
    assert link.is_symlink()
    assert stamps_s(tmp_path / "disk" / "real.mcap") == ALL_S[:1]


@contextmanager
def files_no_larger_than(size: int) -> Iterator[None]:
    """Let the system refuse what goes beyond a size, as a full disk does."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@pytest.mark.parametrize("size", [12_000, 50_000, 123_456])
def test_where_there_is_no_more_room_what_is_stored_becomes_whole(tmp_path: Path, size: int) -> None:
    path = tmp_path / "r.mcap"
    writer = SeriesWriter(path, INFOS)
    stored = 0
    with files_no_larger_than(size):
        told = ""
        try:
            for stored in range(80):
                writer.write(frame(stored), stored * 10**9)
                writer._part.store_all()
        except WorldError as error:
            told = error.code
        assert told == "disk_full"
        writer.finish()
    kept = sum(writer.frames_stored.values())
    assert stored - 1 <= kept <= stored, "the table of contents takes the place of a chunk at most"
    assert path.stat().st_size <= size
    assert stamps_s(path) == ALL_S[:kept]
    with path.open("rb") as file:
        assert make_reader(file, validate_crcs=True).get_summary() is not None


def test_a_disk_that_is_gone_leaves_the_part_and_says_so(tmp_path: Path) -> None:
    writer = RecordingWriter(tmp_path / "r.mcap", INFOS)
    writer.write(frame(0))
    writer.store_all()
    writer._file.raw.close()  # as where the disk was pulled out

    class Gone(io.FileIO):
        def write(self, _data: object) -> int:
            raise OSError(errno.EIO, "Input/output error")

    writer._file.raw = writer._output._file = Gone(unfinished(tmp_path / "r.mcap"), "r+")
    with pytest.raises(WorldError, match="cannot be finished") as caught:
        writer.finish()
    assert "--recover r.mcap.part" in caught.value.remedy
    assert recover(unfinished(tmp_path / "r.mcap"), tmp_path / "saved.mcap").messages == 4


def write_all(path: Path, frames: list[Frame], hands: ThreadPoolExecutor) -> None:
    with RecordingWriter(path, INFOS, hands) as writer:
        for one in frames:
            writer.write(one)


def test_what_cannot_be_packed_is_told(tmp_path: Path) -> None:
    broken = Frame("k1", 0, 1.0, np.zeros((0, 0, 3), np.uint8), NOISE[0], CAMERA)
    with ThreadPoolExecutor(1) as hands, pytest.raises(WorldError, match="cannot be packed"):
        write_all(tmp_path / "r.mcap", [broken], hands)
    assert list(tmp_path.iterdir()) == []


def test_packing_slower_than_frames_come_makes_them_wait_not_pile_up(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from fruitgui.sensors.recordings import writer as module

    monkeypatch.setattr(module, "CHUNK_BYTES", 1)
    go_on, began = threading.Event(), threading.Semaphore(0)
    real = module.pack

    def slow(*what: object) -> Chunk:
        began.release()
        assert go_on.wait(30.0)
        return real(*what)  # type: ignore[arg-type]

    monkeypatch.setattr(module, "pack", slow)
    taken = []

    def write() -> None:
        for number in range(20):
            writer.write(frame(number))
            taken.append(number)

    with ThreadPoolExecutor(1) as hands, RecordingWriter(tmp_path / "r.mcap", INFOS, hands) as writer:
        thread = threading.Thread(target=write)
        thread.start()
        assert began.acquire(timeout=30.0)
        thread.join(0.2)
        assert len(taken) <= module.WAITING_CHUNKS
        go_on.set()
        thread.join(30.0)
        assert len(taken) == 20
    assert stamps_s(tmp_path / "r.mcap") == ALL_S[:20]
