"""A glance at the belt each second that costs next to nothing; only where it looks moved is a closer look taken."""

from __future__ import annotations

import numpy as np

from fruitgui.frame import F64, Bools, Frame
from fruitgui.geometry.plane import Plane
from fruitgui.geometry.rig import Rig
from fruitgui.station.live.level import LevelWatch
from fruitgui.station.rig_watch import RigWatch

GLANCE_S = 1.0
EVERY_GLANCE = 30
"""So manieth glance is a close look anyway."""

STEP_PX = 8
NEAR = 0.06
"""Readings within so much of the belt's inverse depth, 1/m, may be the belt's: 60 mm at a metre."""

BINS = np.arange(-0.03, 0.03, 1e-3)
BANDS = (8e-3, 4e-3, 3e-3, 3e-3)
"""Of the inverse depths about the commonest one, from round to round: the belt's, whatever lies on it."""

DOUBT_RAD, DOUBT_M = float(np.radians(0.11)), 0.0009
"""Less than what the close look calls moved, so that nothing passes the glance that would not pass the look."""


class BumpWatch:
    """Watches whether sensors stand as they were calibrated.

    Args:
        rig: as the station has it.
    """

    def __init__(self, rig: Rig) -> None:
        self._rig = rig
        self._glanced_s: dict[str, float] = {}
        self._glances: dict[str, int] = {}
        self._level = LevelWatch()
        self.close = RigWatch(rig, every=1)

    def see_frame(self, sensor: str, frame: Frame) -> None:
        """Glance at a frame of a station sensor, once a second of its own clock."""
        if abs(frame.time_s - self._glanced_s.get(sensor, -np.inf)) < GLANCE_S:
            return
        self._glanced_s[sensor] = frame.time_s
        self._glances[sensor] = self._glances.get(sensor, -1) + 1
        turned_rad = self._level.feel(sensor, frame.felt_m_s2)
        if turned_rad is not None:
            self.close.feel_turned(sensor, turned_rad)
        if self._glances[sensor] % EVERY_GLANCE == 0 or looks_moved(frame, self._rig.mounts[sensor].surface.plane):
            self.close.see_frame(sensor, frame)


def looks_moved(frame: Frame, plane: Plane) -> bool:
    """Tell whether the belt seems to lie elsewhere than a plane says, by every eighth pixel of one frame."""
    z = frame.depth_mm[::STEP_PX, ::STEP_PX].astype(np.float64) * 1e-3
    seen = z > 0
    rays = np.dstack([frame.intrinsics.rays()[::STEP_PX, ::STEP_PX], np.ones(z.shape)])[seen]
    expected = -plane.normal / plane.offset_m
    apart = 1.0 / z[seen] - rays @ expected
    near = np.abs(apart) < NEAR
    if near.sum() < 0.02 * z.size:
        return True
    missing, on = _fitted(rays[near], apart[near])
    found = expected + missing
    length = float(np.linalg.norm(found))
    now = Plane(-found / length, 1.0 / length)
    tilt_rad = float(np.arccos(np.clip(now.normal @ plane.normal, -1.0, 1.0)))
    middle = (rays[near][on] * z[seen][near][on, None]).mean(axis=0)
    return tilt_rad > DOUBT_RAD or abs(float(plane.height_m(middle) - now.height_m(middle))) > DOUBT_M


def _fitted(rays: F64, apart: F64) -> tuple[F64, Bools]:
    """Return the plane (3,) through most inverse depths, which are linear in the rays, and which of them lie on it."""
    plane: F64 = np.zeros(3)
    on: Bools = np.ones(len(apart), dtype=bool)
    for band in BANDS:
        residual = apart - rays @ plane
        counts = np.convolve(np.histogram(residual, BINS)[0], np.ones(5), "same")
        on = np.asarray(np.abs(residual - BINS[int(np.argmax(counts))] - 5e-4) < band)
        plane = np.asarray(np.linalg.lstsq(rays[on], apart[on], rcond=None)[0], dtype=np.float64)
    return plane, on
