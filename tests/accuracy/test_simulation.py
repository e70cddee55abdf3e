"""Whole simulated frames against the published figures of the sensor that they stand for."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fruitgui.frame import F64, Frame
from fruitgui.geometry.plane import Plane, fit_plane
from fruitgui.simulation import scenes
from fruitgui.simulation.body import Body
from fruitgui.simulation.fruit import KINDS, ball
from fruitgui.simulation.kinect import DepthModel
from fruitgui.simulation.simulation import Simulation

pytestmark = pytest.mark.accuracy


def belt_points(sim: Simulation, number: int) -> F64:
    """Return the frame's points (N, 3) on bare belt, away from its edges, in the optical frame."""
    frame, capture = sim.frame(number), sim.captures[number]
    points = frame.points()[frame.depth_mm > 0].astype(np.float64)
    world = sim.device(capture.sensor).pose.apply(points)
    inside = (np.abs(world[:, 1]) < 0.18) & (np.abs(world[:, 0]) < 0.35) & (np.abs(world[:, 2]) < 0.02)
    return points[inside]


def along_ray_m(plane: Plane, points: F64) -> F64:
    """Return by how much each point's z lies behind where its ray meets the plane."""
    meets = -plane.offset_m / (points @ plane.normal)
    return np.asarray(points[:, 2] * (1 - meets))


@pytest.mark.parametrize("seed", [21, 22])
def test_noise_on_the_belt_is_that_of_a_kinect(seed: int) -> None:
    nominal = scenes.Conditions(noise_factor=1.0)
    sim = scenes.bare_belt(seed, captures=2, height_m=(0.8, 1.5), conditions=nominal)
    for number in range(4):
        points = belt_points(sim, number)
        truth = sim.truth.surfaces[sim.captures[number].sensor].plane
        errors = along_ray_m(truth, points)
        # Khoshelham & Oude Elberink 2012; rounding to millimetres and the shift between the cameras add a little
        relative = errors / points[:, 2] ** 2
        assert 1.25e-3 < relative.std() < 1.8e-3
        # a plane fitted to it is right to a small part of its noise: no bias without a biased device
        assert abs(errors.mean()) < 0.4e-3
        fitted = fit_plane(points).facing(np.zeros(3))
        # 3 mm at 1.4 m over some 800 independent windows within 0.1 m (rms) of the middle: 1.1 mrad; allow four of it
        assert np.arccos(min(fitted.normal @ truth.normal, 1.0)) < 4.5e-3


def test_a_biased_device_is_biased_by_its_scale() -> None:
    model = DepthModel(scale_error=0.006)
    sim = scenes.bare_belt(5, captures=1, conditions=scenes.Conditions(depth_model=model))
    points = belt_points(sim, 0)
    errors = along_ray_m(sim.truth.surfaces["kinect_1"].plane, points)
    assert np.median(errors / points[:, 2]) == pytest.approx(0.006, rel=0.1)


def silhouette_px(sim: Simulation, number: int) -> tuple[int, int]:
    """Return how many pixels of a frame lie more than 12 mm above the belt by depth, and how many truly show a body."""
    frame: Frame = sim.frame(number)
    capture = sim.captures[number]
    plane = sim.truth.surfaces[capture.sensor].plane
    raised = (plane.height_m(frame.points()) > 0.012) & (frame.depth_mm > 0)
    who = sim.eye(capture.sensor).who(sim.in_sight(capture)) >= 0
    near = np.zeros_like(who)
    rows, columns = np.nonzero(who)
    near[max(rows.min() - 8, 0) : rows.max() + 8, max(columns.min() - 8, 0) : columns.max() + 8] = True
    return int((raised & near).sum()), int(who.sum())


def test_fattening_widens_what_depth_shows_by_its_pixels() -> None:
    grown = {}
    for fattening_px in (0.0, 2.0):
        quiet = DepthModel(speckle_share=0.0, dark_infrared=0.0, grazing_cosine=0.0, shadow=0.0)
        conditions = scenes.Conditions(depth_model=quiet, fattening_px=fattening_px)
        sim = scenes.still_scene(31, "single", 0, captures=1, with_rails=False, conditions=conditions)
        one = Body(1, "ball", ball(0.04, (0.9, 0.5, 0.1)), (0.0, 0.0))
        sim = Simulation(replace(sim.scene, bodies=(one,)))
        raised, true = silhouette_px(sim, 0)
        grown[fattening_px] = np.sqrt(raised / np.pi) - np.sqrt(true / np.pi)
    # radius in pixels of the colour camera, whose pixels are 0.905 of the depth camera's
    assert grown[2.0] - grown[0.0] == pytest.approx(2.0 * 0.905, abs=0.4)


def test_kinds_differ_in_colour_as_they_should_under_any_light() -> None:
    hues: dict[str, list[float]] = {kind: [] for kind in KINDS}
    for seed, lux in enumerate((100.0, 300.0, 1000.0)):
        sim = scenes.still_scene(seed, "single", 15, captures=1, conditions=scenes.Conditions(lux=lux))
        frame, capture = sim.frame(0), sim.captures[0]
        bodies = sim.in_sight(capture)
        who = sim.eye(capture.sensor).who(bodies)
        for index, placed in enumerate(bodies):
            pixels = frame.color[who == index].astype(float)
            if len(pixels) > 200:
                red, green, _ = pixels.mean(axis=0)
                hues[placed.body.kind].append(float(np.log(red / green)))
    means = {kind: float(np.mean(values)) for kind, values in hues.items()}
    assert means["red_apple"] > 0.3
    assert means["green_apple"] < -0.05
    assert means["peruvian_avocado"] < means["chilean_avocado"]
    assert means["red_apple"] > means["lemon"] > means["green_apple"]


def test_a_line_holds_what_was_asked_for() -> None:
    sim = scenes.line_scene(41, 60, touching=1 / 3, foreign=6)
    fruit = [thing for thing in sim.truth.fruit if not thing.foreign]
    assert len(fruit) == 60
    assert {thing.kind for thing in fruit} == set(KINDS)
    touching = sum(thing.touching for thing in sim.truth.fruit) / len(sim.truth.fruit)
    assert touching == pytest.approx(1 / 3, abs=0.03)
    half_m = sim.scene.surroundings.belt.width_m / 2
    for body in sim.scene.bodies:
        points = sim.truth.pose_in_world(body.fruit_id, 20.0).apply(body.mesh.vertices_m)
        assert np.abs(points[:, 1]).max() < half_m
        assert points[:, 2].min() > -1e-9
