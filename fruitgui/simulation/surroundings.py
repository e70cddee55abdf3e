"""Everything that never moves, by formula: belt, rails, floor, tables and boxes that stand around."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from fruitgui.frame import F32, F64, Bools
from fruitgui.geometry.pose import Pose
from fruitgui.simulation.light import linear


@dataclass(frozen=True, slots=True)
class Block:
    """A box at rest, edges along the world's axes.

    Attributes:
        low_m, high_m: opposite corners (x, y, z).
        colour: sRGB, 0–1.
        infrared: reflectance at 830 nm, 0–1.
    """

    low_m: tuple[float, float, float]
    high_m: tuple[float, float, float]
    colour: tuple[float, float, float]
    infrared: float = 0.5


@dataclass(frozen=True, slots=True, eq=False)
class Belt:
    """The belt: a rectangle at z = 0 with a texture that moves with it.

    Attributes:
        width_m: across; it spans y = ±width/2.
        ends_m: (x of the rear end, x of the front end); ±inf for an endless one.
        colour: sRGB, 0–1.
        infrared: reflectance at 830 nm, 0–1.
        wear: (rows, columns) relative reflectance; tiled, one cell is `cell_m` wide.
        cell_m: edge of a cell of `wear`.
    """

    width_m: float
    ends_m: tuple[float, float]
    colour: tuple[float, float, float]
    infrared: float
    wear: F32
    cell_m: float = 0.002


@dataclass(frozen=True, slots=True, eq=False)
class Surroundings:
    """What stands around.

    Attributes:
        belt: the belt.
        blocks: rails, table legs, boxes.
        floor_m: depth of the floor below the belt.
        floor_colour: sRGB, 0–1.
    """

    belt: Belt
    blocks: tuple[Block, ...]
    floor_m: float
    floor_colour: tuple[float, float, float]


@dataclass(frozen=True, slots=True, eq=False)
class Backdrop:
    """What one camera sees of the surroundings, per pixel; all (height, width, …).

    Attributes:
        z_m: depth along the optical axis, inf where nothing is.
        normal: unit normal of what is seen, world frame.
        facing: cosine between the normal and the direction to the camera.
        albedo: linear RGB reflectance, without the belt's wear.
        infrared: reflectance at 830 nm.
        on_belt: the pixel sees the belt.
        place_m: (x, y) in the world of what is seen.
    """

    z_m: F32
    normal: F32
    facing: F32
    albedo: F32
    infrared: F32
    on_belt: Bools
    place_m: F32


def look(surroundings: Surroundings, rays: F32, pose: Pose) -> Backdrop:
    """Return what a camera sees: `rays` (H, W, 2) are x/z and y/z of its pixels, `pose` maps it into the world."""
    forward = np.concatenate([rays, np.ones_like(rays[..., :1])], axis=-1).astype(np.float64)
    directions = forward @ pose.rotation.T
    origin = pose.translation_m
    z = np.full(rays.shape[:2], np.inf)
    normal = np.zeros(directions.shape)
    albedo = np.full(directions.shape, 0.03)
    infrared = np.zeros_like(z)
    _add_level(
        -surroundings.floor_m, None, surroundings.floor_colour, 0.4, origin, directions, (z, normal, albedo, infrared)
    )
    for block in surroundings.blocks:
        _add_block(block, origin, directions, (z, normal, albedo, infrared))
    belt = surroundings.belt
    on_belt = _add_level(0.0, belt, belt.colour, belt.infrared, origin, directions, (z, normal, albedo, infrared))
    facing = -(normal * directions).sum(axis=-1) / np.linalg.norm(directions, axis=-1)
    place = origin[:2] + directions[..., :2] * np.where(np.isfinite(z), z, 0.0)[..., None]
    return Backdrop(_f32(z), _f32(normal), _f32(facing), _f32(albedo), _f32(infrared), on_belt, _f32(place))


def _f32(values: F64) -> F32:
    return np.ascontiguousarray(values, dtype=np.float32)


_Layers = tuple[F64, F64, F64, F64]


def _add_level(
    level_m: float, belt: Belt | None, colour: tuple[float, float, float], infrared: float,
    origin: F64, directions: F64, layers: _Layers,
) -> Bools:  # fmt: skip
    """Paint a horizontal plane (the belt's rectangle of it, where given) where it is nearest; tell where."""
    z, normal, albedo, ir = layers
    down = np.minimum(directions[..., 2], -1e-9)
    t = (level_m - origin[2]) / down
    seen = (directions[..., 2] < -1e-6) & (t > 0) & (t < z)
    if belt is not None:
        x = origin[0] + t * directions[..., 0]
        y = origin[1] + t * directions[..., 1]
        seen &= (np.abs(y) <= belt.width_m / 2) & (x >= belt.ends_m[0]) & (x <= belt.ends_m[1])
    _paint(seen, t, np.array([0.0, 0.0, 1.0]), colour, infrared, (z, normal, albedo, ir))
    return np.asarray(seen)


def _add_block(block: Block, origin: F64, directions: F64, layers: _Layers) -> None:
    """Paint a block where it is nearest (slab method, Kay & Kajiya 1986)."""
    safe = np.where(np.abs(directions) < 1e-12, 1e-12, directions)
    first = (np.array(block.low_m) - origin) / safe
    second = (np.array(block.high_m) - origin) / safe
    entries = np.minimum(first, second)
    enter, leave = entries.max(axis=-1), np.maximum(first, second).min(axis=-1)
    seen = (enter < leave) & (enter > 0) & (enter < layers[0])
    axis = entries.argmax(axis=-1)
    normal = np.zeros(directions.shape)
    np.put_along_axis(normal, axis[..., None], -np.sign(np.take_along_axis(directions, axis[..., None], -1)), -1)
    _paint(seen, enter, normal, block.colour, block.infrared, layers)


def _paint(
    seen: Bools, t: F64, normal: F64, colour: tuple[float, float, float], infrared: float, layers: _Layers
) -> None:
    layers[0][seen] = t[seen]
    layers[1][seen] = normal if normal.ndim == 1 else normal[seen]
    layers[2][seen] = linear(np.array(colour))
    layers[3][seen] = infrared


def rails(width_m: float, rng: Generator) -> tuple[Block, Block]:
    """Return two rails beside a belt, of one height and colour, a little apart from it."""
    thick_m, high_m = rng.uniform(0.015, 0.05), rng.uniform(0.015, 0.07)
    grey = rng.uniform(0.35, 0.75)
    colour = (grey, grey * rng.uniform(0.95, 1.05), grey * rng.uniform(0.95, 1.1))
    near, far = width_m / 2, width_m / 2 + thick_m
    return (
        Block((-5.0, near, -0.10), (5.0, far, high_m), colour, 0.5),
        Block((-5.0, -far, -0.10), (5.0, -near, high_m), colour, 0.5),
    )


BELT_COLOURS = (
    (0.16, 0.30, 0.22), (0.16, 0.22, 0.38), (0.12, 0.12, 0.13), (0.42, 0.43, 0.44), (0.80, 0.80, 0.77),
    (0.30, 0.27, 0.24), (0.22, 0.40, 0.48),
)  # fmt: skip
"""PVC and rubber belts as sold: green, blue, black, grey, white, brown, petrol (sRGB)."""


def make_belt(rng: Generator, width_m: float, ends_m: tuple[float, float] = (-np.inf, np.inf)) -> Belt:
    """Return a belt of random colour and wear."""
    base = np.array(BELT_COLOURS[rng.integers(len(BELT_COLOURS))]) * rng.uniform(0.85, 1.15)
    red, green, blue = (float(value) for value in np.clip(base, 0.05, 0.95))
    return Belt(width_m, ends_m, (red, green, blue), float(rng.uniform(0.3, 0.6)), _wear(rng))


def _wear(rng: Generator, rows: int = 320, columns: int = 1024) -> F32:
    """Return a tiled texture: weave, stains, and streaks along the travel; mean 1, never below 0.4."""
    import cv2

    total = np.ones((rows, columns), dtype=np.float32)
    contrast = rng.uniform(0.02, 0.10)
    for along, across, share in ((1.0, 1.0, 0.5), (6.0, 6.0, 0.6), (60.0, 1.5, 0.7), (30.0, 25.0, 0.6)):
        rough = rng.normal(size=(rows, columns)).astype(np.float32)
        rough = np.tile(rough, (1, 3)) if along > 1 else rough
        smooth = cv2.GaussianBlur(rough, (0, 0), sigmaX=along, sigmaY=across, borderType=cv2.BORDER_REFLECT)
        smooth = smooth[:, columns : 2 * columns] if along > 1 else smooth
        total += contrast * share * smooth / max(float(smooth.std()), 1e-6)
    return np.clip(total, 0.4, 1.8)


class WearMap:
    """Where each pixel of one camera looks up the belt's wear."""

    def __init__(self, belt: Belt, behind: Backdrop) -> None:
        rows, self._columns = belt.wear.shape
        self._cell_m = belt.cell_m
        self._on_belt = behind.on_belt.astype(np.float32)
        self._tiled = np.hstack([belt.wear, belt.wear, belt.wear[:, :2]]) - np.float32(1)
        self._u = (behind.place_m[..., 0] / np.float32(belt.cell_m)) % np.float32(self._columns)
        v = (behind.place_m[..., 1] + np.float32(belt.width_m / 2)) / np.float32(belt.cell_m)
        self._v = (rows - 1 - np.abs(v % (2 * (rows - 1)) - (rows - 1))).astype(np.float32)

    def at(self, travel_m: float) -> F32:
        """Return the relative reflectance (H, W) after the belt moved `travel_m`; 1 beside the belt."""
        import cv2

        shift = np.float32((-travel_m / self._cell_m) % self._columns)
        worn: F32 = cv2.remap(self._tiled, self._u + shift, self._v, cv2.INTER_LINEAR)
        worn *= self._on_belt
        worn += np.float32(1)
        return worn
