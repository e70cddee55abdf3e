"""All views of one track as points and outlines over the belt, with how far each may be trusted."""

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

VIEWS_IN_ALL = 56
POINTS_IN_ALL = 1350
POINTS_PER_VIEW = (18, 90)
"""More points only repeat each other: neighbouring errors are correlated by the matching window."""

RIM_IN_ALL = 700
RIM_PER_VIEW = (10, 36)

EDGE_PX = 3.0
"""Points nearer to the edge of their picture than this lie: structured light fattens edges by up to two pixels."""

LEAST_POINTS = 8

WINDOW_PX2 = 45.0
"""Pixels that share one error: the matching window of a Kinect is 9 × 9, and half its overlap still counts."""

SIGMA_PER_Z2 = 1.4e-3
"""Random error of a Kinect's depth, metres at 1 m, growing with z² (Khoshelham & Elberink 2012)."""

STEP_PER_Z2 = 2.9e-3
"""Step of a Kinect's depth, metres at 1 m (1/8 px of disparity at f = 580 px, b = 75 mm)."""


@dataclass(frozen=True, slots=True, eq=False)
class Evidence:
    """V views of one fruit, M samples each (padded), in the belt frame: z up, z = 0 on the belt.

    The first `points` samples of a view are points that it saw; the others lie
    on the sights along its outline, which touch the fruit somewhere. Heights
    are over the belt as each sensor itself sees it, so that a sensor's depth
    bias, which its belt shares, drops out of them.

    Attributes:
        samples_m: (V, M, 3).
        used: (V, M) false where padded.
        points: how many samples of each view are points.
        sight: (V, M, 3) unit vectors from the sensor to the samples.
        depth_sigma_m: (V, M) standard deviation along the sight.
        pixel_m: (V, M) size of a pixel at the sample.
        share: (V,) what one point counts, where they are closer than errors are independent.
        time_s: (V,) since the middle of the track.
        sensor: (V,) index into `sensors`.
        sensors: ids.
        axes: (S, 3, 3) rows are the picture's x, y and depth directions.
        offset_sigma_m: (S,) standard deviation of a sensor's common shift against the others, along the belt.
        centre_m: (V, 3) first guess of the fruit's centre in each view.
        height_m: first guess of the fruit's height.
    """

    samples_m: F64
    used: Bools
    points: int
    sight: F64
    depth_sigma_m: F64
    pixel_m: F64
    share: F64
    time_s: F64
    sensor: Ints
    sensors: tuple[str, ...]
    axes: F64
    offset_sigma_m: F64
    centre_m: F64
    height_m: float

    def thinned(self, every: int) -> Evidence:
        """Return every so many samples of each kind: enough for the first steps of a fit."""
        kept = np.r_[0 : self.points : every, self.points : self.samples_m.shape[1] : every]
        return Evidence(
            self.samples_m[:, kept],
            self.used[:, kept],
            len(range(0, self.points, every)),
            self.sight[:, kept],
            self.depth_sigma_m[:, kept],
            self.pixel_m[:, kept],
            self.share,
            self.time_s,
            self.sensor,
            self.sensors,
            self.axes,
            self.offset_sigma_m,
            self.centre_m,
            self.height_m,
        )


class _Place(NamedTuple):
    """A sensor over its own belt: the pose into the belt frame, and how sure it is along the belt."""

    pose: Pose
    offset_sigma_m: float
    mount: Mount


class _Packed(NamedTuple):
    """One view's samples in its sensor's frame."""

    samples_m: F64
    used: Bools
    share: float


