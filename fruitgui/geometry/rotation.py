"""Rotations in three dimensions: SO(3) by exponential map (Solà 2018, "A micro Lie theory", 4.2)."""

from __future__ import annotations

import numpy as np

from fruitgui.frame import F64


def skew(vector: F64) -> F64:
    """Return [v]× so that [v]× w = v × w; (3,) → (3, 3)."""
    x, y, z = vector
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def rotation_from_vector(vector_rad: F64) -> F64:
    """Return exp([ω]×) for a rotation vector (3,), radians (Rodrigues)."""
    angle = float(np.linalg.norm(vector_rad))
    K = skew(vector_rad)
    if angle < 1e-8:
        return np.eye(3) + K + 0.5 * K @ K
    return np.asarray(np.eye(3) + np.sin(angle) / angle * K + (1.0 - np.cos(angle)) / angle**2 * K @ K)


def vector_from_rotation(rotation: F64) -> F64:
    """Return the rotation vector (3,), radians, of a rotation matrix; its length is in [0, π]."""
    from scipy.spatial.transform import Rotation

    return np.asarray(Rotation.from_matrix(rotation).as_rotvec(), dtype=np.float64)


def rotation_angle(rotation: F64) -> float:
    """Return the angle of a rotation matrix, radians, in [0, π]."""
    return float(np.linalg.norm(vector_from_rotation(rotation)))


def nearest_rotation(matrix: F64) -> F64:
    """Return the rotation nearest to a 3×3 matrix in the Frobenius norm (Higham 1989)."""
    U, _, Vt = np.linalg.svd(matrix)
    return np.asarray(U @ np.diag([1.0, 1.0, np.sign(np.linalg.det(U @ Vt))]) @ Vt)


def is_rotation(matrix: F64, tolerance: float = 1e-4) -> bool:
    """Tell whether a 3×3 matrix is finite, orthonormal within `tolerance` and right-handed."""
    if not np.isfinite(matrix).all():
        return False
    return bool(np.abs(matrix @ matrix.T - np.eye(3)).max() <= tolerance and np.linalg.det(matrix) > 0)


def rotation_between(start: F64, end: F64) -> F64:
    """Return the smallest rotation that turns unit vector `start` (3,) onto unit vector `end` (3,)."""
    axis = np.cross(start, end)
    cosine = float(np.dot(start, end))
    if cosine < -1.0 + 1e-12:
        axis = np.cross(start, np.eye(3)[int(np.argmin(np.abs(start)))])
        return rotation_from_vector(axis / np.linalg.norm(axis) * np.pi)
    K = skew(axis)
    return np.asarray(np.eye(3) + K + K @ K / (1.0 + cosine))
