"""Scenes: the same seed gives the same frames; time, turns and layouts are as asked."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fruitgui.errors import InputError
from fruitgui.frame import F64, Frame, Intrinsics
from fruitgui.simulation import scenes
from fruitgui.simulation.layouts import LAYOUTS
from fruitgui.simulation.motion import stop_and_start
from fruitgui.simulation.simulation import Simulation

SMALL = Intrinsics(320, 240, 262.5, 262.5, 159.5, 119.5)
QUICK = scenes.Conditions(camera=SMALL)


def same(first: Frame, second: Frame) -> bool:
    pixels = np.array_equal(first.color, second.color) and np.array_equal(first.depth_mm, second.depth_mm)
    return pixels and first.time_s == second.time_s and first.sequence == second.sequence


def overlap_share(sim: Simulation, first: str, second: str) -> float:
    """Return the share of the first sensor's points of belt that the second has in its picture."""
    rig = sim.rig()
    grid = np.stack(np.meshgrid(np.linspace(-4, 6, 200), np.linspace(-0.25, 0.25, 11), [0.0]), axis=-1).reshape(-1, 3)
    seen = [_seen(sim, sensor, grid) for sensor in (first, second)]
    assert set(rig.mounts) == set(sim.sensors)
    return float((seen[0] & seen[1]).sum() / max(seen[0].sum(), 1))


def _seen(sim: Simulation, sensor: str, world_m: F64) -> np.ndarray:
    device = sim.device(sensor)
    points = device.pose.inverse().apply(world_m)
    pixels = device.depth_camera.project(np.where(points[:, 2:] > 0.1, points, [0.0, 0.0, 1.0]))
    return (points[:, 2] > 0.1) & (pixels > 0).all(axis=1) & (pixels < (device.depth_camera.width, 240)).all(axis=1)


def test_the_same_seed_gives_the_same_frames_in_any_order() -> None:
    first, second = (scenes.still_scene(4, fruit=6, captures=2, conditions=QUICK) for _ in range(2))
    forward = list(first.frames())
    backward = [second.frame(number) for number in (3, 2, 1, 0)][::-1]
    assert len(forward) == 4
    assert all(same(one, other) for one, other in zip(forward, backward, strict=True))
    assert not np.array_equal(forward[0].depth_mm, forward[2].depth_mm)
    assert not np.array_equal(forward[0].color, scenes.still_scene(5, fruit=6, conditions=QUICK).frame(0).color)


def test_one_rig_on_two_days() -> None:
    one = scenes.still_scene(1, rig_seed=7, fruit=5, conditions=replace(QUICK, scale_error=0.006))
    two = scenes.line_scene(2, rig_seed=7, fruit=5, conditions=replace(QUICK, scale_error=0.006))
    for first, second in zip(one.scene.devices, two.scene.devices, strict=True):
        np.testing.assert_array_equal(first.pose.matrix, second.pose.matrix)
        assert first.depth_model == second.depth_model
        assert first.color_model == second.color_model
        assert first.serial == second.serial
    assert one.scene.surroundings.belt.colour == two.scene.surroundings.belt.colour
    assert one.scene.light != two.scene.light
    assert one.truth.fruit[0].volume_m3 != two.truth.fruit[0].volume_m3


def test_seeds_vary_everything() -> None:
    sims = [scenes.still_scene(seed, fruit=3, conditions=replace(QUICK, scale_error=0.006)) for seed in range(8)]
    assert len({sim.scene.surroundings.belt.colour for sim in sims}) == 8
    assert len({sim.scene.light.lux for sim in sims}) == 8
    assert len({sim.scene.surroundings.belt.width_m for sim in sims}) == 8
    errors = [device.depth_model.scale_error for sim in sims for device in sim.scene.devices]
    assert max(map(abs, errors)) <= 0.006
    assert np.std(errors) > 0.002
    assert len({device.depth_model.fattening_px for sim in sims for device in sim.scene.devices}) == 16


@pytest.mark.parametrize(
    ("layout", "count"), [("single", 1), ("opposed", 2), ("chain", 3), ("ring", 4), ("ring", 6), ("scattered", 5)]
)
def test_layouts_have_their_sensors_and_see_the_fruit(layout: str, count: int) -> None:
    for seed in range(2 if count < 4 else 1):
        sim = scenes.still_scene(seed, layout, 15, sensors=count, captures=1, conditions=QUICK)
        assert len(sim.sensors) == count
        assert len(sim.captures) == count
        heights_m = [device.pose.translation_m[2] for device in sim.scene.devices]
        assert all(0.6 < height < 1.7 for height in heights_m)
        for capture in sim.captures:
            who = sim.eye(capture.sensor).who(sim.in_sight(capture))
            assert len(np.unique(who)) > 2


def test_a_chain_is_linked_through_its_middle() -> None:
    for seed in range(6):
        sim = scenes.still_scene(seed, "chain", 3, conditions=QUICK)
        order = sorted(sim.scene.devices, key=lambda device: float(device.pose.translation_m[0]))
        left, middle, right = (device.sensor for device in order)
        assert overlap_share(sim, left, middle) > 0.2
        assert overlap_share(sim, right, middle) > 0.2
        assert overlap_share(sim, left, right) < 0.2


def test_disconnected_sensors_share_nothing() -> None:
    sim = scenes.still_scene(3, "disconnected", 9, conditions=QUICK)
    first, *_, last = sim.sensors
    assert overlap_share(sim, first, last) == 0
    with pytest.raises(InputError) as error:
        scenes.still_scene(1, "pyramid")
    assert all(name in error.value.remedy for name in LAYOUTS)


