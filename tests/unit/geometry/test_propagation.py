from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from fruitgui.frame import F64
from fruitgui.geometry import propagation
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rotation import rotation_from_vector

vectors = hnp.arrays(np.float64, 3, elements=st.floats(-2.0, 2.0))


def random_pose(rng: np.random.Generator, rotation_std: float = 2e-3, translation_std_m: float = 2e-3) -> Pose:
    A = rng.normal(size=(6, 6)) * np.repeat([rotation_std, translation_std_m], 3)[:, None] / np.sqrt(6)
    return Pose(rotation_from_vector(rng.normal(size=3)), rng.uniform(-1, 1, 3), A @ A.T)


@given(vectors, hnp.arrays(np.float64, (3, 3), elements=st.floats(-1.0, 1.0)))
def test_stacked_point_times_stacked_rows_is_the_matrix_product(point: F64, error: F64) -> None:
    assert propagation.stacked(point) @ error.reshape(9) == pytest.approx(error @ point, abs=1e-12)


def test_stacked_point_has_the_shape_that_equation_4_needs() -> None:
    assert propagation.stacked(np.array([1.0, 2.0, 3.0])).tolist() == [
        [1, 2, 3, 0, 0, 0, 0, 0, 0],
        [0, 0, 0, 1, 2, 3, 0, 0, 0],
        [0, 0, 0, 0, 0, 0, 1, 2, 3],
    ]


@given(vectors, vectors)
def test_entry_jacobian_is_the_first_order_of_a_small_turn(start: F64, turn: F64) -> None:
    R = rotation_from_vector(start)
    small = 1e-4 * turn
    exact = (rotation_from_vector(small) @ R - R).reshape(9)
    assert propagation.rotation_entry_jacobian(R) @ small == pytest.approx(exact, abs=1e-7)


@given(st.integers(0, 2**32 - 1))
def test_entries_with_crossed_terms_say_the_same_as_the_pose(seed: int) -> None:
    rng = np.random.default_rng(seed)
    pose, point = random_pose(rng), rng.uniform(-1, 1, 3)
    mean, covariance = propagation.propagate(point, 1e-6 * np.eye(3), propagation.link(pose))
    pose_mean, pose_covariance = propagation.propagate_pose(point, 1e-6 * np.eye(3), pose)
    assert mean == pytest.approx(pose_mean)
    assert covariance == pytest.approx(pose_covariance, abs=1e-14)


@given(st.integers(0, 2**32 - 1))
def test_recursion_gives_the_three_sensor_expression(seed: int) -> None:
    rng = np.random.default_rng(seed)
    path = [propagation.link(random_pose(rng)) for _ in range(2)]
    point = rng.uniform(-1, 1, 3)
    mean, covariance = propagation.propagate_along(point, 1e-6 * np.eye(3), path)
    three_mean, three_covariance = propagation.propagate_three(point, 1e-6 * np.eye(3), *path)
    assert mean == pytest.approx(three_mean)
    assert covariance == pytest.approx(three_covariance, abs=1e-14)


def test_an_empty_path_changes_nothing() -> None:
    point, covariance = np.arange(3.0), np.diag([1.0, 2.0, 3.0])
    mean, same = propagation.propagate_along(point, covariance, [])
    assert (mean == point).all()
    assert (same == covariance).all()


def test_rotation_entries_have_rank_three() -> None:
    pose = random_pose(np.random.default_rng(3))
    assert np.linalg.matrix_rank(propagation.entry_errors(pose).rotation, tol=1e-12) == 3


def test_a_pose_without_covariance_is_refused() -> None:
    with pytest.raises(ValueError, match="no covariance"):
        propagation.entry_errors(Pose())
    with pytest.raises(ValueError, match="no covariance"):
        propagation.propagate_pose(np.zeros(3), np.eye(3), Pose())