def gather(track: Track, rig: Rig) -> Evidence | None:
    """Bring the views of a track together over the belt; None where no view has enough points to use."""
    chosen = [s for s in track.sightings if s.view.sensor in rig.mounts and len(s.view.points_m) >= LEAST_POINTS]
    chosen = _spread(_prefer_whole(chosen), VIEWS_IN_ALL)
    if not chosen:
        return None
    sensors = tuple(sorted({s.view.sensor for s in chosen}))
    belt = rig.belt_frame()
    places = [_place(rig.mounts[name], belt, _middle(chosen, name)) for name in sensors]
    sensor = np.array([sensors.index(s.view.sensor) for s in chosen])
    points = int(np.clip(POINTS_IN_ALL // len(chosen), *POINTS_PER_VIEW))
    rim = int(np.clip(RIM_IN_ALL // len(chosen), *RIM_PER_VIEW))
    packed = [_pack(s.view, places[k].mount, points, rim) for s, k in zip(chosen, sensor, strict=True)]
    optical = np.stack([p.samples_m for p in packed])
    z = optical[..., 2]
    rotation = np.stack([p.pose.rotation for p in places])
    place = np.stack([p.pose.translation_m for p in places])[sensor]
    directions = optical @ rotation[sensor].transpose(0, 2, 1)
    focal = np.array([p.mount.intrinsics.fx for p in places])[sensor]
    times = np.array([s.time_s for s in chosen])
    return Evidence(
        samples_m=directions + place[:, None, :],
        used=np.stack([p.used for p in packed]),
        points=points,
        sight=directions / np.sqrt(np.einsum("vmd,vmd->vm", directions, directions))[..., None],
        depth_sigma_m=z**2 * np.hypot(SIGMA_PER_Z2, STEP_PER_Z2 / np.sqrt(12.0)),
        pixel_m=z / focal[:, None],
        share=np.array([p.share for p in packed]),
        time_s=times - 0.5 * (times.min() + times.max()),
        sensor=sensor,
        sensors=sensors,
        axes=rotation.transpose(0, 2, 1),
        offset_sigma_m=np.array([p.offset_sigma_m for p in places]),
        centre_m=np.einsum("vij,vj->vi", rotation[sensor], np.stack([s.view.centre_m for s in chosen])) + place,
        height_m=float(np.median([s.view.height_m for s in chosen])),
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
    return _Place(leveled, _offset_sigma_m(mount, middle_m), mount)


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


def _pack(view: FruitView, mount: Mount, count: int, rim: int) -> _Packed:
    """Return a view's samples: `count` points away from its edge, then `rim` on the sights along its outline."""
    points = _inner_points(view, count)
    used = np.zeros(count + rim, dtype=bool)
    used[: len(points)] = True
    samples = np.empty((count + rim, 3))
    samples[: len(points)] = points
    samples[len(points) :] = view.centre_m
    outline = view.outline_px
    if view.whole and not view.shared and len(outline) >= 2 * rim:
        samples[count:] = _on_outline(outline, mount, rim, float(view.centre_m[2]))
        used[count:] = True
    return _Packed(samples, used, min(1.0, view.area_px / (WINDOW_PX2 * len(points))))


def _on_outline(outline_px: F64, mount: Mount, count: int, depth_m: float) -> F64:
    """Return points (count, 3) at a depth on the sights through an outline, spread evenly along it."""
    index = ((np.arange(count) + 0.5) * (len(outline_px) / count)).astype(int)
    camera = mount.intrinsics
    u = np.clip(np.rint(outline_px[index, 0]).astype(int), 0, camera.width - 1)
    v = np.clip(np.rint(outline_px[index, 1]).astype(int), 0, camera.height - 1)
    rays = camera.rays()[v, u].astype(np.float64)
    return np.column_stack([rays, np.ones(count)]) * depth_m


def _inner_points(view: FruitView, count: int) -> F64:
    """Return at most `count` points of a view, away from its edge as far as its size allows."""
    inner = view.edge_px >= min(EDGE_PX, 0.45 * float(view.edge_px.max()))
    index = np.flatnonzero(inner) if inner.sum() >= LEAST_POINTS else np.arange(len(view.points_m))
    if len(index) > count:
        index = index[((np.arange(count) + 0.5) * (len(index) / count)).astype(int)]
    return view.points_m[index].astype(np.float64)
