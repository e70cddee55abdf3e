"""Shift and heading: all that two sensors over one belt can differ by, once both know the belt."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F64
from fruitgui.geometry.pose import Pose


@dataclass(frozen=True, slots=True)
class Shift:
    """Maps (x, y, z) of one belt frame into another: turn about z by `heading_rad`, then move by x and y."""

    x_m: float
    y_m: float
    heading_rad: float

    @property
    def rotation(self) -> F64:
        """The 2×2 rotation."""
        c, s = np.cos(self.heading_rad), np.sin(self.heading_rad)
        return np.array([[c, -s], [s, c]])

    @property
    def move_m(self) -> F64:
        """The (2,) translation."""
        return np.array([self.x_m, self.y_m])

    def pose(self) -> Pose:
        """Return it as a pose."""
        rotation = np.eye(3)
        rotation[:2, :2] = self.rotation
        return Pose(rotation, np.array([self.x_m, self.y_m, 0.0]))

    def apply(self, points_m: F64) -> F64:
        """Map points (…, 2) or (…, 3)."""
        mapped = np.array(points_m, dtype=np.float64)
        mapped[..., :2] = points_m[..., :2] @ self.rotation.T + self.move_m
        return mapped

    def turn(self, vectors: F64) -> F64:
        """Rotate (…, 3)."""
        turned = np.array(vectors, dtype=np.float64)
        turned[..., :2] = vectors[..., :2] @ self.rotation.T
        return turned

    def inverse(self) -> Shift:
        """Return the shift of the other direction."""
        x, y = -self.rotation.T @ self.move_m
        return Shift(float(x), float(y), -self.heading_rad)

    def after(self, first: Shift) -> Shift:
        """Return the shift that applies `first`, then this."""
        x, y = self.rotation @ first.move_m + self.move_m
        return Shift(float(x), float(y), wrapped(self.heading_rad + first.heading_rad))

    def about(self, centre_m: F64, step: F64) -> Shift:
        """Return this shift followed by a small motion (dx, dy, dθ) whose turn is about `centre_m` (2,)."""
        turn = Shift(0.0, 0.0, float(step[2]))
        x, y = centre_m - turn.rotation @ centre_m + step[:2]
        return Shift(float(x), float(y), float(step[2])).after(self)

    def apart(self, other: Shift, at_m: F64) -> tuple[float, float]:
        """Return how far (m, on average over source points (N, 2)) and how much turned (rad) two shifts differ."""
        apart_m = float(np.linalg.norm(self.apply(at_m) - other.apply(at_m), axis=1).mean())
        return apart_m, abs(wrapped(self.heading_rad - other.heading_rad))


def wrapped(angle_rad: float) -> float:
    """Return the angle in [−π, π)."""
    return float((angle_rad + np.pi) % (2 * np.pi) - np.pi)


def best_shift(source_m: F64, target_m: F64) -> Shift:
    """Return the least-squares shift that takes points (N, 2) onto points (N, 2)."""
    a, b = source_m.mean(axis=0), target_m.mean(axis=0)
    p, q = source_m - a, target_m - b
    heading = float(np.arctan2((p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]).sum(), (p * q).sum()))
    x, y = b - Shift(0.0, 0.0, heading).rotation @ a
    return Shift(float(x), float(y), heading)
