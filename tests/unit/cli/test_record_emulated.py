"""`fruitgui record` with the real libfreenect on Kinects of an emulated USB bus: from the plug to the file."""

from __future__ import annotations

import json
import signal
import time
from collections.abc import Callable
from pathlib import Path

from fruitgui.errors import InputError
from fruitgui.sensors.recordings import open_recording
from tests.emulated_usb.emulation import MODEL_1473
from tests.emulated_usb.outside import Command, run_command

PATIENCE_S = 120.0


def wait(true: Callable[[], bool], command: Command) -> None:
    end_s = time.monotonic() + PATIENCE_S
    while not true():
        assert command.process.poll() is None, command.end()
        assert time.monotonic() < end_s
        time.sleep(0.02)


def grown(path: Path, size: int) -> Callable[[], bool]:
    return lambda: path.exists() and path.stat().st_size >= size


def seen(path: Path) -> set[str]:
    """Return whose frames are in a recording that is being made."""
    try:
        return {frame.sensor for _, frame in open_recording(path).frames()}
    except InputError:
        return set()


def test_kinects_are_recorded_as_who_they_are(tmp_path: Path) -> None:
    path = tmp_path / "r.mcap"
    kinects = [{"serial": "A1", "bus": 1}, {"serial": "B2", "bus": 2, "model": MODEL_1473}]
    command = Command({"kinects": kinects}, "record", "--out", str(path), "--json")
    wait(lambda: seen(tmp_path / "r.mcap.part") == {"kinect_1", "kinect_2"}, command)
    command.process.send_signal(signal.SIGINT)
    done = command.end()
    assert done.returncode == 0, done.stderr
    told = json.loads(done.stdout)
    assert told["lost"] == {}
    recording = open_recording(path)
    assert [(one.make, one.model, one.serial) for one in recording.sensors.values()] == [
        ("Microsoft", "Kinect 1414", "A1"), ("Microsoft", "Kinect 1473", "B2")
    ]  # fmt: skip
    frames = [frame for _, frame in recording.frames()]
    assert len(frames) == sum(told["frames"].values())
    for name in recording.sensors:
        times_s = [frame.time_s for frame in frames if frame.sensor == name]
        assert times_s == sorted(times_s)
    assert all(frame.depth_mm.shape == (480, 640) and frame.depth_mm.any() for frame in frames)


def test_it_lasts_as_long_as_was_asked(tmp_path: Path) -> None:
    path = tmp_path / "r.mcap"
    done = run_command({"kinects": [{"serial": "A1"}]}, "record", "--out", str(path), "--seconds", "2", "--json")
    assert done.returncode == 0, done.stderr
    told = json.loads(done.stdout)
    assert told["ended"] == "done"
    assert told["seconds"] < 2.0
    assert sum(1 for _ in open_recording(path).frames()) == told["frames"]["kinect_1"] > 0


def test_one_that_is_unplugged_is_said_and_the_other_goes_on_until_ctrl_c(tmp_path: Path) -> None:
    part = tmp_path / "r.mcap.part"
    kinects = [{"serial": "A1", "bus": 1}, {"serial": "B2", "bus": 2}]
    command = Command({"kinects": kinects}, "record", "--out", str(tmp_path / "r.mcap"), "--json")
    wait(grown(part, 400_000), command)
    command.happen("unplug", 1)
    size = part.stat().st_size
    wait(grown(part, size + 1_000_000), command)
    command.process.send_signal(signal.SIGINT)
    done = command.end()
    assert done.returncode == 0, done.stderr
    assert "kinect_2 gives no frames" in done.stderr
    told = json.loads(done.stdout)
    assert told["ended"] == "stopped"
    assert any(warning.startswith("kinect_2 gave no frames from") for warning in told["warnings"])
    assert told["frames"]["kinect_1"] > 0
    assert list(tmp_path.iterdir()) == [tmp_path / "r.mcap"]
    assert sum(1 for _ in open_recording(tmp_path / "r.mcap").frames()) == sum(told["frames"].values())
