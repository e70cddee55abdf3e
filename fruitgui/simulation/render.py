"""What one sensor sees of the scene at one moment: exact pictures, then measured ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from fruitgui.frame import F32, U8, U16, Intrinsics
from fruitgui.geometry.pose import Pose
from fruitgui.simulation.body import Body
from fruitgui.simulation.device import Device
from fruitgui.simulation.kinect import NoiseBank, Scan, measure_depth, to_millimetres
from fruitgui.simulation.light import ColorResponse, Light, gains, vignette
from fruitgui.simulation.rays import Caster, Hits
from fruitgui.simulation.registration import Registration
from fruitgui.simulation.surroundings import Backdrop, Surroundings, look, wear_at

SKIN_INFRARED = 0.55
"""Reflectance of fruit skin at 830 nm; chlorophyll and anthocyanin are clear there, so dark fruit are not dark."""


@dataclass(frozen=True, slots=True, eq=False)
class Placed:
    """A body at one moment: `pose` maps its mesh's frame into the world."""

    body: Body
    caster: Caster
    pose: Pose


@dataclass(frozen=True, slots=True, eq=False)
class Patch:
    """What one body shows to one camera.

    Attributes:
        rows, columns: the part of the picture that was looked at.
        hits: of its rays, in order of the pixels; distances are depths along the optical axis.
    """

    rows: slice
    columns: slice
    hits: Hits


def cast(placed: Placed, camera: Intrinsics, camera_pose: Pose) -> Patch | None:
    """Return what a camera (pose into the world) sees of a body alone; None if it is out of the picture."""
    to_mesh = placed.pose.inverse() @ camera_pose
    corners = to_mesh.inverse().apply(placed.body.mesh.vertices_m)
    if corners[:, 2].min() < 0.05:
        return None
    pixels = camera.project(corners)
    first = np.maximum(np.floor(pixels.min(axis=0)).astype(int) - 1, 0)
    last = np.minimum(np.ceil(pixels.max(axis=0)).astype(int) + 2, (camera.width, camera.height))
    if (first >= last).any():
        return None
    rows, columns = slice(first[1], last[1]), slice(first[0], last[0])
    rays = camera.rays()[rows, columns].reshape(-1, 2)
    bundle = np.empty((len(rays), 6), dtype=np.float32)
    bundle[:, :3] = to_mesh.translation_m
    bundle[:, 3:] = rays @ to_mesh.rotation[:, :2].T.astype(np.float32) + to_mesh.rotation[:, 2].astype(np.float32)
    return Patch(rows, columns, placed.caster.hits(bundle))


