"""The belt from above, as all sensors together see it: each picture laid on the belt's plane."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F32, F64, U8, Bools, Frame, Intrinsics
from fruitgui.station.belt_setting import off_plan, seen_at
from fruitgui.station.station import Station

COARSE = 8
FAR_AWAY = -1e6
"""Stands for the pixel of a place that is out of sight."""


@dataclass(frozen=True, slots=True, eq=False)
class Mosaic:
    """The way from pictures to one picture of the plan.

    Attributes:
        maps: by sensor, (h, w, 2) float32: which pixel of its picture is seen at each pixel of the mosaic.
        shares: by sensor, (h, w) where it is the one that is shown: of those that see a place, the one that looks at
            it the most from above; what stands on the belt leans least there.
    """

    maps: Mapping[str, F32]
    shares: Mapping[str, Bools]

    def laid(self, frames: Mapping[str, Frame | None]) -> U8:
        """Return the mosaic (h, w, 4) RGBA, clear where no sensor sees the belt."""
        import cv2

        shape = next(iter(self.shares.values())).shape
        mosaic = np.zeros((*shape, 4), np.uint8)
        for sensor, places in self.maps.items():
            frame = frames.get(sensor)
            if frame is not None:
                picture = cv2.remap(
                    frame.color, places[..., 0], places[..., 1], cv2.INTER_LINEAR, None, cv2.BORDER_REPLICATE
                )
                opaque = cv2.cvtColor(picture, cv2.COLOR_RGB2RGBA)
                cv2.copyTo(opaque, self.shares[sensor].view(np.uint8), mosaic)
        return mosaic


def mosaic_of(station: Station, cameras: Mapping[str, Intrinsics], plan_m: F64) -> Mosaic:
    """Return the mosaic of the plan's points (h, w, 2), for the sensors that both know."""
    maps: dict[str, F32] = {}
    steepness: dict[str, F64] = {}
    for sensor, camera in cameras.items():
        if sensor in station.sensors:
            maps[sensor], steep = _seen(station, sensor, camera, plan_m)
            u, v = maps[sensor][..., 0], maps[sensor][..., 1]
            inside = (u >= 0) & (v >= 0) & (u <= camera.width - 1) & (v <= camera.height - 1)
            steepness[sensor] = np.where(inside, steep, -1.0)
    best = np.max(list(steepness.values()), axis=0) if steepness else np.zeros(plan_m.shape[:2])
    return Mosaic(maps, {sensor: (steep >= best) & (steep > 0) for sensor, steep in steepness.items()})


def _seen(station: Station, sensor: str, camera: Intrinsics, plan_m: F64) -> tuple[F32, F32]:
    """Return the pixels (h, w, 2) at which a sensor sees the plan, and how steeply (h, w): the cosine to the normal.

    Both change so little from place to place that every `COARSE`-th is worked out and those between are drawn.
    """
    import cv2

    height, width = plan_m.shape[:2]
    rows = np.linspace(0, height - 1, max(height // COARSE, 2)).round().astype(int)
    columns = np.linspace(0, width - 1, max(width // COARSE, 2)).round().astype(int)
    few_m = plan_m[np.ix_(rows, columns)].reshape(-1, 2)
    points = off_plan(station, sensor, few_m)
    steep = -(points @ station.sensors[sensor].surface.plane.normal) / np.linalg.norm(points, axis=1)
    pixels = np.nan_to_num(seen_at(station, sensor, camera, few_m), nan=FAR_AWAY)
    coarse = np.column_stack([pixels, steep]).astype(np.float32).reshape(len(rows), len(columns), 3)
    u = np.interp(np.arange(width), columns, np.arange(len(columns))).astype(np.float32)
    v = np.interp(np.arange(height), rows, np.arange(len(rows))).astype(np.float32)
    fine = cv2.remap(coarse, *np.meshgrid(u, v), cv2.INTER_LINEAR)
    return np.ascontiguousarray(fine[..., :2]), fine[..., 2]
