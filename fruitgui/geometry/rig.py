"""The sensors as placed over one belt."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F64, Intrinsics
from fruitgui.geometry.plane import Plane, Surface
from fruitgui.geometry.pose import Pose


@dataclass(frozen=True, slots=True, eq=False)
class Mount:
    """One sensor of a rig.

    Attributes:
        sensor: its id.
        pose: from its optical frame into the reference sensor's.
        surface: the belt as it sees it, in its own optical frame.
        intrinsics: of its colour camera.
    """

    sensor: str
    pose: Pose
    surface: Surface
    intrinsics: Intrinsics

    def footprint_m(self) -> F64:
        """Return the (K, 3) polygon of belt that this sensor sees inside its region, in its own optical frame.

        Rays that do not meet the belt within 6 m are cut there.
        """
        import cv2

        plane_frame = self.surface.plane.frame()
        corners = _view_on_plane(self.intrinsics, self.surface.plane)
        seen = plane_frame.apply(corners)[:, :2].astype(np.float32)
        if self.surface.region_m is not None:
            region = plane_frame.apply(self.surface.region_m)[:, :2].astype(np.float32)
            _, both = cv2.intersectConvexConvex(cv2.convexHull(region), cv2.convexHull(seen))
            seen = np.zeros((0, 2), np.float32) if both is None else both.reshape(-1, 2)
        flat = np.hstack([seen.astype(np.float64), np.zeros((len(seen), 1))])
        return plane_frame.inverse().apply(flat)


def _view_on_plane(intrinsics: Intrinsics, plane: Plane, farthest_m: float = 6.0) -> F64:
    """Return where the rays around the picture's edge meet the plane, (K, 3) in the optical frame."""
    edge = intrinsics.rays_at(_edge(intrinsics))
    directions = np.hstack([edge, np.ones((len(edge), 1))])
    approach = -(directions @ plane.normal)
    with np.errstate(divide="ignore"):
        z = np.where(approach > 1e-6, plane.offset_m / np.maximum(approach, 1e-6), farthest_m)
    return np.asarray(directions * np.clip(z, 0.0, farthest_m)[:, None])


def _edge(picture: Intrinsics, step_px: int = 16) -> F64:
    """Return pixels (K, 2) around a picture's edge: the rays of all others are not asked for."""
    right, low = picture.width - 1, picture.height - 1
    u, v = np.arange(0, right + 1, step_px), np.arange(0, low + 1, step_px)
    sides = (
        (u, np.zeros_like(u)), (np.full_like(v, right), v), (right - u, np.full_like(u, low)),
        (np.zeros_like(v), low - v),
    )  # fmt: skip
    return np.concatenate([np.column_stack(side) for side in sides]).astype(np.float64)


@dataclass(frozen=True, slots=True, eq=False)
class Rig:
    """All sensors over one belt.

    Attributes:
        reference: the id of the sensor whose optical frame is the frame of reference.
        mounts: by sensor id.
    """

    reference: str
    mounts: Mapping[str, Mount]

    def belt(self) -> Plane:
        """Return the belt's plane in the reference frame, as the reference sensor (or, without it, another) sees it."""
        mount = self.mounts.get(self.reference)
        if mount is not None:
            return mount.surface.plane
        mount = next(iter(self.mounts.values()))
        return mount.surface.plane.mapped(mount.pose)

    def belt_frame(self) -> Pose:
        """Return the pose from the reference frame into one on the belt: z up from the belt, z = 0 on it."""
        return self.belt().frame()

    def footprint_m(self, sensor: str) -> F64:
        """Return a sensor's footprint on the belt as (K, 2) of the belt frame's x and y."""
        mount = self.mounts[sensor]
        return self.belt_frame().apply(mount.pose.apply(mount.footprint_m()))[:, :2]
