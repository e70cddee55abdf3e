"""Propagation of error against Monte-Carlo, never against itself.

With N = 200 000 draws an entry of a sample covariance has a relative standard
error of about sqrt(2/N) = 0.3 %; first order leaves terms of the order of the
squared turn (4e-6). A bound of 2 % of the covariance's size is over six standard
errors and far below what any missing term would change.
"""

from __future__ import annotations

import numpy as np
import pytest

from fruitgui.frame import F64
from fruitgui.geometry import propagation
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rotation import rotation_from_vector, skew

pytestmark = pytest.mark.accuracy

DRAWS = 200_000
TOLERANCE = 0.02


def random_pose(rng: np.random.Generator) -> Pose:
    A = rng.normal(size=(6, 6)) * np.repeat([2e-3, 2e-3], 3)[:, None] / np.sqrt(6)
    return Pose(rotation_from_vector(rng.normal(size=3)), rng.uniform(-1, 1, 3), A @ A.T)


def spread(rng: np.random.Generator) -> F64:
    A = 1e-3 * rng.normal(size=(3, 3))
    return np.asarray(A @ A.T)


def small_rotations(turns: F64) -> F64:
    """Return exp([ω]×) of (N, 3) small turns, second order kept: (N, 3, 3)."""
    K = np.stack([skew(turn) for turn in np.eye(3)])
    generators = np.einsum("ni,ijk->njk", turns, K)
    return np.asarray(np.eye(3) + generators + 0.5 * generators @ generators)


def drawn_through(rng: np.random.Generator, points: F64, pose: Pose) -> F64:
    assert pose.covariance is not None
    errors = rng.multivariate_normal(np.zeros(6), pose.covariance, len(points))
    mapped = pose.apply(points)
    return np.asarray(np.einsum("nij,nj->ni", small_rotations(errors[:, :3]), mapped) + errors[:, 3:])


def drawn_through_entries(rng: np.random.Generator, points: F64, step: propagation.Link) -> F64:
    turned = rng.multivariate_normal(np.zeros(9), step.errors.rotation, len(points)).reshape(-1, 3, 3)
    moved = rng.multivariate_normal(np.zeros(3), step.errors.translation_m2, len(points))
    return np.asarray(np.einsum("nij,nj->ni", step.rotation + turned, points) + step.translation_m + moved)


def assert_same_spread(points: F64, covariance: F64) -> None:
    sample = np.cov(points.T)
    assert np.abs(sample - covariance).max() <= TOLERANCE * np.abs(np.diag(covariance)).max()


@pytest.mark.parametrize("seed", range(3))
def test_source_expression_for_two_sensors_matches_monte_carlo_on_independent_entries(seed: int) -> None:
    rng = np.random.default_rng(seed)
    pose = random_pose(rng)
    errors = propagation.independent_errors(rng.uniform(1e-6, 9e-6, 9).tolist(), rng.uniform(1e-6, 9e-6, 3).tolist())
    step = propagation.Link(pose.rotation, pose.translation_m, errors)
    mean, covariance = rng.uniform(-1, 1, 3), spread(rng)
    drawn = drawn_through_entries(rng, rng.multivariate_normal(mean, covariance, DRAWS), step)
    expected_mean, expected = propagation.propagate(mean, covariance, step)
    assert np.abs(drawn.mean(axis=0) - expected_mean).max() < 6 * np.sqrt(expected.max() / DRAWS)
    assert_same_spread(drawn, expected)


@pytest.mark.parametrize("sensors", [2, 3, 5])
def test_rotations_drawn_on_the_group_match_the_nine_entries_along_a_path(sensors: int) -> None:
    rng = np.random.default_rng(10 + sensors)
    path = [random_pose(rng) for _ in range(sensors - 1)]
    mean, covariance = rng.uniform(-1, 1, 3), spread(rng)
    drawn = rng.multivariate_normal(mean, covariance, DRAWS)
    for pose in path:
        drawn = drawn_through(rng, drawn, pose)
    _, expected = propagation.propagate_along(mean, covariance, [propagation.link(pose) for pose in path])
    assert_same_spread(drawn, expected)


def test_leaving_out_the_crossed_terms_is_seen_by_monte_carlo() -> None:
    """The check above can fail: the source's independent Δ_R and Δ_T do not describe a turn about a far point."""
    rng = np.random.default_rng(20)
    pose = Pose(rotation_from_vector(rng.normal(size=3)), np.array([1.0, 0.5, 0.2]), np.diag([1e-5] * 3 + [1e-8] * 3))
    full = propagation.entry_errors(pose)
    uncrossed = propagation.EntryErrors(full.rotation, full.translation_m2, np.zeros((9, 3)))
    point = np.array([0.3, -0.2, 0.9])
    drawn = np.cov(drawn_through(rng, np.tile(point, (DRAWS, 1)), pose).T)
    step = propagation.Link(pose.rotation, pose.translation_m, uncrossed)
    _, expected = propagation.propagate(point, np.zeros((3, 3)), step)
    assert np.abs(drawn - expected).max() > 10 * TOLERANCE * np.abs(np.diag(expected)).max()
