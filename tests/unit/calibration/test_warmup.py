"""Depth that drifts after a start, and light that changes, seen on the bare belt."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from fruitgui.calibration.bare_belt import BeltPatch, first_patch, read_belt
from fruitgui.calibration.light_drift import light_drift
from fruitgui.calibration.warmup import Warmth, warmup
from fruitgui.frame import F64, Frame
from fruitgui.simulation.scenes import still_scene
from tests.unit.calibration.drift import Drift, drifted

LOOK_S = 6.0
DISTANCE_M = 1.0


@cache
def _frames() -> tuple[Frame, ...]:
    scene = still_scene(5, "single", 8, captures=6)
    return tuple(scene.frames())


def _at(time_s: float, drift: Drift) -> Frame:
    frame = _frames()[int(time_s) % len(_frames())]
    return drifted(replace(frame, time_s=time_s, sequence=int(10 * time_s)), drift)


def _patch(drift: Drift) -> BeltPatch:
    patch = first_patch([_at(0.1 * n, drift) for n in range(3)])
    assert patch is not None
    return patch


def _looks(minutes: float) -> F64:
    return np.arange(0.0, 60.0 * minutes, LOOK_S)


def test_the_belt_is_read_to_a_tenth_of_a_millimetre_whatever_lies_on_it() -> None:
    drift = Drift(warming=0.006, warming_s=600.0)
    patch = _patch(drift)
    about_m = 0.0
    for time_s in (60.0, 300.0, 900.0, 2400.0):
        reading = read_belt(_at(time_s, drift), patch, about_m)
        assert reading is not None
        true_m = patch.distance_m * (drift.depth_scale(time_s) / drift.depth_scale(0.1) - 1.0)
        assert reading.off_m == pytest.approx(true_m, abs=0.0003)
        about_m = reading.off_m


def test_a_belt_that_is_covered_or_gone_is_not_read() -> None:
    patch = _patch(Drift())
    frame = _at(5.0, Drift())
    covered = replace(frame, depth_mm=np.where(frame.depth_mm > 0, frame.depth_mm - 60, 0).astype(np.uint16))
    assert read_belt(covered, patch) is None
    assert read_belt(replace(frame, depth_mm=np.zeros_like(frame.depth_mm)), patch) is None


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize(("drift_mm", "constant_min"), [(6.0, 10.0), (10.0, 20.0), (-4.0, 15.0)])
def test_steady_is_said_when_little_is_left_and_not_before(drift_mm: float, constant_min: float, seed: int) -> None:
    times = _looks(120)
    left_m = 1e-3 * drift_mm * np.exp(-times / (60.0 * constant_min))
    offs = left_m - left_m[0] + np.random.default_rng(seed).normal(0, 1e-4, len(times))
    states = [warmup(times[:n], offs[:n], DISTANCE_M) for n in range(20, len(times), 10)]
    first = next(n for n, one in zip(range(20, len(times), 10), states, strict=True) if one.state is Warmth.STEADY)
    assert abs(left_m[first]) < 1.5e-3, "what is left is about the tolerance"
    assert times[first] < 60.0 * 6 * constant_min, "and it does come"
    assert warmup(times[:45], offs[:45], DISTANCE_M).state is Warmth.DRIFTING
    last = states[-1]
    assert last.state is Warmth.STEADY
    assert last.since_s == pytest.approx(times[-1] - times[first], abs=900.0)
    assert last.drifted_m == pytest.approx(-1e-3 * drift_mm, rel=0.15)


@pytest.mark.parametrize("seed", range(10))
def test_a_steady_sensor_is_steady_after_some_minutes_and_stays_so(seed: int) -> None:
    times = _looks(90)
    offs = np.random.default_rng(seed).normal(0, 1.5e-4, len(times))
    assert warmup(times[:25], offs[:25], DISTANCE_M).state is Warmth.UNKNOWN
    states = {warmup(times[:n], offs[:n], DISTANCE_M).state for n in range(60, len(times), 7)}
    assert states == {Warmth.STEADY}
    assert warmup(times, offs, DISTANCE_M).since_s > 3600.0


def test_a_jump_is_not_steady_until_it_is_minutes_ago() -> None:
    times = _looks(40)
    offs = np.where(times > 1800.0, 0.008, 0.0)
    at = [int((1800.0 + later) / LOOK_S) for later in (180.0, 540.0)]
    after = [warmup(times[:n], offs[:n], DISTANCE_M) for n in at]
    assert [one.state for one in after] == [Warmth.DRIFTING, Warmth.STEADY]
    assert after[1].since_s < 600.0


def test_nothing_is_said_before_anything_was_seen() -> None:
    assert warmup([], [], 1.0).state is Warmth.UNKNOWN
    assert warmup([3.0], [0.0], 1.0).state is Warmth.UNKNOWN
    gap = warmup([0.0, 6.0, 7000.0], [0.0, 0.0, 0.001], 1.0)
    assert gap.state is Warmth.UNKNOWN, "two minutes out of two hours are not enough"


@pytest.mark.parametrize(
    ("light", "bright", "white"),
    [
        ((1.0, 1.0, 1.0), False, False),
        ((1.15, 1.15, 1.15), False, False),
        ((1.6, 1.6, 1.6), True, False),
        ((0.6, 0.6, 0.6), True, False),
        ((1.25, 1.0, 0.85), False, True),
        ((1.05, 1.0, 0.97), False, False),
    ],
)
def test_light_that_changes_is_seen_on_the_belt(light: tuple[float, float, float], bright: bool, white: bool) -> None:
    drift = Drift(light_from_s=100.0, light=light)
    patch = _patch(Drift())
    readings = [read_belt(_at(time_s, drift), patch) for time_s in (*range(0, 60, 6), *range(120, 180, 6))]
    lights = [reading.light for reading in readings if reading is not None and reading.light is not None]
    assert len(lights) == len(readings)
    told = light_drift(lights[:10], lights[10:])
    assert told is not None
    assert (told.brightness_off, told.white_off) == (bright, white)
    assert told.brightness == pytest.approx(0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2], rel=0.08)


def test_too_few_looks_say_nothing_of_the_light() -> None:
    assert light_drift([(0.1, 0.1, 0.1)] * 3, [(0.5, 0.5, 0.5)] * 9) is None
