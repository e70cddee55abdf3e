"""`fruitgui record` with the real libfreenect on Kinects of an emulated USB bus: from the plug to the file."""

from __future__ import annotations

import json
import signal
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from itertools import pairwise
from pathlib import Path
from typing import Any

from fruitgui.sensors.recordings import open_recording
from tests.emulated_usb.emulation import MODEL_1473
from tests.emulated_usb.outside import Command, alone, run_command

pytestmark = alone

PATIENCE_S = 240.0


@contextmanager
def recording(path: Path, *kinects: dict[str, object]) -> Iterator[Command]:
    """Let `fruitgui record` run among Kinects; it is gone afterwards."""
    command = Command({"kinects": list(kinects)}, "record", "--out", str(path), "--json")
    try:
        yield command
    finally:
        if command.process.returncode is None:
            command.process.kill()
            command.end()


def ended(command: Command) -> tuple[dict[str, Any], str]:
    """End it by Ctrl-C; return what it told, and what it warned of."""
    command.process.send_signal(signal.SIGINT)
    done = command.end()
    assert done.returncode == 0, done.stderr
    told: dict[str, Any] = json.loads(done.stdout)
    return told, done.stderr


def wait(true: Callable[[], bool], command: Command) -> None:
    end_s = time.monotonic() + PATIENCE_S
    while not true():
        assert command.process.poll() is None, command.end().stderr
        assert time.monotonic() < end_s
        time.sleep(0.1)


def grown(path: Path, size: int) -> Callable[[], bool]:
    return lambda: path.exists() and path.stat().st_size >= size


def test_a_kinect_is_recorded_as_who_it_is_for_as_long_as_was_asked(tmp_path: Path) -> None:
    path = tmp_path / "r.mcap"
    kinects = [{"serial": "B2", "model": MODEL_1473}]
    done = run_command({"kinects": kinects}, "record", "--out", str(path), "--seconds", "2", "--json")
    assert done.returncode == 0, done.stderr
    told = json.loads(done.stdout)
    assert told["ended"] == "done"
    assert told["lost"] == {}
    assert told["seconds"] < 2.0
    made = open_recording(path)
    assert [(one.make, one.model, one.serial) for one in made.sensors.values()] == [("Microsoft", "Kinect 1473", "B2")]
    frames = [frame for _, frame in made.frames()]
    assert len(frames) == told["frames"]["kinect_1"] > 0
    times_s = [frame.time_s for frame in frames]
    assert times_s == sorted(times_s)
    assert all(frame.depth_mm.shape == (480, 640) and frame.depth_mm.any() for frame in frames)


def test_two_that_take_turns_are_both_recorded_and_nothing_of_them_is_lost(tmp_path: Path) -> None:
    path = tmp_path / "r.mcap"
    kinects = [{"serial": "A1", "bus": 1}, {"serial": "B2", "bus": 2}]
    done = run_command({"kinects": kinects}, "record", "--out", str(path), "--seconds", "6", "--json")
    assert done.returncode == 0, done.stderr
    told = json.loads(done.stdout)
    assert told["lost"] == {}
    fewer, more = sorted(told["frames"].values())
    # One in two turns each, three frames a turn, on a computer that may have no time for either.
    assert fewer >= 6
    assert more <= 2 * fewer + 6
    times_s: dict[str, list[float]] = {"kinect_1": [], "kinect_2": []}
    for _, frame in open_recording(path).frames():
        times_s[frame.sensor].append(frame.time_s)
        assert frame.depth_mm.any(), "no frame is of the dark"
    assert {sensor: len(own) for sensor, own in times_s.items()} == told["frames"]
    order = sorted((time_s, sensor) for sensor, own in times_s.items() for time_s in own)
    assert sum(before[1] != now[1] for before, now in pairwise(order)) >= 4, "they take turns"


def test_one_that_is_unplugged_is_said_and_the_other_goes_on_until_ctrl_c(tmp_path: Path) -> None:
    part = tmp_path / "r.mcap.part"
    with recording(tmp_path / "r.mcap", {"serial": "A1", "bus": 1}, {"serial": "B2", "bus": 2}) as command:
        wait(grown(part, 100_000), command)
        command.happen("unplug", 1)
        size = part.stat().st_size
        wait(grown(part, size + 300_000), command)
        told, warned = ended(command)
    assert "kinect_2 gives no frames" in warned
    assert told["ended"] == "stopped"
    assert any(warning.startswith("kinect_2 gave no frames from") for warning in told["warnings"])
    assert told["frames"]["kinect_1"] > 0
    assert list(tmp_path.iterdir()) == [tmp_path / "r.mcap"]
    assert sum(1 for _ in open_recording(tmp_path / "r.mcap").frames()) == sum(told["frames"].values())
