"""What every sensor makes: one colour image and the depth registered to it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

U8 = NDArray[np.uint8]
U16 = NDArray[np.uint16]
F32 = NDArray[np.float32]
F64 = NDArray[np.float64]
Bools = NDArray[np.bool_]
Ints = NDArray[np.intp]


@dataclass(frozen=True, slots=True)
class Intrinsics:
    """Pinhole camera with lens distortion (OpenCV's order: k1 k2 p1 p2 k3 …), pixels.

    Pixel (u, v) has its centre at integer coordinates, u to the right, v down.
    """

    width: int
    height: int
    fx: float
    fy: float
    cx: float
    cy: float
    distortion: tuple[float, ...] = ()

    @property
    def matrix(self) -> F64:
        """The 3×3 camera matrix."""
        return np.array([[self.fx, 0.0, self.cx], [0.0, self.fy, self.cy], [0.0, 0.0, 1.0]])

    def rays(self) -> F32:
        """Return x/z and y/z of every pixel's ray, undistorted: (height, width, 2). Shared; do not write."""
        return _rays(self)

    def rays_at(self, pixels: F64) -> F64:
        """Return x/z and y/z of the rays through pixels (N, 2), undistorted: (N, 2)."""
        if self.distortion:
            import cv2

            points = np.asarray(pixels, dtype=np.float64).reshape(-1, 1, 2)
            undistorted = cv2.undistortPoints(points, self.matrix, np.array(self.distortion))
            return np.asarray(undistorted, dtype=np.float64).reshape(-1, 2)
        return (np.asarray(pixels, dtype=np.float64) - [self.cx, self.cy]) / [self.fx, self.fy]

    def project(self, points_m: F64) -> F64:
        """Return pixel coordinates (N, 2) of points (N, 3) in the optical frame, z > 0, lens included."""
        import cv2

        points = np.asarray(points_m, dtype=np.float64).reshape(-1, 3)
        if not self.distortion:
            z = points[:, 2]
            return np.stack([self.fx * points[:, 0] / z + self.cx, self.fy * points[:, 1] / z + self.cy], axis=1)
        pixels, _ = cv2.projectPoints(points, np.zeros(3), np.zeros(3), self.matrix, np.array(self.distortion))
        return np.asarray(pixels, dtype=np.float64).reshape(-1, 2)


@lru_cache(maxsize=64)
def _rays(camera: Intrinsics) -> F32:
    u, v = np.meshgrid(np.arange(camera.width, dtype=np.float64), np.arange(camera.height, dtype=np.float64))
    rays = camera.rays_at(np.stack([u, v], axis=-1).reshape(-1, 2)).astype(np.float32)
    rays = rays.reshape(camera.height, camera.width, 2)
    rays.setflags(write=False)
    return rays


@dataclass(frozen=True, slots=True, eq=False)
class Frame:
    """One capture of one sensor.

    Attributes:
        sensor: the sensor's id.
        sequence: counts the captures of this sensor, from 0.
        time_s: capture time of the depth, seconds, in the sensor's own clock.
        color: (height, width, 3) uint8, RGB.
        depth_mm: (height, width) uint16, registered to the colour image, 0 = no reading.
        intrinsics: of the colour camera, which the depth shares.
        damaged: a part was lost on its way and shows something older; a feed counts it and hands it on to nobody.
        felt_m_s2: what the sensor's accelerometer felt lately, in axes of its own: gravity, as long as it stands still;
            None where there is none.
        clock_leaps: how often the sensor's clock has leapt since it was opened; `time_s` goes on by the host's then.
        time_sure: whether `time_s` can be believed; not yet, while it only shows how a device's clock stands to the
            host's, which takes less than a second mostly. What orders frames by their times lets go of the others.
    """

    sensor: str
    sequence: int
    time_s: float
    color: U8
    depth_mm: U16
    intrinsics: Intrinsics
    damaged: bool = False
    felt_m_s2: tuple[float, float, float] | None = None
    clock_leaps: int = 0
    time_sure: bool = True

    def points(self) -> F32:
        """Return every pixel's point in the optical frame, metres: (height, width, 3), zeros where no reading."""
        z = self.depth_mm.astype(np.float32) * np.float32(1e-3)
        points = np.empty((*z.shape, 3), dtype=np.float32)
        np.multiply(self.intrinsics.rays(), z[..., None], out=points[..., :2])
        points[..., 2] = z
        return points
