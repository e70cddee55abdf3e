"""The belt from above (x along its motion, y to the left of it, metres), and ellipses there and in pictures."""

from __future__ import annotations

import numpy as np

from fruitgui.frame import F64, Intrinsics
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rig import Rig
from fruitgui.station.live.state import Spread

CHI2_95 = 5.991
"""Squared distance within which a normal place in the plane lies with 95 %."""

NEAREST_M = 0.05
"""What is nearer to a sensor's plane than this has no place in its picture."""

TURN_RAD = np.radians(3.0)
"""The view from above turns only where the belt's direction has really changed."""


class FromAbove:
    """Maps the reference frame onto the belt seen from above; it turns as the belt's direction becomes known."""

    def __init__(self, rig: Rig) -> None:
        self._rig = rig
        self._belt = rig.belt_frame()
        self._heading_rad: float | None = None
        self.pose: Pose = self._belt
        self.footprints_m = self._footprints()

    @property
    def along(self) -> bool:
        """Whether the way of the belt is known: x runs with it."""
        return self._heading_rad is not None

    def head_along(self, velocity_m_s: F64 | None) -> None:
        """Turn x along the belt's motion."""
        if velocity_m_s is None or float(np.linalg.norm(velocity_m_s)) < 1e-3:
            return
        along = self._belt.turn(velocity_m_s)
        heading_rad = float(np.arctan2(along[1], along[0]))
        if self._heading_rad is not None and abs(_wrapped(heading_rad - self._heading_rad)) < TURN_RAD:
            return
        self._heading_rad = heading_rad
        cosine, sine = np.cos(heading_rad), np.sin(heading_rad)
        turn = np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])
        self.pose = Pose(turn @ self._belt.rotation, turn @ self._belt.translation_m)
        self.footprints_m = self._footprints()

    def places_m(self, points_m: F64) -> F64:
        """Return points (n, 3) of the reference frame as seen from above, (n, 2)."""
        return self.pose.apply(points_m.reshape(-1, 3))[:, :2]

    def spreads(self, places_m: F64, covariances_m2: F64) -> list[Spread]:
        """Return the ellipses of places (n, 2) seen from above, given covariances (n, 3, 3) in the reference frame."""
        R = self.pose.rotation[:2]
        return spreads_of(places_m, R @ covariances_m2 @ R.T)

    def _footprints(self) -> dict[str, F64]:
        return {name: self.places_m(mount.pose.apply(mount.footprint_m())) for name, mount in self._rig.mounts.items()}


def spreads_of(centres: F64, covariances: F64) -> list[Spread]:
    """Return the ellipses of 95 % of covariances (n, 2, 2) about centres (n, 2)."""
    values, vectors = np.linalg.eigh(covariances)
    axes = np.sqrt(CHI2_95 * np.maximum(values, 0.0))
    angle_rad = np.arctan2(vectors[:, 1, 1], vectors[:, 0, 1])
    rows = np.column_stack([centres, axes[:, 1], axes[:, 0], angle_rad])
    return [Spread(*row) for row in rows.tolist()]


def pictured_spreads(lens: Intrinsics, to_sensor: Pose, positions_m: F64, covariances_m2: F64) -> list[Spread | None]:
    """Return the ellipses of places in a sensor's picture, pixels (lens distortion left out of their shape).

    Args:
        lens: of the sensor.
        to_sensor: from the reference frame to the sensor's.
        positions_m: (n, 3) reference frame. covariances_m2: (n, 3, 3) of them.

    Returns:
        None for what lies behind the sensor.
    """
    x, y, z = to_sensor.apply(positions_m).T
    before = z >= NEAREST_M
    depth = np.where(before, z, 1.0)
    J = np.zeros((len(z), 2, 3))
    J[:, 0, 0], J[:, 0, 2] = lens.fx / depth, -lens.fx * x / depth**2
    J[:, 1, 1], J[:, 1, 2] = lens.fy / depth, -lens.fy * y / depth**2
    J = J @ to_sensor.rotation
    pixels = lens.project(np.stack([x, y, depth], axis=1))
    spreads = spreads_of(pixels, J @ covariances_m2 @ J.transpose(0, 2, 1))
    return [spread if seen else None for spread, seen in zip(spreads, before.tolist(), strict=True)]


def _wrapped(angle_rad: float) -> float:
    return float((angle_rad + np.pi) % (2.0 * np.pi) - np.pi)
