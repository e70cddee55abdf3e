"""Kinects that take turns see each fruit in short bursts with long gaps: all of them are counted once, and measured."""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from fruitgui.perception.perceiver import Perceiver
from fruitgui.sensors.sensor import Projector
from fruitgui.sensors.turns import Schedule
from fruitgui.simulation import scenes
from fruitgui.simulation.simulated import sensor_info
from fruitgui.simulation.simulation import Capture, Simulation
from fruitgui.station.turn_plan import overlapping, seen_length_m, turn_plan
from fruitgui.tracking.track import Track
from fruitgui.tracking.tracker import Tracker
from tests.accuracy.test_measurement import Measured, as_registered, errors, measured_tracks, say

pytestmark = pytest.mark.accuracy

RATE_HZ = 30.0
FRUIT = 18


def test_fruit_are_counted_once_and_measured_at_the_speed_that_turns_allow() -> None:
    for seed, speed_m_s in ((43, 0.25), (43, None), (50, None), (56, None), (61, None)):
        sim, tracks, highest_m_s = followed(speed_m_s, seed)
        found = measured_tracks(sim, as_registered(sim), tracks)
        counted = Counter(one.true.fruit_id for one in found)
        say(f"taking turns, seed {seed}, {speed_m_s or highest_m_s:.2f} m/s", errors(found))
        assert len(tracks) == FRUIT
        assert set(counted.values()) == {1}
        assert len(counted) == FRUIT
        for track in tracks:
            views = Counter(one.view.sensor for one in track.sightings)
            assert min(views[sensor] for sensor in sim.sensors) >= 3, views
        assert volume_error(found) < 0.06


def followed(speed_m_s: float | None, seed: int) -> tuple[Simulation, list[Track], float]:
    """Return a line, the fruit that were followed on it, and the highest speed that the turns of its sensors allow."""
    still = scenes.line_scene(seed, FRUIT, 0.25)
    infos = {
        name: replace(sensor_info(still, name), rate_hz=RATE_HZ, projector=Projector.SWITCHED) for name in still.sensors
    }
    rig = still.rig()
    plan = turn_plan(infos, {name: seen_length_m(info.intrinsics, None) for name, info in infos.items()}, rig)
    assert plan.takes_turns
    assert overlapping(rig)
    sim = scenes.line_scene(seed, FRUIT, plan.highest_speed_m_s if speed_m_s is None else speed_m_s)
    ends_s = max(one.time_s for one in sim.captures)
    sim = Simulation(replace(sim.scene, captures=tuple(kept(plan.schedule, ends_s))))
    rig = as_registered(sim)
    eyes = {name: Perceiver(name, mount.intrinsics, mount.surface) for name, mount in rig.mounts.items()}
    tracker, tracks = Tracker(rig), []
    for frame in sim.frames():
        tracks += tracker.update(eyes[frame.sensor].observe(frame, frame.time_s))
    return sim, [*tracks, *tracker.finish()], plan.highest_speed_m_s


def kept(schedule: Schedule, ends_s: float) -> Iterator[Capture]:
    """Yield what is kept of turns that follow each other without a pause: pictures in light that has settled."""
    at_s = 0.0
    while at_s < ends_s:
        for slot in schedule.slots:
            for sensor in slot:
                light = schedule.lights[sensor]
                lasts_s = light.turn_s(schedule.views)
                yield from (
                    Capture(at_s + lasts_s - (schedule.views - 1 - view) * light.period_s, sensor)
                    for view in range(schedule.views)
                )
            at_s += max(schedule.lights[sensor].turn_s(schedule.views) for sensor in slot)


def volume_error(found: list[Measured]) -> float:
    return float(np.abs(errors(found)[:, 0]).mean())


if __name__ == "__main__":
    first, last, *speeds = map(float, sys.argv[1:])
    for number in range(int(first), int(last)):
        for wanted in speeds:
            line, ways, highest = followed(wanted or None, number)
            there = measured_tracks(line, as_registered(line), ways)
            text = f"seed {number}, {wanted or highest:.2f} m/s of {highest:.2f}: {len(ways)} tracks of {FRUIT} fruit"
            say(f"{text}, {len({one.true.fruit_id for one in there})} distinct", errors(there))
