"""Projectors that take turns: never two at once, nobody waits for the dead, nobody sees what was badly lit."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise

import pytest

from fruitgui.errors import WorldError
from fruitgui.frame import Frame
from fruitgui.sensors.feed import Arrival, Feed, Running, Subscription
from fruitgui.sensors.feed.reader import LATER_TURNS_S
from fruitgui.sensors.sensor import Projector, SensorTimeoutError
from fruitgui.sensors.turns import Light, Schedule, Settling, turns
from tests.unit.sensors.lit_room import LitRoom, LitSensor, holes
from tests.unit.sensors.scripted import until

pytestmark = pytest.mark.usefixtures("no_leaked_threads")

LONG_S = 30.0
LIGHT = Light(1 / 50, Settling(0.04, 1), 0.0)


def alone(*names: str) -> Schedule:
    return turns(dict.fromkeys(names, LIGHT), None)


@contextmanager
def running(*sensors: LitSensor, schedule: Schedule | None = None) -> Iterator[Feed]:
    feed = Feed(sensors, schedule or alone(*(one.info.sensor for one in sensors)))
    feed.start()
    try:
        yield feed
    finally:
        for sensor in sensors:
            sensor.let_go.set()
        feed.stop()


def frames(queue: Subscription, count: int) -> list[Arrival]:
    taken: list[Arrival] = []
    until(lambda: _took(queue, taken) >= count, LONG_S)
    return taken


def _took(queue: Subscription, taken: list[Arrival]) -> int:
    arrival = queue.take(0.2)
    taken.extend([] if arrival is None else [arrival])
    return len(taken)


def test_two_take_turns_and_never_shine_together() -> None:
    room = LitRoom()
    left, right = LitSensor("left", room), LitSensor("right", room)
    with running(left, right) as feed:
        queue = feed.subscribe(100)
        seen = frames(queue, 20)
        until(lambda: len(room.order()) > 10, LONG_S)
    assert room.most_lit == 1
    assert room.alternates()
    assert {arrival.frame.sensor for arrival in seen} == {"left", "right"}
    assert room.lit() == {}


def test_nobody_sees_frames_before_the_light_has_settled() -> None:
    room = LitRoom()
    sensors = [LitSensor(name, room, settle_s=0.15) for name in ("left", "right")]
    light = Light(1 / 50, Settling(0.2, 3), 0.0)
    with running(*sensors, schedule=turns({"left": light, "right": light}, None)) as feed:
        seen = frames(feed.subscribe(100), 12)
        newest = feed.newest("left")
    assert newest is not None
    assert all(holes(arrival.frame.depth_mm) == pytest.approx(0.05, abs=1e-3) for arrival in seen)
    assert all(arrival.lit.since_s >= 0.2 and arrival.lit.frames >= 3 for arrival in seen)


def test_frames_to_discard_are_counted_where_time_alone_would_do() -> None:
    room = LitRoom()
    light = Light(1 / 50, Settling(0.0, 6), 0.0)
    with running(LitSensor("left", room), LitSensor("right", room), schedule=turns(
        {"left": light, "right": light}, None
    )) as feed:  # fmt: skip
        seen = frames(feed.subscribe(100), 6)
    assert {arrival.lit.frames for arrival in seen} == {6, 7, 8}


def test_every_call_to_a_sensor_comes_from_its_own_thread() -> None:
    room = LitRoom()
    left, right = LitSensor("left", room), LitSensor("right", room)
    with running(left, right) as feed:
        frames(feed.subscribe(100), 10)
        feed.take_turns(turns({"left": LIGHT, "right": LIGHT}, []))
        until(lambda: len(room.lit()) == 2, LONG_S)
    assert len(left.threads) == len(right.threads) == 1
    assert left.threads != right.threads
    assert threading.get_ident() not in left.threads | right.threads


def test_it_is_told_to_be_dark_before_it_starts() -> None:
    room = LitRoom()
    left, right = LitSensor("left", room), LitSensor("right", room)
    with running(left, right) as feed:
        frames(feed.subscribe(100), 4)
    for sensor in (left, right):
        calls = [call for call in sensor.calls if call != "read"]
        assert calls[:4] == ["open", "off", "start", "on"]


def test_sensors_that_do_not_overlap_share_a_turn_and_a_lonely_one_is_never_dark() -> None:
    """A chain a-b-c: b is on alone, a and c together; d sees none of them."""
    room = LitRoom()
    names = ("a", "b", "c", "d")
    plan = turns(dict.fromkeys(names, LIGHT), [("a", "b"), ("b", "c")])
    with running(*(LitSensor(name, room) for name in names), schedule=plan) as feed:
        frames(feed.subscribe(100), 60)
        until(lambda: room.order().count("b") > 5, LONG_S)
    on: set[str] = set()
    for _, sensor, lit in room.log[:-4]:
        (on.add if lit else on.discard)(sensor)
        assert not {"b"} < on - {"d"}
    assert room.order().count("d") == 1


def test_sensors_whose_light_harms_nobody_are_never_switched() -> None:
    room = LitRoom()
    sensors = [LitSensor(name, room, projector=Projector.HARMLESS) for name in ("left", "right")]
    feed = Feed(sensors)
    assert feed.schedule.slots == ()
    with running(*sensors, schedule=feed.schedule) as feed:
        frames(feed.subscribe(100), 20)
        assert feed.health("left").nominal_hz == 50.0
    assert {"on", "off"}.isdisjoint(sensors[0].calls + sensors[1].calls)


def test_without_a_schedule_each_is_alone() -> None:
    room = LitRoom()
    assert Feed([LitSensor("left", room), LitSensor("right", room)]).schedule.slots == (("left",), ("right",))


def test_the_turn_of_a_dead_sensor_goes_to_the_others_until_it_is_back() -> None:
    room = LitRoom()
    left, right = LitSensor("left", room), LitSensor("right", room)
    with running(left, right) as feed:
        frames(feed.subscribe(100), 8)
        right.gone.set()
        until(lambda: feed.health("right").state is Running.FAILED, LONG_S)
        before = len(room.order())
        alone_frames = feed.health("left").frames
        until(lambda: feed.health("left").frames > alone_frames + 30, LONG_S)
        assert len(room.order()) <= before + 1  # left shines on, and is not switched any more
        right.gone.clear()
        feed.try_again("right")
        until(lambda: feed.health("right").state is Running.RUNNING, LONG_S)
        frames(feed.subscribe(100), 20)
    assert room.most_lit == 1


def test_one_that_falls_silent_in_its_turn_holds_the_others_for_a_moment_only() -> None:
    room = LitRoom()
    left, right = LitSensor("left", room), LitSensor("right", room)
    with running(left, right) as feed:
        queue = feed.subscribe(1000)
        frames(queue, 8)
        right.mute.set()
        until(lambda: feed.health("right").state in (Running.SILENT, Running.FAILED), LONG_S)
        left_before = feed.health("left").frames
        until(lambda: feed.health("left").frames > left_before + 10, LONG_S)
        right.mute.clear()
        until(lambda: feed.health("right").state is Running.RUNNING, LONG_S)
    assert room.most_lit == 1


@pytest.mark.parametrize("call", ["read", "off"])
def test_a_driver_that_hangs_while_it_shines_is_waited_for_then_named(call: str) -> None:
    """The others wait as long as an honest call may take, then go on and say that they may be blinded."""
    room = LitRoom()
    left, right = LitSensor("left", room), LitSensor("right", room)
    with running(left, right) as feed:
        frames(feed.subscribe(100), 8)
        assert feed.health("left").blinded_by == ()
        until(lambda: "right" in room.lit(), LONG_S)
        right.hang_in = call
        assert right.hung.wait(LONG_S)
        assert room.most_lit == 1
        until(lambda: feed.health("right").hangs, LONG_S)
        before = feed.health("left").frames
        until(lambda: feed.health("left").frames > before + 10, LONG_S)
        assert feed.health("left").blinded_by == ("right",)
        right.hang_in = ""
        right.let_go.set()
        until(lambda: feed.health("left").blinded_by == (), LONG_S)
        until(lambda: room.lit().keys() == {"left"}, LONG_S)


def test_a_driver_that_hangs_in_the_dark_blinds_nobody() -> None:
    room = LitRoom()
    left, right = LitSensor("left", room), LitSensor("right", room)
    with running(left, right) as feed:
        frames(feed.subscribe(100), 8)
        until(lambda: "left" in room.lit(), LONG_S)
        right.hang_in = "on"
        assert right.hung.wait(LONG_S)
        until(lambda: feed.health("right").hangs, LONG_S)
        before = feed.health("left").frames
        until(lambda: feed.health("left").frames > before + 10, LONG_S)
        assert room.most_lit == 1


def test_one_that_no_longer_obeys_in_its_turn_is_named_until_a_turn_of_its_own_ends() -> None:
    """It answers that it cannot be switched off: the others go on, and are told who may blind them."""
    room = LitRoom()
    left, right = LitSensor("left", room), LitSensor("right", room)
    with running(left, right) as feed:
        frames(feed.subscribe(100), 8)
        right.deaf.set()
        until(lambda: feed.health("right").state is Running.FAILED, LONG_S)
        until(lambda: feed.health("left").blinded_by == ("right",), LONG_S)
        before = feed.health("left").frames
        until(lambda: feed.health("left").frames > before + 10, LONG_S)
        right.deaf.clear()
        feed.try_again("right")
        until(lambda: feed.health("left").blinded_by == (), LONG_S)
        until(lambda: feed.health("right").state is Running.RUNNING, LONG_S)


def test_damaged_frames_are_counted_reach_nobody_and_hold_no_turn() -> None:
    room = LitRoom()
    left, right = LitSensor("left", room), LitSensor("right", room)
    with running(left, right) as feed:
        queue = feed.subscribe(1000)
        frames(queue, 4)
        right.damaged.set()
        until(lambda: feed.health("right").damaged > 30, LONG_S)
        before, right_before = feed.health("left").frames, feed.health("right").frames
        until(lambda: feed.health("left").frames > before + 10, LONG_S)
        assert feed.health("right").state is Running.RUNNING
        assert feed.health("right").frames == right_before
        right.damaged.clear()
        until(lambda: feed.health("right").frames > right_before, LONG_S)
        queue.close()
        rest = list(iter(lambda: queue.take(0.0), None))
        assert not any(arrival.frame.damaged for arrival in rest)
        newest = feed.newest("right")
        assert newest is not None
        assert not newest.damaged


def test_another_schedule_is_kept_to_at_once() -> None:
    room = LitRoom()
    left, right = LitSensor("left", room), LitSensor("right", room)
    with running(left, right) as feed:
        frames(feed.subscribe(100), 8)
        assert room.most_lit == 1
        feed.take_turns(turns({"left": LIGHT, "right": LIGHT}, []))
        until(lambda: len(room.lit()) == 2, LONG_S)
        feed.take_turns(alone("left", "right"))
        until(lambda: len(room.lit()) < 2, LONG_S)
        room.most_lit = 0
        frames(feed.subscribe(100), 12)
    assert room.most_lit == 1


def test_the_rate_that_turns_leave_is_what_is_promised() -> None:
    room = LitRoom()
    with running(LitSensor("left", room), LitSensor("right", room)) as feed:
        assert feed.health("left").nominal_hz == pytest.approx(3 / (2 * (0.04 + 3 / 50)))
        until(lambda: feed.health("left").frames > 60, LONG_S)
        assert feed.health("left").drops == 0
        assert 0.4 < feed.health("left").rate_hz / feed.health("left").nominal_hz < 1.3


def test_dark_sensors_are_heard_to_die() -> None:
    """Right waits for a turn that never comes: left hangs on to its own."""
    room = LitRoom()
    slow = Light(1 / 50, Settling(60.0, 0), 0.0)
    left, right = LitSensor("left", room), LitSensor("right", room)
    with running(left, right, schedule=turns({"left": slow, "right": slow}, None)) as feed:
        until(lambda: bool(room.lit()), LONG_S)
        dark = right if "left" in room.lit() else left
        dark.gone.set()
        until(lambda: feed.health(dark.info.sensor).state is Running.FAILED, LONG_S)


def unchanged(seen: list[Arrival], sensor: str) -> list[Arrival]:
    """Return a sensor's frames while others shone as a frame before: one that comes as they change is of both."""
    own = [one for one in seen if one.frame.sensor == sensor]
    return [one for before, one in pairwise(own) if before.lit.others == one.lit.others]


