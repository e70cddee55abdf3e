"""All views of one track as points over the belt, with how far each may be trusted."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from fruitgui.frame import F64, Bools, Ints
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rig import Mount, Rig
from fruitgui.geometry.rotation import rotation_between
from fruitgui.perception.view import FruitView
from fruitgui.tracking.track import Sighting, Track

POINTS_IN_ALL = 3200
"""Points that a fit uses. More only repeat each other: neighbouring errors are correlated by the matching window."""

POINTS_PER_VIEW = (24, 110)
VIEWS_IN_ALL = 72

EDGE_PX = 3.0
"""Points nearer to the edge of their picture than this lie: structured light fattens edges by up to two pixels."""

LEAST_POINTS = 8

SIGMA_PER_Z2 = 1.4e-3
"""Random error of a Kinect's depth, metres at 1 m, growing with z² (Khoshelham & Elberink 2012)."""

STEP_PER_Z2 = 2.9e-3
"""Step of a Kinect's depth, metres at 1 m (1/8 px of disparity at f = 580 px, b = 75 mm)."""


@dataclass(frozen=True, slots=True, eq=False)
class Evidence:
    """V views of one fruit, M points each (padded), in the belt frame: z up, z = 0 on the belt.

    Heights are over the belt as each sensor itself sees it, so that a sensor's
    depth bias, which its belt shares, drops out of them.

    Attributes:
        points_m: (V, M, 3).
        used: (V, M) false where padded.
        sight: (V, M, 3) unit vectors from the sensor to the points.
        depth_sigma_m: (V, M) standard deviation along the sight.
        pixel_m: (V, M) size of a pixel at the point.
        time_s: (V,) since the middle of the track.
        sensor: (V,) index into `sensors`.
        sensors: ids.
        sensor_place_m: (S, 3) where the sensors are.
        offset_sigma_m: (S,) standard deviation of a sensor's common shift against the others, along the belt.
        centre_m: (V, 3) first guess of the fruit's centre in each view.
        height_m: first guess of the fruit's height.
    """

    points_m: F64
    used: Bools
    sight: F64
    depth_sigma_m: F64
    pixel_m: F64
    time_s: F64
    sensor: Ints
    sensors: tuple[str, ...]
    sensor_place_m: F64
    offset_sigma_m: F64
    centre_m: F64
    height_m: float


class _Place(NamedTuple):
    """A sensor over its own belt: the pose into the belt frame, and how sure it is along the belt."""

    pose: Pose
    offset_sigma_m: float


def gather(track: Track, rig: Rig) -> Evidence | None:
    """Bring the views of a track together over the belt; None where no view has enough points to use."""
    chosen = [s for s in track.sightings if s.view.sensor in rig.mounts and len(s.view.points_m) >= LEAST_POINTS]
    chosen = _spread(_prefer_whole(chosen), VIEWS_IN_ALL)
    if not chosen:
        return None
    sensors = tuple(sorted({s.view.sensor for s in chosen}))
    belt = rig.belt_frame()
    places = {name: _place(rig.mounts[name], belt, _middle(chosen, name)) for name in sensors}
    per_view = int(np.clip(POINTS_IN_ALL // len(chosen), *POINTS_PER_VIEW))
    packed = [_pack(s.view, places[s.view.sensor].pose, per_view, rig.mounts[s.view.sensor]) for s in chosen]
    points, used, sight, sigma, pixel = (np.stack(part) for part in zip(*packed, strict=True))
    times = np.array([s.time_s for s in chosen])
    return Evidence(
        points,
        used,
        sight,
        sigma,
        pixel,
        times - 0.5 * (times.min() + times.max()),
        np.array([sensors.index(s.view.sensor) for s in chosen]),
        sensors,
        np.stack([places[name].pose.translation_m for name in sensors]),
        np.array([places[name].offset_sigma_m for name in sensors]),
        np.stack([places[s.view.sensor].pose.apply(s.view.centre_m) for s in chosen]),
        float(np.median([s.view.height_m for s in chosen])),
    )


def _prefer_whole(sightings: list[Sighting]) -> list[Sighting]:
    """Leave out views cut by the picture or hidden by a neighbour while enough whole ones remain."""
    whole = [s for s in sightings if s.view.whole]
    return whole if len(whole) >= 6 and 3 * len(whole) >= len(sightings) else sightings


def _spread(sightings: list[Sighting], most: int) -> list[Sighting]:
    if len(sightings) <= most:
        return sightings
    return [sightings[i] for i in np.linspace(0, len(sightings) - 1, most).round().astype(int)]


def _middle(sightings: list[Sighting], sensor: str) -> F64:
    """Return the middle of what one sensor saw of the fruit, in its own optical frame."""
    return np.asarray(np.mean([s.view.centre_m for s in sightings if s.view.sensor == sensor], axis=0))


def _place(mount: Mount, belt: Pose, middle_m: F64) -> _Place:
    """Return a sensor's pose into the belt frame, turned and lifted so that its own belt lies at z = 0.

    The turn is about where it saw the fruit, so that nothing moves along the belt there.
    """
    pose = Pose(belt.rotation, belt.translation_m) @ Pose(mount.pose.rotation, mount.pose.translation_m)
    own = mount.surface.plane.mapped(pose)
    pivot = pose.apply(middle_m)
    R = rotation_between(own.normal, np.array([0.0, 0.0, 1.0]))
    lift = np.array([0.0, 0.0, float(own.height_m(pivot)) - pivot[2]])
    leveled = Pose(R @ pose.rotation, R @ (pose.translation_m - pivot) + pivot + lift)
    return _Place(leveled, _offset_sigma_m(mount, middle_m))


def _offset_sigma_m(mount: Mount, middle_m: F64) -> float:
    """Return how far a sensor may stand beside its pose along the belt, as far as one fruit is concerned.

    The pose's own covariance, and a floor for what no covariance knows: a depth
    bias that differs over the belt (0.6 % of 0.3 m beside where the pose was fitted).
    """
    variance = 1.5e-3**2
    if mount.pose.covariance is not None:
        J = mount.pose.point_jacobian(mount.pose.apply(middle_m))
        variance += float(np.trace(J @ mount.pose.covariance @ J.T)) / 3.0
    return float(np.sqrt(variance))


def _pack(view: FruitView, pose: Pose, count: int, mount: Mount) -> tuple[F64, Bools, F64, F64, F64]:
    points = _inner_points(view, count)
    used = np.zeros(count, dtype=bool)
    used[: len(points)] = True
    padded = np.empty((count, 3))
    padded[: len(points)] = points
    padded[len(points) :] = points[0]
    z = padded[:, 2]
    sigma = z**2 * np.hypot(SIGMA_PER_Z2, STEP_PER_Z2 / np.sqrt(12.0))
    sight = pose.turn(padded)
    sight /= np.linalg.norm(sight, axis=1, keepdims=True)
    return pose.apply(padded), used, sight, sigma, z / mount.intrinsics.fx


def _inner_points(view: FruitView, count: int) -> F64:
    """Return at most `count` points of a view, away from its edge as far as its size allows."""
    inner = view.edge_px >= min(EDGE_PX, 0.45 * float(view.edge_px.max()))
    index = np.flatnonzero(inner) if inner.sum() >= LEAST_POINTS else np.arange(len(view.points_m))
    if len(index) > count:
        index = index[((np.arange(count) + 0.5) * (len(index) / count)).astype(int)]
    return view.points_m[index].astype(np.float64)
