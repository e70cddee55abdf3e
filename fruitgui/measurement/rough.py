"""The size of what no surface can be fitted to: from its outlines and heights alone, and as unsure as that is."""

from __future__ import annotations

import numpy as np

from fruitgui.frame import F64
from fruitgui.geometry.rig import Rig
from fruitgui.measurement.fruit import Quantity, Size
from fruitgui.perception.view import FruitView
from fruitgui.tracking.track import Track

ROUGH_EXTENT, ROUGH_VOLUME = 0.2, 0.5
"""Relative standard deviations of an extent and of a volume that come from outlines alone."""

LEAST_M = 1e-3


def rough_size(track: Track, rig: Rig) -> Size:
    """Return the size of an ellipsoid as long and broad as the outlines and as high as the views say."""
    views = [sighting.view for sighting in track.sightings]
    extents = np.array([_extents_m(view, rig) for view in views])
    length, breadth, height = np.maximum(np.median(extents, axis=0), LEAST_M)
    longest, middle = sorted((length, breadth, height))[:0:-1]
    volume = np.pi / 6.0 * length * breadth * height
    around = np.pi * (length + breadth) / 2.0
    return Size(
        volume_m3=Quantity(float(volume), float(ROUGH_VOLUME * volume)),
        length_m=_rough(longest),
        diameter_m=_rough(middle),
        perimeter_m=_rough(around),
        coverage=0.0,
    )


def _rough(value_m: float) -> Quantity:
    return Quantity(float(value_m), float(ROUGH_EXTENT * value_m))


def _extents_m(view: FruitView, rig: Rig) -> F64:
    """Return length and breadth of a view's outline at its distance, and its height over the belt, metres."""
    import cv2

    mount = rig.mounts.get(view.sensor)
    focal = next(iter(rig.mounts.values())).intrinsics.fx if mount is None else mount.intrinsics.fx
    outline = np.asarray(view.outline_px, dtype=np.float32).reshape(-1, 1, 2)
    sides = cv2.minAreaRect(outline)[1] if len(outline) >= 3 else view.box_px[2:]
    scale = float(view.centre_m[2]) / focal
    return np.array([max(sides) * scale, min(sides) * scale, view.height_m])
