from __future__ import annotations

import numpy as np
import pytest

from fruitgui.calibration.arbitrary import Match
from fruitgui.calibration.study import closure, errors, gaussian, real_pose, summed_up
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rotation import rotation_from_vector


def random_pose(rng: np.random.Generator) -> Pose:
    return Pose(rotation_from_vector(rng.normal(size=3)), rng.uniform(-1, 1, 3))


def test_real_pose_is_the_source_formula_and_maps_views() -> None:
    rng = np.random.default_rng(1)
    source, target = random_pose(rng), random_pose(rng)
    point = rng.uniform(-1, 1, 3)
    in_source, in_target = source.inverse().apply(point), target.inverse().apply(point)
    assert real_pose(source, target).apply(in_source) == pytest.approx(in_target)


def test_errors_recover_the_covariance_they_were_drawn_from() -> None:
    rng = np.random.default_rng(2)
    A = 1e-3 * rng.normal(size=(6, 6))
    covariance = A @ A.T
    found = [random_pose(rng) for _ in range(1500)]
    real = []
    for pose, twist in zip(found, rng.multivariate_normal(np.zeros(6), covariance, len(found)), strict=True):
        real.append(Pose(rotation_from_vector(twist[:3]), twist[3:]) @ pose)
    got = errors(found, real).se3_covariance
    assert np.abs(got - covariance).max() < 0.12 * np.abs(np.diag(covariance)).max()


def test_gaussian_says_what_is_none() -> None:
    rng = np.random.default_rng(3)
    assert gaussian(rng.normal(0.1, 0.02, 200)).normal_p > 0.001
    assert gaussian(rng.exponential(1.0, 200)).normal_p < 0.001


def test_pairs_left_out_are_named_with_the_reason() -> None:
    rng = np.random.default_rng(4)
    poses = [random_pose(rng) for _ in range(2)]
    right = real_pose(poses[1], poses[0])
    matches = {(1, 0): Match(right, right, "", 0.9), (0, 1): Match(None, None, "too little overlap", 0.1)}
    result = summed_up(poses, matches)
    assert (result.views, result.pairs, result.registered) == (2, 2, 1)
    assert result.left_out[0].reason == "too little overlap"
    assert result.product is not None
    assert result.product.translation_m[0] == pytest.approx(0.0, abs=1e-12)


def test_wrong_known_poses_do_not_spoil_how_loops_close() -> None:
    rng = np.random.default_rng(5)
    poses = [random_pose(rng) for _ in range(4)]
    pairs = [(a, b) for a in range(4) for b in range(4) if a != b]
    matches = {(a, b): Match(real_pose(poses[a], poses[b]), None, "", 0.9) for a, b in pairs}
    result = summed_up([random_pose(rng) for _ in poses], matches)
    assert result.product is not None
    assert result.closure is not None
    assert len(result.closure.rotation_rad) == 4
    assert result.closure.translation_m.max() < 1e-12
    assert np.median(result.product.translation_m) > 0.1


def test_a_turned_registration_shows_in_its_loop() -> None:
    rng = np.random.default_rng(6)
    poses = [random_pose(rng) for _ in range(3)]
    found = {(a, b): real_pose(poses[a], poses[b]) for a, b in ((0, 1), (1, 2), (0, 2))}
    found[0, 2] = Pose(rotation_from_vector(np.array([0.0, 0.0, 0.01])), np.zeros(3)) @ found[0, 2]
    gaps = closure(found, 3)
    assert gaps is not None
    assert gaps.rotation_rad == pytest.approx([0.01])
    assert closure({(0, 1): found[0, 1]}, 3) is None
