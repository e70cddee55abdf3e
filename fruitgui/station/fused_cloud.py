"""What the sensors see of a still scene, laid together over the belt: before and after they were placed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from fruitgui.calibration.still import average
from fruitgui.calibration.surface import fit_belt
from fruitgui.frame import F32, U8, Frame, Intrinsics
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rig import Rig
from fruitgui.station.station import Station

MOST_POINTS = 300_000
"""Of all sensors together: more cannot be told apart on a screen."""

HEIGHTS_M = (-0.04, 0.35)
FARTHEST_M = 3.0
"""Points farther below or above the belt, or farther away along it, are floor, wall or ceiling."""


@dataclass(frozen=True, slots=True, eq=False)
class SensorCloud:
    """One sensor's points over the belt: z up from it, z = 0 on it.

    Attributes:
        sensor: its name.
        before_m: (N, 3) float32 as the sensors were thought to stand before. after_m: as they stand.
        colors: (N, 3) uint8 RGB.
    """

    sensor: str
    before_m: F32
    after_m: F32
    colors: U8


def fused_clouds(
    stills: Mapping[str, Sequence[Frame]], before: Station | None, after: Station | None
) -> tuple[SensorCloud, ...]:
    """Return the clouds of all sensors whose belt is seen.

    Args:
        stills: frames of the still scene by sensor.
        before: the station until now; where it does not know these sensors each is laid on its own belt, as if all
            stood at one place.
        after: the new station; where None (refused) it is as before.
    """
    old, new = _over_belt(before, stills), _over_belt(after, stills)
    clouds = []
    for sensor, frames in stills.items():
        still = average(frames)
        belt = fit_belt(still)
        alone = None if belt is None else belt.plane.frame()
        earlier = old.get(sensor, alone)
        if earlier is None:
            continue
        points = still.points()[still.seen]
        colors = still.color[still.seen]
        step = max(1, -(-len(points) * len(stills) // MOST_POINTS))
        points, colors = points[::step], colors[::step]
        later = new.get(sensor, earlier)
        near = _near(later.apply(points)) | _near(earlier.apply(points))
        points = points[near]
        clouds.append(SensorCloud(sensor, _mapped(earlier, points), _mapped(later, points), colors[near]))
    return tuple(_turned(cloud, _along(clouds)) for cloud in clouds)


def _along(clouds: Sequence[SensorCloud]) -> F32:
    """Return the turn about z (3, 3) that lays what is seen along x: a belt is longer than it is wide."""
    flat = np.concatenate([cloud.after_m[::11, :2] for cloud in clouds])
    _, axes = np.linalg.eigh(np.cov(flat.T))
    along = axes[:, 1] * (1.0 if axes[0, 1] >= 0 else -1.0)
    turn = np.eye(3, dtype=np.float32)
    turn[:2, :2] = [[along[0], along[1]], [-along[1], along[0]]]
    return turn


def _turned(cloud: SensorCloud, turn: F32) -> SensorCloud:
    return SensorCloud(cloud.sensor, cloud.before_m @ turn.T, cloud.after_m @ turn.T, cloud.colors)


def _over_belt(station: Station | None, stills: Mapping[str, Sequence[Frame]]) -> dict[str, Pose]:
    """Return, by sensor, the way from its optical frame to the belt of a station that knows all of them."""
    if station is None or not set(stills) <= set(station.sensors):
        return {}
    cameras: dict[str, Intrinsics] = {sensor: frames[0].intrinsics for sensor, frames in stills.items()}
    rig: Rig = station.rig(cameras)
    return {sensor: rig.belt_frame() @ mount.pose for sensor, mount in rig.mounts.items()}


def _mapped(pose: Pose, points: F32) -> F32:
    return pose.apply(points).astype(np.float32)


def _near(points: np.ndarray) -> np.ndarray:
    low, high = HEIGHTS_M
    inside = (points[:, 2] > low) & (points[:, 2] < high)
    return np.asarray(inside & (np.abs(points[:, :2]).max(axis=1) < FARTHEST_M))
