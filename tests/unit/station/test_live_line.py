"""The line on live sensors: faults are said and the line goes on; nothing is counted before it is kept."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from fruitgui.frame import Frame, Intrinsics
from fruitgui.geometry.pose import Pose
from fruitgui.sensors.depth_correction import DepthCorrection
from fruitgui.sensors.feed import Feed, Running
from fruitgui.sensors.named import NamedSensor
from fruitgui.sensors.sensor import Sensor
from fruitgui.station.live import FLAT_OUT, LIVE, Finished, Intake, LiveLine, Phase, first_look, showing
from fruitgui.station.live.counting import Counting
from fruitgui.station.live.following import Following
from fruitgui.station.live.opinions import Opinions
from fruitgui.station.live.sensor_watch import SensorWatch
from fruitgui.station.live.showing import Showing
from fruitgui.station.station import Station, StationSensor
from fruitgui.station.waiting import BufferedSink
from tests.unit.perception.spheres import Ball, Table
from tests.unit.sensors.scripted import ScriptedSensor, gone, until
from tests.unit.station.memory_sink import MemorySink

pytestmark = pytest.mark.usefixtures("no_leaked_threads")

SMALL = Intrinsics(320, 240, 262.5, 262.5, 159.5, 119.5)
SURFACE = Table((), tilt_rad=0.0, intrinsics=SMALL).surface()
SPEED_M_S, STEP_S = 0.24, 0.2
ALL_IN_VIEW = 28
"""Frames of three balls that pass until all of them are in view."""
BALLS = ((0.035, (200, 60, 40)), (0.028, (60, 170, 50)), (0.04, (210, 180, 50)))


def passing(sensor: str, balls: int = 3, first_s: float = 0.0) -> list[Frame]:
    """Return frames of a row of balls that comes in on one side and leaves on the other."""
    return carried(sensor, [0.24 * n for n in range(balls)], first_s)


def carried(sensor: str, behind_m: list[float], first_s: float = 0.0) -> list[Frame]:
    """Return frames of balls that lie so far behind the first one and are carried from one side to the other."""
    steps = round((1.84 + behind_m[-1]) / (SPEED_M_S * STEP_S))
    frames = []
    for number in range(steps):
        front_m = -0.8 + number * STEP_S * SPEED_M_S
        row = tuple(
            Ball(front_m - way_m, 0.0, *BALLS[n % 3]) for n, way_m in enumerate(behind_m) if abs(front_m - way_m) < 0.8
        )
        frame = Table(row, tilt_rad=0.0, intrinsics=SMALL, seed=number).frame()
        frames.append(replace(frame, sensor=sensor, sequence=number, time_s=first_s + STEP_S * number))
    return frames


class Small(ScriptedSensor):
    """A scripted sensor with the small camera."""

    @property
    def info(self):  # type: ignore[no-untyped-def]  # noqa: ANN201
        return replace(super().info, intrinsics=SMALL, rate_hz=5.0)


class Steady(Small):
    """Shows a bare belt, ten times a second, unless its plug is pulled."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self._frame = replace(Table((), tilt_rad=0.0, intrinsics=SMALL).frame(), sensor=name)
        self._count = 0
        self.unplugged = threading.Event()

    def open(self) -> None:
        if self.unplugged.is_set():
            raise gone(self.info.sensor)

    def read(self, timeout_s: float) -> Frame:  # noqa: ARG002 - it never is late
        self.unplugged.wait(0.1)
        self.open()
        self._count += 1
        return replace(self._frame, sequence=self._count, time_s=0.1 * self._count)


def station(*names: str, correction: DepthCorrection | None = None) -> Station:
    sensors = {name: StationSensor(f"S-{name}", Pose.exact(), SURFACE, depth_correction=correction) for name in names}
    return Station(names[0], sensors, np.array([-SPEED_M_S, 0.0, 0.0]))


@contextmanager
def running(line: LiveLine, feed: Feed) -> Iterator[None]:
    line.start()
    feed.start()
    try:
        yield
    finally:
        assert line.stop()
        assert feed.stop() == ()


