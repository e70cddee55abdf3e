"""Kinects that take turns, on the real libfreenect over an emulated USB bus: by what their registers say."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from types import MappingProxyType

import psutil

from fruitgui.sensors.feed import Feed, Running
from fruitgui.sensors.kinect.clock import FRAME_TICKS
from fruitgui.sensors.kinect.driver import KinectDriver
from fruitgui.sensors.turns import Settling, lights_of, turns
from tests.emulated_usb import pictures
from tests.emulated_usb.emulation import DEPTH_ON, DEPTH_REGISTER, Emulation, Hang, Kinect, Written
from tests.emulated_usb.outside import inside
from tests.unit.sensors.scripted import until

LONG_S = 60.0
NONE: Mapping[int, float] = MappingProxyType({})
QUICK = Settling(0.05, 1)
LEFT, RIGHT = Kinect("A1"), Kinect("B2")


class Streaming:
    """Pushes pictures of both streams of every Kinect, thirty times a second."""

    def __init__(self, usb: Emulation) -> None:
        self._usb = usb
        self._stop = threading.Event()
        self._threads = [threading.Thread(target=self._run, args=(number,)) for number in range(len(usb.kinects))]

    def __enter__(self) -> None:
        for thread in self._threads:
            thread.start()

    def __exit__(self, *_: object) -> None:
        self._stop.set()
        for thread in self._threads:
            thread.join()

    def _run(self, number: int) -> None:
        count, grey, level = 0, pictures.grey(100), pictures.level(700)
        while not self._stop.wait(1 / 30):
            count += 1
            self._usb.push_video(number, grey, count * FRAME_TICKS, 0)
            self._usb.push_depth(number, level, count * FRAME_TICKS + 60_000, 0)


@contextmanager
def running(usb: Emulation, *kinects: Kinect) -> Iterator[Feed]:
    usb.plug_in(*kinects)
    driver = KinectDriver()
    sensors = [driver.sensor(one.serial) for one in kinects]
    infos = [sensor.info for sensor in sensors]
    settlings = dict.fromkeys((one.serial for one in kinects), QUICK)
    feed = Feed(sensors, turns(lights_of(infos, settlings), None))
    with Streaming(usb):
        feed.start()
        try:
            yield feed
        finally:
            for number in range(len(kinects)):
                usb.hang(number, Hang.NOTHING)
            feed.stop()


def clashes(
    log: list[Written],
    clash: Callable[[set[int]], bool] = lambda on: len(on) > 1,
    unplugged: Mapping[int, float] = NONE,
) -> int:
    """Return how often projectors were on together that may not be.

    Args:
        log: of the registers.
        clash: whether these may not.
        unplugged: when a Kinect lost its power, monotonic.
    """
    on: set[int] = set()
    times = 0
    for one in log:
        on -= {kinect for kinect, gone_s in unplugged.items() if one.time_s > gone_s}
        unplugged = {kinect: gone_s for kinect, gone_s in unplugged.items() if one.time_s <= gone_s}
        if one.register == DEPTH_REGISTER:
            (on.add if one.value == DEPTH_ON else on.discard)(one.kinect)
            times += clash(on)
    return times


def turns_of(log: list[Written], number: int) -> int:
    return sum(one.register == DEPTH_REGISTER and one.value == DEPTH_ON and one.kinect == number for one in log)


@inside
def test_projectors_alternate_and_are_never_on_together(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    with running(usb, LEFT, RIGHT) as feed:
        queue = feed.subscribe(1000)
        until(lambda: all(feed.health(one).frames > 15 for one in feed.sensors), LONG_S)
        seen = list(iter(lambda: queue.take(0.0), None))
    log = usb.log()
    assert clashes(log) == 0
    assert min(turns_of(log, number) for number in (0, 1)) > 4
    assert all(arrival.lit.settled for arrival in seen)
    assert not usb.shines(0)
    assert not usb.shines(1)


@inside
def test_four_see_the_same_belt(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    kinects = (LEFT, RIGHT, Kinect("C3"), Kinect("D4"))
    with running(usb, *kinects) as feed:
        until(lambda: all(feed.health(one).frames > 6 for one in feed.sensors), LONG_S)
        pairs = {frozenset((0, 1)), frozenset((2, 3))}
        infos = feed.infos
        lights = lights_of(infos.values(), dict.fromkeys(["A1", "B2", "C3", "D4"], QUICK))
        names = list(infos)
        assert clashes(usb.log()) == 0
        feed.take_turns(turns(lights, [(names[0], names[1]), (names[2], names[3])]))
        until(lambda: usb.shines(0) and usb.shines(2), LONG_S)
        before = {name: feed.health(name).frames for name in names}
        until(lambda: all(feed.health(name).frames > before[name] + 9 for name in names), LONG_S)
    assert clashes(usb.log(), lambda on: any(pair <= on for pair in pairs)) == 0


@inside
def test_one_is_unplugged_and_comes_back_by_its_serial(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    with running(usb, LEFT, RIGHT) as feed:
        left, right = feed.sensors
        until(lambda: all(feed.health(one).frames > 6 for one in feed.sensors), LONG_S)
        usb.plug(1, False)
        gone_s = time.monotonic()
        until(lambda: feed.health(right).state is Running.FAILED, LONG_S)
        noticed_s = time.monotonic() - gone_s
        error = feed.health(right).error
        assert error is not None
        assert error.code == "sensor_gone"
        before, turns_before = feed.health(left).frames, turns_of(usb.log(), 0)
        until(lambda: feed.health(left).frames > before + 40, LONG_S)
        assert turns_of(usb.log(), 0) <= turns_before + 1  # the turns of the other one are its own now
        usb.plug(1, True)
        until(lambda: feed.health(right).state is Running.RUNNING, LONG_S)
        again = feed.health(right).frames
        until(lambda: feed.health(right).frames > again + 6, LONG_S)
    assert clashes(usb.log(), unplugged={1: gone_s}) == 0
    assert noticed_s < 5.0  # some 0.1 s on a machine that has nothing else to do


@inside
def test_one_that_hangs_while_it_shines_is_named_and_the_other_goes_on(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    with running(usb, LEFT, RIGHT) as feed:
        left, right = feed.sensors
        until(lambda: all(feed.health(one).frames > 6 for one in feed.sensors), LONG_S)
        until(lambda: usb.shines(1), LONG_S)
        usb.hang(1, Hang.CONTROL)
        until(lambda: feed.health(left).blinded_by == (right,), LONG_S)
        before = feed.health(left).frames
        until(lambda: feed.health(left).frames > before + 20, LONG_S)


@inside
def test_a_hundred_starts_and_stops_leave_nothing(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(LEFT, RIGHT)
    driver, process = KinectDriver(), psutil.Process()

    def once() -> None:
        feed = Feed([driver.sensor("A1"), driver.sensor("B2")])
        feed.start()
        until(lambda: all(feed.health(one).state is not Running.STOPPED for one in feed.sensors), LONG_S)
        until(lambda: usb.shines(0) or usb.shines(1), LONG_S)
        assert feed.stop() == ()

    for _ in range(10):
        once()
    threads, files, bytes_before = process.num_threads(), process.num_fds(), process.memory_info().rss
    for _ in range(100):
        once()
    until(lambda: process.num_threads() <= threads, LONG_S)
    until(lambda: process.num_fds() <= files, LONG_S)
    assert process.memory_info().rss - bytes_before < 30e6
    assert usb.left_open[0] == usb.left_open[2] == 0
