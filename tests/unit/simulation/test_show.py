"""A simulated rig that runs for ever: what it shows, the truth about it, and its process."""

from __future__ import annotations

import multiprocessing
from dataclasses import replace
from itertools import islice

import cv2
import numpy as np
import pytest

from fruitgui.calibration.depth.seeing import see_belt
from fruitgui.calibration.still import average
from fruitgui.frame import F64, Frame
from fruitgui.sensors.feed import Feed, Running, WaitForRoom
from fruitgui.sensors.player import FlatOut
from fruitgui.simulation.ahead import SimulatedRig
from fruitgui.simulation.scenes import sight_of
from fruitgui.simulation.show import SHOWN_BALL_M, SHOWN_BOARD_M, SHOWN_RAISE_M, Show, Showing
from fruitgui.simulation.supply import BATCH, LineOptions, crossed, has_left, supply
from tests.unit.sensors.scripted import until

pytestmark = pytest.mark.usefixtures("no_leaked_threads")

OPTIONS = LineOptions(rig_seed=3, seed=5, speed_m_s=0.4)


def same(first: Frame, second: Frame) -> bool:
    return (
        first.time_s == second.time_s
        and np.array_equal(first.color, second.color)
        and np.array_equal(first.depth_mm, second.depth_mm)
    )


def raised_px(frame: Frame, empty: Frame) -> int:
    """Return how many pixels are at least 15 mm nearer than on the empty belt; noise of single pixels left out."""
    now, then = (cv2.medianBlur(one.depth_mm, 5).astype(int) for one in (frame, empty))
    return int(((now > 0) & (then > 0) & (now < then - 15)).sum())


def frames_of(show: Show, showing: Showing, count: int) -> list[Frame]:
    show.showing = showing
    return [show.frame() for _ in range(count)]


def test_fruit_keep_coming_and_never_lie_in_each_other() -> None:
    setting = OPTIONS.setting()
    bodies = [body for batch in islice(supply(OPTIONS, setting), 4) for body in batch]
    assert [body.fruit_id for body in bodies] == list(range(1, 4 * BATCH + 1))
    ends = [(body.start_m[0] - body.reach_m(), body.start_m[0] + body.reach_m()) for body in bodies]
    for batch in range(3):
        rear = min(low for low, _ in ends[batch * BATCH : (batch + 1) * BATCH])
        front = max(high for _, high in ends[(batch + 1) * BATCH : (batch + 2) * BATCH])
        assert front < rear


def test_as_many_come_as_were_asked_for() -> None:
    options = replace(OPTIONS, fruit=17)
    assert sum(len(batch) for batch in supply(options, options.setting())) == 17


def test_the_truth_is_who_has_come_and_gone() -> None:
    setting = OPTIONS.setting()
    low_m, high_m = sight_of(setting)
    first = next(supply(OPTIONS, setting))[0]
    assert crossed(OPTIONS, 0.0) == []
    passed_s = (high_m + 0.3 - first.start_m[0]) / OPTIONS.speed_m_s
    assert first.fruit_id in {one.fruit_id for one in crossed(OPTIONS, passed_s)}
    assert first.start_m[0] < low_m
    assert not has_left(first, 0.0, high_m)
    many = crossed(replace(OPTIONS, fruit=30), 1e4)
    assert [one.fruit_id for one in many] == list(range(1, 31))


def test_the_same_calls_give_the_same_frames() -> None:
    assert all(same(one, other) for one, other in zip(*(frames_of(Show(OPTIONS), Showing.LINE, 4),) * 2, strict=True))
    first, second = Show(OPTIONS), Show(OPTIONS)
    for showing in (Showing.LINE, Showing.STILL, Showing.LINE):
        assert all(
            same(one, other)
            for one, other in zip(frames_of(first, showing, 2), frames_of(second, showing, 2), strict=True)
        )


def test_a_still_scene_has_structure_and_an_empty_belt_has_none() -> None:
    show = Show(OPTIONS)
    empty = frames_of(show, Showing.EMPTY, 4)
    still = frames_of(show, Showing.STILL, 4)
    assert raised_px(empty[2], empty[0]) < 2000
    assert raised_px(still[0], empty[0]) > 10_000
    assert raised_px(still[2], still[0]) < 2000


def test_a_paused_belt_stands_while_stamps_go_on() -> None:
    show = Show(OPTIONS)
    frames_of(show, Showing.LINE, 40)
    belt_s = show.belt_s
    paused = frames_of(show, Showing.PAUSED, 4)
    assert show.belt_s == belt_s
    assert [one.sequence for one in paused] == [20, 20, 21, 21]
    assert paused[0].time_s < paused[2].time_s
    moved = raised_px(frames_of(show, Showing.LINE, 10)[-2], paused[0])
    assert raised_px(paused[2], paused[0]) < 0.2 * moved


def test_a_line_that_ends_is_over_when_all_have_left() -> None:
    show = Show(replace(OPTIONS, fruit=1, speed_m_s=2.0))
    count = 0
    while not show.over:
        show.frame()
        count += 1
    assert 5 < count < 60
    assert len(crossed(replace(OPTIONS, fruit=1, speed_m_s=2.0), show.belt_s)) == 1


