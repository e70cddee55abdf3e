"""Sensors that run are watched: warm or not, and whether their light is as it was."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from fruitgui.calibration.warmup import Warmth
from fruitgui.frame import Frame
from fruitgui.sensors.feed import Feed
from fruitgui.sensors.sensor import SensorInfo
from fruitgui.simulation.scenes import still_scene
from fruitgui.simulation.simulated import sensor_info
from fruitgui.station.steadiness import LOOK_S, MISSED_LOOKS, SensorSteadiness, SteadinessWatch
from tests.unit.calibration.drift import Drift, drifted


@cache
def _shown() -> tuple[tuple[Frame, ...], SensorInfo]:
    scene = still_scene(5, "single", 6, captures=4)
    return tuple(scene.frames()), sensor_info(scene, "kinect_1")


def _frame(number: int, time_s: float, drift: Drift) -> Frame:
    frames, _ = _shown()
    return drifted(replace(frames[number % len(frames)], sequence=number, time_s=time_s), drift)


def _watched(minutes: float, drift: Drift) -> SensorSteadiness:
    watched = SensorSteadiness()
    for number in range(int(60 * minutes / 2)):
        watched.see(_frame(number, 2.0 * number, drift))
    return watched


def test_a_sensor_that_warms_up_drifts_and_then_is_steady() -> None:
    drift = Drift(warming=0.008, warming_s=300.0)
    early, late = _watched(8, drift).now.warmup, _watched(45, drift).now.warmup
    assert (early.state, late.state) == (Warmth.DRIFTING, Warmth.STEADY)
    assert early.rate_m_s is not None
    assert early.rate_m_s < 0.0 < late.since_s
    assert late.drifted_m == pytest.approx(-0.008, abs=0.003)


def test_light_that_changes_is_noticed_and_light_that_stays_is_not() -> None:
    steady = _watched(8, Drift()).now.light
    darker = _watched(8, Drift(light_from_s=300.0, light=(0.5, 0.5, 0.5))).now.light
    assert steady is not None
    assert darker is not None
    assert not steady.brightness_off
    assert not steady.white_off
    assert darker.brightness_off
    assert not darker.white_off


def test_a_clock_that_runs_backwards_begins_anew() -> None:
    watched = _watched(8, Drift())
    assert watched.now.warmup.state is not Warmth.UNKNOWN
    watched.see(_frame(9000, 1.0, Drift()))
    assert watched.now.warmup.state is Warmth.UNKNOWN
    assert watched.now.warmup.watched_s == 0.0


def test_a_belt_that_went_elsewhere_is_looked_for_anew() -> None:
    watched = _watched(8, Drift())
    frame = _frame(0, 0.0, Drift())
    far = replace(frame, depth_mm=np.where(frame.depth_mm > 0, frame.depth_mm * 1.2, 0).astype(np.uint16))
    for number in range(MISSED_LOOKS + 40):
        watched.see(replace(far, sequence=20_000 + number, time_s=1000.0 + LOOK_S * number))
    assert watched.now.warmup.watched_s > 0.0
    assert abs(watched.now.warmup.drifted_m) < 0.001


def _from_afar(frame: Frame, times: float = 1.2) -> Frame:
    return replace(frame, depth_mm=np.where(frame.depth_mm > 0, frame.depth_mm * times, 0).astype(np.uint16))


def _hung(watched: SensorSteadiness, times: float, from_s: float, minutes: float, drift: Drift) -> None:
    """Let a sensor see the belt from so many times as far."""
    for number in range(int(60 * minutes / LOOK_S)):
        time_s = from_s + LOOK_S * number
        watched.see(_from_afar(_frame(number + int(from_s), time_s, drift), times))


def test_a_sensor_that_is_raised_for_long_and_put_back_is_as_warm_as_it_was() -> None:
    watched = _watched(20, Drift())
    before = watched.now.warmup
    assert before.state is Warmth.STEADY
    _hung(watched, 1.2, 1200.0, 4.0, Drift())
    raised = watched.now.warmup
    assert raised.state is Warmth.STEADY, "nobody has to wait because of a ladder"
    assert raised.since_s > before.since_s + 60.0
    _hung(watched, 1.2, 1440.0, 6.0, Drift())
    assert watched.now.warmup.state is Warmth.STEADY, "seen from up there"
    assert watched.now.warmup.since_s > raised.since_s
    darker = Drift(light_from_s=0.0, light=(0.5, 0.5, 0.5))
    _hung(watched, 1.0, 1800.0, 1.5, darker)
    back = watched.now
    assert back.warmup.state is Warmth.STEADY
    assert back.warmup.since_s > raised.since_s
    assert back.light is not None
    assert back.light.brightness_off, "light is held to what it was at first from there"


def test_a_sensor_that_still_warms_up_says_so_from_a_second_height_too() -> None:
    drift = Drift(warming=0.008, warming_s=900.0)
    watched = _watched(8, drift)
    assert watched.now.warmup.state is Warmth.DRIFTING
    _hung(watched, 1.2, 480.0, 4.0, drift)
    assert watched.now.warmup.state is Warmth.DRIFTING
    assert watched.now.warmup.since_s == 0.0


def test_what_was_steady_and_drifts_at_another_height_is_not_called_steady() -> None:
    watched = _watched(20, Drift())
    for number in range(120):
        time_s = 1200.0 + LOOK_S * number
        creeping = 1.2 * (1.0 + 4e-6 * LOOK_S * number)
        watched.see(_from_afar(_frame(5000 + number, time_s, Drift()), creeping))
    assert watched.now.warmup.state is Warmth.DRIFTING


def test_frames_without_depth_do_no_harm() -> None:
    watched = SensorSteadiness()
    frames, _ = _shown()
    dark = replace(frames[0], depth_mm=np.zeros_like(frames[0].depth_mm))
    for number in range(40):
        watched.see(replace(dark, sequence=number, time_s=6.0 * number))
    assert watched.now.warmup.state is Warmth.UNKNOWN


class _Fast:
    """A sensor whose clock runs a hundred times too fast."""

    def __init__(self, drift: Drift) -> None:
        self._drift, self._next = drift, 0

    @property
    def info(self) -> SensorInfo:
        return _shown()[1]

    def open(self) -> None: ...

    def start(self) -> None: ...

    def read(self, timeout_s: float) -> Frame:  # noqa: ARG002
        time.sleep(0.02)
        self._next += 1
        return _frame(self._next, 3.0 * self._next, self._drift)

    def projector(self, on: bool) -> None: ...

    def stop(self) -> None: ...

    def close(self) -> None: ...


@pytest.fixture
def feed() -> Iterator[Feed]:
    made = Feed([_Fast(Drift())])
    made.start()
    yield made
    made.stop()


def _until(ready: Callable[[], bool], most_s: float = 60.0) -> None:
    end_s = time.monotonic() + most_s
    while not ready():
        assert time.monotonic() < end_s, "it did not come"
        time.sleep(0.02)


@pytest.mark.usefixtures("no_leaked_threads")
def test_the_watch_looks_beside_and_ends(feed: Feed, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("fruitgui.station.steadiness.BEGIN_S", 0.0)
    monkeypatch.setattr("fruitgui.station.steadiness.REST_S", 0.01)
    watch = SteadinessWatch(feed)
    watch.start()
    try:
        _until(lambda: watch.of("kinect_1").warmup.watched_s > 30.0)
        assert watch.of("nobody").warmup.state is Warmth.UNKNOWN
    finally:
        watch.stop()
        assert watch.wait(20.0)
