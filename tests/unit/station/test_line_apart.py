"""A line in a process of its own does what one in this process does, and outlives it."""

from __future__ import annotations

import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from multiprocessing.shared_memory import SharedMemory
from pathlib import Path

import pytest

from fruitgui.errors import FruitguiError, InputError, WorldError
from fruitgui.frame import Frame
from fruitgui.sensors.feed import Feed
from fruitgui.sensors.sensor import EndOfStreamError, Sensor, SensorTimeoutError
from fruitgui.station.live import FLAT_OUT, LIVE, Counting, Finished, Intake, LineApart, LiveLine, Phase
from fruitgui.station.live.apart.gallery import Gallery
from fruitgui.station.live.apart.messages import Start
from fruitgui.station.live.apart.process import LineProcess
from fruitgui.station.live.apart.processes import Processes
from fruitgui.station.waiting import BufferedSink
from tests.unit.sensors.scripted import gone, until
from tests.unit.station.memory_sink import MemorySink
from tests.unit.station.test_live_line import (
    ALL_IN_VIEW,
    Small,
    Steady,
    failing_once_it_is_due,
    passing,
    station,
)

pytestmark = pytest.mark.usefixtures("no_leaked_threads")

LONG_S = 90.0


def line_of(*sensors: Sensor, lot: int | None = 1, intake: Intake = FLAT_OUT) -> tuple[LineApart, Feed, MemorySink]:
    feed, sink = Feed(sensors), MemorySink()
    names = [sensor.info.sensor for sensor in sensors]
    return LineApart(feed, station(*names), None, Counting(BufferedSink(sink)), lot, intake), feed, sink


@contextmanager
def running(line: LineApart, feed: Feed) -> Iterator[None]:
    line.start()
    feed.start()
    try:
        yield
    finally:
        line.stop()
        assert feed.stop() == ()


def kill(line: LineApart) -> None:
    """Kill a line's process, as a machine without memory does."""
    assert line.pid is not None
    os.kill(line.pid, signal.SIGKILL)


def beside(frames: list[Frame]) -> MemorySink:
    """Return what a line in this process makes of frames."""
    left = Small("left", frames)
    left.end()
    feed, sink = Feed([left]), MemorySink()
    line = LiveLine(feed, station("left"), None, Counting(BufferedSink(sink)), 1, FLAT_OUT)
    line.start()
    feed.start()
    assert line.wait(LONG_S)
    assert line.stop()
    assert feed.stop() == ()
    return sink


def test_constructing_starts_nothing() -> None:
    line, _, _ = line_of(Small("left"))
    assert line.pid is None
    assert line.state.phase is Phase.STOPPED
    assert line.stop()


def test_it_counts_what_a_line_in_this_process_counts_and_shows_it() -> None:
    frames = passing("left")
    left = Small("left", frames[:ALL_IN_VIEW])
    line, feed, sink = line_of(left)
    with running(line, feed):
        until(lambda: line.state.frames == ALL_IN_VIEW and len(line.state.tracks) == 3, LONG_S)
        until(lambda: any(len(one.outline_px) > 10 for one in line.previews["left"].fruit), LONG_S)
        shown = line.previews["left"]
        (frame,) = (one for one in frames if one.sequence == shown.sequence)
        assert shown.color is not frame.color or shown.color.shape == (240, 320, 3)
        assert (shown.color == frame.color).all(), "the picture is the one that its outlines belong to"
        left.give(*frames[ALL_IN_VIEW:])
        left.end()
        assert line.wait(LONG_S)
        state = line.state
        assert (state.phase, state.lot, state.frames) == (Phase.ENDED, 1, len(frames))
        assert state.counted == len(sink.kept) == 3
        assert [counted.number for counted, _ in state.last] == [3, 2, 1]
        assert [one.sensor for one in state.health] == ["left"]
        assert state.warnings == ()
    same = beside(frames)
    assert [one.fruit.volume_m3 for one, _ in sink.kept] == [one.fruit.volume_m3 for one, _ in same.kept]
    assert [[crop.data for crop in crops] for _, crops in sink.kept] == [
        [crop.data for crop in crops] for _, crops in same.kept
    ]


