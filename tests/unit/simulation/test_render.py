"""Pictures agree with the geometry they show."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fruitgui.frame import F64, Intrinsics
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rotation import rotation_from_vector
from fruitgui.simulation import scenes
from fruitgui.simulation.kinect import PERFECT
from fruitgui.simulation.layouts import look_at
from fruitgui.simulation.light import ColorModel, Light, expose, linear, make_light, mixing
from fruitgui.simulation.registration import Registration
from fruitgui.simulation.render import motion_kernel
from fruitgui.simulation.simulation import Simulation
from fruitgui.simulation.surroundings import Block, Surroundings, look, make_belt

SMALL = Intrinsics(320, 240, 262.5, 262.5, 159.5, 119.5)
EXACT = scenes.Conditions(depth_model=PERFECT, fattening_px=0.0, camera=SMALL)


@pytest.fixture(scope="module")
def still() -> Simulation:
    return scenes.still_scene(11, fruit=14, touching=0.3, captures=1, conditions=EXACT)


def points_in_world(sim: Simulation, number: int) -> tuple[F64, F64]:
    """Return the frame's points (N, 3) in the world and which body (N,) their pixels show, those with depth."""
    frame, capture = sim.frame(number), sim.captures[number]
    seen = frame.depth_mm > 0
    who = sim.eye(capture.sensor).who(sim.in_sight(capture))
    return sim.device(capture.sensor).pose.apply(frame.points()[seen]), who[seen]


@pytest.mark.parametrize("number", [0, 1])
def test_depth_lies_on_what_is_there(still: Simulation, number: int) -> None:
    points, who = points_in_world(still, number)
    belt = (who < 0) & (np.abs(points[:, 1]) < 0.24) & (np.abs(points[:, 0]) < 0.4) & (np.abs(points[:, 2]) < 0.02)
    # whole millimetres, and a pixel of the depth camera seen from the colour camera: half of 3.8 mm/px at 1 m on a
    # belt slanted up to 45°
    assert np.quantile(np.abs(points[belt, 2]), 0.99) < 0.0045
    assert np.sqrt(np.mean(points[belt, 2] ** 2)) < 0.002
    assert abs(points[belt, 2].mean()) < 0.0005
    offsets = [_off_surface_m(still, number, index, points[who == index]) for index in range(who.max() + 1)]
    all_m = np.concatenate(offsets)
    assert len(all_m) > 1500
    assert np.median(np.abs(all_m)) < 0.0015
    assert np.quantile(np.abs(all_m), 0.9) < 0.006


def _off_surface_m(sim: Simulation, number: int, index: int, points: F64) -> F64:
    import open3d as o3d

    placed = sim.in_sight(sim.captures[number])[index]
    scene = o3d.t.geometry.RaycastingScene(nthreads=1)
    scene.add_triangles(
        o3d.core.Tensor(placed.body.mesh.vertices_m.astype(np.float32)),
        o3d.core.Tensor(placed.body.mesh.triangles.astype(np.uint32)),
    )
    local = placed.pose.inverse().apply(points).astype(np.float32)
    return np.asarray(scene.compute_distance(o3d.core.Tensor(np.ascontiguousarray(local)), nthreads=1).numpy())


def test_colour_shows_each_fruit_where_its_centre_projects(still: Simulation) -> None:
    capture = still.captures[0]
    bodies = still.in_sight(capture)
    who = still.eye(capture.sensor).who(bodies)
    device = still.device(capture.sensor)
    inside = 0
    for index, placed in enumerate(bodies):
        u, v = device.color_camera.project(device.pose.inverse().apply(placed.pose.translation_m[None]))[0]
        if 0 <= u < 319 and 0 <= v < 239:
            inside += who[round(v), round(u)] == index
    # a neighbour may stand in front of a touching fruit's middle, seldom
    assert inside >= 0.8 * len(bodies)


def test_true_poses_bring_the_views_together(still: Simulation) -> None:
    first, _ = points_in_world(still, 0)
    second, _ = points_in_world(still, 1)
    reference = still.truth.poses[still.sensors[1]].apply(still.device(still.sensors[1]).pose.inverse().apply(second))
    direct = still.device(still.sensors[0]).pose.inverse().apply(second)
    np.testing.assert_allclose(reference, direct, atol=1e-9)
    assert abs(np.median(first[np.abs(first[:, 2]) < 0.01, 2])) < 5e-4


def test_truth_of_surface_and_rig(still: Simulation) -> None:
    rig = still.rig()
    for sensor in still.sensors:
        mount = rig.mounts[sensor]
        height_m = still.device(sensor).pose.translation_m[2]
        assert mount.surface.plane.offset_m == pytest.approx(height_m)
        assert mount.surface.region_m is not None
        np.testing.assert_allclose(mount.surface.plane.height_m(mount.surface.region_m), 0, atol=1e-9)
    place = still.truth.position_m(1, 0.0)
    assert rig.belt().height_m(place) == pytest.approx(still.truth.pose_in_world(1, 0.0).translation_m[2])


