"""The belt from above, as all sensors together see it: each picture laid on the belt's plane."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F32, F64, U8, Bools, Frame, Intrinsics
from fruitgui.station.belt_setting import off_plan, seen_at
from fruitgui.station.station import Station


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
                shown = self.shares[sensor]
                picture = cv2.remap(
                    frame.color, places[..., 0], places[..., 1], cv2.INTER_LINEAR, None, cv2.BORDER_REPLICATE
                )
                mosaic[shown, :3], mosaic[shown, 3] = picture[shown], 255
        return mosaic


def mosaic_of(station: Station, cameras: Mapping[str, Intrinsics], plan_m: F64) -> Mosaic:
    """Return the mosaic of the plan's points (h, w, 2), for the sensors that both know."""
    shape = plan_m.shape[:2]
    flat_m = plan_m.reshape(-1, 2)
    maps: dict[str, F32] = {}
    steepness: dict[str, F64] = {}
    for sensor, camera in cameras.items():
        if sensor not in station.sensors:
            continue
        pixels = seen_at(station, sensor, camera, flat_m)
        inside = (pixels >= 0).all(axis=1) & (pixels[:, 0] < camera.width) & (pixels[:, 1] < camera.height)
        points = off_plan(station, sensor, flat_m)
        steep = -(points @ station.sensors[sensor].surface.plane.normal) / np.linalg.norm(points, axis=1)
        maps[sensor] = np.where(inside[:, None], pixels, 0.0).astype(np.float32).reshape(*shape, 2)
        steepness[sensor] = np.where(inside, steep, -1.0).reshape(shape)
    best = np.max(list(steepness.values()), axis=0) if steepness else np.zeros(shape)
    return Mosaic(maps, {sensor: (steep >= best) & (steep > 0) for sensor, steep in steepness.items()})
