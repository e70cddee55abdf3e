"""Where each sensor, and all of them together, can see a fruit."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F64
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rig import Mount, Rig


@dataclass(frozen=True, slots=True, eq=False)
class SensorField:
    """What one sensor sees: inside its picture, and over its region of the belt.

    Attributes:
        pose: from the reference frame into the sensor's.
        half_planes: (K, 4) of planes in the sensor's frame (unit normal, offset), positive inside.
    """

    pose: Pose
    half_planes: F64

    def depth_m(self, points_m: F64) -> F64:
        """Return how far points (n, 3) of the reference frame lie inside (negative: outside), metres, (n,)."""
        points = self.pose.apply(points_m)
        return np.asarray((points @ self.half_planes[:, :3].T + self.half_planes[:, 3]).min(axis=1))


def _picture_planes(mount: Mount) -> F64:
    """Return the four planes through the picture's borders, normals inward (lens distortion left out)."""
    lens = mount.intrinsics
    left, right = -lens.cx / lens.fx, (lens.width - 1 - lens.cx) / lens.fx
    top, bottom = -lens.cy / lens.fy, (lens.height - 1 - lens.cy) / lens.fy
    normals = np.array([[1, 0, -left], [-1, 0, right], [0, 1, -top], [0, -1, bottom]], dtype=np.float64)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return np.hstack([normals, np.zeros((4, 1))])


def _region_planes(mount: Mount) -> F64:
    """Return the upright planes through the sides of the region's convex hull, normals inward."""
    import cv2

    if mount.surface.region_m is None or len(mount.surface.region_m) < 3:
        return np.zeros((0, 4))
    frame = mount.surface.plane.frame()
    hull = cv2.convexHull(frame.apply(mount.surface.region_m)[:, :2].astype(np.float32)).reshape(-1, 2)
    corners = np.asarray(hull, dtype=np.float64)
    sides = np.roll(corners, -1, axis=0) - corners
    lengths = np.linalg.norm(sides, axis=1)
    corners, sides = corners[lengths > 1e-6], sides[lengths > 1e-6] / lengths[lengths > 1e-6, None]
    inward = np.stack([-sides[:, 1], sides[:, 0], np.zeros(len(sides))], axis=1)
    inward *= np.sign(((corners.mean(axis=0) - corners) * inward[:, :2]).sum(axis=1))[:, None]
    offsets = -(inward[:, :2] * corners).sum(axis=1)
    back = frame.inverse()
    normals = back.turn(inward)
    return np.hstack([normals, (offsets - normals @ back.translation_m)[:, None]])


@dataclass(frozen=True, slots=True, eq=False)
class FieldOfView:
    """The fields of all sensors of a rig, by sensor id."""

    sensors: dict[str, SensorField]

    @classmethod
    def of(cls, rig: Rig) -> FieldOfView:
        """Return the fields of a rig's sensors."""
        return cls({name: _sensor_field(mount) for name, mount in rig.mounts.items()})

    def depth_m(self, points_m: F64) -> F64:
        """Return how far points (n, 3) lie inside the field of the sensor that sees them best, (n,)."""
        return np.asarray(np.max([field.depth_m(points_m) for field in self.sensors.values()], axis=0))


def _sensor_field(mount: Mount) -> SensorField:
    return SensorField(mount.pose.inverse(), np.vstack([_picture_planes(mount), _region_planes(mount)]))
