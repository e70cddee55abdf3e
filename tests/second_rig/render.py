"""Pictures and true depth: sphere tracing inside the pixel box of each thing, over the standing backdrop."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from tests.second_rig.bodies import F64
from tests.second_rig.camera import Lens, Stand, project, rays
from tests.second_rig.kinect import Fields, fields, read_depth
from tests.second_rig.produce import Thing
from tests.second_rig.scene import Actor, Eye, Scene
from tests.second_rig.setting import BELT, Backdrop, backdrop, belt_grain, lamp_light, linear

DEPTH_CAMERA_SHIFT_M = np.array([-0.025, 0.0, 0.0])
"""Where a sensor's own depth camera sits in its colour frame, when depth is not registered."""


@dataclass(frozen=True, slots=True, eq=False)
class Shot:
    """One frame before it is written: RGB (h, w, 3), depth in millimetres (h, w), what every pixel shows."""

    colour: NDArray[np.uint8]
    depth_mm: NDArray[np.uint16]
    owner: NDArray[np.int32]


@dataclass(slots=True, eq=False)
class _View:
    depth_m: F64
    owner: NDArray[np.int32]
    cosine: F64
    light: F64
    place_m: F64


@dataclass(slots=True)
class Renderer:
    """Renders a scene's captures; keeps each camera's backdrop, and its last view for as long as nothing moves."""

    scene: Scene
    _backdrops: dict[tuple[str, bytes], Backdrop] = field(default_factory=dict)
    _still: dict[tuple[str, bytes, bytes], _View] = field(default_factory=dict)
    _fields: dict[str, Fields] = field(default_factory=dict)

    def shoot(self, eye: Eye, time_s: float, sequence: int) -> Shot:
        """Return what a sensor gives at a time; the same for the same seed."""
        rng = np.random.default_rng([self.scene.seed, sum(eye.name.encode()), sequence, 77])
        stand = self.scene.stand_at(eye, time_s)
        view = self._trace(eye, stand, time_s)
        if eye.name not in self._fields:
            own = np.random.default_rng([self.scene.seed, sum(eye.name.encode())])
            shape = (eye.lens.height, eye.lens.width)
            self._fields[eye.name] = fields(shape, eye.noise, own)
        chaos = self._fields[eye.name]
        grain = np.stack([chaos.cut(chaos.white, rng) for _ in range(3)], axis=-1)
        colour = _expose(view.light, self.scene.light_lx, grain)
        if eye.depth_in_own_camera:
            stand = Stand(stand.rotation, stand.outward(DEPTH_CAMERA_SHIFT_M))
            depth_view = self._trace(eye, stand, time_s)
        else:
            depth_view = view
        depth = read_depth(depth_view.depth_m, depth_view.owner, depth_view.cosine, depth_view.light.mean(axis=-1),
                           eye.lens.fx, eye.noise, rng, chaos)  # fmt: skip
        return Shot(colour, depth, view.owner)

    def _trace(self, eye: Eye, stand: Stand, time_s: float) -> _View:
        key = (eye.name, stand.centre_m.tobytes())
        if key not in self._backdrops:
            self._backdrops[key] = backdrop(self.scene.setting, eye.lens, stand)
        places = np.array([self.scene.origin_m(actor, time_s) for actor in self.scene.actors]).tobytes()
        view = self._still.get((*key, places))
        if view is None:
            view = _begin(self._backdrops[key], self.scene, time_s)
            for actor in self.scene.actors:
                _paint(view, actor, self.scene, eye.lens, stand, time_s)
            self._still = {old: kept for old, kept in self._still.items() if old[:2] != key}
            self._still[(*key, places)] = view
        return view


def _begin(back: Backdrop, scene: Scene, time_s: float) -> _View:
    grain = belt_grain(back, scene.drive.travel_m(time_s)) * scene.setting.grain
    shade = back.shade * np.where(back.part == BELT, 1.0 + grain, 1.0 + 0.02 * grain)
    light = back.albedo * shade[..., None]
    return _View(back.depth_m.copy(), -back.part.astype(np.int32), back.cosine.copy(), light, back.place_m)


def _paint(view: _View, actor: Actor, scene: Scene, lens: Lens, stand: Stand, time_s: float) -> None:
    origin, turn = scene.origin_m(actor, time_s), actor.turned(time_s)
    box = _box(lens, stand, origin, actor.thing.body.radius_m * 1.5)
    if box is None:
        return
    _darken(view, box, origin, actor.thing.body.radius_m)
    box = _box(lens, stand, origin, actor.thing.body.radius_m)
    if box is None:
        return
    directions = rays(lens)[box].reshape(-1, 3) @ (turn.T @ stand.rotation).T
    eye_m = turn.T @ (stand.centre_m - origin)
    depth = _march(actor.thing, eye_m, directions)
    old = view.depth_m[box].reshape(-1)
    hit = np.flatnonzero(depth < old)
    if not len(hit):
        return
    spots = eye_m + depth[hit, None] * directions[hit]
    normals = _normals(actor.thing, spots)
    sight = -directions[hit] / np.linalg.norm(directions[hit], axis=1, keepdims=True)
    cosine = np.abs(np.sum(normals * sight, axis=1))
    light = _shine(actor.thing, actor.number, spots, normals, sight, turn, origin, scene)
    rows, columns = np.divmod(hit, box[1].stop - box[1].start)
    rows, columns = rows + box[0].start, columns + box[1].start
    view.depth_m[rows, columns] = depth[hit]
    view.owner[rows, columns] = actor.number + 1
    view.cosine[rows, columns] = cosine
    view.light[rows, columns] = light


