"""All views of one track as points and outlines over the belt, with how far each may be trusted."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from fruitgui.frame import F64, Bools, Ints
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rig import Mount, Rig
from fruitgui.geometry.rotation import rotation_between
from fruitgui.measurement.samples import LEAST_POINTS, take_samples
from fruitgui.perception.view import FruitView
from fruitgui.tracking.track import Sighting, Track

VIEWS_IN_ALL = 48
POINTS_IN_ALL = 1150
POINTS_PER_VIEW = (22, 90)
"""More points only repeat each other: neighbouring errors are correlated by the matching window."""

RIM_IN_ALL = 520
RIM_PER_VIEW = (10, 36)
RIM_INDEPENDENT = 10.0

INDEPENDENT_VIEWS = 40.0
"""What many views have in common (the device's own errors, ragged outlines) does not average out beyond this."""

ENOUGH_CLEAR, AS_CLEAR = 6, 0.9
"""Views of a sensor that are enough, and what part of their free outline others must show to be used beside them."""

INDEPENDENT_CUTS = 20.0
"""Views in which a neighbour touches or hides the fruit repeat each other sooner: it travels along."""

WINDOW_PX2 = 45.0
"""Pixels that share one error: the matching window of a Kinect is 9 × 9, and half its overlap still counts."""

SIGMA_PER_Z2 = 1.4e-3
"""Random error of a Kinect's depth, metres at 1 m, growing with z² (Khoshelham & Elberink 2012)."""

STEP_PER_Z2 = 2.9e-3
"""Step of a Kinect's depth, metres at 1 m (1/8 px of disparity at f = 580 px, b = 75 mm)."""


UNSTEADY_M, LEAST_PATH = 3e-3, 8
"""A path of so many views that strays farther from a cubic in time is that of a belt that stopped or changed its speed:
the noise of a path is about 1 mm from capture to capture."""


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
        share: (V, M) what one sample counts, where they are closer than errors are independent.
        time_s: (V,) since the middle of the track.
        way_m: (V, 3) how far the belt had carried the fruit, as tracking tells it.
        sensor: (V,) index into `sensors`.
        sensors: ids.
        axes: (S, 3, 3) rows are the picture's x, y and depth directions.
        sensor_place_m: (S, 3) where the sensors are.
        sightings: (V,) index of each view in the track.
        offset_sigma_m: (S,) standard deviation of a sensor's common shift against the others, along the belt.
        centre_m: (V, 3) first guess of the fruit's centre in each view.
        height_m: first guess of the fruit's height.
        spoilt: (V,) whether a neighbour or the picture's edge spoils the view.
    """

    samples_m: F64
    used: Bools
    points: int
    sight: F64
    depth_sigma_m: F64
    pixel_m: F64
    share: F64
    time_s: F64
    way_m: F64
    sensor: Ints
    sensors: tuple[str, ...]
    axes: F64
    sensor_place_m: F64
    sightings: Ints
    offset_sigma_m: F64
    centre_m: F64
    height_m: float
    spoilt: Bools

    def views_of(self, track: Track) -> list[FruitView]:
        """Return the views (V,) of the track from which this was gathered."""
        return [track.sightings[number].view for number in self.sightings]

    def seen_by(self, sensor: int) -> Evidence:
        """Return the views of one sensor alone, by its index."""
        mine = self.sensor == sensor
        return replace(
            self,
            samples_m=self.samples_m[mine],
            used=self.used[mine],
            sight=self.sight[mine],
            depth_sigma_m=self.depth_sigma_m[mine],
            pixel_m=self.pixel_m[mine],
            share=self.share[mine],
            time_s=self.time_s[mine],
            way_m=self.way_m[mine],
            sensor=self.sensor[mine],
            sightings=self.sightings[mine],
            centre_m=self.centre_m[mine],
            spoilt=self.spoilt[mine],
        )

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
            self.share[:, kept],
            self.time_s,
            self.way_m,
            self.sensor,
            self.sensors,
            self.axes,
            self.sensor_place_m,
            self.sightings,
            self.offset_sigma_m,
            self.centre_m,
            self.height_m,
            self.spoilt,
        )


def _indices(track: Track, chosen: list[Sighting]) -> Ints:
    index = {id(sighting): number for number, sighting in enumerate(track.sightings)}
    return np.array([index[id(sighting)] for sighting in chosen])


class _Place(NamedTuple):
    """A sensor over its own belt: the pose into the belt frame, and how sure it is along the belt."""

    pose: Pose
    offset_sigma_m: float
    mount: Mount


def gather(track: Track, rig: Rig) -> Evidence | None:
    """Bring the views of a track together over the belt; None where no view has enough points to use."""
    chosen = _chosen(track, rig)
    if not chosen:
        return None
    sensors = tuple(sorted({s.view.sensor for s in chosen}))
    belt = rig.belt_frame()
    places = [_place(rig.mounts[name], belt, _middle(chosen, name)) for name in sensors]
    sensor = np.array([sensors.index(s.view.sensor) for s in chosen])
    points = int(np.clip(POINTS_IN_ALL // len(chosen), *POINTS_PER_VIEW))
    rim = int(np.clip(RIM_IN_ALL // len(chosen), *RIM_PER_VIEW))
    views = [s.view for s in chosen]
    samples, used = take_samples(views, sensor, [p.mount.intrinsics for p in places], points, rim)
    z = samples[..., 2]
    rotation = np.stack([p.pose.rotation for p in places])
    place = np.stack([p.pose.translation_m for p in places])[sensor]
    directions = np.matmul(samples, rotation[sensor].transpose(0, 2, 1))
    focal = np.array([p.mount.intrinsics.fx for p in places])[sensor]
    area_px = np.array([s.view.area_px for s in chosen])
    times = np.array([s.time_s for s in chosen])
    spoilt = np.array([s.view.shared or not s.view.whole for s in chosen])
    numbers = _indices(track, chosen)
    times -= 0.5 * (times.min() + times.max())
    return Evidence(
        samples_m=directions + place[:, None, :],
        used=used,
        points=points,
        sight=directions / np.linalg.norm(directions, axis=2, keepdims=True),
        depth_sigma_m=z**2 * np.hypot(SIGMA_PER_Z2, STEP_PER_Z2 / np.sqrt(12.0)),
        pixel_m=z / focal[:, None],
        share=_share(used, points, area_px, spoilt),
        time_s=times,
        way_m=_way(times, numbers, track, belt),
        sensor=sensor,
        sensors=sensors,
        axes=rotation.transpose(0, 2, 1),
        sensor_place_m=np.stack([p.pose.translation_m for p in places]),
        sightings=numbers,
        offset_sigma_m=np.array([p.offset_sigma_m for p in places]),
        centre_m=np.matmul(rotation[sensor], np.stack([s.view.centre_m for s in chosen])[..., None])[..., 0] + place,
        height_m=float(np.median([s.view.height_m for s in chosen])),
        spoilt=spoilt,
    )


def _way(time_s: F64, numbers: Ints, track: Track, belt: Pose) -> F64:
    """Return the way (V, 3) that a fruit was carried: at its mean velocity, or its path where the belt was unsteady.

    A path is known capture by capture, and so less evenly than a velocity: it is taken only where the belt did what
    no cubic in time can follow.
    """
    way = time_s[:, None] * belt.turn(track.velocity_m_s)
    if len(time_s) < LEAST_PATH:
        return np.asarray(way)
    path_m = belt.apply(np.array([track.path[number].position_m for number in numbers]))
    powers = np.vander(time_s / max(float(np.abs(time_s).max()), 1e-9), 4)
    left = path_m - powers @ np.linalg.lstsq(powers, path_m, rcond=None)[0]
    if float(np.sqrt((left[:, :2] ** 2).sum(axis=1).mean())) < UNSTEADY_M:
        return np.asarray(way)
    return np.asarray((path_m - path_m.mean(axis=0)) * (1.0, 1.0, 0.0))


def _chosen(track: Track, rig: Rig) -> list[Sighting]:
    """Return the sightings that are worth being looked at together, spread over the way."""
    seen = [s for s in track.sightings if s.view.sensor in rig.mounts and len(s.view.points_m) >= LEAST_POINTS]
    return _spread(_clearest(seen), VIEWS_IN_ALL)


def _clearest(sightings: list[Sighting]) -> list[Sighting]:
    """Leave out what a neighbour or the picture's edge spoils, while each sensor keeps enough that is clearer.

    A sensor that saw the fruit whole seldom, because a neighbour stood before it, is still worth its other views.
    """
    kept = []
    for sensor in sorted({s.view.sensor for s in sightings}):
        mine = [s for s in sightings if s.view.sensor == sensor]
        whole = [s for s in mine if s.view.whole]
        mine = whole if len(whole) >= ENOUGH_CLEAR and 3 * len(whole) >= len(mine) else mine
        free = np.array([s.view.outline_free.mean() for s in mine])
        enough = np.sort(free)[-min(len(free), ENOUGH_CLEAR)]
        kept += [s for s, share in zip(mine, free, strict=True) if share >= AS_CLEAR * enough]
    return sorted(kept, key=lambda s: s.time_s)


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


def _share(used: Bools, points: int, area_px: F64, cut: Bools) -> F64:
    """Return what each sample (V, M) counts; `cut` are the views (V,) that a neighbour or the picture's edge spoils."""
    share = np.ones(used.shape)
    share[:, :points] = np.minimum(1.0, area_px / (WINDOW_PX2 * np.maximum(used[:, :points].sum(axis=1), 1)))[:, None]
    share[:, points:] = min(1.0, RIM_INDEPENDENT / max(used.shape[1] - points, 1))
    share *= min(1.0, INDEPENDENT_VIEWS / len(used))
    share[cut] *= min(1.0, INDEPENDENT_CUTS / max(int(np.count_nonzero(cut)), 1))
    return share
