"""The two cameras of a Kinect, and how one stands to the other, from what the factory wrote into it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from fruitgui.frame import F64, Intrinsics
from fruitgui.geometry.pose import Pose
from fruitgui.sensors.kinect.depth_table import ZeroPlane
from fruitgui.sensors.kinect.factory import Factory
from fruitgui.sensors.registration import Registration

WIDTH, HEIGHT = 640, 480
NOMINAL_COLOR = Intrinsics(WIDTH, HEIGHT, 525.0, 525.0, 319.5, 239.5)
_NOMINAL_DISTANCE_M = 0.025

_DEPTHS_M = (0.6, 1.0, 2.0)
_STEP_PX = 16
_LARGEST_RMS_PX = 1.0
"""What the factory wrote is a lens, a roll and a shift to some tenths of a pixel; more says that it is damaged."""
_FOCAL_PX = (450.0, 600.0)
_LARGEST_ROLL = math.radians(5.0)


@dataclass(frozen=True, slots=True, eq=False)
class Cameras:
    """What registers one device's depth to its colour.

    Attributes:
        registration: depth camera, colour camera and pose.
        rms_px: how far it is from what the factory wrote; None where that cannot be used, and a usual Kinect's cameras
            stand in.
    """

    registration: Registration
    rms_px: float | None


def depth_camera(plane: ZeroPlane) -> Intrinsics:
    """Return the infrared camera as the device itself sees it: without a lens that bends."""
    return Intrinsics(WIDTH, HEIGHT, plane.focal_px, plane.focal_px, (WIDTH - 1) / 2, (HEIGHT - 1) / 2)


def nominal_cameras(plane: ZeroPlane) -> Cameras:
    """Return a usual Kinect's cameras."""
    pose = Pose(np.eye(3), np.array([-_NOMINAL_DISTANCE_M, 0.0, 0.0]))
    return Cameras(Registration(depth_camera(plane), NOMINAL_COLOR, pose), None)


@lru_cache(maxsize=8)
def cameras_of(factory: Factory) -> Cameras:
    """Return the cameras that put each reading where the factory says, as nearly as cameras can.

    The factory's table is a cubic polynomial of the depth pixel and a shift
    along the rows that goes with inverse depth: two cameras that look the same
    way, rolled against each other, with a lens between them. The infrared
    camera is taken to be straight, since depth is; what bends is the colour
    camera's. So the points that are made of the registered picture lie where
    the infrared camera saw them. Made once for each device, since its tables take a second.
    """
    from scipy.optimize import least_squares

    depth = depth_camera(factory.zero_plane)
    u, v, z_m = (one.ravel() for one in np.meshgrid(*_grid(), indexing="ij"))
    wanted = np.stack(factory.color_pixels(u, v, z_m))
    seen = (wanted > -1).all(axis=0) & (wanted[0] < WIDTH) & (wanted[1] < HEIGHT)
    if seen.mean() < 0.5 or not np.isfinite(wanted).all():
        return nominal_cameras(factory.zero_plane)
    rays = np.stack([(u - depth.cx) / depth.fx, (v - depth.cy) / depth.fy])[:, seen]
    inverse, wanted = 1.0 / z_m[seen], wanted[:, seen]

    def misses(parameters: F64) -> F64:
        return np.asarray((_color_pixels(parameters, rays, inverse, factory.parallax_px_m) - wanted).ravel())

    begin = np.array([525.0, 525.0, 319.5, 239.5, 0.0, 0.0, 0.0, 0.0])
    found = least_squares(misses, begin, x_scale=np.array([10.0, 10.0, 10.0, 10.0, 0.1, 0.01, 0.01, 0.01]))
    rms_px = math.sqrt(2.0 * float(np.mean(found.fun**2)))
    if not _is_plausible(found.x, rms_px):
        return nominal_cameras(factory.zero_plane)
    return Cameras(_registration(found.x, depth, factory.parallax_px_m), rms_px)


def _grid() -> tuple[F64, F64, F64]:
    middle = _STEP_PX / 2 - 0.5
    return np.arange(middle, WIDTH, _STEP_PX), np.arange(middle, HEIGHT, _STEP_PX), np.array(_DEPTHS_M)


def _color_pixels(parameters: F64, rays: F64, inverse: F64, parallax_px_m: float) -> F64:
    """Return colour pixels (2, N) of depth rays (2, N) at inverse depths (N,), OpenCV's lens."""
    fx, fy, cx, cy, k1, p1, p2, roll = parameters
    x = math.cos(roll) * rays[0] - math.sin(roll) * rays[1] - parallax_px_m / fx * inverse
    y = math.sin(roll) * rays[0] + math.cos(roll) * rays[1]
    r2 = x * x + y * y
    bent_x = x * (1.0 + k1 * r2) + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x)
    bent_y = y * (1.0 + k1 * r2) + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y
    return np.stack([fx * bent_x + cx, fy * bent_y + cy])


def _is_plausible(parameters: F64, rms_px: float) -> bool:
    fx, fy, _, _, k1, p1, p2, roll = parameters
    low, high = _FOCAL_PX
    lens = abs(k1) < 0.5 and abs(p1) < 0.05 and abs(p2) < 0.05
    return rms_px < _LARGEST_RMS_PX and low < fx < high and low < fy < high and lens and abs(roll) < _LARGEST_ROLL


def _registration(parameters: F64, depth: Intrinsics, parallax_px_m: float) -> Registration:
    fx, fy, cx, cy, k1, p1, p2, roll = (float(one) for one in parameters)
    color = Intrinsics(WIDTH, HEIGHT, fx, fy, cx, cy, (k1, 0.0, p1, p2, 0.0))
    turn = np.array([[math.cos(roll), -math.sin(roll), 0.0], [math.sin(roll), math.cos(roll), 0.0], [0.0, 0.0, 1.0]])
    return Registration(depth, color, Pose(turn, np.array([-parallax_px_m / fx, 0.0, 0.0])))
