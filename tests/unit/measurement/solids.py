"""Ellipsoids that pass under two opposed sensors: exact sights, then a Kinect's disparity noise. Truth is a formula."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.frame import F64, Intrinsics
from fruitgui.geometry.plane import Plane, Surface
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rig import Mount, Rig
from fruitgui.geometry.rotation import rotation_from_vector
from fruitgui.perception.view import FruitView
from fruitgui.tracking.track import PathPoint, Sighting, Track

CAMERA = Intrinsics(640, 480, 580.0, 580.0, 319.5, 239.5)
DISPARITY_M_PX = 580.0 * 0.075


@dataclass(frozen=True)
class Solid:
    """An ellipsoid with semi-axes (3,), turned by a rotation vector (3,), resting on the belt."""

    axes_m: tuple[float, float, float]
    turn_rad: tuple[float, float, float] = (0.0, 0.0, 0.0)

    @property
    def volume_m3(self) -> float:
        return float(4.0 / 3.0 * np.pi * np.prod(self.axes_m))

    @property
    def length_m(self) -> float:
        return 2.0 * max(self.axes_m)

    @property
    def diameter_m(self) -> float:
        return 2.0 * sorted(self.axes_m)[1]

    @property
    def matrix(self) -> F64:
        """A with |A p| = 1 on the surface, belt axes."""
        return np.asarray(np.diag(1.0 / np.array(self.axes_m)) @ rotation_from_vector(np.array(self.turn_rad)).T)

    @property
    def height_m(self) -> float:
        """Of the centre over the belt."""
        return float(np.linalg.norm(np.linalg.inv(self.matrix).T[:, 2]))


def opposed_rig(height_m: float = 1.0, tilt_deg: float = 40.0, sensors: int = 2) -> tuple[dict[str, Pose], Rig]:
    """Return the sensors' poses into the belt's frame, and the rig that a calibration without error would give."""
    poses = {}
    for number in range(sensors):
        side, tilt = 1.0 - 2.0 * number, np.deg2rad(tilt_deg)
        forward = np.array([0.0, -side * np.sin(tilt), -np.cos(tilt)])
        right = np.array([side, 0.0, 0.0])
        rotation = np.stack([right, np.cross(forward, right), forward], axis=1)
        poses[f"kinect_{number + 1}"] = Pose(rotation, -forward * height_m / np.cos(tilt))
    reference = poses["kinect_1"].inverse()
    mounts = {
        name: Mount(
            name,
            reference @ pose,
            Surface(Plane(pose.inverse().turn([0.0, 0.0, 1.0]), float(pose.translation_m[2]))),
            CAMERA,
        )
        for name, pose in poses.items()
    }
    return poses, Rig("kinect_1", mounts)


def track_of(
    solid: Solid,
    seed: int = 0,
    *,
    views: int = 40,
    noise: float = 1.0,
    fattening_px: int = 0,
    rig: tuple[dict[str, Pose], Rig] | None = None,
    only: str | None = None,
    wobble_rad: float = 0.0,
    still_s: float = 0.0,
) -> tuple[Track, Rig]:
    """Return the track of a solid that passes at 0.1 m/s, seen by the sensors in turn, and their rig.

    Halfway the belt stands for `still_s`.
    """
    rng = np.random.default_rng(seed)
    poses, stand = rig or opposed_rig()
    names = [only] if only else list(poses)
    sightings, centres = [], []
    for number in range(views):
        time_s = (8.0 + still_s) * (number + 0.5) / views
        moved_s = min(time_s, max(4.0, time_s - still_s))
        name = names[number % len(names)]
        turn = rotation_from_vector(np.array([0.0, wobble_rad * np.sin(2.1 * time_s), 0.0]))
        matrix = solid.matrix @ turn.T
        lifted = float(np.linalg.norm(np.linalg.inv(matrix).T[:, 2]))
        centre = np.array([0.1 * moved_s - 0.4, 0.03, lifted])
        view = _view(matrix, centre, name, poses[name], number, time_s, noise, fattening_px, rng)
        sightings.append(Sighting(time_s, view))
        centres.append(centre)
    to_reference = poses["kinect_1"].inverse()
    path = tuple(
        PathPoint(s.time_s, to_reference.apply(centre), 1e-5 * np.eye(3))
        for s, centre in zip(sightings, centres, strict=True)
    )
    return Track(1, tuple(sightings), path, to_reference.turn([0.8 / (8.0 + still_s), 0.0, 0.0])), stand


def _view(
    matrix: F64, centre: F64, sensor: str, pose: Pose, number: int, time_s: float, noise: float, fattening_px: int,
    rng: np.random.Generator,
) -> FruitView:  # fmt: skip
    A = matrix @ pose.rotation
    middle = pose.inverse().apply(centre)
    u0, v0 = CAMERA.project(middle[None])[0].round().astype(int)
    reach = int(0.09 * CAMERA.fx / middle[2])
    v, u = np.mgrid[v0 - reach : v0 + reach + 1, u0 - reach : u0 + reach + 1]
    rays = np.stack([(u - CAMERA.cx) / CAMERA.fx, (v - CAMERA.cy) / CAMERA.fy, np.ones(u.shape)], axis=-1)
    z = _first_hit(rays @ A.T, A @ middle)
    z = _fattened(z, fattening_px)
    mask = (z > 0).astype(np.uint8)
    depth = _measured(z, noise, rng)
    edge = cv2.distanceTransform(mask, cv2.DIST_L2, 3)
    inside = mask > 0
    points = (rays * depth[..., None])[inside].astype(np.float32)
    contours, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    outline = max(contours, key=len)[:, 0].astype(np.float32) + np.array([u[0, 0], v[0, 0]], np.float32)
    mean = points.mean(axis=0).astype(np.float64)
    height = pose.apply(points)[:, 2]
    left, top, width, tall = cv2.boundingRect(outline.astype(np.int32))
    return FruitView(
        sensor, number, time_s, (left, top, width, tall), outline, points, edge[inside].astype(np.float32),
        int(inside.sum()), mean * (1.0 + 0.02 / float(np.linalg.norm(mean))), 1e-5 * np.eye(3), mean, 1e-6 * np.eye(3),
        float(np.percentile(height, 97)), np.zeros(1, np.float32), np.zeros((40, 40, 3), np.uint8), True, False,
        np.ones(len(outline), bool),
    )  # fmt: skip


def _first_hit(directions: F64, middle: F64) -> F64:
    """Return the depth of the nearer root of |d z − m|² = 1 where there is one, else 0."""
    a = np.sum(directions**2, axis=-1)
    b = directions @ middle
    root = b**2 - a * (middle @ middle - 1.0)
    return np.where(root > 0, (b - np.sqrt(np.maximum(root, 0.0))) / a, 0.0)


def _fattened(z: F64, pixels: int) -> F64:
    grown = z
    for _ in range(pixels):
        wide = cv2.dilate(grown.astype(np.float32), cv2.getStructuringElement(cv2.MORPH_CROSS, (3, 3)))
        grown = np.where(grown > 0, grown, wide)
    return grown


def _measured(z: F64, noise: float, rng: np.random.Generator) -> F64:
    """Return depth from disparity with correlated noise (σ_z = 1.4e-3 z² m) in steps of 1/8 px."""
    if not noise:
        return z
    chance = cv2.GaussianBlur(rng.normal(size=z.shape), (0, 0), 1.5) * 3.0 * np.sqrt(np.pi)
    disparity = DISPARITY_M_PX / np.where(z > 0, z, 1.0) + noise * 0.05 * chance
    return np.where(z > 0, DISPARITY_M_PX / (np.rint(disparity * 8.0) / 8.0), 0.0)
