"""Recording as a person does it: from a terminal, with sensors, until something ends it."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from fruitgui.cli.program import main
from fruitgui.sensors.recordings import open_recording, parts_after
from tests.journeys.plugged_in import NAMES, number_of

PATIENCE_S = 60.0


@contextmanager
def recording(*arguments: object, rate: float = 10.0, frames: int = 10**9) -> Iterator[subprocess.Popen[str]]:
    """Let `fruitgui record` run, with sensors; it is gone afterwards."""
    command = [sys.executable, "-m", "tests.journeys.plugged_in", "--rate", str(rate), "--frames", str(frames), "--"]
    process = subprocess.Popen(
        [*command, "record", *map(str, arguments)],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env={**os.environ, "XDG_DATA_HOME": "/nonexistent"},
    )  # fmt: skip
    try:
        yield process
    finally:
        process.kill()
        process.communicate()


def grown(path: Path, size: int) -> Callable[[], bool]:
    return lambda: path.exists() and path.stat().st_size >= size


def wait(true: Callable[[], bool], process: subprocess.Popen[str]) -> None:
    until_s = time.monotonic() + PATIENCE_S
    while not true():
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < until_s
        time.sleep(0.02)


def numbers(*paths: Path) -> dict[str, list[int]]:
    told: dict[str, list[int]] = {name: [] for name in NAMES}
    for path in paths:
        for _, frame in open_recording(path).frames():
            told[frame.sensor].append(number_of(frame))
    return told


def without_a_gap(told: dict[str, list[int]]) -> bool:
    return all(one == list(range(len(one))) and one for one in told.values())


@pytest.mark.parametrize(
    ("how", "wanted", "code"),
    [(signal.SIGINT, (), 0), (signal.SIGINT, ("--seconds", 600), 130), (signal.SIGTERM, (), 0), (signal.SIGHUP, (), 0)],
)
def test_ctrl_c_ends_it_and_the_file_is_whole(
    tmp_path: Path, how: signal.Signals, wanted: tuple[object, ...], code: int
) -> None:
    path = tmp_path / "r.mcap"
    with recording("--out", path, "--json", *wanted) as process:
        wait(grown(tmp_path / "r.mcap.part", 3_000_000), process)
        process.send_signal(how)
        out, err = process.communicate(timeout=PATIENCE_S)
    assert (process.returncode, err) == (code, "")
    told = json.loads(out)
    assert told["ended"] == "stopped"
    assert told["lost"] == {}
    assert {name: len(one) for name, one in numbers(path).items()} == told["frames"]
    assert without_a_gap(numbers(path))
    assert list(tmp_path.iterdir()) == [path]


def test_it_lasts_as_long_as_was_asked(tmp_path: Path) -> None:
    path = tmp_path / "r.mcap"
    with recording("--out", path, "--json", "--seconds", 1, rate=10.0) as process:
        out, _ = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 0
    told = json.loads(out)
    assert told["ended"] == "done"
    assert 0.0 < told["seconds"] < 1.0
    assert without_a_gap(numbers(path))


def test_killed_it_leaves_what_can_be_recovered_up_to_the_last_second(tmp_path: Path) -> None:
    path, part = tmp_path / "r.mcap", tmp_path / "r.mcap.part"
    with recording("--out", path) as process:
        wait(grown(part, 5_000_000), process)
        process.kill()
        process.wait(PATIENCE_S)
    assert list(tmp_path.iterdir()) == [part]
    size = part.stat().st_size
    assert main(["record", "--out", str(path)]) == 2, "what can be saved is not written over"
    assert part.stat().st_size == size
    assert main(["record", "--recover", str(part), "--out", str(path)]) == 0
    assert without_a_gap(numbers(path))
    assert open_recording(path).sensors["kinect_2"].serial == "A0-kinect_2"
    assert not open_recording(path).warnings


def test_frames_reach_the_disk_within_a_second_however_slow_they_come(tmp_path: Path) -> None:
    part = tmp_path / "r.mcap.part"
    with recording("--out", tmp_path / "r.mcap", rate=2.0) as process:
        wait(grown(part, 100_000), process)
        began_s, size = time.monotonic(), part.stat().st_size
        wait(lambda: part.stat().st_size > size, process)
        process.kill()
    assert time.monotonic() - began_s < 20.0
    assert main(["record", "--recover", str(part), "--out", str(tmp_path / "saved.mcap")]) == 0
    assert without_a_gap(numbers(tmp_path / "saved.mcap"))


def test_a_disk_of_few_megabytes_ends_it_and_everything_is_readable(tmp_path: Path) -> None:
    disk = tmp_path / "disk"
    disk.mkdir()
    if os.geteuid() != 0 or subprocess.call(["mount", "-t", "tmpfs", "-o", "size=24m", "tmpfs", disk]):
        pytest.skip("a small disk cannot be made here")
    try:
        with recording("--out", disk / "r.mcap", "--keep-free-mb", 0, "--json") as process:
            out, err = process.communicate(timeout=PATIENCE_S)
        assert process.returncode == 0, err
        told = json.loads(out)
        assert told["ended"] == "disk_full"
        assert "nearly full" in err
        assert list(disk.iterdir()) == [disk / "r.mcap"]
        assert {name: len(one) for name, one in numbers(disk / "r.mcap").items()} == told["frames"]
        assert sum(told["frames"].values()) > 4
    finally:
        subprocess.check_call(["umount", disk])


def test_it_ends_while_the_reserve_is_left(tmp_path: Path) -> None:
    keep_mb = shutil.disk_usage(tmp_path).free // 10**6 + 10**6
    with recording("--out", tmp_path / "r.mcap", "--keep-free-mb", keep_mb, "--json") as process:
        out, _ = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 1
    assert json.loads(out)["error"]["code"] == "disk_full"
    assert list(tmp_path.iterdir()) == []


def test_parts_from_a_terminal(tmp_path: Path) -> None:
    path = tmp_path / "r.mcap"
    arguments = ("--out", path, "--split-seconds", 5, "--split-mb", 50, "--sensors", "kinect_2", "--json")
    with recording(*arguments, rate=10.0, frames=120) as process:
        out, _ = process.communicate(timeout=PATIENCE_S)
    told = json.loads(out)
    assert process.returncode == 0
    assert told["ended"] == "sensors_ended"
    assert [Path(part) for part in told["parts"]] == [path, *parts_after(path)]
    assert len(told["parts"]) >= 3
    assert numbers(path, *parts_after(path)) == {"kinect_1": [], "kinect_2": list(range(120))}


def test_the_names_are_those_of_the_station(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with recording("--out", tmp_path / "r.mcap", "--sensors", "left") as process:
        _, err = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 2
    assert "there are kinect_1, kinect_2" in err
    assert capsys.readouterr().out == ""


def test_with_nothing_connected_it_says_that_it_is_simulated(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    assert main(["record", "--out", str(tmp_path / "a.mcap"), "--seconds", "1"]) == 0
    assert "No sensor is connected: this records the simulated rig" in capsys.readouterr().err
    assert main(["record", "--out", str(tmp_path / "b.mcap"), "--seconds", "1", "--simulated"]) == 0
    assert capsys.readouterr().err == ""


def test_recording_loads_neither_open3d_nor_qt(tmp_path: Path) -> None:
    code = (
        "import sys; from tests.journeys.plugged_in import plugged_in;"
        f"plugged_in(['--frames', '3', '--', 'record', '--out', {str(tmp_path / 'r.mcap')!r}]);"
        "print([name for name in ('open3d', 'PySide6', 'sklearn', 'pyrealsense2', 'depthai') if name in sys.modules])"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], check=True, capture_output=True, text=True, timeout=PATIENCE_S,
        env={**os.environ, "XDG_DATA_HOME": str(tmp_path)},
    )  # fmt: skip
    assert done.stdout.splitlines()[-1] == "[]"