class Eye:
    """A device in its surroundings: everything about its pictures that never changes, made once."""

    def __init__(self, device: Device, surroundings: Surroundings, light: Light, rng: Generator) -> None:
        self.device = device
        self._surroundings = surroundings
        self._light = light
        self._depth_pose = device.pose @ device.depth_to_color
        depth, color = device.depth_camera, device.color_camera
        self._behind_depth = look(surroundings, depth.rays(), self._depth_pose)
        self._behind_color = look(surroundings, color.rays(), device.pose)
        self._signal = self._behind_depth.infrared * self._behind_depth.facing
        self._radius2 = _radius2(depth)
        self._vignette = vignette(_radius2(color), device.color_model)
        self._gains = gains(light, device.color_model).astype(np.float32)
        self._lit = self._lit_backdrop(self._behind_color)
        self._register = Registration(depth, color, device.depth_to_color)
        self._bank = NoiseBank(depth.height, depth.width, device.depth_model.window_px, rng)
        self._grain = rng.standard_normal((color.height + 211, color.width + 307, 3), dtype=np.float32)
        self._response = ColorResponse(device.color_model, light)

    def _lit_backdrop(self, behind: Backdrop) -> F32:
        light = self._light.on(behind.normal) * self._light.over(behind.place_m) * self._vignette
        return np.asarray(behind.albedo * light[..., None] * self._gains, dtype=np.float32)

    def depth(self, bodies: Sequence[Placed], rng: Generator) -> U16:
        """Return the registered depth, millimetres, as the sensor would give it."""
        scan = self.scan(bodies)
        device = self.device
        radius2 = self._radius2 if device.depth_model.radial_error else None
        measured = measure_depth(scan, device.depth_model, device.depth_camera.fx, radius2, self._bank, rng)
        return to_millimetres(self._register(measured))

    def scan(self, bodies: Sequence[Placed]) -> Scan:
        """Return exact depth in the infrared camera."""
        z, signal, facing = self._behind_depth.z_m.copy(), self._signal.copy(), self._behind_depth.facing.copy()
        for placed in bodies:
            patch = cast(placed, self.device.depth_camera, self._depth_pose)
            if patch is None:
                continue
            rows, columns, found = self._nearer(patch, z)
            z[rows, columns] = patch.hits.distance[found]
            normal = patch.hits.normal[found] @ placed.pose.rotation.T.astype(np.float32)
            rays = self.device.depth_camera.rays()[rows, columns]
            cosine = _facing(normal, rays, self._depth_pose)
            facing[rows, columns] = cosine
            signal[rows, columns] = SKIN_INFRARED * cosine
        return Scan(z, signal, facing)

    @staticmethod
    def _nearer(patch: Patch, z: F32) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return rows and columns of the pixels where the patch is in front of `z`, and which of its hits they are."""
        width = patch.columns.stop - patch.columns.start
        index = np.flatnonzero(patch.hits.hit)
        rows, columns = index // width + patch.rows.start, index % width + patch.columns.start
        found = np.flatnonzero(patch.hits.distance < z[rows, columns])
        return rows[found], columns[found], found

    def color(self, bodies: Sequence[Placed], travel_m: float, rng: Generator) -> U8:
        """Return the colour picture."""
        picture, _ = self.radiance(bodies, travel_m)
        blur = self.device.color_model.blur_px
        if blur:
            import cv2

            picture = cv2.GaussianBlur(picture, (3, 3), blur)
        row, column = int(rng.integers(212)), int(rng.integers(308))
        height, width = picture.shape[:2]
        return self._response.expose(picture, self._grain[row : row + height, column : column + width])

    def radiance(self, bodies: Sequence[Placed], travel_m: float) -> tuple[F32, U16]:
        """Return the light that comes from every pixel (H, W, 3), and which body it sees (index + 1, 0 none)."""
        behind = self._behind_color
        worn = np.where(behind.on_belt, wear_at(self._surroundings.belt, behind.place_m, travel_m), np.float32(1))
        z, who = behind.z_m.copy(), np.zeros(behind.z_m.shape, dtype=np.uint16)
        patches = [cast(placed, self.device.color_camera, self.device.pose) for placed in bodies]
        for placed, patch in zip(bodies, patches, strict=True):
            if patch is not None:
                self._darken_belt(worn, placed, patch)
        picture = self._lit * worn[..., None]
        for index, (placed, patch) in enumerate(zip(bodies, patches, strict=True)):
            if patch is None:
                continue
            rows, columns, found = self._nearer(patch, z)
            z[rows, columns] = patch.hits.distance[found]
            who[rows, columns] = index + 1
            picture[rows, columns] = self._shine(placed, patch, found) * self._vignette[rows, columns, None]
        return picture, who

    def _shine(self, placed: Placed, patch: Patch, found: np.ndarray) -> F32:
        normal = patch.hits.normal[found] @ placed.pose.rotation.T.astype(np.float32)
        light = self._light.on(normal) * self._light.over(placed.pose.translation_m[:2].astype(np.float32))
        return np.asarray(patch.hits.albedo[found] * light[:, None] * self._gains, dtype=np.float32)

    def _darken_belt(self, worn: F32, placed: Placed, patch: Patch) -> None:
        """Darken the belt around a body (the sky it hides)."""
        margin = (patch.rows.stop - patch.rows.start + patch.columns.stop - patch.columns.start) // 8
        rows = slice(max(patch.rows.start - margin, 0), patch.rows.stop + margin)
        columns = slice(max(patch.columns.start - margin, 0), patch.columns.stop + margin)
        behind = self._behind_color
        away = behind.place_m[rows, columns] - placed.pose.translation_m[:2].astype(np.float32)
        reach2 = np.float32(placed.body.reach_m() ** 2)
        near = np.exp(-(away[..., 0] ** 2 + away[..., 1] ** 2) / reach2)
        worn[rows, columns] *= np.where(behind.on_belt[rows, columns], 1 - np.float32(self._light.contact) * near, 1)


def _facing(normal: F32, rays: F32, pose: Pose) -> F32:
    """Return the cosine between world normals (N, 3) and the line of sight of pixels with rays (N, 2)."""
    toward = rays @ pose.rotation[:, :2].T.astype(np.float32) + pose.rotation[:, 2].astype(np.float32)
    return np.asarray(-(normal * toward).sum(axis=1) / np.linalg.norm(toward, axis=1))


def _radius2(camera: Intrinsics) -> F32:
    u = (np.arange(camera.width) - camera.cx)[None, :]
    v = (np.arange(camera.height) - camera.cy)[:, None]
    squared = u * u + v * v
    return np.asarray(squared / squared.max(), dtype=np.float32)
