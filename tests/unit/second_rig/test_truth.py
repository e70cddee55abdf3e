"""The second rig's own truth: a judge has to be right first."""

from __future__ import annotations

import numpy as np
import pytest

from tests.second_rig.camera import KINECT, aim, project, rays, relative
from tests.second_rig.kinect import Noise
from tests.second_rig.produce import sphere
from tests.second_rig.render import Renderer
from tests.second_rig.scene import Eye, Scene, lay
from tests.second_rig.setting import Setting

RADIUS_M = 0.035


def test_a_ball_has_the_volume_and_callipers_of_a_ball() -> None:
    truth = sphere(RADIUS_M, (200.0, 120.0, 60.0)).truth
    assert truth.volume_m3 == pytest.approx(4.0 / 3.0 * np.pi * RADIUS_M**3, rel=1e-4)
    assert truth.length_m == pytest.approx(2 * RADIUS_M, abs=5e-5)
    assert truth.diameter_m == pytest.approx(2 * RADIUS_M, abs=1e-4)
    assert np.allclose(truth.centre_m, 0.0, atol=1e-5)


def test_rendered_depth_lies_on_the_ball_and_on_the_belt() -> None:
    rng = np.random.default_rng(5)
    ball = lay(0, sphere(RADIUS_M, (200.0, 120.0, 60.0)), 0.05, -0.03, rng)
    quiet = Noise(sigma=0.0, step_px=0.0, holes=0.0, shadow=False, edge_jitter_px=0.0)
    eye = Eye("k", aim(np.array([0.2, 0.6, 0.9]), np.zeros(3), 0.1), noise=quiet)
    scene = Scene(1, Setting(), (eye,), (ball,), 1.0)
    shot = Renderer(scene).shoot(eye, 0.0, 0)
    points = eye.stand.outward((rays(KINECT) * (shot.depth_mm / 1000.0)[..., None]).reshape(-1, 3))
    owner, read = shot.owner.reshape(-1), shot.depth_mm.reshape(-1) > 0
    on_ball, on_belt = points[(owner == 1) & read], points[(owner == -1) & read]
    assert len(on_ball) > 800
    # Depth is rounded to millimetres along the line of sight.
    assert np.abs(np.linalg.norm(on_ball - scene.centre_m(ball, 0.0), axis=1) - RADIUS_M).max() < 0.0008
    assert np.abs(on_belt[:, 2]).max() < 0.0008


def test_relative_poses_carry_points_from_one_sensor_to_the_other() -> None:
    first, second = aim(np.array([0.1, 0.7, 1.0]), np.zeros(3)), aim(np.array([-0.2, -0.6, 1.1]), np.zeros(3), 0.2)
    rotation, shift = relative(first, second)
    place = np.array([[0.03, -0.05, 0.02]])
    assert np.allclose(second.inward(place) @ rotation.T + shift, first.inward(place))
    assert np.linalg.det(rotation) == pytest.approx(1.0)
    assert np.allclose(project(KINECT, first.inward(np.zeros((1, 3)))), [[KINECT.cx, KINECT.cy]])
