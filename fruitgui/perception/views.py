"""The records that perception hands on, made from the arrays of a whole frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F32, F64, U8, Bools, Frame, Ints
from fruitgui.perception.centre import Centres, Heights
from fruitgui.perception.limits import DepthLimits
from fruitgui.perception.outline import Ellipses, Outlines
from fruitgui.perception.parts import Parts
from fruitgui.perception.pixels import Pixels
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
    heights: Heights
    centres: Centres
    whole: Bools
    free: Bools
    features: F32


def build_views(
    frame: Frame, color: U8, limits: DepthLimits, kept: list[int], max_points: int, seen: Seen
) -> tuple[FruitView, ...]:
    """Return the views of those fruit whose numbers are `kept`. They share arrays of what was seen of fruit."""
    across, down = limits.crop[1].start, limits.crop[0].start
    outline_px = seen.outlines.places.astype(np.float32)
    corner = np.array([across, down], dtype=np.float32)
    for axis, start in enumerate((across, down)):
        outline_px[:, axis] += np.float32(start)
    patches = patches_at(color, seen.ellipses.centre_px + corner)
    areas = seen.ellipses.area_px.astype(np.intp).tolist()
    first, length = seen.outlines.starts.tolist(), seen.outlines.counts.tolist()
    tops, whole, shared = seen.heights.top_m.tolist(), seen.whole.tolist(), seen.parts.shared.tolist()
    points_m, edge_px, bounds = _points(seen.pixels)
    centres = seen.centres
    views = []
    for n in kept:
        left, top, width, height = seen.parts.boxes[n]
        sample = _spread(bounds[n], bounds[n + 1], max_points)
        views.append(
            FruitView(
                sensor=frame.sensor,
                sequence=frame.sequence,
                time_s=frame.time_s,
                box_px=(left + across, top + down, width, height),
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
                patch=patches[n],
                whole=whole[n],
                shared=shared[n],
                outline_free=seen.free[first[n] : first[n] + length[n]],
            )
        )
    return tuple(views)


def _points(pixels: Pixels) -> tuple[F32, F32, list[int]]:
    """Return all sound points (Q, 3), their distances from the edge (Q,), and where each fruit's begin and end."""
    sound = np.flatnonzero(pixels.valid > 0)
    points = np.empty((len(sound), 3), np.float32)
    for axis, values in enumerate((pixels.x_m, pixels.y_m, pixels.depth_m)):
        points[:, axis] = values.take(sound)
    bounds = np.searchsorted(sound, np.append(pixels.runs.starts, len(pixels.valid)))
    return points, pixels.edge_px.take(sound), bounds.tolist()


def _spread(start: int, end: int, most: int) -> slice | Ints:
    """Return what to take of a run of points: all, or `most` of them, evenly."""
    if end - start <= most:
        return slice(start, end)
    return np.linspace(start, end - 1, most).astype(np.intp)


def patches_at(color: U8, middles_px: F64, size: int = PATCH_PX) -> list[U8]:
    """Return the (size, size, 3) patches around points (N, 2: u, v), shifted inwards at the picture's edge."""
    height, width = color.shape[:2]
    if min(height, width) < size:
        rest = ((0, max(size - height, 0)), (0, max(size - width, 0)), (0, 0))
        return patches_at(np.pad(color, rest, mode="edge"), middles_px, size)
    corners = np.rint(middles_px).astype(np.intp) - size // 2
    corners = np.minimum(np.maximum(corners, 0), (width - size, height - size)).tolist()
    return [color[top : top + size, left : left + size].copy() for left, top in corners]