def test_sensors_take_turns() -> None:
    sim = scenes.line_scene(3, 4, captures_hz=10.0, conditions=QUICK)
    times_s = np.array([capture.time_s for capture in sim.captures])
    gaps_s = np.diff(times_s)
    assert gaps_s.min() > 0.085
    assert gaps_s.max() < 0.115
    sensors = [capture.sensor for capture in sim.captures]
    assert sensors[:4] == ["kinect_1", "kinect_2", "kinect_1", "kinect_2"]
    numbers = [sim.frame(n).sequence for n in (0, 1, 2, 3)]
    assert numbers == [0, 0, 1, 1]


def test_silence_loss_and_clocks() -> None:
    conditions = replace(QUICK, clock_offset_s=1.0, drop_share=0.2)
    sim = scenes.line_scene(6, 5, silent=[(1, 3.0, 5.0)], conditions=conditions)
    from_second = [capture.time_s for capture in sim.captures if capture.sensor == "kinect_2"]
    assert not [time_s for time_s in from_second if 3.0 <= time_s < 5.0]
    assert [capture for capture in sim.captures if capture.sensor == "kinect_1" and 3.0 <= capture.time_s < 5.0]
    turns = sim.captures[-1].time_s * 10
    assert 0.6 < len(sim.captures) / turns < 0.9
    assert sim.device("kinect_1").clock_offset_s == 0.0
    number = next(n for n, capture in enumerate(sim.captures) if capture.sensor == "kinect_2")
    offset_s = sim.device("kinect_2").clock_offset_s
    assert offset_s != 0.0
    assert sim.frame(number).time_s + offset_s == pytest.approx(sim.captures[number].time_s)


def test_a_line_begins_and_ends_empty_and_moves_as_told() -> None:
    sim = scenes.line_scene(9, 8, speed_m_s=0.2, restless=0.0, conditions=QUICK)
    for number in (0, 1, -2, -1):
        capture = sim.captures[number]
        assert (sim.eye(capture.sensor).who(sim.in_sight(capture)) < 0).all()
    for thing in sim.truth.fruit:
        moved = sim.truth.position_m(thing.fruit_id, 7.0) - sim.truth.position_m(thing.fruit_id, 2.0)
        np.testing.assert_allclose(moved, 5.0 * sim.truth.velocity_m_s(3.0), atol=1e-9)
    assert np.linalg.norm(sim.truth.velocity_m_s(0.0)) == pytest.approx(0.2)
    assert abs(sim.truth.velocity_m_s(0.0) @ sim.rig().belt().normal) < 1e-9


def test_a_line_may_stop() -> None:
    sim = scenes.line_scene(9, 5, speed=stop_and_start(0.2, 4.0, 3.0), conditions=QUICK)
    assert np.linalg.norm(sim.truth.velocity_m_s(5.5)) == 0.0
    still = sim.truth.position_m(1, 6.9) - sim.truth.position_m(1, 4.5)
    # rocking goes on by itself
    assert np.linalg.norm(still) < 0.03
    assert sim.captures[-1].time_s > 3.0 + 1.5 / 0.2


def test_foreign_objects_and_fruit_nobody_trained() -> None:
    sim = scenes.line_scene(2, 10, foreign=4, foreign_kinds=("orange", "pear", "stone"), conditions=QUICK)
    strange = [thing for thing in sim.truth.fruit if thing.foreign]
    assert len(strange) == 4
    assert {thing.kind for thing in strange} <= {"orange", "pear", "stone"}
    assert sorted(thing.fruit_id for thing in sim.truth.fruit) == list(range(1, 15))


def test_something_moves_between_the_captures() -> None:
    sim = scenes.still_scene(2, fruit=9, moved_m=0.03, conditions=QUICK)
    early_s, late_s = sim.captures[0].time_s, sim.captures[-1].time_s
    gaps = [
        np.linalg.norm(sim.truth.position_m(t.fruit_id, late_s) - sim.truth.position_m(t.fruit_id, early_s))
        for t in sim.truth.fruit
    ]
    assert sum(gap > 0.015 for gap in gaps) >= 3
    assert any(gap == 0 for gap in gaps)


@pytest.mark.parametrize(("pattern", "count"), [("row", 7), ("grid", 28)])
def test_equal_spheres(pattern: str, count: int) -> None:
    sim = scenes.sphere_scene(1, pattern, conditions=QUICK)
    assert len(sim.truth.fruit) == count
    assert len({round(thing.volume_m3 * 1e12) for thing in sim.truth.fruit}) == 1


def test_a_bare_belt_has_no_fruit_and_has_depth() -> None:
    bare = scenes.bare_belt(1, conditions=QUICK)
    assert bare.truth.fruit == ()
    assert (bare.frame(0).depth_mm > 0).mean() > 0.5


@pytest.mark.parametrize("size", [(424, 240), (848, 480)])
def test_other_resolutions(size: tuple[int, int]) -> None:
    width, height = size
    camera = Intrinsics(width, height, 0.82 * width, 0.82 * width, width / 2 - 0.5, height / 2 - 0.5)
    frame = scenes.still_scene(1, "single", 4, captures=1, conditions=scenes.Conditions(camera=camera)).frame(0)
    assert frame.depth_mm.shape == (height, width)
    assert frame.color.shape == (height, width, 3)
    assert frame.intrinsics == camera
    assert (frame.depth_mm > 0).mean() > 0.4


def test_placements_for_calibrating() -> None:
    sims = [scenes.placement_scene(seed, captures=1, conditions=QUICK) for seed in range(3)]
    assert [len(sim.sensors) for sim in sims] == [2, 3, 4]
    assert all(8 <= len(sim.truth.fruit) <= 26 for sim in sims)
    assert all(sim.scene.surroundings.blocks for sim in sims)
