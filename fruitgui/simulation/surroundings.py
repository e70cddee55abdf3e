"""Everything that never moves, by formula: belt, rails, floor, tables and boxes that stand around."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from fruitgui.frame import F32, Bools
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
    R, origin = pose.rotation.astype(np.float32), pose.translation_m.astype(np.float32)
    directions = (rays[..., 0] * axis[0] + rays[..., 1] * axis[1] + axis[2] for axis in R)
    canvas = _Canvas(origin, *(np.where(np.abs(part) < 1e-9, np.float32(1e-9), part) for part in directions))
    canvas.add_level(-surroundings.floor_m, surroundings.floor_colour, 0.4)
    for block in surroundings.blocks:
        canvas.add_block(block)
    return canvas.finished(canvas.add_belt(surroundings.belt))


class _Canvas:
    """Depth so far, and the number of the face that each pixel sees; 0 is nothing."""

    def __init__(self, origin: F32, x: F32, y: F32, z: F32) -> None:
        self._origin = origin
        self._way = (x, y, z)
        self._z_m = np.full(x.shape, np.inf, dtype=np.float32)
        self._face = np.zeros(x.shape, dtype=np.uint8)
        self._normals = [(0.0, 0.0, 0.0)]
        self._albedos = [np.full(3, 0.03, dtype=np.float32)]
        self._infrareds = [0.0]

    def _new_face(self, normal: tuple[float, float, float], colour: tuple[float, float, float], infrared: float) -> int:
        self._normals.append(normal)
        self._albedos.append(linear(np.array(colour)))
        self._infrareds.append(infrared)
        return len(self._normals) - 1

    def _draw(self, seen: Bools, z_m: F32, face: int) -> None:
        self._z_m[seen] = z_m[seen]
        self._face[seen] = face

    def _level(self, level_m: float) -> tuple[Bools, F32]:
        """Return where a horizontal plane is nearest and seen from above, and its depth."""
        z_m = (np.float32(level_m) - self._origin[2]) / self._way[2]
        return (self._way[2] < 0) & (z_m > 0) & (z_m < self._z_m), z_m

    def add_level(self, level_m: float, colour: tuple[float, float, float], infrared: float) -> None:
        """Draw an endless floor."""
        seen, z_m = self._level(level_m)
        self._draw(seen, z_m, self._new_face((0.0, 0.0, 1.0), colour, infrared))

    def add_belt(self, belt: Belt) -> Bools:
        """Draw the belt's rectangle; tell where it is seen."""
        seen, z_m = self._level(0.0)
        x = self._origin[0] + z_m * self._way[0]
        y = self._origin[1] + z_m * self._way[1]
        seen &= (np.abs(y) <= belt.width_m / 2) & (x >= belt.ends_m[0]) & (x <= belt.ends_m[1])
        self._draw(seen, z_m, self._new_face((0.0, 0.0, 1.0), belt.colour, belt.infrared))
        return seen

    def add_block(self, block: Block) -> None:
        """Draw a block (slab method, Kay & Kajiya 1986)."""
        enters: list[F32] = []
        leave = np.full(self._z_m.shape, np.inf, dtype=np.float32)
        for way, origin, low, high in zip(self._way, self._origin, block.low_m, block.high_m, strict=True):
            first, second = (np.float32(low) - origin) / way, (np.float32(high) - origin) / way
            enters.append(np.minimum(first, second))
            np.minimum(leave, np.maximum(first, second), out=leave)
        enter = np.maximum(np.maximum(enters[0], enters[1]), enters[2])
        seen = (enter < leave) & (enter > 0) & (enter < self._z_m)
        for axis in range(3):
            through = seen & (enter == enters[axis])
            for sign in (-1.0, 1.0):
                normal = tuple(sign if number == axis else 0.0 for number in range(3))
                face = self._new_face((normal[0], normal[1], normal[2]), block.colour, block.infrared)
                self._draw(through & (self._way[axis] * np.float32(sign) < 0), enter, face)

    def finished(self, on_belt: Bools) -> Backdrop:
        """Return the picture."""
        x, y, z = self._way
        normal = np.array(self._normals, dtype=np.float32)[self._face]
        length = np.sqrt(x * x + y * y + z * z)
        facing = -(normal[..., 0] * x + normal[..., 1] * y + normal[..., 2] * z) / length
        near_m = np.where(np.isfinite(self._z_m), self._z_m, np.float32(0))
        place = np.stack([self._origin[0] + x * near_m, self._origin[1] + y * near_m], axis=-1)
        albedo = np.array(self._albedos, dtype=np.float32)[self._face]
        infrared = np.array(self._infrareds, dtype=np.float32)[self._face]
        return Backdrop(self._z_m, normal, facing, albedo, infrared, on_belt, place)


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


def make_belt(
    rng: Generator, width_m: float, ends_m: tuple[float, float] = (-np.inf, np.inf), wear: float | None = None
) -> Belt:
    """Return a belt of random colour; `wear` is how strongly its texture shows: drawn where None, 0 for not at all."""
    base = np.array(BELT_COLOURS[rng.integers(len(BELT_COLOURS))]) * rng.uniform(0.85, 1.15)
    red, green, blue = (float(value) for value in np.clip(base, 0.05, 0.95))
    return Belt(width_m, ends_m, (red, green, blue), float(rng.uniform(0.3, 0.6)), _wear(rng, wear))


def _wear(rng: Generator, strength: float | None, rows: int = 320, columns: int = 1024) -> F32:
    """Return a tiled texture: weave, stains, and streaks along the travel; mean 1, never below 0.4."""
    total = np.ones((rows, columns), dtype=np.float32)
    drawn = rng.uniform(0.02, 0.10)
    contrast = drawn if strength is None else strength
    for along, across, share in ((1, 1, 0.5), (8, 8, 0.6), (128, 2, 0.7), (64, 32, 0.6)):
        total += np.float32(contrast * share) * _cloud(rng, rows, columns, along, across)
    return np.clip(total, 0.4, 1.8)


def _cloud(rng: Generator, rows: int, columns: int, along: int, across: int) -> F32:
    """Return noise with cells of `along` by `across`, the left edge fitting to the right, standard deviation 1."""
    import cv2

    rough = rng.standard_normal((rows // across, columns // along), dtype=np.float32)
    wide = np.tile(rough, (1, 3))
    smooth = cv2.resize(wide, (3 * columns, rows), interpolation=cv2.INTER_CUBIC)[:, columns : 2 * columns]
    cloud: F32 = cv2.GaussianBlur(smooth, (3, 3), 0.8)
    return cloud / np.float32(cloud.std())


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
