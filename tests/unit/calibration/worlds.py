"""A plain world for tests of calibration, apart from the product's own simulation: a plane, spheres, one camera."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F64, Frame, Intrinsics
from fruitgui.geometry.pose import Pose

CAMERA = Intrinsics(320, 240, 270.0, 270.0, 159.5, 119.5)


@dataclass(frozen=True)
class Ball:
    x_m: float
    y_m: float
    radius_m: float
    color: tuple[int, int, int] = (200, 120, 40)


def looking_at(eye_m: Sequence[float], at_m: Sequence[float]) -> Pose:
    """Return the pose camera → world of a camera at `eye_m` whose axis passes `at_m`; the world's z is up."""
    eye = np.asarray(eye_m, dtype=np.float64)
    z = np.asarray(at_m, dtype=np.float64) - eye
    z /= np.linalg.norm(z)
    x = np.cross(z, [0.0, 0.0, 1.0])
    x /= np.linalg.norm(x)
    return Pose(np.stack([x, np.cross(z, x), z], axis=1), eye)


def depth_of(pose: Pose, balls: Sequence[Ball], half_width_m: float = 0.4) -> tuple[F64, np.ndarray]:
    """Return depth (m, 0 beyond the belt) and colour of a belt along x with balls on it; balls may overhang nothing."""
    rays = np.dstack([CAMERA.rays().astype(np.float64), np.ones((CAMERA.height, CAMERA.width))])
    along = rays @ pose.rotation.T
    depth = -pose.translation_m[2] / along[..., 2]
    place = pose.translation_m + along * depth[..., None]
    depth = np.where(np.abs(place[..., 1]) < half_width_m, depth, 0.0)
    color = np.full((*depth.shape, 3), 70, np.uint8)
    for ball in balls:
        to = np.array([ball.x_m, ball.y_m, ball.radius_m]) - pose.translation_m
        a, b, c = (along**2).sum(-1), along @ to, to @ to - ball.radius_m**2
        root = b**2 - a * c
        hit = root > 0
        near = (b - np.sqrt(np.maximum(root, 0))) / a
        depth = np.where(hit, near, depth)
        color[hit] = ball.color
    return depth, color


def frames_of(
    sensor: str, pose: Pose, balls: Sequence[Ball], seed: int, count: int = 6, half_width_m: float = 0.4
) -> list[Frame]:
    """Return captures with the steps and noise of structured light."""
    rng = np.random.default_rng(seed)
    depth, color = depth_of(pose, balls, half_width_m)
    inverse = np.divide(1.0, depth, out=np.zeros_like(depth), where=depth > 0)
    frames = []
    for k in range(count):
        noisy = np.round((inverse + rng.normal(0, 1.4e-3, inverse.shape)) / 2.9e-3) * 2.9e-3
        z = np.where(inverse > 0, 1000.0 / np.maximum(noisy, 0.1), 0.0)
        frames.append(Frame(sensor, k, 0.2 * k, color, np.round(z).astype(np.uint16), CAMERA))
    return frames


def scattered(seed: int, count: int = 12) -> list[Ball]:
    """Return balls of 25–42 mm radius, apart from each other."""
    rng = np.random.default_rng(seed)
    balls: list[Ball] = []
    while len(balls) < count:
        x, y = rng.uniform(-0.35, 0.35), rng.uniform(-0.25, 0.25)
        if all(np.hypot(x - b.x_m, y - b.y_m) > 0.1 for b in balls):
            balls.append(Ball(x, y, float(rng.uniform(0.025, 0.042))))
    return balls


OPPOSED = {
    "left": looking_at([0.05, -0.5, 1.0], [0.0, 0.0, 0.0]),
    "right": looking_at([-0.04, 0.55, 0.95], [0.03, 0.0, 0.0]),
}
