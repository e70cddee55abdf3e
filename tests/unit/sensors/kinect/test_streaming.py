"""Emulated Kinects that stream by themselves, through the feed: as on a packing floor, with what happens there."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from pathlib import Path

from fruitgui.sensors.feed import Arrival, ByCapture, Feed, Running, Subscription
from fruitgui.sensors.kinect.driver import KinectDriver
from fruitgui.station.sources import DevicesSource, devices_of
from tests.emulated_usb.emulation import Emulation, Hang, Kinect
from tests.emulated_usb.outside import inside, run_command
from tests.emulated_usb.player import Fault, Player

HOLD_MS = 2000
"""On a busy machine the bus waits for the host; what a real one loses then is tested where it is asked for."""


def until(true: Callable[[], bool], within_s: float = 180.0) -> None:
    end_s = time.monotonic() + within_s
    while not true():
        assert time.monotonic() < end_s, "it did not happen in time"
        time.sleep(0.01)


def taken(queue: Subscription) -> Iterator[Arrival]:
    """Give what waits in a queue that was closed."""
    while (arrival := queue.take(1.0)) is not None:
        yield arrival


@inside
def test_what_is_plugged_in_is_found_connected_and_runs(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"), Kinect("B2"))
    driver = KinectDriver()
    (source,) = devices_of(lambda: [driver]).find()
    assert source.name == "2 kinect"
    feed = Feed(source.connect().sensors)
    assert feed.sensors == ("kinect_1", "kinect_2")
    with Player(usb, wait_ms=HOLD_MS):
        feed.start()
        until(lambda: all(feed.health(name).frames > 12 for name in feed.sensors))
        assert all(feed.health(name).state is Running.RUNNING for name in feed.sensors)
        assert feed.stop() == ()


@inside
def test_times_are_believed_after_a_while_and_frames_leave_in_their_order(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"), Kinect("B2"))
    driver = KinectDriver()
    feed = Feed([driver.sensor("A1"), driver.sensor("B2")])
    ordered, as_they_came = feed.subscribe(300, ByCapture({})), feed.subscribe(300)
    with Player(usb, wait_ms=HOLD_MS):
        feed.start()
        until(lambda: all((newest := feed.newest(name)) and newest.time_sure for name in feed.sensors))
        assert feed.stop() == ()
    in_order, all_of_them = ([one.frame for one in taken(queue)] for queue in (ordered, as_they_came))
    assert [one.time_s for one in in_order] == sorted(one.time_s for one in in_order)
    for name in feed.sensors:
        own = [one for one in all_of_them if one.sensor == name]
        sure = [one.sequence for one in own if one.time_sure]  # all, where colour came long before its first turn
        assert sure
        assert [one.sequence for one in in_order if one.sensor == name] == sure


@inside
def test_one_that_is_unplugged_comes_back_by_itself(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"), Kinect("B2"))
    driver = KinectDriver()
    source = DevicesSource(tuple(devices_of(lambda: [driver]).find()[0].devices), lambda: [driver])  # type: ignore[attr-defined]
    feed = Feed(source.connect().sensors)
    with Player(usb, wait_ms=HOLD_MS) as player:
        feed.start()
        until(lambda: all(feed.health(name).frames > 5 for name in feed.sensors))
        player.do(Fault(0.0, "unplug", 1))
        until(lambda: feed.health("kinect_2").state is Running.FAILED)
        error = feed.health("kinect_2").error
        assert error is not None
        assert error.code == "sensor_gone"
        frames = feed.health("kinect_1").frames
        until(lambda: feed.health("kinect_1").frames > frames + 10)
        frames = feed.health("kinect_2").frames
        player.do(Fault(0.0, "plug_in", 1))
        until(lambda: feed.health("kinect_2").frames > frames + 10)
        assert feed.stop() == ()


@inside
def test_a_feed_whose_sensor_hangs_stops_and_names_it(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"), Kinect("B2"))
    driver = KinectDriver()
    feed = Feed([driver.sensor("A1"), driver.sensor("B2")])
    with Player(usb, wait_ms=HOLD_MS) as player:
        feed.start()
        until(lambda: all(feed.health(name).frames > 5 for name in feed.sensors))
        player.do(Fault(0.0, "hang", 0, Hang.EVENTS))
        until(lambda: feed.health("kinect_A1").state in (Running.SILENT, Running.FAILED))
        left = feed.stop()
        assert set(left) <= {"kinect_A1"}
        player.do(Fault(0.0, "unplug", 0))


def test_a_command_runs_among_kinects_that_stream() -> None:
    done = run_command({"kinects": [{"serial": "A1"}]}, "--version")
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("fruitgui ")
