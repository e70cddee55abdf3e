from __future__ import annotations

from dataclasses import replace

import numpy as np

from fruitgui.calibration.still import average
from fruitgui.calibration.surface import fit_belt
from fruitgui.calibration.watch import belt_elsewhere, fruit_drift, plane_drift
from fruitgui.geometry.plane import Surface
from fruitgui.geometry.rig import Mount
from tests.unit.calibration.worlds import OPPOSED, frames_of, looking_at, scattered


def station_surface() -> Surface:
    belt = fit_belt(average(frames_of("left", OPPOSED["left"], scattered(1), seed=1)))
    assert belt is not None
    return belt.surface


def test_a_rig_that_stands_gives_no_alarm_whatever_lies_on_the_belt() -> None:
    surface = station_surface()
    for seed in range(2, 6):
        drift = plane_drift(frames_of("left", OPPOSED["left"], scattered(seed), seed=seed, count=3), surface)
        assert drift is not None
        assert not drift.stale


def test_a_bump_of_half_a_degree_is_seen() -> None:
    bumped = looking_at([0.05, -0.5, 1.0], [0.0, 0.012, 0.0])
    drift = plane_drift(frames_of("left", bumped, scattered(2), seed=2, count=3), station_surface())
    assert drift is not None
    assert drift.stale


def test_nothing_in_view_says_nothing() -> None:
    away = looking_at([0.0, 3.0, 1.0], [0.0, 6.0, 0.0])
    assert plane_drift(frames_of("left", away, [], seed=1, count=2), station_surface()) is None


def test_a_belt_that_is_nowhere_near_is_told_from_one_that_is_not_seen() -> None:
    surface = station_surface()
    frames = frames_of("left", OPPOSED["left"], scattered(2), seed=2, count=3)
    mount = Mount("left", OPPOSED["left"], surface, frames[0].intrinsics)
    assert surface.region_m is not None
    assert not belt_elsewhere(frames, mount)
    tenths = [replace(one, depth_mm=(10 * one.depth_mm.astype(np.uint32)).astype(np.uint16)) for one in frames]
    assert belt_elsewhere(tenths, mount)
    assert not belt_elsewhere(tenths, replace(mount, surface=Surface(surface.plane)))
    dark = [replace(one, depth_mm=np.zeros_like(one.depth_mm)) for one in frames]
    assert not belt_elsewhere(dark, mount)


def test_fruit_that_two_sensors_see_apart_are_an_alarm() -> None:
    rng = np.random.default_rng(0)
    covariances = np.tile(4e-6 * np.eye(3), (30, 1, 1))
    noise = rng.normal(0, 2e-3, (30, 3))
    same, moved = fruit_drift(noise, covariances), fruit_drift(noise + np.array([0.012, 0, 0]), covariances)
    assert same is not None
    assert moved is not None
    assert not same.stale
    assert moved.stale
    assert fruit_drift(noise[:3], covariances[:3]) is None
