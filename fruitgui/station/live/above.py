"""The belt from above (x along its motion, y to the left of it, metres), and ellipses there and in pictures."""

from __future__ import annotations

import numpy as np

from fruitgui.frame import F64
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rig import Mount, Rig
from fruitgui.station.live.state import Spread

CHI2_95 = 5.991
"""Squared distance within which a normal place in the plane lies with 95 %."""

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

    def spread(self, place_m: F64, covariance_m2: F64) -> Spread:
        """Return the ellipse of a place seen from above, given its covariance (3, 3) in the reference frame."""
        R = self.pose.rotation
        return spread_of(place_m, (R @ covariance_m2 @ R.T)[:2, :2])

    def _footprints(self) -> dict[str, F64]:
        return {name: self.places_m(mount.pose.apply(mount.footprint_m())) for name, mount in self._rig.mounts.items()}


def spread_of(centre: F64, covariance: F64) -> Spread:
    """Return the ellipse of 95 % of a covariance (2, 2) about a centre (2,)."""
    values, vectors = np.linalg.eigh(covariance)
    minor, major = np.sqrt(CHI2_95 * np.maximum(values, 0.0))
    angle_rad = float(np.arctan2(vectors[1, 1], vectors[0, 1]))
    return Spread(float(centre[0]), float(centre[1]), float(major), float(minor), angle_rad)


def pictured_spread(mount: Mount, position_m: F64, covariance_m2: F64) -> Spread | None:
    """Return the ellipse of a place in a sensor's picture, pixels (lens distortion left out of its shape).

    Args:
        mount: of the sensor.
        position_m: (3,) reference frame. covariance_m2: (3, 3) of it.

    Returns:
        None where it lies behind the sensor.
    """
    to_sensor = mount.pose.inverse()
    point = to_sensor.apply(position_m)
    if point[2] < 0.05:
        return None
    lens, z = mount.intrinsics, point[2]
    J = np.array([[lens.fx / z, 0.0, -lens.fx * point[0] / z**2], [0.0, lens.fy / z, -lens.fy * point[1] / z**2]])
    J = J @ to_sensor.rotation
    return spread_of(lens.project(point)[0], J @ covariance_m2 @ J.T)


def _wrapped(angle_rad: float) -> float:
    return float((angle_rad + np.pi) % (2.0 * np.pi) - np.pi)