def line_of(*sensors: Sensor, lot: int | None = 1, intake: Intake = FLAT_OUT) -> tuple[LiveLine, Feed, MemorySink]:
    feed, sink = Feed(sensors), MemorySink()
    names = [sensor.info.sensor for sensor in sensors]
    return LiveLine(feed, station(*names), None, Counting(BufferedSink(sink)), lot, intake), feed, sink


def balls_in(line: LiveLine) -> set[int]:
    """Return the tracks that look from above like the balls that they are, with a trail behind them."""
    return {
        one.track
        for one in line.state.tracks
        if len(one.footprint_m)
        and len(one.trail_m) > 1
        and (np.abs(np.ptp(one.footprint_m, axis=0) - 0.07) < 0.03).all()
    }


def test_constructing_starts_nothing() -> None:
    before = threading.active_count()
    line, _, _ = line_of(Small("left"))
    assert threading.active_count() == before
    assert line.state.phase is Phase.STOPPED
    assert line.stop()


def test_what_passes_is_counted_once_it_is_kept_and_drawn_while_in_view(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(showing, "SHOWN_HZ", 1e6)  # the last frame is drawn, however quick it follows the one before
    frames = passing("left")
    left = Small("left", frames[:ALL_IN_VIEW])
    line, feed, sink = line_of(left)
    with running(line, feed):
        until(lambda: len(balls_in(line)) == 3, 60.0)
        preview = line.previews["left"]
        assert preview.color.shape == (240, 320, 3)
        assert any(len(one.outline_px) > 10 for one in preview.fruit)
        left.give(*frames[ALL_IN_VIEW:])
        left.end()
        assert line.wait(60.0)
        assert line.state.phase is Phase.ENDED
        assert line.state.counted == len(sink.kept) == 3
        assert line.state.frames == len(frames)
        assert [one.fruit.fruit for one, _ in sink.kept] == [1, 2, 3]
        assert [counted.number for counted, _ in line.state.last] == [3, 2, 1]
        assert line.state.warnings == ()


def test_stopping_counts_what_is_in_view() -> None:
    line, feed, sink = line_of(Small("left", passing("left")[:ALL_IN_VIEW]))
    with running(line, feed):
        until(lambda: line.state.frames == 28, 60.0)
        assert sink.kept == []
    assert len(sink.kept) == 3
    assert line.state.phase is Phase.STOPPED


def test_a_frame_that_cannot_be_used_is_said_and_skipped() -> None:
    frames = passing("left")
    wrong = replace(frames[10], color=frames[10].color[:100], depth_mm=frames[10].depth_mm[:100])
    left = Small("left", [*frames[:10], wrong, *frames[11:]])
    left.end()
    line, feed, sink = line_of(left)
    with running(line, feed):
        assert line.wait(60.0)
        state = line.state
        assert (state.skipped, state.frames) == (1, len(frames) - 1)
        assert [(one.code, one.sensors) for one in state.warnings] == [("frame_skipped", ("left",))]
        assert len(sink.kept) == 3


def failing_once_it_is_due(when: Callable[..., bool], part: Callable[..., Any]) -> Callable[..., Any]:
    """Return a part of the line that raises instead of working, whenever it is due."""

    def works_or_fails(*given: Any, **named: Any) -> Any:  # noqa: ANN401
        if when(*given):
            raise ValueError("a part that fails")
        return part(*given, **named)

    return works_or_fails


@pytest.mark.parametrize(
    ("room", "name", "said"),
    [
        (Showing, "show", "not_drawn"),
        (Following, "see_off", "not_drawn"),
        (Following, "preview", "not_drawn"),
        (Following, "tracks_now", "not_drawn"),
        (SensorWatch, "look", "not_watched"),
        (Counting, "retry", "fruit_not_counted"),
    ],
)
def test_a_part_that_fails_is_said_and_nothing_stands_still(
    monkeypatch: pytest.MonkeyPatch, room: type, name: str, said: str
) -> None:
    monkeypatch.setattr(room, name, failing_once_it_is_due(lambda *_: True, getattr(room, name)))
    frames = passing("left")
    left = Small("left", frames)
    left.end()
    line, feed, sink = line_of(left)
    with running(line, feed):
        assert line.wait(60.0)
        state = line.state
        assert (state.phase, state.frames, state.skipped) == (Phase.ENDED, len(frames), 0)
        assert {one.code for one in state.warnings} == {said}
    assert len(sink.kept) == 3


def test_fruit_that_left_with_a_frame_that_failed_are_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    failed = list[int]()

    def at_leaving(*_: object) -> bool:
        if following := [one for one in at_work if one._left]:
            failed.append(len(following[0]._left))
        return bool(following)

    at_work = list[Following]()
    begin = Following.__init__

    def noted(following: Following, *given: Any) -> None:  # noqa: ANN401
        begin(following, *given)
        at_work.append(following)

    monkeypatch.setattr(Following, "__init__", noted)
    monkeypatch.setattr(Opinions, "form", failing_once_it_is_due(at_leaving, Opinions.form))
    frames = passing("left")
    left = Small("left", frames)
    left.end()
    line, feed, sink = line_of(left)
    with running(line, feed):
        assert line.wait(60.0)
        assert line.state.skipped == len(failed) > 0
        assert {one.code for one in line.state.warnings} == {"frame_skipped"}
    assert len(sink.kept) == 3


def test_fruit_that_waited_for_clocks_that_could_not_be_judged_are_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> dict[str, float]:
        raise ValueError("clocks that cannot be judged")

    monkeypatch.setattr(first_look, "decided_offsets_s", fail)
    sensors = tuple(Small(name, passing(name)) for name in ("left", "right"))
    for sensor in sensors:
        sensor.end()
    line, feed, sink = line_of(*sensors)
    with running(line, feed):
        assert line.wait(60.0)
        assert {one.code for one in line.state.warnings} <= {"frame_skipped", "fruit_not_counted"}
        assert line.state.warnings
    assert len(sink.kept) == 3


def test_while_the_disk_is_full_nothing_is_counted_and_then_everything_is() -> None:
    left = Small("left", passing("left"))
    line, feed, sink = line_of(left)
    sink.full.set()
    with running(line, feed):
        until(lambda: line.state.sink.waiting == 2, 60.0)
        assert line.state.counted == 0
        assert "not_kept" in {one.code for one in line.state.warnings}
        sink.full.clear()
        until(lambda: line.state.counted >= 2, 20.0)
    assert line.state.counted == len(sink.kept) == 3


def test_between_lots_fruit_pass_uncounted_and_are_taught_all_the_same() -> None:
    left, told = Small("left", passing("left")), list[Finished]()
    feed, sink = Feed([left]), MemorySink()
    line = LiveLine(feed, station("left"), None, Counting(BufferedSink(sink), told.append), None, FLAT_OUT)
    with running(line, feed):
        left.end()
        assert line.wait(60.0)
        assert (line.state.counted, line.state.passed) == (0, 3)
    assert len(told) == 3
    assert all(one.crops and one.evidence.views >= 3 and one.sensors == ("left",) for one in told)


def test_a_helper_that_dies_is_done_without() -> None:
    frames = passing("left")
    left = Small("left", frames[:20])
    line, feed, sink = line_of(left)
    with running(line, feed):
        until(lambda: line.state.frames == 20 and bool(multiprocessing.active_children()), 60.0)
        for child in multiprocessing.active_children():
            child.kill()
            child.join()
        left.give(*frames[20:])
        left.end()
        assert line.wait(60.0)
    assert len(sink.kept) == 3


def test_stopping_counts_what_helpers_that_stand_still_do_not_measure() -> None:
    left = Small("left", passing("left")[:ALL_IN_VIEW])
    line, feed, sink = line_of(left)
    line.start()
    feed.start()
    until(lambda: line.state.frames == ALL_IN_VIEW and all(one.works for one in line._bench.helpers), 60.0)
    for child in multiprocessing.active_children():
        os.kill(child.pid or 0, signal.SIGSTOP)
    assert line.stop(0.5)
    assert feed.stop() == ()
    assert [one.fruit.fruit for one, _ in sink.kept] == [1, 2, 3]
    assert not multiprocessing.active_children()
    assert {one.code for one in line.state.warnings} == {"fruit_not_measured"}, "sized roughly, and said so"


def test_a_sensor_that_dies_does_not_hold_the_others() -> None:
    left, right = Small("left", passing("left")), Small("right", passing("right")[:5])
    right.give(gone("right"))
    line, feed, sink = line_of(left, right, intake=LIVE)
    with running(line, feed):
        until(lambda: line.state.frames + sum(line.state.dropped.values()) >= len(passing("left")), 60.0)
    assert sink.kept or sum(line.state.dropped.values()) > 10


def test_what_only_a_dead_sensor_sees_is_said_to_be_blind_until_it_is_back() -> None:
    """The right one looks at the belt 0.5 m farther to the side; the belt runs along x of both."""
    left, right = Steady("left"), Steady("right")
    names = ("left", "right")
    poses = (Pose.exact(), Pose(np.eye(3), np.array([0.0, 0.5, 0.0]), np.zeros((6, 6))))
    beside = {name: StationSensor(f"S-{name}", pose, SURFACE) for name, pose in zip(names, poses, strict=True)}
    feed, sink = Feed([left, right]), MemorySink()
    belt = Station("left", beside, np.array([SPEED_M_S, 0.0, 0.0]))
    line = LiveLine(feed, belt, None, Counting(BufferedSink(sink)), 1, LIVE)
    with running(line, feed):
        until(lambda: all(feed.health(name).frames > 3 for name in names), 60.0)
        until(lambda: line.state.blind is None, 60.0)
        right.unplugged.set()
        until(lambda: line.state.blind is not None, 60.0)
        blind = line.state.blind
        assert blind is not None
        assert blind.sensors == ("right",)
        assert blind.sides == ("right",)  # y of the sensor's frame points to the right of the belt's way
        assert blind.lanes_m is not None
        (lane,) = blind.lanes_m
        assert lane[1] - lane[0] == pytest.approx(0.5, abs=0.02)
        assert ("part_blind", ("right",)) in [(one.code, one.sensors) for one in line.state.warnings]
        right.unplugged.clear()
        until(lambda: line.state.blind is None, 60.0)


def test_a_recorded_sensor_that_waits_for_the_others_is_not_away() -> None:
    left = Small("left", passing("left")[:1])
    line, feed, _ = line_of(left)
    with running(line, feed):
        until(lambda: feed.health("left").state is Running.SILENT, 60.0)
        looked_s = time.monotonic()
        until(lambda: time.monotonic() > looked_s + 1.0)
        assert line.state.blind is None
        assert line.state.warnings == ()


def test_a_clock_set_anew_is_said_and_followed_on() -> None:
    frames = passing("left")
    left = Small("left")
    line, feed, sink = line_of(left, intake=replace(FLAT_OUT, jump_s=20.0))
    with running(line, feed):
        left.give(*frames[:25])
        until(lambda: line.state.frames == 25, 60.0)
        left.give(*(replace(one, time_s=one.time_s - 5000.0) for one in frames[25:]))
        left.end()
        assert line.wait(60.0)
        assert {one.code for one in line.state.warnings} == {"clock_jumped"}
    assert len(sink.kept) == 3


PATIENCE_S = 180.0
UNEVEN_M = [0.0, 0.2, 0.53, 0.7, 1.1, 1.27, 1.66, 1.9]


def two_clocks(apart_s: float) -> tuple[LiveLine, Feed, MemorySink, tuple[Small, Small]]:
    """Return a line of two sensors that see the same from one place, and whose clocks are apart."""
    sensors = tuple(Small(name, carried(name, UNEVEN_M, first_s)) for name, first_s in (("a", 0.0), ("b", apart_s)))
    return *line_of(*sensors), (sensors[0], sensors[1])


@pytest.mark.parametrize("apart_s", [0.7, -1.2])
def test_fruit_are_counted_once_where_a_clock_is_off_from_the_start(apart_s: float) -> None:
    line, feed, sink, sensors = two_clocks(apart_s)
    with running(line, feed):
        for sensor in sensors:
            sensor.end()
        assert line.wait(PATIENCE_S)
        warnings = line.state.warnings
    assert {(one.code, one.sensors) for one in warnings} == {("clock_put_right", ("b",))}
    assert len(sink.kept) == len(UNEVEN_M)
    for _, crops in sink.kept:
        assert {crop.sensor for crop in crops} == {"a", "b"}, (
            "pictures of both sensors, also of what was followed again"
        )
    assert line.state.waiting_fruit == 0


def test_clocks_that_agree_are_left_alone() -> None:
    line, feed, sink, sensors = two_clocks(0.0)
    with running(line, feed):
        for sensor in sensors:
            sensor.end()
        assert line.wait(PATIENCE_S)
    assert len(sink.kept) == len(UNEVEN_M)
    assert line.state.warnings == ()


def test_fruit_that_wait_for_the_clocks_go_into_the_lot_in_which_they_left() -> None:
    frames = {name: carried(name, UNEVEN_M, first_s) for name, first_s in (("a", 0.0), ("b", 0.7))}
    sensors = tuple(Small(name, of[:45]) for name, of in frames.items())
    line, feed, sink = line_of(*sensors)
    with running(line, feed):
        until(lambda: line.state.frames == 90 and line.state.waiting_fruit > 0, PATIENCE_S)
        assert sink.kept == []
        line.count_into(None)
        for sensor, of in zip(sensors, frames.values(), strict=True):
            sensor.give(*of[45:])
            sensor.end()
        assert line.wait(PATIENCE_S)
    passed = line.state.passed
    assert len(sink.kept) + passed == len(UNEVEN_M)
    assert 0 < len(sink.kept) < len(UNEVEN_M)


def test_sensors_are_known_by_serial_and_depth_is_put_right() -> None:
    frames = [replace(one, depth_mm=(one.depth_mm * 0.8).astype(np.uint16)) for one in passing("x")]
    sensor = NamedSensor(Small("left", frames), "other")
    feed, sink = Feed([sensor]), MemorySink()
    nearer = station("left", correction=DepthCorrection(scale=1.25))
    line = LiveLine(feed, nearer, None, Counting(BufferedSink(sink)), 1, FLAT_OUT)
    with running(line, feed):
        until(lambda: line.state.frames == len(frames), 60.0)
        assert line.previews["other"].station_id == "left"
        assert "sensor_not_matched" not in {one.code for one in line.state.warnings}
    assert len(sink.kept) == 3


def test_a_bumped_sensor_is_said_at_once() -> None:
    bumped = Table((), tilt_rad=0.03, intrinsics=SMALL)
    frames = [
        replace(Table((), tilt_rad=0.03, intrinsics=SMALL, seed=n).frame(), sensor="left", sequence=n, time_s=0.2 * n)
        for n in range(30)
    ]
    assert bumped.surface().plane.normal @ SURFACE.plane.normal < 0.9999
    line, feed, _ = line_of(Small("left", frames))
    with running(line, feed):
        until(lambda: {one.code for one in line.state.warnings} == {"calibration_stale"}, 30.0)
        assert line.state.warnings[0].sensors == ("left",)


def test_starting_and_stopping_many_times_leaves_nothing() -> None:
    frames = passing("left")[:6]
    before = threading.active_count()
    for _ in range(20):
        left = Small("left", frames)
        line, feed, _ = line_of(left)
        with running(line, feed):
            until(lambda line=line: line.state.frames > 0, 60.0)
            left.end()
    assert threading.active_count() == before


@pytest.mark.parametrize(("every", "said"), [(2, set()), (8, {"part_sparse"})])
def test_damaged_pictures_are_said_from_when_on_fruit_may_be_missed(every: int, said: set[str]) -> None:
    """At 0.24 m/s a fruit takes some three seconds through the view; a picture comes each 0.2 s."""
    frames = passing("left")
    left = Small("left", [replace(one, damaged=number % every > 0) for number, one in enumerate(frames)])
    left.end()
    line, feed, _ = line_of(left)
    with running(line, feed):
        assert line.wait(60.0)
        state = line.state
        assert state.health[0].damaged == sum(number % every > 0 for number in range(len(frames)))
        assert {one.code for one in state.warnings} == said
        assert [one.sensors for one in state.warnings] == [("left",)] * len(said)
        assert (state.sparse is not None) == bool(said)
