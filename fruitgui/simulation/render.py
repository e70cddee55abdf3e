"""What one sensor sees of the scene at one moment: exact pictures, then measured ones."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from fruitgui.frame import F32, F64, U8, U16, Intrinsics, Ints
from fruitgui.geometry.pose import Pose
from fruitgui.simulation.body import Body
from fruitgui.simulation.device import Device
from fruitgui.simulation.kinect import NoiseBank, Scan, measure_depth, to_millimetres
from fruitgui.simulation.light import Light, expose, mixing, vignette
from fruitgui.simulation.rays import Caster, Hits
from fruitgui.simulation.registration import Registration
from fruitgui.simulation.surroundings import Backdrop, Surroundings, WearMap, look

SKIN_INFRARED = 0.55
"""Reflectance of fruit skin at 830 nm; chlorophyll and anthocyanin are clear there, so dark fruit are not dark."""

NEAREST_BODY_M = 0.05


@dataclass(frozen=True, slots=True, eq=False)
class Placed:
    """A body at one moment: `pose` maps its mesh's frame into the world."""

    body: Body
    caster: Caster
    pose: Pose


@dataclass(frozen=True, slots=True, eq=False)
class Glimpse:
    """What one body shows to one camera, alone.

    Attributes:
        box: (left, top, right, bottom) of the part of the picture that was looked at, end exclusive.
        pixel: (K,) flat numbers of the pixels that see it.
        hits: of those pixels' rays, same order; distances are depths along the optical axis, metres.
        facing: (K,) cosine between the facet's normal and the line of sight.
    """

    box: tuple[int, int, int, int]
    pixel: Ints
    hits: Hits
    facing: F32


class Camera:
    """A pinhole in the world, made ready to look at bodies."""

    def __init__(self, intrinsics: Intrinsics, pose: Pose) -> None:
        self.intrinsics = intrinsics
        self.pose = pose
        rays = intrinsics.rays()
        self._forward = np.concatenate([rays, np.ones_like(rays[..., :1])], axis=-1)
        self._slant = np.linalg.norm(self._forward, axis=-1).ravel()

    def glimpse(self, placed: Placed) -> Glimpse | None:
        """Return what is seen of a body; None if it is out of the picture."""
        to_mesh = placed.pose.inverse() @ self.pose
        box = self._box(to_mesh.inverse().apply(placed.caster.rim_m))
        if box is None:
            return None
        left, top, right, bottom = box
        forward = self._forward[top:bottom, left:right].reshape(-1, 3)
        to_rays = np.zeros((3, 6), dtype=np.float32)
        to_rays[2, :3] = to_mesh.translation_m
        to_rays[:, 3:] = to_mesh.rotation.T
        rays = forward @ to_rays
        hits = placed.caster.hits(rays)
        row, column = np.divmod(hits.ray, right - left)
        pixel = (row + top) * self.intrinsics.width + (column + left)
        facing = -np.einsum("ij,ij->i", hits.normal, rays.take(hits.ray, axis=0)[:, 3:]) / self._slant.take(pixel)
        return Glimpse(box, pixel, hits, facing)

    def _box(self, points_m: np.ndarray) -> tuple[int, int, int, int] | None:
        if points_m[:, 2].min() < NEAREST_BODY_M:
            return None
        u, v = self.intrinsics.project(points_m).T
        left, top = max(int(u.min()) - 1, 0), max(int(v.min()) - 1, 0)
        right, bottom = min(int(u.max()) + 3, self.intrinsics.width), min(int(v.max()) + 3, self.intrinsics.height)
        return None if left >= right or top >= bottom else (left, top, right, bottom)


def in_front(glimpses: Sequence[Glimpse | None], z_m: F32) -> Iterator[tuple[int, Glimpse, Ints]]:
    """Draw bodies into a depth picture `z_m` (H, W); yield (number, glimpse, hits that were nearest when drawn)."""
    flat = z_m.reshape(-1)
    for number, glimpse in enumerate(glimpses):
        if glimpse is None:
            continue
        which = np.flatnonzero(glimpse.hits.distance < flat.take(glimpse.pixel))
        flat[glimpse.pixel.take(which)] = glimpse.hits.distance.take(which)
        yield number, glimpse, which