def test_stopping_counts_what_is_in_view_and_gives_everything_back() -> None:
    line, feed, sink = line_of(Small("left", passing("left")[:ALL_IN_VIEW]))
    line.start()
    feed.start()
    until(lambda: line.state.frames == ALL_IN_VIEW, LONG_S)
    assert line._processes._between is not None
    memory = line._processes._between.memory
    assert sink.kept == []
    assert line.stop()
    assert line.stop(), "again does nothing"
    assert feed.stop() == ()
    assert len(sink.kept) == 3
    assert line.state.phase is Phase.STOPPED
    with pytest.raises(FileNotFoundError):
        SharedMemory(memory.name)


def test_frames_that_have_not_the_size_they_say_are_skipped_and_said() -> None:
    frames = passing("left")
    for number in (10, 12, 14, 16, 18):  # more than there are places
        wrong = frames[number]
        frames[number] = replace(wrong, color=wrong.color[:100], depth_mm=wrong.depth_mm[:100])
    left = Small("left", frames)
    left.end()
    line, feed, sink = line_of(left)
    with running(line, feed):
        assert line.wait(LONG_S)
        state = line.state
        assert (state.skipped, state.frames) == (5, len(frames) - 5)
        assert [(one.code, one.sensors, one.count) for one in state.warnings] == [("frame_skipped", ("left",), 5)]
    assert len(sink.kept) == 3


def test_a_process_that_ends_before_there_is_a_line_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    begin = LineProcess.begin

    def die(process: LineProcess, start: Start) -> None:
        begin(process, start)
        os.kill(process.pid or 0, signal.SIGKILL)

    monkeypatch.setattr(LineProcess, "begin", die)
    line, _, _ = line_of(Small("left"))
    with pytest.raises(WorldError) as told:
        line.start()
    assert told.value.code == "line_not_started"


def test_fruit_pass_uncounted_in_a_pause_and_are_taught_all_the_same() -> None:
    left, told = Small("left", passing("left")), list[Finished]()
    feed, sink = Feed([left]), MemorySink()
    line = LineApart(feed, station("left"), None, Counting(BufferedSink(sink), told.append), 1, FLAT_OUT)
    line.count_into(None)
    with running(line, feed):
        left.end()
        assert line.wait(LONG_S)
        assert (line.state.counted, line.state.passed) == (0, 3)
    assert [one.sensors for one in told] == [("left",)] * 3


def test_a_line_that_is_killed_is_begun_again_and_said() -> None:
    first, second = passing("left"), passing("left", first_s=60.0)
    left = Small("left", first)
    line, feed, sink = line_of(left)
    with running(line, feed):
        until(lambda: line.state.counted >= 1, LONG_S)
        before = len(sink.kept)
        kill(line)
        until(lambda: "line_begun_again" in {one.code for one in line.state.warnings}, LONG_S)
        left.give(*second)
        left.end()
        assert line.wait(LONG_S)
        assert line.state.phase is Phase.ENDED
    assert before + 3 <= len(sink.kept) <= 6, "what was counted stays so, and what comes is counted"
    assert [one.fruit.fruit for one, _ in sink.kept] == [*range(1, len(sink.kept) + 1)], "no number comes twice"


def test_a_line_that_hangs_is_ended_begun_again_and_said() -> None:
    left = Small("left", passing("left")[:ALL_IN_VIEW])
    line, feed, sink = line_of(left)
    with running(line, feed):
        until(lambda: line.state.frames == ALL_IN_VIEW, LONG_S)
        assert line.pid is not None
        os.kill(line.pid, signal.SIGSTOP)
        until(lambda: line.state.warnings != (), LONG_S)
        (said,) = line.state.warnings
        assert said.code == "line_begun_again"
        assert "did not answer" in said.text
        left.give(*passing("left", first_s=60.0))
        left.end()
        assert line.wait(LONG_S)
        assert line.state.phase is Phase.ENDED
    assert len(sink.kept) == 3


def test_a_line_that_ended_by_what_nobody_foresaw_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    failed: list[BaseException | None] = []
    monkeypatch.setattr(threading, "excepthook", lambda told: failed.append(told.exc_value))
    monkeypatch.setattr(Gallery, "show", failing_once_it_is_due(lambda *_: True, Gallery.show))
    line, feed, _ = line_of(Steady("left"), intake=LIVE)
    with running(line, feed):
        until(lambda: line.state.phase is Phase.ENDED, LONG_S)
        assert [one.code for one in line.state.warnings] == ["line_lost"]
    assert [type(error) for error in failed] == [ValueError]