def test_a_rehearsal_hears_everything_and_nobody_else_does() -> None:
    room = LitRoom()
    left, right = (LitSensor(name, room, settle_s=0.2) for name in ("left", "right"))
    trial = Schedule((("left",), ("right",), ("left", "right")), dict.fromkeys(("left", "right"), Light(
        1 / 50, Settling(0.0, 0), 0.0
    )), views=20)  # fmt: skip
    with running(left, right) as feed:
        queue = feed.subscribe(1000)
        with feed.rehearsal(trial, 1000) as heard:
            with pytest.raises(ValueError, match="at a time"), feed.rehearsal(trial, 10):
                pass
            seen = frames(heard, 150)
            queue.clear()
            frames(heard, 30)
            assert queue.waiting == 0
        until(lambda: len(room.lit()) < 2, LONG_S)
        assert len(frames(queue, 6)) == 6
    settled = unchanged(seen, "left") + unchanged(seen, "right")
    together = [holes(one.frame.depth_mm) for one in settled if one.lit.others and one.lit.since_s > 0.25]
    apart = [holes(one.frame.depth_mm) for one in settled if not one.lit.others and one.lit.since_s > 0.25]
    assert min(len(together), len(apart)) > 10
    assert together == pytest.approx([0.15] * len(together), abs=1e-3)
    assert apart == pytest.approx([0.05] * len(apart), abs=1e-3)
    assert max(holes(one.frame.depth_mm) for one in seen if one.lit.frames == 0) > 0.4


@pytest.mark.parametrize("call", ["open", "start"])
def test_one_whose_first_opening_failed_has_the_same_patience_for_its_first_frame(call: str) -> None:
    room = LitRoom()

    class Late(LitSensor):
        """Fails at first, and then gives nothing for longer than one that was heard before may."""

        silent_until_s = 0.0
        failed = False

        def open(self) -> None:
            super().open()
            self.fail_once("open")

        def start(self) -> None:
            super().start()
            self.fail_once("start")

        def fail_once(self, now: str) -> None:
            if now == call and not self.failed:
                self.failed = True
                raise WorldError("in_use", "The device is in use.", "Close the other program.")

        def read(self, timeout_s: float) -> Frame:
            if self.info.sensor in room.lit():
                self.silent_until_s = self.silent_until_s or time.monotonic() + 1.6 * LATER_TURNS_S
                if time.monotonic() < self.silent_until_s:
                    time.sleep(timeout_s)
                    raise SensorTimeoutError(self.info.sensor, timeout_s)
            return super().read(timeout_s)

    late, other = Late("late", room), LitSensor("other", room)
    with running(late, other) as feed:
        until(lambda: feed.health("late").frames > 3, LONG_S)
        assert late.calls.count("open") == 2, "it was given the time for its first frame"
