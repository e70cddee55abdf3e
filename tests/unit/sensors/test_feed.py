"""Sensors running: newest frames, health, faults, queues, and an end within seconds."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from itertools import count

import pytest

from fruitgui.frame import Frame
from fruitgui.sensors.feed import ByCapture, DropOldest, Feed, Running, WaitForRoom
from fruitgui.sensors.feed.patience import Patience
from fruitgui.sensors.sensor import Sensor, SensorTimeoutError
from tests.unit.sensors.scripted import Hang, ScriptedSensor, gone, small_frame, until

pytestmark = pytest.mark.usefixtures("no_leaked_threads")


@contextmanager
def running(*sensors: Sensor) -> Iterator[Feed]:
    feed = Feed(sensors)
    feed.start()
    try:
        yield feed
    finally:
        assert feed.stop() == ()


def test_the_newest_frame_of_each_sensor_is_at_hand() -> None:
    left, right = ScriptedSensor("left"), ScriptedSensor("right")
    with running(left, right) as feed:
        assert feed.newest("left") is None
        left.give(small_frame("left", 0), small_frame("left", 1))
        until(lambda: feed.health("left").frames == 2)
        newest = feed.newest("left")
        assert newest is not None
        assert newest.sequence == 1
        assert feed.newest("right") is None
        assert feed.health("left").state is Running.RUNNING
        assert feed.health("right").state is Running.STARTING


def test_constructing_starts_nothing() -> None:
    before = threading.active_count()
    feed = Feed([ScriptedSensor("left")])
    assert threading.active_count() == before
    assert feed.health("left").state is Running.STOPPED


def test_two_sensors_of_one_name_are_refused() -> None:
    with pytest.raises(ValueError, match="one name"):
        Feed([ScriptedSensor("left"), ScriptedSensor("left")])


def test_numbers_that_are_missing_are_counted_as_drops() -> None:
    left = ScriptedSensor("left", [small_frame("left", n) for n in (0, 1, 4, 5, 7)])
    with running(left) as feed:
        until(lambda: feed.health("left").frames == 5)
        assert feed.health("left").drops == 3


def test_a_sensor_that_dies_is_opened_again_while_the_others_run() -> None:
    left, right = ScriptedSensor("left"), ScriptedSensor("right")
    with running(left, right) as feed:
        left.give(small_frame("left", 0), gone("left"))
        until(lambda: feed.health("left").state is Running.FAILED)
        error = feed.health("left").error
        assert error is not None
        assert error.code == "sensor_gone"
        right.give(small_frame("right", 0))
        until(lambda: feed.health("right").state is Running.RUNNING)
        left.give(small_frame("left", 0))
        until(lambda: feed.health("left").state is Running.RUNNING)
        assert feed.health("left").error is None
        assert (feed.health("left").reopened, left.opened, left.closed) == (1, 2, 1)
        assert feed.health("left").drops == 0


def test_a_bug_in_a_driver_takes_down_its_sensor_only() -> None:
    left = ScriptedSensor("left")
    with running(left) as feed:
        left.give(ZeroDivisionError("in the driver"))
        until(lambda: feed.health("left").state is Running.FAILED)
        error = feed.health("left").error
        assert error is not None
        assert "ZeroDivisionError" in error.what


def test_a_silent_sensor_is_named_within_a_second_or_so() -> None:
    left = ScriptedSensor("left", [small_frame("left", 0)])
    with running(left) as feed:
        until(lambda: feed.health("left").state is Running.RUNNING)
        began_s = time.monotonic()
        until(lambda: feed.health("left").state is Running.SILENT)
        assert time.monotonic() - began_s < 5.0  # 0.8 s on a machine that has nothing else to do
        left.give(small_frame("left", 1))
        until(lambda: feed.health("left").state is Running.RUNNING)


def test_stopping_ends_within_two_seconds_and_names_the_driver_that_hangs() -> None:
    left, right = ScriptedSensor("left"), ScriptedSensor("right")
    feed = Feed([left, right])
    feed.start()
    left.give(Hang())
    assert left.hung.wait(5.0)
    began_s = time.monotonic()
    assert feed.stop() == ("left",)
    assert time.monotonic() - began_s < 2.5
    assert feed.health("left").abandoned
    left.let_go.set()
    until(lambda: left.closed == 1)


def test_the_rate_is_measured() -> None:
    left = ScriptedSensor("left", rate_hz=20.0)
    with running(left) as feed:
        begin_s = time.monotonic()
        for n in range(12):
            until(lambda n=n: time.monotonic() >= begin_s + 0.05 * n)
            left.give(small_frame("left", n))
        until(lambda: feed.health("left").frames == 12)
        assert feed.health("left").rate_hz == pytest.approx(20.0, rel=0.3)


def test_a_slow_reader_loses_the_oldest_and_is_told_how_many() -> None:
    left = ScriptedSensor("left")
    with running(left) as feed:
        queue = feed.subscribe(DropOldest(3))
        left.give(*(small_frame("left", n) for n in range(10)))
        until(lambda: feed.health("left").frames == 10)
        until(lambda: queue.dropped["left"] == 7)
        taken = [arrival.frame.sequence for arrival in iter(lambda: queue.take(0.0), None)]
        assert taken == [7, 8, 9]


def test_a_lossless_queue_makes_the_sensor_wait() -> None:
    frames = [small_frame("left", n) for n in range(50)]
    left = ScriptedSensor("left")
    with running(left) as feed:
        queue = feed.subscribe(WaitForRoom(4))
        left.give(*frames)
        left.end()
        until(lambda: queue.waiting == 4)
        taken = []
        while not queue.over:
            arrival = queue.take(1.0)
            if arrival is not None:
                taken.append(arrival.frame.sequence)
        assert taken == list(range(50))
        assert not any(queue.dropped.values())
        assert feed.ended


def test_a_reader_that_waits_for_room_does_not_hold_the_stop() -> None:
    left = ScriptedSensor("left")
    with running(left) as feed:
        queue = feed.subscribe(WaitForRoom(1))
        left.give(small_frame("left", 0), small_frame("left", 1))
        until(lambda: queue.waiting == 1)


class ToldSensor(ScriptedSensor):
    """Tells, as often as no frame comes, when anything last came."""

    heard_s: float | None = None

    def read(self, timeout_s: float) -> Frame:
        try:
            return super().read(timeout_s)
        except SensorTimeoutError:
            raise SensorTimeoutError("told", timeout_s, self.heard_s) from None


def test_a_sensor_of_which_nothing_at_all_comes_is_silent_before_it_owes_a_frame() -> None:
    told = ToldSensor("told", rate_hz=0.01)  # it owes a frame after minutes only
    with running(told) as feed:
        told.give(small_frame("told", 0))
        until(lambda: feed.health("told").state is Running.RUNNING)
        told.heard_s = time.monotonic() - 1000.0
        until(lambda: feed.health("told").state is Running.SILENT)
        error = feed.health("told").error
        assert error is not None
        assert error.code == "sensor_silent"
        told.heard_s = time.monotonic() + 1000.0
        until(lambda: feed.health("told").state is Running.RUNNING)
        assert feed.health("told").error is None


def test_a_sensor_that_is_made_to_wait_is_not_silent() -> None:
    left = ScriptedSensor("left")
    with running(left) as feed:
        queue = feed.subscribe(WaitForRoom(1))
        left.give(small_frame("left", 0), small_frame("left", 1))
        until(lambda: feed.health("left").frames == 2)
        blocked_s = time.monotonic()
        until(lambda: time.monotonic() > blocked_s + 1.2)
        assert feed.health("left").state is Running.RUNNING
        assert queue.take(1.0) is not None
        until(lambda: feed.health("left").state is Running.SILENT)


def test_frames_leave_in_the_order_of_capture() -> None:
    left, right = ScriptedSensor("left"), ScriptedSensor("right")
    left.give(*(small_frame("left", n, 0.2 * n) for n in range(20)))
    feed = Feed([left, right])
    queue = feed.subscribe(WaitForRoom(100), ByCapture({"right": -1.0}, patience_s=30.0))
    feed.start()
    until(lambda: queue.waiting == 20)
    right.give(*(small_frame("right", n, 1.1 + 0.2 * n) for n in range(20)))
    left.end()
    right.end()
    times = []
    while not queue.over:
        arrival = queue.take(1.0)
        if arrival is not None:
            times.append(arrival.frame.time_s - (1.0 if arrival.frame.sensor == "right" else 0.0))
    feed.stop()
    assert len(times) == 40
    assert times == sorted(times)


def test_a_frame_whose_time_is_not_sure_is_seen_but_has_no_place_in_the_order_of_capture() -> None:
    left = ScriptedSensor("left")
    with running(left) as feed:
        ordered, as_they_came = feed.subscribe(DropOldest(10), ByCapture({})), feed.subscribe(DropOldest(10))
        left.give(replace(small_frame("left", 0), time_sure=False))
        until(lambda: feed.newest("left") is not None)
        left.give(small_frame("left", 1))
        until(lambda: feed.health("left").frames == 2)
    assert [[one and one.frame.sequence for one in (queue.take(1.0), queue.take(0.0))] for queue in (
        ordered, as_they_came
    )] == [[1, None], [0, 1]]  # fmt: skip


def test_a_late_sensor_is_waited_for_and_a_silent_one_holds_nobody() -> None:
    left, right = ScriptedSensor("left"), ScriptedSensor("right")
    with running(left, right) as feed:
        queue = feed.subscribe(DropOldest(100), ByCapture({}, patience_s=0.5))
        left.give(small_frame("left", 0, 1.0))
        until(lambda: queue.waiting == 1)
        assert queue.take(0.1) is None
        first = queue.take(2.0)
        assert first is not None
        left.give(*(small_frame("left", n, 1.0 + n) for n in range(1, 6)))
        began_s = time.monotonic()
        for _ in range(5):
            assert queue.take(0.4) is not None
        assert time.monotonic() - began_s < 0.4


def test_a_sensor_that_failed_is_not_waited_for() -> None:
    left, right = ScriptedSensor("left"), ScriptedSensor("right")
    with running(left, right) as feed:
        queue = feed.subscribe(DropOldest(100), ByCapture({}, patience_s=60.0))
        right.give(small_frame("right", 0, 0.0), gone("right"))
        until(lambda: feed.health("right").state is Running.FAILED)
        left.give(small_frame("left", 0, 1.0))
        assert [queue.take(5.0) is not None for _ in range(2)] == [True, True]


def test_a_queue_is_not_over_while_its_sensor_may_come_back() -> None:
    left = ScriptedSensor("left", [small_frame("left", 0)])
    with running(left) as feed:
        queue = feed.subscribe(DropOldest(10))
        until(lambda: feed.health("left").frames == 1)
        queue.clear()
        left.give(gone("left"))
        until(lambda: feed.health("left").state is Running.FAILED)
        assert queue.take(0.0) is None
        assert not queue.over
        left.give(small_frame("left", 0))
        assert queue.take(10.0) is not None
    assert queue.over


def test_starting_and_stopping_many_times_leaves_nothing() -> None:
    before = threading.active_count()
    for _ in range(20):
        left = ScriptedSensor("left", [small_frame("left", n) for n in range(5)])
        with running(left) as feed:
            until(lambda feed=feed: feed.health("left").frames > 0)
            left.end()
    assert threading.active_count() == before


def test_leaps_of_a_clock_are_counted_on_when_it_is_opened_again() -> None:
    left = ScriptedSensor("left")

    def leapt(sequence: int, leaps: int) -> Frame:
        return replace(small_frame("left", sequence), clock_leaps=leaps)

    with running(left) as feed:
        left.give(leapt(0, 0), leapt(1, 1), leapt(2, 1), replace(leapt(3, 2), damaged=True))
        until(lambda: feed.health("left").damaged == 1)
        assert feed.health("left").clock_leaps == 2
        left.give(gone("left"), leapt(0, 0), leapt(1, 1))
        until(lambda: feed.health("left").frames == 5)
        assert feed.health("left").clock_leaps == 3


def test_one_that_gives_only_damaged_pictures_runs_and_is_of_no_use() -> None:
    left = ScriptedSensor("left", [small_frame("left", 0)])
    sequence = count(1)

    def damaged() -> None:
        left.give(replace(small_frame("left", next(sequence)), damaged=True))

    with running(left) as feed:
        until(lambda: feed.health("left").frames == 1)
        until(lambda: damaged() or feed.health("left").useless)
        health = feed.health("left")
        assert (health.state, health.reopened, health.frames) == (Running.RUNNING, 0, 1)
        left.give(small_frame("left", next(sequence)))
        until(lambda: not feed.health("left").useless)


def test_patience_counts_what_is_owed_while_it_is_to_come_and_what_is_of_use_apart() -> None:
    patience = Patience()
    patience.expect(10.0)
    patience.hear(11.0, of_use=False)
    patience.rest(12.0)
    patience.expect(20.0)
    assert (patience.owed_s(20.5), patience.useless_s(20.5)) == (1.5, 2.5)
    patience.hear(21.0, of_use=False)
    assert (patience.owed_s(21.0), patience.useless_s(21.0)) == (0.0, 3.0)
    patience.hear(22.0)
    assert patience.useless_s(22.5) == 0.5
    patience.forget()
    assert patience.useless_s(30.0) == 0.0