def _box(lens: Lens, stand: Stand, origin_m: F64, radius_m: float) -> tuple[slice, slice] | None:
    """Return rows and columns that can show a ball, or None."""
    centre = stand.inward(origin_m[None])[0]
    if centre[2] < radius_m + 0.05:
        return None
    near = centre[2] - radius_m
    middle = project(lens, centre[None])[0]
    reach = 1.15 * max(lens.fx, lens.fy) * radius_m / near + 2.0
    reach *= 1.0 + 0.3 * float(np.hypot(*centre[:2])) / centre[2]
    low = np.maximum(np.floor(middle - reach), 0).astype(int)
    high = np.minimum(np.ceil(middle + reach) + 1, [lens.width, lens.height]).astype(int)
    if (high <= low).any():
        return None
    return slice(int(low[1]), int(high[1])), slice(int(low[0]), int(high[0]))


def _darken(view: _View, box: tuple[slice, slice], origin_m: F64, radius_m: float) -> None:
    """Dim the belt round a thing's foot: a soft contact shadow."""
    away = np.sum((view.place_m[box] - origin_m[:2]) ** 2, axis=-1) / (0.75 * radius_m) ** 2
    dim = 1.0 - 0.45 * np.exp(-away)
    view.light[box] *= np.where(view.owner[box] == -BELT, dim, 1.0)[..., None]


def _march(thing: Thing, eye_m: F64, directions: F64) -> F64:
    """Return z of the first crossing along rays eye + z · direction (body frame); infinite where none."""
    body = thing.body
    # Single precision errs by a tenth of a micrometre here and takes half the time.
    directions, eye_m = directions.astype(np.float32), eye_m.astype(np.float32)
    length = np.linalg.norm(directions, axis=1)
    # Rays start where they meet the ellipsoid that holds the body.
    scaled, start = directions / body.shell_m.astype(np.float32), eye_m / body.shell_m.astype(np.float32)
    square = np.einsum("ij,ij->i", scaled, scaled)
    along = -(scaled @ start) / square
    inside = along**2 - (np.float32(start @ start) - 1.0) / square
    half = np.sqrt(np.maximum(inside, 0.0))
    z, last = along - half, along + half
    found = np.full(len(z), np.inf)
    active = np.flatnonzero(inside > 0.0)
    for _ in range(60):
        if not len(active):
            break
        value = body.value(eye_m + z[active, None] * directions[active])
        done = value < 2e-4
        found[active[done]] = z[active[done]]
        z[active] += body.slack * np.maximum(value, 1.5e-4) / length[active]
        active = active[~done & (z[active] < last[active])]
    hit = np.flatnonzero(np.isfinite(found))
    for _ in range(2 if len(hit) else 0):  # the last quarter of a millimetre
        found[hit] += body.value(eye_m + found[hit, None] * directions[hit]) / length[hit]
    return found


def _normals(thing: Thing, spots: F64) -> F64:
    step = 2e-4
    slope = np.stack([thing.body.value(spots + step * axis) - thing.body.value(spots - step * axis)
                      for axis in np.eye(3)], axis=1)  # fmt: skip
    return np.asarray(slope / np.maximum(np.linalg.norm(slope, axis=1, keepdims=True), 1e-12))


def _shine(thing: Thing, number: int, spots: F64, normals: F64, sight: F64, turn: F64, origin: F64,
           scene: Scene) -> F64:  # fmt: skip
    """Return linear radiance: blotched albedo under Lambert's law, and a highlight."""
    rng = np.random.default_rng([scene.seed, number])
    waves = rng.normal(0.0, 1.0, (6, 3)) * np.array([60.0, 90.0, 150.0, 260.0, 420.0, 700.0])[:, None]
    mottle = np.sin(spots @ waves.T + rng.uniform(0.0, 6.28, 6)) @ np.array([0.3, 0.3, 0.25, 0.2, 0.15, 0.15])
    mix = np.clip(0.5 + 0.6 * mottle, 0.0, 1.0)[:, None]
    albedo = linear(thing.colour) * (1.0 - mix) + linear(thing.blotch) * mix
    world, world_normals = spots @ turn.T + origin, normals @ turn.T
    light = albedo * lamp_light(world, world_normals, scene.setting)[:, None]
    # Less of the sky reaches the lower side of a thing that lies on a belt.
    light *= (0.6 + 0.4 * np.clip(0.5 + world_normals[:, 2], 0.0, 1.0))[:, None]
    lamp = np.asarray(scene.setting.lamp_m) - world
    halfway = lamp / np.linalg.norm(lamp, axis=1, keepdims=True) + sight @ turn.T
    halfway /= np.linalg.norm(halfway, axis=1, keepdims=True)
    highlight = np.clip(np.sum(halfway * world_normals, axis=1), 0.0, 1.0) ** 40
    return np.asarray(light + thing.gloss * 0.5 * highlight[:, None])


def _expose(light: F64, light_lx: float, grain: NDArray[np.float32]) -> NDArray[np.uint8]:
    """Return the picture: automatic exposure that does not quite keep up, a cast in dim light, shot noise."""
    dim = np.log10(400.0 / light_lx)
    gain = 0.95 * 10.0 ** (-0.35 * dim)
    cast = 1.0 + np.array([0.06, 0.0, -0.08]) * dim
    levels = np.clip(light * (gain * cast * 4095.0), 0.0, 4095.0).astype(np.uint16)
    curve = (255.0 * (np.arange(4096) / 4095.0) ** (1.0 / 2.2)).astype(np.float32)
    sigma = np.float32(2.0 * 10.0 ** (0.5 * dim) + 0.5)
    return np.clip(curve[levels] + sigma * grain + 0.5, 0.0, 255.0).astype(np.uint8)
