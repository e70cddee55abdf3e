"""How a lens bends rays: OpenCV's model, for all pixels at once.

`cv2.projectPoints` makes the Jacobian of every point as well and takes a
hundred times as long; registration projects whole pictures.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from fruitgui.frame import F64, Intrinsics

_BEYOND = 0.3
"""How far beyond the picture's edge, as a part of its size, the lens polynomial is believed."""


def pixels_of_rays(camera: Intrinsics, x: ArrayLike, y: ArrayLike) -> tuple[F64, F64]:
    """Return pixels (u, v) of rays x/z, y/z, any shape.

    Inside the picture and somewhat beyond it as the lens bends them; farther
    out the polynomial may fold back into the picture, so there the picture
    goes on straight.
    """
    x, y = np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)
    if not camera.distortion:
        return camera.fx * x + camera.cx, camera.fy * y + camera.cy
    low, high = _domain(camera)
    inner_x, inner_y = np.clip(x, low[0], high[0]), np.clip(y, low[1], high[1])
    bent_x, bent_y = _bent(camera.distortion, inner_x, inner_y)
    return camera.fx * (bent_x + x - inner_x) + camera.cx, camera.fy * (bent_y + y - inner_y) + camera.cy


def _domain(camera: Intrinsics) -> tuple[F64, F64]:
    columns = [camera.rays()[..., axis] for axis in (0, 1)]  # numpy takes thirty times as long for both at once
    low, high = (np.array([extreme(one) for one in columns], dtype=np.float64) for extreme in (np.min, np.max))
    margin = _BEYOND * (high - low)
    return low - margin, high + margin


def _bent(distortion: tuple[float, ...], x: F64, y: F64) -> tuple[F64, F64]:
    """Return the rays as the lens bends them (OpenCV, camera calibration, eq. of the distortion model)."""
    k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4, tilt_x, tilt_y = (*distortion, *(0.0,) * 14)[:14]
    r2 = x * x + y * y
    radial = (1.0 + r2 * (k1 + r2 * (k2 + r2 * k3))) / (1.0 + r2 * (k4 + r2 * (k5 + r2 * k6)))
    xy = 2.0 * x * y
    bent_x = x * radial + p1 * xy + p2 * (r2 + 2.0 * x * x) + r2 * (s1 + r2 * s2)
    bent_y = y * radial + p1 * (r2 + 2.0 * y * y) + p2 * xy + r2 * (s3 + r2 * s4)
    if tilt_x or tilt_y:
        return _tilted(tilt_x, tilt_y, bent_x, bent_y)
    return bent_x, bent_y


def _tilted(tilt_x: float, tilt_y: float, x: F64, y: F64) -> tuple[F64, F64]:
    """Return where rays meet a tilted image plane (OpenCV, tilted sensor model)."""
    cos_x, sin_x, cos_y, sin_y = np.cos(tilt_x), np.sin(tilt_x), np.cos(tilt_y), np.sin(tilt_y)
    turn_x = np.array([[1, 0, 0], [0, cos_x, sin_x], [0, -sin_x, cos_x]])
    turn_y = np.array([[cos_y, 0, -sin_y], [0, 1, 0], [sin_y, 0, cos_y]])
    R = turn_y @ turn_x
    T = np.array([[R[2, 2], 0, -R[0, 2]], [0, R[2, 2], -R[1, 2]], [0, 0, 1]]) @ R
    z = T[2, 0] * x + T[2, 1] * y + T[2, 2]
    return (T[0, 0] * x + T[0, 1] * y + T[0, 2]) / z, (T[1, 0] * x + T[1, 1] * y + T[1, 2]) / z