def test_the_process_gives_the_same_frames_as_the_show_and_leaves_nothing() -> None:
    options = replace(OPTIONS, fruit=1, speed_m_s=2.0)
    feed = Feed(SimulatedRig(options, FlatOut()).sensors())
    queue = feed.subscribe(WaitForRoom(4))
    feed.start()
    frames: dict[str, list[Frame]] = {sensor: [] for sensor in feed.sensors}
    while not queue.over:
        arrival = queue.take(1.0)
        if arrival is not None:
            frames[arrival.frame.sensor].append(arrival.frame)
    assert feed.stop() == ()
    show = Show(options)
    for sensor, own in frames.items():
        assert [one.sequence for one in own] == list(range(len(own)))
        assert len(own) > 3
        assert own[0].sensor == sensor
    first = show.frame()
    assert same(first, frames[first.sensor][0])


def test_it_runs_at_its_pace_and_shows_what_it_is_told_to() -> None:
    rig = SimulatedRig(OPTIONS)
    rig.show(Showing.EMPTY)
    feed = Feed(rig.sensors())
    feed.start()
    until(lambda: all(feed.health(sensor).frames > 8 for sensor in feed.sensors), 60.0)
    assert feed.health("kinect_1").rate_hz < 1.3 * OPTIONS.rate_hz
    empty = feed.newest("kinect_1")
    assert empty is not None
    rig.show(Showing.STILL)

    def shows_something() -> bool:
        newest = feed.newest("kinect_1")
        return newest is not None and raised_px(newest, empty) > 8000

    until(shows_something, 20.0)
    assert feed.health("kinect_1").drops == 0
    assert feed.stop() == ()


def test_a_belt_stands_while_it_is_asked_to_and_what_else_is_shown_stays() -> None:
    rig = SimulatedRig(OPTIONS)
    with rig.standing():
        assert rig.showing is Showing.PAUSED
    assert rig.showing is Showing.LINE
    rig.show(Showing.STILL)
    with rig.standing():
        assert rig.showing is Showing.STILL
        rig.show(Showing.EMPTY)
    assert rig.showing is Showing.EMPTY


def test_a_renderer_that_dies_is_started_again() -> None:
    rig = SimulatedRig(OPTIONS, FlatOut())
    feed = Feed(rig.sensors())
    feed.start()
    until(lambda: feed.newest("kinect_1") is not None, 60.0)
    for child in multiprocessing.active_children():
        child.kill()
    until(lambda: feed.health("kinect_1").reopened > 0, 30.0)
    before = feed.health("kinect_1").frames
    until(lambda: feed.health("kinect_1").frames > before and feed.health("kinect_1").state is Running.RUNNING, 60.0)
    assert feed.stop() == ()


def test_a_carton_and_a_ball_are_shown_for_measuring_depth() -> None:
    show = Show(OPTIONS)
    empty = frames_of(show, Showing.EMPTY, 2)
    carton, ball = (frames_of(show, showing, 2) for showing in (Showing.BOARD, Showing.BALL))
    for sensor, frame in enumerate(empty):
        distance_m = float(np.median(frame.depth_mm[frame.depth_mm > 0])) * 1e-3
        lid_px = SHOWN_BOARD_M[0] * SHOWN_BOARD_M[1] * (frame.intrinsics.fx / distance_m) ** 2
        assert 0.7 * lid_px < raised_px(carton[sensor], frame) < 3.0 * lid_px
        ball_px = np.pi / 4 * (SHOWN_BALL_M * frame.intrinsics.fx / distance_m) ** 2
        assert 0.7 * ball_px < raised_px(ball[sensor], frame) < 2.0 * ball_px
    assert raised_px(frames_of(show, Showing.EMPTY, 2)[0], empty[0]) < 2000, "they are gone again"


def test_devices_that_err_are_others_at_the_same_places() -> None:
    perfect, erring = OPTIONS.setting().devices, replace(OPTIONS, depth_error=1.0).setting().devices
    for one, other in zip(perfect, erring, strict=True):
        assert np.array_equal(one.pose.matrix, other.pose.matrix)
        assert (one.depth_model.scale_error, one.depth_model.offset_m, one.depth_model.radial_error) == (0.0, 0.0, 0.0)
        assert other.depth_model.scale_error != 0.0 != other.depth_model.offset_m
        assert one.serial != other.serial, "what is kept of the one is not put on the other"


def test_raised_sensors_see_the_bare_belt_from_farther_away() -> None:
    show = Show(OPTIONS)
    empty, higher = (frames_of(show, showing, 2) for showing in (Showing.EMPTY, Showing.RAISED))
    for low, high in zip(empty, higher, strict=True):
        distances_m = [1.0 / float(np.linalg.norm(belt_of(frame))) for frame in (low, high)]
        assert distances_m[1] - distances_m[0] == pytest.approx(SHOWN_RAISE_M, abs=0.01)
    again = Show(OPTIONS)
    frames_of(again, Showing.EMPTY, 2)
    second = frames_of(again, Showing.RAISED, 2)
    assert all(same(one, other) for one, other in zip(higher, second, strict=True))
    assert raised_px(frames_of(show, Showing.EMPTY, 2)[0], empty[0]) < 2000, "they are where they were again"


def belt_of(frame: Frame) -> F64:
    """Return the a of the belt's plane, 1/z = a·(x, y, 1), as a frame shows it."""
    belt = see_belt(average([frame]))
    assert belt is not None
    return belt.coefficients
