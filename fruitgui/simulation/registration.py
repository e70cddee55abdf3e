"""Depth from its own camera into the colour camera's pixels, as the device's driver does it."""

from __future__ import annotations

import numpy as np

from fruitgui.frame import F32, Intrinsics
from fruitgui.geometry.pose import Pose


class Registration:
    """Forward warp of depth between two cameras of one sensor; what lands twice is decided for the nearer.

    The colour camera stands to the right of the infrared camera, so of two
    pixels in one row that land on the same place the right one is the nearer:
    writing each row from left to right keeps it. Where no pixel lands, there
    is a hole.
    """

    def __init__(self, depth_camera: Intrinsics, color_camera: Intrinsics, pose: Pose) -> None:
        """Prepare the warp; `pose` maps the depth camera's frame into the colour camera's."""
        rays = depth_camera.rays().astype(np.float64)
        forward = np.concatenate([rays, np.ones_like(rays[..., :1])], axis=-1)
        turned = (forward @ pose.rotation.T).reshape(-1, 3)
        self._rays = np.ascontiguousarray(turned.T, dtype=np.float32)
        self._shift = pose.translation_m.astype(np.float32)
        self._camera = color_camera

    def __call__(self, depth_m: F32) -> F32:
        """Return depth (H, W) of the colour camera, metres, 0 where nothing landed."""
        z = depth_m.ravel()
        camera = self._camera
        depth = self._rays[2] * z + self._shift[2]
        with np.errstate(divide="ignore", invalid="ignore"):
            x = (self._rays[0] * z + self._shift[0]) / depth
            y = (self._rays[1] * z + self._shift[1]) / depth
        if camera.distortion:
            x, y = _distorted(x, y, camera.distortion)
        u = x * np.float32(camera.fx) + np.float32(camera.cx + 0.5)
        v = y * np.float32(camera.fy) + np.float32(camera.cy + 0.5)
        landed = (z > 0) & (u >= 0) & (v >= 0) & (u < camera.width) & (v < camera.height)
        place = v[landed].astype(np.int32) * camera.width + u[landed].astype(np.int32)
        registered = np.zeros(camera.height * camera.width, dtype=np.float32)
        registered[place] = depth[landed]
        return registered.reshape(camera.height, camera.width)


def _distorted(x: F32, y: F32, distortion: tuple[float, ...]) -> tuple[F32, F32]:
    """Return x/z and y/z as the lens bends them (OpenCV's k1 k2 p1 p2 k3)."""
    k1, k2, p1, p2, k3 = (*distortion, 0.0, 0.0, 0.0, 0.0, 0.0)[:5]
    r2 = x * x + y * y
    radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3))
    bent_x = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x)
    bent_y = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y
    return bent_x.astype(np.float32), bent_y.astype(np.float32)
