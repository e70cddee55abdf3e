"""Counting and paths on simulated frames seen through perception: true poses, so that tracking answers for itself."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from fruitgui.frame import F64
from fruitgui.perception.perceiver import Perceiver
from fruitgui.simulation import scenes
from fruitgui.simulation.motion import stop_and_start
from fruitgui.simulation.simulation import Simulation
from fruitgui.tracking.track import Track
from fruitgui.tracking.tracker import Tracker

pytestmark = pytest.mark.accuracy

SAME_M = 0.05
"""A path farther than this from every fruit's true centre belongs to none."""

ABOUT_M = 0.5
"""A fruit that was this far from a path amid it is not the one it is of."""


@dataclass(frozen=True)
class Outcome:
    """How often each fruit was counted, and the squared normalised errors of all path points."""

    counts: dict[int, int]
    strangers: int
    squared: F64
    speed_m_s: float


def run(simulation: Simulation) -> Outcome:
    rig = simulation.rig()
    eyes = {sensor: Perceiver(sensor, mount.intrinsics, mount.surface) for sensor, mount in rig.mounts.items()}
    tracker = Tracker(rig)
    tracks: list[Track] = []
    for frame in simulation.frames():
        tracks += tracker.update(eyes[frame.sensor].observe(frame, frame.time_s))
    tracks += tracker.finish()
    motion = tracker.belt
    assert motion is not None
    counts = {fruit.fruit_id: 0 for fruit in simulation.truth.fruit}
    squared: list[float] = []
    strangers = 0
    for track in tracks:
        apart = {fruit: errors(track, simulation, fruit) for fruit in counts if is_about(track, simulation, fruit)}
        nearest = min(apart, key=lambda fruit: float(np.median(np.linalg.norm(apart[fruit], axis=1))), default=None)
        if nearest is None or np.median(np.linalg.norm(apart[nearest], axis=1)) > SAME_M:
            strangers += 1
            continue
        counts[nearest] += 1
        covariances = np.array([point.covariance_m2 for point in track.path])
        squared += np.einsum("ki,kij,kj->k", apart[nearest], np.linalg.inv(covariances), apart[nearest]).tolist()
    return Outcome(counts, strangers, np.array(squared), motion.speed_m_s)


def is_about(track: Track, simulation: Simulation, fruit: int) -> bool:
    """Tell whether a fruit was within some lengths of it amid a track; what was not is no nearest one."""
    amid = track.path[len(track.path) // 2]
    return float(np.linalg.norm(amid.position_m - simulation.truth.position_m(fruit, amid.time_s))) < ABOUT_M


def errors(track: Track, simulation: Simulation, fruit: int) -> F64:
    """Return path minus truth at each of the path's k points, (k, 3)."""
    return np.array([point.position_m - simulation.truth.position_m(fruit, point.time_s) for point in track.path])


def assert_each_once(outcome: Outcome) -> None:
    assert {fruit: count for fruit, count in outcome.counts.items() if count != 1} == {}
    assert outcome.strangers == 0


def test_sixty_fruit_fast_none_lost_none_double_and_paths_are_honest() -> None:
    outcome = run(scenes.line_scene(seed=211, fruit=60, speed_m_s=0.4))
    assert_each_once(outcome)
    assert outcome.speed_m_s == pytest.approx(0.4, rel=0.02)
    # χ²(3): 95 % lie below 7.81; errors of one fruit's path are correlated, so the share is loose.
    assert np.mean(outcome.squared < 7.81) > 0.88
    assert np.mean(outcome.squared) < 2.0 * 3.0


def test_a_third_touching_miscounts_at_most_two_in_a_hundred() -> None:
    outcome = run(scenes.line_scene(seed=212, fruit=50, speed_m_s=0.3, touching=0.33))
    wrong = sum(abs(count - 1) for count in outcome.counts.values()) + outcome.strangers
    assert wrong <= 1


def test_a_sensor_silent_for_some_seconds_loses_and_doubles_nothing() -> None:
    outcome = run(scenes.line_scene(seed=213, fruit=30, speed_m_s=0.3, silent=((1, 4.0, 7.0),)))
    assert_each_once(outcome)


def test_a_belt_that_stops_and_starts() -> None:
    outcome = run(scenes.line_scene(seed=214, fruit=24, speed=stop_and_start(0.3, 4.0, 2.0)))
    assert_each_once(outcome)