class Eye:
    """A device in its surroundings: everything about its pictures that never changes, made once."""

    def __init__(self, device: Device, surroundings: Surroundings, light: Light, rng: Generator) -> None:
        self.device = device
        self._light = light
        depth, color = device.depth_camera, device.color_camera
        self._depth_camera = Camera(depth, device.pose @ device.depth_to_color)
        self._color_camera = Camera(color, device.pose)
        behind, self._behind_color = (
            look(surroundings, camera.intrinsics.rays(), camera.pose)
            for camera in (self._depth_camera, self._color_camera)
        )
        self._empty_belt = Scan(behind.z_m, behind.infrared * behind.facing, behind.facing)
        self._radius2 = _radius2(depth)
        self._vignette = vignette(_radius2(color), device.color_model)
        self._mixing = mixing(light, device.color_model)
        self._lit = self._lit_backdrop(self._behind_color)
        self._wear = WearMap(surroundings.belt, self._behind_color)
        self._register = Registration(depth, color, device.depth_to_color)
        self._bank = NoiseBank(depth.height, depth.width, device.depth_model.window_px, rng)
        self._last_scan: tuple[bytes, Scan] | None = None
        self._last_light: tuple[bytes, F32] | None = None
        self._grain = _grain(color.height + 211, color.width + 307, device.color_model.blur_px, rng)

    def _lit_backdrop(self, behind: Backdrop) -> F32:
        light = self._light.on(behind.normal) * self._light.over(behind.place_m) * self._vignette
        return np.asarray(behind.albedo @ self._mixing * light[..., None], dtype=np.float32)

    def depth(self, bodies: Sequence[Placed], rng: Generator) -> U16:
        """Return the depth registered to colour, millimetres, as the sensor would give it."""
        return to_millimetres(self._register(self._measured(bodies, rng)))

    def own_depth(self, bodies: Sequence[Placed], rng: Generator) -> U16:
        """Return the depth in the infrared camera's own picture, millimetres."""
        return to_millimetres(self._measured(bodies, rng))

    def _measured(self, bodies: Sequence[Placed], rng: Generator) -> F32:
        scan = self.scan(bodies)
        device = self.device
        radius2 = self._radius2 if device.depth_model.radial_error else None
        return measure_depth(scan, device.depth_model, device.depth_camera.fx, radius2, self._bank, rng)

    def scan(self, bodies: Sequence[Placed]) -> Scan:
        """Return exact depth in the infrared camera, not to be written; kept while nothing moves."""
        key = _stand(bodies)
        if self._last_scan is None or self._last_scan[0] != key:
            self._last_scan = (key, self._scanned(bodies))
        return self._last_scan[1]

    def _scanned(self, bodies: Sequence[Placed]) -> Scan:
        empty = self._empty_belt
        z, signal, facing = empty.z_m.copy(), empty.signal.copy(), empty.facing.copy()
        for _, glimpse, which in in_front([self._depth_camera.glimpse(placed) for placed in bodies], z):
            pixel, cosine = glimpse.pixel.take(which), glimpse.facing.take(which)
            facing.reshape(-1)[pixel] = cosine
            signal.reshape(-1)[pixel] = np.float32(SKIN_INFRARED) * cosine
        return Scan(z, signal, facing)

    def color(self, bodies: Sequence[Placed], travel_m: float, speed_m_s: float, rng: Generator) -> U8:
        """Return the colour picture of a belt that has moved `travel_m` and moves at `speed_m_s`."""
        key = _stand(bodies) + np.array([travel_m, speed_m_s]).tobytes()
        if self._last_light is None or self._last_light[0] != key:
            self._last_light = (key, self._focused(bodies, travel_m, speed_m_s))
        light = self._last_light[1]
        row, column = int(rng.integers(212)), int(rng.integers(308))
        grain = self._grain[row : row + light.shape[0], column : column + light.shape[1]]
        return expose(light, self.device.color_model, self._light.lux, grain)

    def _focused(self, bodies: Sequence[Placed], travel_m: float, speed_m_s: float) -> F32:
        """Return the light on the sensor: what comes from the scene, blurred by lens and motion."""
        import cv2

        light = self.radiance(bodies, travel_m)
        model = self.device.color_model
        if model.blur_px:
            light = cv2.GaussianBlur(light, (3, 3), model.blur_px)
        smear = self._smear(speed_m_s * model.exposure_at_s(self._light.lux))
        if smear is not None:
            light = cv2.filter2D(light, -1, smear, borderType=cv2.BORDER_REPLICATE)
        return light

    def _smear(self, moved_m: float) -> F32 | None:
        """Return the kernel of motion blur for a belt that moves so far while exposing; None where it shows nothing.

        Taken amid the picture for all of it: what does not move are rails, which lie along the motion.
        """
        place, axis = self.device.pose.translation_m, self.device.pose.rotation[:, 2]
        middle = place - axis * place[2] / axis[2]
        ends = np.stack([middle, middle + np.array([moved_m, 0.0, 0.0])])
        first, last = self.device.color_camera.project(self.device.pose.inverse().apply(ends))
        return motion_kernel(last - first)

    def radiance(self, bodies: Sequence[Placed], travel_m: float) -> F32:
        """Return the light that comes from every pixel, (H, W, 3)."""
        import cv2

        glimpses = [self._color_camera.glimpse(placed) for placed in bodies]
        worn = self._wear.at(travel_m)
        for placed, glimpse in zip(bodies, glimpses, strict=True):
            if glimpse is not None:
                self._darken_belt(worn, placed, glimpse)
        picture: F32 = cv2.multiply(self._lit, cv2.merge([worn, worn, worn]))
        flat, shade = picture.reshape(-1, 3), self._vignette.reshape(-1)
        for number, glimpse, which in in_front(glimpses, self._behind_color.z_m.copy()):
            pixel = glimpse.pixel.take(which)
            flat[pixel] = self._shine(bodies[number], glimpse, which) * shade.take(pixel)[:, None]
        return picture

    def who(self, bodies: Sequence[Placed]) -> Ints:
        """Return which body each pixel of the colour picture sees: its number in `bodies`, −1 for none; (H, W)."""
        seen = np.full(self._behind_color.z_m.shape, -1, dtype=np.intp)
        glimpses = [self._color_camera.glimpse(placed) for placed in bodies]
        for number, glimpse, which in in_front(glimpses, self._behind_color.z_m.copy()):
            seen.reshape(-1)[glimpse.pixel[which]] = number
        return seen

    def _shine(self, placed: Placed, glimpse: Glimpse, which: Ints) -> F32:
        normal, albedo = placed.caster.skin(glimpse.hits, which)
        normal = normal @ placed.pose.rotation.T.astype(np.float32)
        shine = albedo * self._light.on(normal)[:, None]
        if placed.body.mesh.gloss:
            toward = self.device.pose.translation_m - placed.pose.translation_m
            mirrored = self._light.mirrored(normal, toward / np.linalg.norm(toward))
            shine += (placed.body.mesh.gloss * mirrored)[:, None]
        shine *= self._light.over(placed.pose.translation_m[:2].astype(np.float32))
        return np.asarray(shine @ self._mixing)

    def _darken_belt(self, worn: F32, placed: Placed, glimpse: Glimpse) -> None:
        """Darken the belt around a body (it hides a part of the sky)."""
        left, top, right, bottom = glimpse.box
        margin = (right - left + bottom - top) // 5
        part = np.s_[max(top - margin, 0) : bottom + margin, max(left - margin, 0) : right + margin]
        away = self._behind_color.place_m[part] - placed.pose.translation_m[:2].astype(np.float32)
        away *= np.float32(0.6 / placed.caster.reach_m)
        near = np.maximum(1 - away[..., 0] ** 2 - away[..., 1] ** 2, 0)
        near *= near
        near *= self._behind_color.on_belt[part]
        worn[part] *= 1 - np.float32(self._light.contact) * near


