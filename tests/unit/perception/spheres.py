"""Balls on a plane as a structured-light sensor sees them, drawn by formula: a second opinion on the simulation."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from fruitgui.frame import F64, Frame, Intrinsics
from fruitgui.geometry.plane import Plane, Surface
from fruitgui.perception import Perceiver
from fruitgui.perception.view import FruitView

GRAIN = np.random.default_rng(0).normal(0.0, 4.0, 100_003)
"""Noise, prepared: a prime number of draws, shown from another place every time."""

KINECT = Intrinsics(640, 480, 525.0, 525.0, 319.5, 239.5)


@dataclass(frozen=True, slots=True, eq=False)
class Ball:
    """Centre in the belt frame (x, y; it rests on z = 0), radius, colour."""

    x_m: float
    y_m: float
    radius_m: float
    rgb: tuple[int, int, int] = (200, 60, 40)


@dataclass(frozen=True, slots=True, eq=False)
class Table:
    """A camera `height_m` above a plane, tilted from the vertical, and balls on it."""

    balls: tuple[Ball, ...]
    height_m: float = 1.0
    tilt_rad: float = 0.5
    intrinsics: Intrinsics = KINECT
    noise_m: float = 1.4e-3
    step_m: float = 2.9e-3
    seed: int = 0
    region_m: F64 | None = field(default=None)

    def plane(self) -> Plane:
        """The plane in the optical frame: the camera looks down and, by the tilt, along +y of the picture."""
        return Plane(np.array([0.0, -np.sin(self.tilt_rad), -np.cos(self.tilt_rad)]), self.height_m)

    def surface(self) -> Surface:
        return Surface(self.plane(), self.region_m)

    def centres_m(self) -> F64:
        """Centres of the balls in the optical frame, (N, 3)."""
        flat = np.array([[ball.x_m, ball.y_m, ball.radius_m] for ball in self.balls]).reshape(-1, 3)
        return self.plane().frame().inverse().apply(flat)

    def frame(self) -> Frame:
        rng = np.random.default_rng(self.seed)
        rays = self.intrinsics.rays().astype(np.float64)
        directions = np.concatenate([rays, np.ones((*rays.shape[:2], 1))], axis=-1)
        slope = -(directions @ self.plane().normal)
        z = np.where(slope > 1e-3, self.height_m / np.maximum(slope, 1e-3), 0.0)
        color = np.full((*z.shape, 3), 110.0)
        for ball, centre in zip(self.balls, self.centres_m(), strict=True):
            hit = _sphere_depth(directions, centre, ball.radius_m)
            nearer = (hit > 0) & ((hit < z) | (z == 0))
            z[nearer] = hit[nearer]
            color[nearer] = ball.rgb
        return Frame("ball", 0, 0.0, self._picture(color, rng), self._measured(z, rng), self.intrinsics)

    def _picture(self, color: F64, rng: np.random.Generator) -> np.ndarray:
        grain = np.roll(GRAIN, int(rng.integers(GRAIN.size)))
        return np.clip(color + np.resize(grain, color.shape), 0, 255).astype(np.uint8)

    def _measured(self, z: F64, rng: np.random.Generator) -> np.ndarray:
        """Depth in whole millimetres with noise and disparity steps, none beyond 4 m."""
        import cv2

        shift = int(rng.integers(GRAIN.size))
        noise = cv2.GaussianBlur(np.resize(np.roll(GRAIN, shift), z.shape).astype(np.float32), (0, 0), 1.5)
        z = z + noise / noise.std() * self.noise_m * z**2
        if self.step_m > 0:
            with np.errstate(divide="ignore", invalid="ignore"):
                z = np.where(z > 0.1, 1.0 / (np.rint(1.0 / np.maximum(z, 0.1) / self.step_m) * self.step_m), 0.0)
        z = np.where((z > 0.1) & (z < 4.0), z, 0.0)
        return np.rint(z * 1e3).astype(np.uint16)


def _sphere_depth(directions: F64, centre: F64, radius_m: float) -> F64:
    a = (directions**2).sum(axis=-1)
    b = directions @ centre
    discriminant = b**2 - a * (centre @ centre - radius_m**2)
    return np.where(discriminant > 0, (b - np.sqrt(np.maximum(discriminant, 0.0))) / a, 0.0)


def row_of_balls(radii_m: tuple[float, ...], gap_m: float, **table: object) -> Table:
    """Return balls in a row across the middle of the picture, `gap_m` between their equators' nearest points."""
    empty = Table((), **table)  # type: ignore[arg-type]
    middle = empty.plane().frame().apply(np.array([0.0, 0.0, empty.height_m / np.cos(empty.tilt_rad)]))
    places = [0.0]
    for before, after in pairwise(radii_m):
        # Balls of unlike radius on one plane touch at a distance of 2 √(r₁ r₂).
        places.append(places[-1] + 2.0 * np.sqrt(before * after) + gap_m)
    shift = (places[0] + places[-1]) / 2.0
    balls = tuple(Ball(middle[0] + x - shift, middle[1], radius) for x, radius in zip(places, radii_m, strict=True))
    return Table(balls, **table)  # type: ignore[arg-type]


def perceiver(table: Table, **options: object) -> Perceiver:
    return Perceiver("ball", table.intrinsics, table.surface(), **options)  # type: ignore[arg-type]


def views(table: Table, **options: object) -> tuple[FruitView, ...]:
    return perceiver(table, **options).observe(table.frame(), 0.0).views


def nearest(table: Table, view: FruitView) -> int:
    """Return the number of the ball whose centre is nearest to a view's."""
    return int(np.argmin(np.linalg.norm(table.centres_m() - view.centre_m, axis=1)))