def test_registration_keeps_the_nearer_and_leaves_holes() -> None:
    depth_camera = Intrinsics(320, 240, 290.0, 290.0, 159.5, 119.5)
    register = Registration(depth_camera, SMALL, Pose(np.eye(3), np.array([-0.025, 0.0, 0.0])))
    z = np.full((240, 320), 1.5, dtype=np.float32)
    z[60:180, 100:200] = 0.8
    out = register(z)
    near, far = SMALL.fx * 0.025 / 0.8, SMALL.fx * 0.025 / 1.5
    left = (100 - 159.5) / 290 * 262.5 + 159.5
    row = out[120]
    columns = np.flatnonzero(row == np.float32(0.8))
    assert columns.min() == pytest.approx(left - near, abs=1)
    # on the right of the near square the colour camera sees wall that the depth camera did not
    hole = np.flatnonzero(row[columns.max() + 1 : columns.max() + 20] == 0)
    assert len(hole) == pytest.approx(near - far, abs=1.5)


def test_registration_agrees_with_the_lens() -> None:
    bent = replace(SMALL, distortion=(0.1, -0.05, 0.001, -0.001, 0.02))
    pose = Pose(rotation_from_vector(np.array([0.002, -0.003, 0.004])), np.array([-0.025, 0.001, 0.002]))
    depth_camera = Intrinsics(320, 240, 290.0, 290.0, 159.5, 119.5)
    z = np.zeros((240, 320), dtype=np.float32)
    z[60, 250] = 1.1
    ray = np.append(depth_camera.rays()[60, 250].astype(float), 1.0)
    u, v = bent.project(pose.apply(1.1 * ray)[None])[0]
    out = Registration(depth_camera, bent, pose)(z)
    assert np.argwhere(out > 0).tolist() == [[round(v), round(u)]]


def test_depth_in_its_own_camera_registers_to_the_frames(still: Simulation) -> None:
    device = still.device(still.captures[0].sensor)
    own_m = still.own_depth_mm(0).astype(np.float32) / 1000
    again = Registration(device.depth_camera, device.color_camera, device.depth_to_color)(own_m)
    apart_m = np.abs(again - still.frame(0).depth_mm / 1000)
    # whole millimetres may move a reading across the border of a pixel, seldom
    assert (apart_m > 1.1e-3).mean() < 1e-3


def test_blocks_and_belt_are_where_they_are() -> None:
    belt = make_belt(np.random.default_rng(0), 0.5, (-0.3, 0.3))
    block = Block((-0.1, -0.05, 0.0), (0.1, 0.05, 0.2), (0.5, 0.5, 0.5))
    behind = look(
        Surroundings(belt, (block,), 0.7, (0.4, 0.4, 0.4)), SMALL.rays(), look_at(np.array([0, 0, 1.0]), np.zeros(3))
    )
    assert behind.z_m[120, 160] == pytest.approx(0.8, abs=1e-5)
    assert behind.z_m[120, 230] == pytest.approx(1.0, abs=1e-5)
    assert behind.z_m[120, 319] == pytest.approx(1.7, abs=1e-5)
    assert behind.on_belt[120, 230]
    assert not behind.on_belt[120, 160]
    np.testing.assert_allclose(behind.normal[120, 160], [0, 0, 1])


def test_dark_halls_are_noisy_and_exposure_compensates() -> None:
    grain = np.random.default_rng(0).standard_normal((100, 100, 3)).astype(np.float32)
    radiance = np.full((100, 100, 3), 0.2, dtype=np.float32)
    dim, bright = (expose(radiance, ColorModel(), lux, grain).astype(float) for lux in (100.0, 1000.0))
    assert dim.std() > 1.8 * bright.std()
    assert 0.75 < dim.mean() / bright.mean() < 0.95
    silent = expose(radiance, ColorModel(noise=0.0), 300.0, grain)
    assert (silent == round(255 * 0.2**0.5)).all()


def test_shot_noise_is_the_square_root_of_the_electrons() -> None:
    grain = np.random.default_rng(1).standard_normal((200, 200, 3)).astype(np.float32)
    model = ColorModel(read_noise=0.0, compliance=0.0)
    picture = expose(np.full((200, 200, 3), 0.2, dtype=np.float32), model, 100.0, grain).astype(float)
    electrons = 0.2 * 1800
    # the square root of light halves relative noise
    assert picture.std() / picture.mean() == pytest.approx(0.5 / electrons**0.5, rel=0.05)


def test_light_mixes_colours_and_shades() -> None:
    warm = Light(tint=(1.2, 1.0, 0.8), ambient=0.4, direction=(0.0, 0.0, 1.0))
    orange = linear(np.array([0.9, 0.5, 0.1]))
    plain = orange @ mixing(warm, ColorModel(crosstalk=0.0))
    np.testing.assert_allclose(plain, orange * [1.2, 1.0, 0.8], rtol=1e-6)
    dull = orange @ mixing(Light(), ColorModel(crosstalk=0.1))
    assert dull.max() / dull.min() < orange.max() / orange.min()
    up, side = warm.on(np.array([[0, 0, 1.0], [1.0, 0, 0]], dtype=np.float32))
    assert up > side > 0
    lux = [make_light(np.random.default_rng(seed)).lux for seed in range(60)]
    assert 100 <= min(lux) < 150
    assert 700 < max(lux) <= 1000


def test_motion_blur_spreads_light_along_the_way() -> None:
    assert motion_kernel(np.array([0.3, 0.2])) is None
    kernel = motion_kernel(np.array([4.0, 0.0]))
    assert kernel is not None
    assert kernel.sum() == pytest.approx(1.0, rel=1e-5)
    columns = np.arange(kernel.shape[1]) - kernel.shape[1] // 2
    spread = np.sqrt((kernel.sum(axis=0) * columns**2).sum())
    assert spread == pytest.approx(4.0 / 12**0.5, rel=0.15)
    assert kernel.sum(axis=1).max() == pytest.approx(1.0, rel=1e-5)
