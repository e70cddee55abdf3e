"""Intrinsics from what a camera says of itself."""

from __future__ import annotations

import math

from fruitgui.frame import Intrinsics
from fruitgui.sensors.recordings.raw import MalformedError
from fruitgui.sensors.recordings.wire import CameraInfo

_SUPPORTED = {"plumb_bob": (0, 4, 5), "rational_polynomial": (0, 8, 12, 14), "": (0, 4, 5, 8, 12, 14)}
_MODEL_NAMES = {"none": "", "radtan": "plumb_bob", "brown_conrady": "plumb_bob"}
_MAX_SIDE = 16384
_SAME_SHAPE = 0.02
"""Relative difference of the two scales between a camera's stated size and its pictures that is rounding."""


def intrinsics_of(info: CameraInfo, size: tuple[int, int], *, rectified: bool) -> Intrinsics:
    """Return the camera of pictures of `size` (width, height).

    Where pictures are smaller or larger than the camera says, by one factor
    both ways, the camera is scaled; binning and region of interest count too.

    Args:
        info: what the camera says of itself.
        size: of the pictures.
        rectified: the pictures are rectified: the projection matrix holds, the lens does not.

    Raises:
        MalformedError: no camera matrix, or a lens model that is not supported.
    """
    fx, fy, cx, cy = _matrix(info, rectified)
    distortion = () if rectified else _distortion(info)
    full, (cx, cy) = _full_size(info, size, (cx, cy))
    return resized(Intrinsics(*full, fx, fy, cx, cy, distortion), size)


def resized(camera: Intrinsics, size: tuple[int, int]) -> Intrinsics:
    """Return the same camera at another resolution (width, height).

    Raises:
        MalformedError: the two sizes differ in shape.
    """
    full = (camera.width, camera.height)
    if full == size:
        return camera
    if max(full) > _MAX_SIDE:
        raise MalformedError(f"camera_info claims {full[0]}×{full[1]} pixels")
    scale_u, scale_v = size[0] / full[0], size[1] / full[1]
    if abs(scale_u / scale_v - 1.0) > _SAME_SHAPE:
        raise MalformedError(f"the camera is for {full[0]}×{full[1]} pixels, pictures are {size[0]}×{size[1]}")
    return Intrinsics(
        *size,
        camera.fx * scale_u,
        camera.fy * scale_v,
        (camera.cx + 0.5) * scale_u - 0.5,
        (camera.cy + 0.5) * scale_v - 0.5,
        camera.distortion,
    )


def _matrix(info: CameraInfo, rectified: bool) -> tuple[float, float, float, float]:
    K = info.K
    if rectified and info.P[0] > 0:
        K = (*info.P[0:3], *info.P[4:7], *info.P[8:11])
    if not all(math.isfinite(value) for value in K):
        raise MalformedError("the camera matrix in camera_info is not finite")
    fx, fy = K[0], K[4]
    if not (1.0 <= fx <= 1e5 and 1.0 <= fy <= 1e5):
        raise MalformedError("the camera matrix in camera_info holds no focal length")
    if not (abs(K[2]) < 1e5 and abs(K[5]) < 1e5):
        raise MalformedError("the principal point in camera_info is out of bounds")
    return fx, fy, K[2], K[5]


def _distortion(info: CameraInfo) -> tuple[float, ...]:
    model = _MODEL_NAMES.get(info.model.lower(), info.model.lower())
    if model not in _SUPPORTED:
        raise MalformedError(
            f"the lens model {info.model[:30]!r} is not supported (plumb_bob and rational_polynomial are)"
        )
    if not all(math.isfinite(value) for value in info.D):
        raise MalformedError("the lens coefficients in camera_info are not finite")
    if len(info.D) not in _SUPPORTED[model] and any(info.D):
        raise MalformedError(f"camera_info holds {len(info.D)} lens coefficients, which {info.model!r} does not have")
    return info.D if any(info.D) else ()


def _full_size(
    info: CameraInfo, size: tuple[int, int], centre: tuple[float, float]
) -> tuple[tuple[int, int], tuple[float, float]]:
    """Return the size to which the camera matrix belongs and the principal point in it, region applied."""
    x, y, columns, rows = info.region
    if columns and rows and (columns, rows) != (info.width, info.height):
        return (columns, rows), (centre[0] - x, centre[1] - y)
    if info.width == 0 or info.height == 0:
        return size, centre
    return (info.width, info.height), centre
