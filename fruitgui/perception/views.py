"""The records that perception hands on, made from the arrays of a whole frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F32, U8, Bools, Frame, Ints
from fruitgui.perception.centre import Centres
from fruitgui.perception.limits import DepthLimits
from fruitgui.perception.outline import Ellipses, Outlines
from fruitgui.perception.pixels import Pixels
from fruitgui.perception.split import Parts
from fruitgui.perception.view import FruitView

PATCH_PX = 40
"""Side of the source's colour patch (paper 3.2)."""


@dataclass(frozen=True, slots=True, eq=False)
class Seen:
    """Everything worked out about the N fruit of one frame."""

    parts: Parts
    outlines: Outlines
    pixels: Pixels
    ellipses: Ellipses
    centres: Centres
    whole: Bools
    features: F32


def build_views(
    frame: Frame, color: U8, limits: DepthLimits, kept: list[int], max_points: int, seen: Seen
) -> tuple[FruitView, ...]:
    """Return the views of those fruit whose numbers are `kept`. They share arrays of what was seen of fruit."""
    corner = np.array([limits.crop[1].start, limits.crop[0].start], dtype=np.int32)
    outline_px = (seen.outlines.places + corner).astype(np.float32)
    boxes = (seen.outlines.boxes() + np.tile(corner, 2)).tolist()
    middles = (seen.ellipses.centre_px + corner).tolist()
    areas = seen.ellipses.area_px.astype(np.intp).tolist()
    first, length = seen.outlines.starts.tolist(), seen.outlines.counts.tolist()
    tops, whole, shared = seen.centres.top_m.tolist(), seen.whole.tolist(), seen.parts.shared.tolist()
    points_m, edge_px, bounds = _points(seen.pixels)
    centres = seen.centres
    views = []
    for n in kept:
        left, top, right, bottom = boxes[n]
        sample = _spread(bounds[n], bounds[n + 1], max_points)
        views.append(
            FruitView(
                sensor=frame.sensor,
                sequence=frame.sequence,
                time_s=frame.time_s,
                box_px=(left, top, right - left + 1, bottom - top + 1),
                outline_px=outline_px[first[n] : first[n] + length[n]],
                points_m=points_m[sample],
                edge_px=edge_px[sample],
                area_px=areas[n],
                centre_m=centres.centre_m[n],
                centre_covariance_m2=centres.centre_covariance_m2[n],
                mean_m=centres.mean_m[n],
                mean_covariance_m2=centres.mean_covariance_m2[n],
                height_m=tops[n],
                features=seen.features[n],
                patch=patch_at(color, *middles[n]),
                whole=whole[n],
                shared=shared[n],
            )
        )
    return tuple(views)


def _points(pixels: Pixels) -> tuple[F32, F32, list[int]]:
    """Return all sound points (Q, 3), their distances from the edge (Q,), and where each fruit's begin and end."""
    sound = np.flatnonzero(pixels.valid)
    z = pixels.depth_m.take(sound)
    points = np.empty((len(sound), 3), np.float32)
    np.multiply(pixels.ray_x.take(sound), z, out=points[:, 0])
    np.multiply(pixels.ray_y.take(sound), z, out=points[:, 1])
    points[:, 2] = z
    bounds = np.searchsorted(sound, np.append(pixels.starts, len(pixels.valid)))
    return points, pixels.edge_px.take(sound), bounds.tolist()


def _spread(start: int, end: int, most: int) -> slice | Ints:
    """Return what to take of a run of points: all, or `most` of them, evenly."""
    if end - start <= most:
        return slice(start, end)
    return np.linspace(start, end - 1, most).astype(np.intp)


def patch_at(color: U8, u_px: float, v_px: float, size: int = PATCH_PX) -> U8:
    """Return the (size, size, 3) patch around a point, shifted inwards at the picture's edge."""
    height, width = color.shape[:2]
    left = min(max(round(u_px) - size // 2, 0), max(width - size, 0))
    top = min(max(round(v_px) - size // 2, 0), max(height - size, 0))
    patch = color[top : top + size, left : left + size].copy()
    if patch.shape[:2] != (size, size):
        patch = np.pad(patch, ((0, size - patch.shape[0]), (0, size - patch.shape[1]), (0, 0)), mode="edge")
    return patch
