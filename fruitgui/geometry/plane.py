"""Planes: n·x + d = 0 with a unit normal."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from fruitgui.frame import F64
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rotation import rotation_between


@dataclass(frozen=True, slots=True, eq=False)
class Plane:
    """The points x with normal·x + offset_m = 0.

    Attributes:
        normal: (3,), unit length; for a belt it points to the sensor's side.
        offset_m: signed distance of the origin from the plane, along the normal.
    """

    normal: F64
    offset_m: float

    def height_m(self, points_m: ArrayLike) -> F64:
        """Return the signed distance of points (…, 3) from the plane, positive on the normal's side."""
        return np.asarray(np.asarray(points_m, dtype=np.float64) @ self.normal + self.offset_m)

    def foot(self, points_m: ArrayLike) -> F64:
        """Return the nearest points (…, 3) on the plane."""
        points = np.asarray(points_m, dtype=np.float64)
        return np.asarray(points - self.height_m(points)[..., None] * self.normal)

    def facing(self, point_m: F64) -> Plane:
        """Return the same plane with its normal pointing to the side of `point_m`."""
        return self if self.height_m(point_m) >= 0 else Plane(-self.normal, -self.offset_m)

    def mapped(self, pose: Pose) -> Plane:
        """Return the plane in the target frame of `pose`."""
        normal = pose.turn(self.normal)
        return Plane(normal, float(self.offset_m - normal @ pose.translation_m))

    def frame(self) -> Pose:
        """Return the pose into a frame lying on the plane: z along the normal, z = 0 on the plane.

        The origin maps from the foot of the source frame's origin; the x axis is
        the source's x axis laid on the plane by the smallest turn.
        """
        R = rotation_between(self.normal, np.array([0.0, 0.0, 1.0]))
        return Pose(R, np.array([0.0, 0.0, self.offset_m]))


@dataclass(frozen=True, slots=True, eq=False)
class Surface:
    """The belt as one sensor sees it.

    Attributes:
        plane: in the sensor's optical frame, normal to the sensor's side.
        region_m: (K, 3) polygon on the plane inside which fruit may be; None means everywhere in view.
    """

    plane: Plane
    region_m: F64 | None = None


def fit_plane(points_m: F64) -> Plane:
    """Return the plane of least squared distances to points (N, 3), N ≥ 3."""
    centre = points_m.mean(axis=0)
    _, _, Vt = np.linalg.svd(points_m - centre, full_matrices=False)
    normal = Vt[2]
    return Plane(normal, float(-normal @ centre))
