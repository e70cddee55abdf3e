"""How errors of registration spread to the points that it maps (the source's sections 2.6.3 and 2.6.4).

The source models a registration as (R + Δ_R) X + T + Δ_T, with the nine entries
of Δ_R stacked row by row. Its F_I, as printed, builds the transpose of what its
equation 4 needs; `stacked` builds the 3×9 matrix itself. The nine entries of a
rotation's error are not independent; `entry_covariance` gives their rank-three
covariance from one on SE(3), so that both descriptions can be compared.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F64
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rotation import skew


@dataclass(frozen=True, slots=True, eq=False)
class EntryErrors:
    """The source's description of how wrong a registration is; Δ_R and Δ_T independent of each other unless crossed.

    Attributes:
        rotation: (9, 9) covariance of Δ_R, entries row by row.
        translation_m2: (3, 3) covariance of Δ_T.
        cross_m: (9, 3) covariance between the two; the source leaves it out (zeros).
    """

    rotation: F64
    translation_m2: F64
    cross_m: F64


@dataclass(frozen=True, slots=True, eq=False)
class Link:
    """One registration on a path: maps X to R X + T, with the errors of its entries.

    Attributes:
        rotation: (3, 3).
        translation_m: (3,).
        errors: of the entries of both.
    """

    rotation: F64
    translation_m: F64
    errors: EntryErrors

    def apply(self, point_m: F64) -> F64:
        """Map one point (3,)."""
        return np.asarray(self.rotation @ point_m + self.translation_m)


def stacked(point: F64) -> F64:
    """Return X̂_r = I₃ ⊗ x̂ᵀ, (3, 9): Δ_R x̂ = X̂_r vec(Δ_R), entries row by row (equation 4)."""
    return np.asarray(np.kron(np.eye(3), np.asarray(point)[None, :]), dtype=np.float64)


def rotation_entry_jacobian(rotation: F64) -> F64:
    """Return d vec(exp([ω]×) R) / dω at ω = 0, (9, 3): to first order Δ_R = [ω]× R."""
    return np.stack([(skew(axis) @ rotation).reshape(9) for axis in np.eye(3)], axis=1)


def entry_errors(pose: Pose) -> EntryErrors:
    """Return the source's description of a pose's covariance on SE(3), to first order.

    The pose's errors (ω, v) act in the target frame: exp([ω]×)(R X + T) + v, so Δ_R = [ω]× R and
    Δ_T = ω × T + v. Crossed terms are kept: with them `propagate` agrees with the SE(3) result exactly.

    Raises:
        ValueError: the pose carries no covariance.
    """
    if pose.covariance is None:
        raise ValueError("the pose carries no covariance")
    J_rotation = np.hstack([rotation_entry_jacobian(pose.rotation), np.zeros((9, 3))])
    J_translation = np.hstack([-skew(pose.translation_m), np.eye(3)])
    return EntryErrors(
        J_rotation @ pose.covariance @ J_rotation.T,
        J_translation @ pose.covariance @ J_translation.T,
        J_rotation @ pose.covariance @ J_translation.T,
    )


def independent_errors(rotation_diagonal: Sequence[float], translation_diagonal_m2: Sequence[float]) -> EntryErrors:
    """Return errors as the source gives them: two diagonals (9 and 3 values), nothing crossed."""
    return EntryErrors(np.diag(rotation_diagonal), np.diag(translation_diagonal_m2), np.zeros((9, 3)))


def link(pose: Pose) -> Link:
    """Return a pose with covariance as one step of a path."""
    return Link(pose.rotation, pose.translation_m, entry_errors(pose))


def propagate(point_m: F64, covariance_m2: F64, step: Link) -> tuple[F64, F64]:
    """Return mean (3,) and covariance (3, 3) of Y = (R + Δ_R) X + T + Δ_T, first order: two sensors.

    Ŷ = R X̂ + T,  Σ_Y = R Σ_X Rᵀ + X̂_r Σ_ΔR X̂_rᵀ + Σ_ΔT (and the crossed terms, where given).
    """
    X_r = stacked(point_m)
    errors = step.errors
    crossed = X_r @ errors.cross_m
    spread = X_r @ errors.rotation @ X_r.T + errors.translation_m2 + crossed + crossed.T
    return step.apply(point_m), step.rotation @ covariance_m2 @ step.rotation.T + spread


def propagate_three(point_m: F64, covariance_m2: F64, first: Link, second: Link) -> tuple[F64, F64]:
    """Return mean and covariance of a point of the third sensor in the first one's frame, as the source writes it.

    `first` maps sensor 3 into sensor 2's frame (R₃₂, T₃₂), `second` sensor 2 into sensor 1's (R₂₁, T₂₁). The
    expression is written out term by term; `propagate_along` must give the same.
    """
    R21, R32 = second.rotation, first.rotation
    middle = first.apply(point_m)
    X_3r, X_2r = stacked(point_m), stacked(middle)
    crossed = R21 @ X_3r @ first.errors.cross_m @ R21.T + X_2r @ second.errors.cross_m
    covariance = (
        R21 @ R32 @ covariance_m2 @ R32.T @ R21.T
        + R21 @ X_3r @ first.errors.rotation @ X_3r.T @ R21.T
        + R21 @ first.errors.translation_m2 @ R21.T
        + X_2r @ second.errors.rotation @ X_2r.T
        + second.errors.translation_m2
        + crossed
        + crossed.T
    )
    return second.apply(middle), covariance


def propagate_along(point_m: F64, covariance_m2: F64, path: Sequence[Link]) -> tuple[F64, F64]:
    """Return mean and covariance of a point carried along any path of registrations, nearest step first.

    The recursion X ← R X + T, Σ ← R Σ Rᵀ + X̂_r Σ_ΔR X̂_rᵀ + Σ_ΔT, at each step with the point where it then is.
    An empty path changes nothing. Errors of the steps are independent of each other.
    """
    for step in path:
        point_m, covariance_m2 = propagate(point_m, covariance_m2, step)
    return point_m, covariance_m2


def propagate_pose(point_m: F64, covariance_m2: F64, pose: Pose) -> tuple[F64, F64]:
    """Return mean and covariance of a mapped point from the pose's own 6×6 covariance (product mode).

    Raises:
        ValueError: the pose carries no covariance.
    """
    if pose.covariance is None:
        raise ValueError("the pose carries no covariance")
    mapped = pose.apply(point_m)
    J = pose.point_jacobian(mapped)
    return mapped, pose.rotation @ covariance_m2 @ pose.rotation.T + J @ pose.covariance @ J.T
