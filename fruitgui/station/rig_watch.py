"""The watch over a bumped rig while it runs: belts and fruit against the station."""

from __future__ import annotations

import math
from collections import defaultdict, deque
from itertools import combinations

import numpy as np

from fruitgui.calibration.watch import FruitDrift, PlaneDrift, belt_elsewhere, fruit_drift, plane_drift
from fruitgui.frame import F64, Frame
from fruitgui.geometry.rig import Rig
from fruitgui.tracking.track import Track

EVERY_FRAMES = 40
FRAMES_PER_LOOK = 5
"""Every so many frames one is kept; so many together are held against the station's belt."""

FRUIT_KEPT = 40
"""The latest fruit that two sensors saw; an old bump that was mended is forgotten."""


class RigWatch:
    """Compares what passes with the station; says once of each sensor or pair that it is stale.

    Args:
        rig: as the station has it.
        every: so manieth frame of a sensor is kept for a look at its belt.
    """

    def __init__(self, rig: Rig, every: int = EVERY_FRAMES) -> None:
        self._rig = rig
        self._every = every
        self._counts: dict[str, int] = defaultdict(int)
        self._frames: dict[str, list[Frame]] = defaultdict(list)
        self._gaps: dict[tuple[str, str], deque[tuple[F64, F64]]] = defaultdict(lambda: deque(maxlen=FRUIT_KEPT))
        self._said: dict[str, str] = {}

    @property
    def warnings(self) -> list[str]:
        """What is stale, in words that begin with `calibration_stale`."""
        return list(self._said.values())

    @property
    def stale(self) -> dict[tuple[str, ...], str]:
        """What is stale, in words, by the sensors that it concerns."""
        return {tuple(names.split()): text for names, text in list(self._said.items())}

    def see_frame(self, sensor: str, frame: Frame) -> None:
        """Look at a frame of a station sensor, now and then."""
        number = self._counts[sensor]
        self._counts[sensor] += 1
        if number % self._pace(number) or sensor in self._said:
            return
        self._frames[sensor].append(frame)
        if len(self._frames[sensor]) == FRAMES_PER_LOOK:
            frames, mount = self._frames.pop(sensor), self._rig.mounts[sensor]
            drift = plane_drift(frames, mount.surface)
            if drift is not None and drift.stale:
                self._said[sensor] = _belt_moved(sensor, drift)
            elif drift is None and belt_elsewhere(frames, mount):
                self._said[sensor] = _belt_elsewhere(sensor)

    def _pace(self, number: int) -> int:
        """Return the so manieth frame that is kept: more of the first, since a recording may be short."""
        return max(self._every // FRAMES_PER_LOOK, 1) if number < self._every else self._every

    def feel_turned(self, sensor: str, angle_rad: float) -> None:
        """Note that a sensor was turned, as its accelerometer says."""
        self._said.setdefault(sensor, _turned(sensor, angle_rad))

    def see_track(self, track: Track) -> None:
        """Compare where the sensors saw one fruit."""
        seen = {sensor: gap for sensor in self._rig.mounts if (gap := self._residual(track, sensor)) is not None}
        for pair in combinations(sorted(seen), 2):
            (first, first_spread), (second, second_spread) = seen[pair[0]], seen[pair[1]]
            self._gaps[pair].append((second - first, first_spread + second_spread))
            name = " ".join(pair)
            if name in self._said:
                continue
            gaps, spreads = zip(*self._gaps[pair], strict=True)
            drift = fruit_drift(np.array(gaps), np.array(spreads))
            if drift is not None and drift.stale:
                self._said[name] = _fruit_apart(pair, drift)

    def _residual(self, track: Track, sensor: str) -> tuple[F64, F64] | None:
        """Return (mean distance of a sensor's centres from the path, its covariance), reference frame."""
        views = [one for one in track.sightings if one.view.sensor == sensor and one.view.whole and not one.view.shared]
        if len(views) < 3:
            return None
        mount = self._rig.mounts[sensor]
        times = np.array([point.time_s for point in track.path])
        path = np.array([point.position_m for point in track.path])
        at = np.array([np.interp([one.time_s for one in views], times, path[:, axis]) for axis in range(3)]).T
        centres = mount.pose.apply(np.array([one.view.centre_m for one in views]))
        spread = mount.pose.rotation @ np.mean([one.view.centre_covariance_m2 for one in views], axis=0)
        spread = spread @ mount.pose.rotation.T
        if mount.pose.covariance is not None:
            J = mount.pose.point_jacobian(centres.mean(axis=0))
            spread = spread + J @ mount.pose.covariance @ J.T
        return (centres - at).mean(axis=0), spread


def _turned(sensor: str, angle_rad: float) -> str:
    return (
        f"calibration_stale: sensor {sensor} was turned by {math.degrees(angle_rad):.1f}° since the line began, as it "
        "feels itself. Calibrate again; sizes and counts of this run may be wrong."
    )


def _belt_elsewhere(sensor: str) -> str:
    return (
        f"calibration_stale: what sensor {sensor} sees where the belt was when it was calibrated lies elsewhere: it "
        "was moved far, looks at another belt, or its depth is in another unit. Calibrate again; sizes and counts of "
        "this run may be wrong."
    )


def _belt_moved(sensor: str, drift: PlaneDrift) -> str:
    return (
        f"calibration_stale: sensor {sensor} sees the belt {abs(drift.lift_m) * 1e3:.0f} mm and "
        f"{math.degrees(drift.tilt_rad):.1f}° from where it was when calibrated: it was bumped, or the belt was. "
        "Calibrate again; sizes and counts of this run may be wrong."
    )


def _fruit_apart(pair: tuple[str, str], drift: FruitDrift) -> str:
    apart_mm = float(np.linalg.norm(drift.offset_m)) * 1e3
    return (
        f"calibration_stale: sensors {pair[0]} and {pair[1]} see the same fruit {apart_mm:.0f} mm apart "
        f"(median of {drift.fruit}): one of them was moved. Calibrate again; sizes and counts of this run may be wrong."
    )