def test_a_line_is_stopped_while_it_is_begun_again(monkeypatch: pytest.MonkeyPatch) -> None:
    begin, beginning, stopping = LineProcess.begin, threading.Event(), threading.Event()
    line, feed, _ = line_of(Small("left", passing("left")[:ALL_IN_VIEW]))
    with running(line, feed):
        until(lambda: line.state.frames == ALL_IN_VIEW, LONG_S)

        def begin_late(process: LineProcess, start: Start) -> None:
            beginning.set()
            assert stopping.wait(LONG_S)
            begin(process, start)

        monkeypatch.setattr(LineProcess, "begin", begin_late)
        kill(line)
        assert beginning.wait(LONG_S)
        killed, told = line.pid, Processes.stop

        def tell(processes: Processes, until_s: float, lot: int | None) -> None:
            told(processes, until_s, lot)
            stopping.set()

        monkeypatch.setattr(Processes, "stop", tell)
        assert line.stop(LONG_S), "the process that was on its way is told to stop once it is there"
        assert line.state.phase is Phase.STOPPED
        assert line.pid not in (None, killed)
    assert multiprocessing.active_children() == []


def test_a_line_that_is_killed_again_and_again_says_that_nothing_is_counted() -> None:
    line, feed, _ = line_of(Steady("left"), intake=LIVE)
    with running(line, feed):
        for _ in range(4):
            pid = line.pid
            until(lambda: line.state.frames > 0, LONG_S)
            kill(line)
            until(lambda pid=pid: line.pid != pid or line.state.phase is Phase.ENDED, LONG_S)  # type: ignore[misc]
        until(lambda: line.state.phase is Phase.ENDED, LONG_S)
        assert {"line_begun_again", "line_lost"} == {one.code for one in line.state.warnings}


def test_a_line_that_stands_still_is_left_when_its_time_is_over() -> None:
    line, feed, _ = line_of(Small("left", passing("left")[:ALL_IN_VIEW]))
    line.start()
    feed.start()
    until(lambda: line.state.frames == ALL_IN_VIEW, LONG_S)
    assert line.pid is not None
    os.kill(line.pid, signal.SIGSTOP)
    began_s = time.monotonic()
    assert not line.stop(0.5)
    assert time.monotonic() - began_s < 30.0
    assert feed.stop() == ()
    assert line.state.phase is Phase.STOPPED


def test_sensors_that_the_station_lacks_are_said_at_once() -> None:
    with pytest.raises(InputError):
        LineApart(Feed([Small("other")]), station("left"), None, Counting(BufferedSink(MemorySink())))


ORPHAN = """
import os, sys
from tests.unit.station.test_line_apart import line_of, until
from tests.unit.station.test_live_line import Steady
from fruitgui.station.live import LIVE

if __name__ == "__main__":
    line, feed, _ = line_of(Steady("left"), intake=LIVE)
    line.start()
    feed.start()
    until(lambda: line.state.frames > 0, 90.0)
    print(line.pid, flush=True)
    sys.stdin.read()
"""


def test_no_process_outlives_one_that_is_killed(tmp_path: Path) -> None:
    script = tmp_path / "orphan.py"
    script.write_text(ORPHAN)
    root = Path(__file__).parents[3]
    with subprocess.Popen(
        [sys.executable, script],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        env=os.environ | {"PYTHONPATH": str(root)},
    ) as owner:
        assert owner.stdout is not None
        pid = int(owner.stdout.readline())
        owner.kill()
    until(lambda: not _lives(pid), LONG_S)


def _lives(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] not in ("Z", "X")
    except FileNotFoundError:
        return False


@pytest.mark.parametrize("error", [SensorTimeoutError("left", 2.0), EndOfStreamError("left"), gone("left")])
def test_an_error_is_the_same_in_another_process(error: FruitguiError) -> None:
    import pickle

    again = pickle.loads(pickle.dumps(error))  # noqa: S301 - from this line
    assert type(again) is type(error)
    assert (again.code, again.what, again.remedy, again.values) == (error.code, error.what, error.remedy, error.values)
    assert str(again) == str(error)