def _stand(bodies: Sequence[Placed]) -> bytes:
    """Return what says which bodies stand where."""
    poses = [np.append(placed.pose.matrix, placed.body.fruit_id) for placed in bodies]
    return np.array(poses).tobytes()


def motion_kernel(way_px: F64) -> F32 | None:
    """Return the kernel that spreads light evenly along a way (u, v), pixels; None for less than half a pixel."""
    length = float(np.linalg.norm(way_px))
    if length < 0.5:
        return None
    half = int(np.ceil(length / 2)) + 1
    kernel = np.zeros((2 * half + 1, 2 * half + 1), dtype=np.float32)
    for share in np.linspace(-0.5, 0.5, 4 * half + 1):
        u, v = half + way_px * share
        column, row = int(u), int(v)
        right, down = u - column, v - row
        kernel[row : row + 2, column : column + 2] += np.outer((1 - down, down), (1 - right, right))
    return np.asarray(kernel / kernel.sum())


def _grain(height: int, width: int, blur_px: float, rng: Generator) -> F32:
    """Return standard normal noise (H, W, 3), correlated as far as the colour filter's pixels reach."""
    import cv2

    grain = rng.standard_normal((height, width, 3), dtype=np.float32)
    if blur_px:
        grain = cv2.GaussianBlur(grain, (3, 3), 0.5)
    return np.asarray(grain / grain.std(), dtype=np.float32)


def _radius2(camera: Intrinsics) -> F32:
    u = (np.arange(camera.width) - camera.cx)[None, :]
    v = (np.arange(camera.height) - camera.cy)[:, None]
    squared = u * u + v * v
    return np.asarray(squared / squared.max(), dtype=np.float32)
