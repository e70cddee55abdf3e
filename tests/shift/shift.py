"""A shift: two emulated Kinects, the real library, the whole line, and what goes wrong on a packing floor."""

from __future__ import annotations

import gc
import threading
from dataclasses import dataclass
from pathlib import Path

import psutil

from fruitgui.heap import give_back, keep_few_heaps
from fruitgui.records.lot import LotPlan
from fruitgui.records.store import Store
from fruitgui.sensors.feed import Feed, Running
from fruitgui.sensors.kinect.driver import KinectDriver
from fruitgui.station.live import LIVE, Counting, LiveLine
from fruitgui.station.sources import DeviceId, DevicesSource
from fruitgui.station.waiting import BufferedSink
from tests.emulated_usb.emulation import Emulation, Kinect
from tests.emulated_usb.player import Player
from tests.shift import belt
from tests.shift.counted import Count, SeenSink, counted
from tests.shift.fast_time import FastTime
from tests.shift.given_out import given_out_mb
from tests.shift.mishaps import Mishap, mishaps
from tests.shift.watching import Watcher, unsaid

SERIALS = ("A1", "B2")
HOLD_MS = 2000
_BEGINNING_RATE, _BEGINNING_S = 0.05, 300.0
"""Libraries are loaded and tables made while the sensors open: that takes some seconds, and is not what is tested."""

_CALM_S, _GOVERN_S = 0.15, 0.1
_FASTER, _SLOWER = 1.03, 0.7
_MOST_WAITING = 6


@dataclass(frozen=True, slots=True)
class InUse:
    """What the process has.

    Attributes:
        memory_mb: that the C library gave out and did not get back. resident_mb: that the system gave the process.
        threads, files, usb: threads, file handles, handles of the emulated bus.
    """

    memory_mb: float
    resident_mb: float
    threads: int
    files: int
    usb: int


@dataclass(frozen=True, slots=True)
class Outcome:
    """How a shift went.

    Attributes:
        device_s, wall_s: how long it was, and how long it took.
        count: of the balls.
        told, kept: fruit that the store said it kept, and those that it has of the lot at the end.
        happened, unsaid: what went wrong, and what of it nobody said.
        frames, skipped: of the line.
        warnings: of the line, in words.
        leaps: of clocks, that the line warned of.
        quarter, end: what was in use after the first quarter, and at the end, both while it ran.
        threads_left: when all was stopped.
    """

    device_s: float
    wall_s: float
    count: Count
    told: int
    kept: int
    happened: tuple[Mishap, ...]
    unsaid: tuple[Mishap, ...]
    frames: int
    skipped: int
    warnings: tuple[str, ...]
    leaps: int
    quarter: InUse
    end: InUse
    threads_left: int


def run(usb: Emulation, seconds: float, seed: int, folder: Path) -> Outcome:
    """Run a shift of so many seconds of the devices' time; the process's clock is not to be trusted afterwards.

    Args:
        usb: the emulated bus.
        seconds: of the devices' time.
        seed: of the mishaps and of the balls.
        folder: empty, for the store.
    """
    keep_few_heaps()
    with Store(folder) as store:
        return _run(usb, seconds, seed, store)


def _run(usb: Emulation, seconds: float, seed: int, store: Store) -> Outcome:
    time = FastTime(_BEGINNING_RATE)
    time.install()
    real_s = time.real_s()
    usb.plug_in(*(Kinect(serial, registration=belt.FACTORY) for serial in SERIALS))
    happening = mishaps(seed, seconds, len(SERIALS))
    driver = KinectDriver(time.now_s)
    source = DevicesSource(tuple(DeviceId(driver.make, serial) for serial in SERIALS), lambda: [driver])
    feed, sink = Feed(source.connect().sensors), SeenSink(store)
    lot = store.lots.start(LotPlan("Shift")).key
    line = LiveLine(feed, belt.station(feed.sensors, SERIALS), None, Counting(BufferedSink(sink)), lot, LIVE)
    scene = belt.Belt(seed, lambda kinect, time_s: not any(one.troubles(kinect, time_s) for one in happening))
    player = Player(usb, scene, [fault for one in happening for fault in one.faults], HOLD_MS, seed)
    player.start()
    line.start()
    feed.start()
    watcher = Watcher(feed, time, player.began_s)
    watcher.start()
    began_s = _wait_for_sensors(feed, time)
    _govern(player, line, time, seconds / 4)
    quarter = _in_use(usb)
    _govern(player, line, time, seconds)
    end, ended_s = _in_use(usb), player.now_s
    watcher.stop()
    time.run_at(1.0)
    feed.stop()
    line.stop()
    player.stop()
    state = line.state
    return Outcome(
        ended_s,
        time.real_s() - real_s,
        counted(sink.seen, player.began_s, (began_s - player.began_s, ended_s), seed, scene.pictured),
        len(sink.seen),
        sum(one.fruit for one in store.lots.totals(lot)),
        tuple(happening),
        tuple(unsaid(happening, watcher.said)),
        state.frames,
        state.skipped,
        tuple(warning.text for warning in state.warnings),
        sum(warning.count for warning in state.warnings if warning.code == "clock_jumped"),
        quarter,
        end,
        _settled(time),
    )


def _wait_for_sensors(feed: Feed, time: FastTime) -> float:
    """Return when all sensors ran."""
    end_s = time.real_s() + _BEGINNING_S
    while any(feed.health(sensor).state is not Running.RUNNING for sensor in feed.sensors):
        assert time.real_s() < end_s, "the sensors did not start"
        time.really_sleep(_GOVERN_S)
    return time.now_s()


def _govern(player: Player, line: LiveLine, time: FastTime, until_s: float) -> None:
    """Let time run as fast as devices and line follow, until some time of the devices."""
    dropped = 0
    while player.now_s < until_s:
        state = line.state
        drops = sum(health.drops for health in state.health) + sum(state.dropped.values())
        behind = max(player.late_s) > _CALM_S or state.backlog > _MOST_WAITING or drops > dropped
        dropped = drops
        time.run_at(time.rate * (_SLOWER if behind else _FASTER))
        time.really_sleep(_GOVERN_S)


def _in_use(usb: Emulation) -> InUse:
    """Return what is in use, without what is only not given back."""
    gc.collect()
    give_back()
    process = psutil.Process()
    return InUse(
        given_out_mb(), process.memory_info().rss / 1e6, threading.active_count(), process.num_fds(), usb.left_open[0]
    )


def _settled(time: FastTime) -> int:
    end_s = time.real_s() + 20.0
    while threading.active_count() > 1 and time.real_s() < end_s:
        time.really_sleep(0.05)
    return threading.active_count()
