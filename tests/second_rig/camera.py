"""Where a camera stands and through which lens it looks."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from tests.second_rig.bodies import F64


@dataclass(frozen=True, slots=True)
class Lens:
    """Pinhole, pixels; pixel centres at integers; `distortion` is OpenCV's k1 k2 p1 p2 k3."""

    width: int = 640
    height: int = 480
    fx: float = 525.0
    fy: float = 525.0
    cx: float = 319.5
    cy: float = 239.5
    distortion: tuple[float, ...] = ()

    @property
    def matrix(self) -> F64:
        """The camera matrix."""
        return np.array([[self.fx, 0.0, self.cx], [0.0, self.fy, self.cy], [0.0, 0.0, 1.0]])


KINECT = Lens()
LENSES = {
    "640x480": KINECT,
    "848x480": Lens(848, 480, 615.3, 614.8, 421.7, 238.2),
    "320x240": Lens(320, 240, 262.1, 262.4, 161.2, 118.9),
    "1280x720": Lens(1280, 720, 911.0, 910.4, 642.1, 355.6),
}


@dataclass(frozen=True, slots=True, eq=False)
class Stand:
    """Pose camera → world: a world point is rotation @ X + centre."""

    rotation: F64
    centre_m: F64

    def inward(self, points_m: F64) -> F64:
        """Return world points in the camera's optical frame."""
        return np.asarray((np.asarray(points_m) - self.centre_m) @ self.rotation)

    def outward(self, points_m: F64) -> F64:
        """Return camera points in the world."""
        return np.asarray(points_m @ self.rotation.T + self.centre_m)


def aim(centre_m: F64, target_m: F64, roll_rad: float = 0.0) -> Stand:
    """Return a camera at `centre_m` that looks at `target_m` (world z up), rolled about its line of sight."""
    forward = np.asarray(target_m, dtype=float) - centre_m
    forward /= np.linalg.norm(forward)
    up = np.array([0.0, 0.0, 1.0]) if abs(forward[2]) < 0.999 else np.array([0.0, 1.0, 0.0])
    right = np.cross(forward, up)
    right /= np.linalg.norm(right)
    down = np.cross(forward, right)
    c, s = np.cos(roll_rad), np.sin(roll_rad)
    return Stand(np.stack([c * right + s * down, c * down - s * right, forward], axis=1), np.asarray(centre_m, float))


def relative(reference: Stand, other: Stand) -> tuple[F64, F64]:
    """Return R, T with X_reference = R X_other + T."""
    return reference.rotation.T @ other.rotation, reference.rotation.T @ (other.centre_m - reference.centre_m)


def project(lens: Lens, points_m: F64) -> F64:
    """Return pixels (N, 2) of points (N, 3) of the optical frame."""
    if not lens.distortion:
        return np.stack([lens.fx * points_m[:, 0], lens.fy * points_m[:, 1]], axis=1) / points_m[:, 2:] + [
            lens.cx,
            lens.cy,
        ]
    import cv2

    pixels, _ = cv2.projectPoints(points_m, np.zeros(3), np.zeros(3), lens.matrix, np.array(lens.distortion))
    return np.asarray(pixels.reshape(-1, 2))


@lru_cache(maxsize=8)
def rays(lens: Lens) -> F64:
    """Return x/z, y/z, 1 of every pixel: (height, width, 3)."""
    import cv2

    u, v = np.meshgrid(np.arange(lens.width, dtype=float), np.arange(lens.height, dtype=float))
    if lens.distortion:
        pixels = np.stack([u, v], axis=-1).reshape(-1, 1, 2)
        plain = cv2.undistortPoints(pixels, lens.matrix, np.array(lens.distortion)).reshape(lens.height, lens.width, 2)
    else:
        plain = np.stack([(u - lens.cx) / lens.fx, (v - lens.cy) / lens.fy], axis=-1)
    return np.concatenate([plain, np.ones((lens.height, lens.width, 1))], axis=-1)


def sees(lens: Lens, stand: Stand, points_m: F64, margin_px: float = 0.0) -> np.ndarray:
    """Return which world points (N, 3) lie in the picture and within 0.4–4 m."""
    inside = stand.inward(points_m)
    ahead = (inside[:, 2] > 0.4) & (inside[:, 2] < 4.0)
    pixels = project(lens, np.where(ahead[:, None], inside, [0.0, 0.0, 1.0]))
    low = (pixels >= margin_px).all(axis=1)
    return np.asarray(ahead & low & (pixels <= [lens.width - 1 - margin_px, lens.height - 1 - margin_px]).all(axis=1))
