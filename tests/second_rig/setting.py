"""What stands still: the belt, its rails, the floor, things beside it, and the lamp."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from tests.second_rig.bodies import F64
from tests.second_rig.camera import Lens, Stand, rays

BELT, FLOOR, SOLID = 1, 2, 3


@dataclass(frozen=True, slots=True)
class Block:
    """A box beside or on the belt, its sides along the world's axes."""

    low_m: tuple[float, float, float]
    high_m: tuple[float, float, float]
    colour: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Setting:
    """The world's standing part; the belt is the plane z = 0 and runs along x.

    Attributes:
        ends_m: x of the belt's two ends.
        grain: how strongly the belt's texture shows, as a share.
        lamp_m: place of the lamp.
        ambient: share of the light that comes from everywhere.
    """

    width_m: float = 0.5
    ends_m: tuple[float, float] = (-5.0, 5.0)
    floor_m: float = -0.75
    belt_colour: tuple[float, float, float] = (196.0, 200.0, 204.0)
    floor_colour: tuple[float, float, float] = (96.0, 92.0, 88.0)
    grain: float = 0.04
    blocks: tuple[Block, ...] = ()
    lamp_m: tuple[float, float, float] = (0.3, -0.4, 2.2)
    ambient: float = 0.45
    seed: int = 0


def rails(width_m: float, height_m: float, thick_m: float, gap_m: float, colour: tuple[float, float, float],
          ends_m: tuple[float, float] = (-5.0, 5.0)) -> tuple[Block, Block]:  # fmt: skip
    """Return a rail on either side of the belt."""
    inner, outer = width_m / 2 + gap_m, width_m / 2 + gap_m + thick_m
    low = -0.05
    return (
        Block((ends_m[0], inner, low), (ends_m[1], outer, height_m), colour),
        Block((ends_m[0], -outer, low), (ends_m[1], -inner, height_m), colour),
    )


@dataclass(frozen=True, slots=True, eq=False)
class Backdrop:
    """The standing part as one camera sees it, all (height, width).

    Attributes:
        depth_m: z along the optical axis; infinite where there is nothing.
        part: 0 nothing, or `BELT`, `FLOOR`, `SOLID`.
        place_m: x, y on the belt's plane, (height, width, 2).
        cosine: of the angle between the surface's normal and the line of sight.
        albedo: linear reflectance, (height, width, 3); `shade`: light that falls there.
    """

    depth_m: F64
    part: NDArray[np.uint8]
    place_m: F64
    cosine: F64
    albedo: F64
    shade: F64
    grain: F64 = field(repr=False)


def linear(colour: object) -> F64:
    """Return linear reflectance of an sRGB colour (0–255)."""
    return np.asarray((np.asarray(colour, dtype=float) / 255.0) ** 2.2)


def lamp_light(points_m: F64, normals: F64, setting: Setting) -> F64:
    """Return Lambert's share plus the ambient one, about 1 below the lamp."""
    towards = np.asarray(setting.lamp_m) - points_m
    distance = np.linalg.norm(towards, axis=-1)
    cosine = np.maximum(np.sum(towards * normals, axis=-1) / distance, 0.0)
    return np.asarray(setting.ambient + (1.0 - setting.ambient) * cosine * (setting.lamp_m[2] / distance) ** 2)


def backdrop(setting: Setting, lens: Lens, stand: Stand) -> Backdrop:
    """Cut every pixel's ray with the belt, the floor and the blocks."""
    directions = rays(lens) @ stand.rotation.T
    shape = directions.shape[:2]
    origin = stand.centre_m
    depth = np.full(shape, np.inf)
    part = np.zeros(shape, np.uint8)
    normals = np.zeros((*shape, 3))
    albedo = np.full((*shape, 3), 0.02)
    for kind, height, colour in ((BELT, 0.0, setting.belt_colour), (FLOOR, setting.floor_m, setting.floor_colour)):
        with np.errstate(divide="ignore", invalid="ignore"):
            reach = (height - origin[2]) / directions[..., 2]
        spot = origin[:2] + np.where(np.isfinite(reach), reach, 0.0)[..., None] * directions[..., :2]
        hit = np.isfinite(reach) & (reach > 0.0) & (reach < depth)
        if kind == BELT:
            hit &= np.abs(spot[..., 1]) < setting.width_m / 2
            hit &= (spot[..., 0] > setting.ends_m[0]) & (spot[..., 0] < setting.ends_m[1])
        depth, part = np.where(hit, reach, depth), np.where(hit, np.uint8(kind), part)
        normals[hit], albedo[hit] = (0.0, 0.0, 1.0), linear(colour)
    for block in setting.blocks:
        reach, side = _slabs(origin, directions, block)
        hit = reach < depth
        depth, part = np.where(hit, reach, depth), np.where(hit, np.uint8(SOLID), part)
        normals[hit], albedo[hit] = side[hit], linear(block.colour)
    spots = origin + np.where(np.isfinite(depth), depth, 0.0)[..., None] * directions
    cosine = np.abs(np.sum(normals * directions, axis=-1)) / np.linalg.norm(directions, axis=-1)
    shade = lamp_light(spots, normals, setting)
    return Backdrop(depth, part, spots[..., :2], cosine, albedo, shade, _grain(setting.seed))


def _slabs(origin: F64, directions: F64, block: Block) -> tuple[F64, F64]:
    """Return where rays enter a box (infinite where they miss) and the normal there."""
    with np.errstate(divide="ignore", invalid="ignore"):
        first = (np.array(block.low_m) - origin) / directions
        second = (np.array(block.high_m) - origin) / directions
    near, far = np.fmin(first, second), np.fmax(first, second)
    entry, leave = near.max(axis=-1), far.min(axis=-1)
    hit = (entry < leave) & (entry > 0.0)
    normal = np.eye(3)[near.argmax(axis=-1)] * -np.sign(directions)
    return np.where(hit, entry, np.inf), normal


def _grain(seed: int) -> F64:
    """Return a periodic texture of 512×512 cells, mean 0, about ±1."""
    rng = np.random.default_rng(seed)
    frequency = np.hypot(*np.meshgrid(np.fft.fftfreq(512), np.fft.fftfreq(512)))
    fine = np.fft.ifft2(np.fft.fft2(rng.standard_normal((512, 512))) * np.exp(-((frequency / 0.15) ** 2))).real
    broad = np.fft.ifft2(np.fft.fft2(rng.standard_normal((512, 512))) * np.exp(-((frequency / 0.01) ** 2))).real
    return np.asarray(0.6 * fine / fine.std() + 0.6 * broad / broad.std())


def belt_grain(scene: Backdrop, travel_m: float) -> F64:
    """Return the belt's texture under every pixel when the belt has moved by `travel_m`; cells of 2 mm."""
    cells = np.floor((scene.place_m - [travel_m, 0.0]) / 0.002).astype(np.int64) % 512
    return np.asarray(scene.grain[cells[..., 1], cells[..., 0]])
