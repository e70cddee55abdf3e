"""Rigid poses with covariance on SE(3) (Barfoot 2017, "State estimation for robotics", 7.3).

Convention, everywhere: a pose maps X to R X + T; its covariance is that of
(ω, v), radians and metres, where the true point is exp([ω]×)(R X + T) + v.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from fruitgui.frame import F64
from fruitgui.geometry.rotation import rotation_angle, skew


@dataclass(frozen=True, slots=True, eq=False)
class Pose:
    """Maps points of one frame of reference into another: R X + T.

    Attributes:
        rotation: (3, 3).
        translation_m: (3,).
        covariance: (6, 6) of (ω, v), rad and m, in the target frame; None where unknown.
    """

    rotation: F64 = field(default_factory=lambda: np.eye(3))
    translation_m: F64 = field(default_factory=lambda: np.zeros(3))
    covariance: F64 | None = None

    @classmethod
    def exact(cls) -> Self:
        """Return the identity, known without error: the reference sensor's pose."""
        return cls(np.eye(3), np.zeros(3), np.zeros((6, 6)))

    @property
    def matrix(self) -> F64:
        """The homogeneous 4×4 matrix."""
        matrix = np.eye(4)
        matrix[:3, :3] = self.rotation
        matrix[:3, 3] = self.translation_m
        return matrix

    def apply(self, points: ArrayLike) -> F64:
        """Map points (…, 3)."""
        return np.asarray(points, dtype=np.float64) @ self.rotation.T + self.translation_m

    def turn(self, vectors: ArrayLike) -> F64:
        """Rotate directions (…, 3), without the translation."""
        return np.asarray(vectors, dtype=np.float64) @ self.rotation.T

    def adjoint(self) -> F64:
        """Return the 6×6 matrix that carries (ω, v) of the source frame into the target frame."""
        J = np.zeros((6, 6))
        J[:3, :3] = self.rotation
        J[3:, 3:] = self.rotation
        J[3:, :3] = skew(self.translation_m) @ self.rotation
        return J

    def inverse(self) -> Pose:
        """Return the pose of the other direction, covariance carried over (first order)."""
        backward = Pose(self.rotation.T, -self.rotation.T @ self.translation_m)
        if self.covariance is None:
            return backward
        J = backward.adjoint()
        return Pose(backward.rotation, backward.translation_m, J @ self.covariance @ J.T)

    def __matmul__(self, first: Pose) -> Pose:
        """Return the pose that applies `first`, then this one; independent errors add (first order)."""
        rotation = self.rotation @ first.rotation
        translation_m = self.rotation @ first.translation_m + self.translation_m
        if self.covariance is None or first.covariance is None:
            return Pose(rotation, translation_m)
        J = self.adjoint()
        return Pose(rotation, translation_m, self.covariance + J @ first.covariance @ J.T)

    def point_jacobian(self, mapped_point_m: F64) -> F64:
        """Return d(true point)/d(ω, v), (3, 6), at a point (3,) already mapped into the target frame."""
        return np.hstack([-skew(mapped_point_m), np.eye(3)])

    def distance_to(self, other: Pose, points_m: F64) -> tuple[float, float]:
        """Return (mean displacement in metres of the source points (N, 3), angle in radians) between two poses."""
        displacement = float(np.linalg.norm(self.apply(points_m) - other.apply(points_m), axis=1).mean())
        return displacement, rotation_angle(self.rotation.T @ other.rotation)
