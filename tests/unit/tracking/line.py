"""A belt of fruit reduced to what tracking sees: centres with errors, outlines' sizes, colours. No pictures."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from fruitgui.frame import F64, Intrinsics
from fruitgui.geometry.plane import Plane, Surface
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rig import Mount, Rig
from fruitgui.geometry.rotation import rotation_from_vector
from fruitgui.perception.view import FruitView, Observation

GRAIN = np.random.default_rng(0).normal(scale=6.0, size=(40, 40, 3))

Shown = tuple[F64, float, F64, bool, bool, int]
"""Centre, radius, colour, whole, shared, and the number of the piece (-1: none, or several)."""

KINECT = Intrinsics(640, 480, 580.0, 580.0, 319.5, 239.5)


def looking_at(eye: Sequence[float], target: Sequence[float]) -> Pose:
    """Return the pose sensor → world (z up) of a sensor at `eye` that looks at `target`, its x axis along the belt."""
    z = np.array(target, dtype=float) - np.array(eye, dtype=float)
    z /= np.linalg.norm(z)
    x = np.cross(z, np.array([0.0, 0.0, 1.0]))
    x /= np.linalg.norm(x)
    return Pose(np.column_stack([x, np.cross(z, x), z]), np.array(eye, dtype=float))


@dataclass(frozen=True)
class Table:
    """A rig, and the pose world → reference frame; the belt is the world's z = 0 and runs along x."""

    rig: Rig
    world: Pose


def rig_of(eyes: Sequence[tuple[Sequence[float], Sequence[float]]], covariance: F64 | None = None) -> Table:
    """Return Kinects over the world's plane z = 0; the first is the reference."""
    worlds = [looking_at(eye, target) for eye, target in eyes]
    to_reference = worlds[0].inverse()
    mounts = {}
    for i, world in enumerate(worlds):
        pose = to_reference @ world
        exact = covariance is None or i == 0
        normal = world.rotation.T @ np.array([0.0, 0.0, 1.0])
        plane = Plane(normal, float(world.translation_m[2]))
        posed = Pose(pose.rotation, pose.translation_m, np.zeros((6, 6)) if exact else covariance)
        mounts[f"s{i + 1}"] = Mount(f"s{i + 1}", posed, Surface(plane), KINECT)
    return Table(Rig("s1", mounts), to_reference)


def opposed(covariance: F64 | None = None) -> Table:
    return rig_of([((0, -0.5, 0.95), (0, 0.05, 0)), ((0.1, 0.5, 1.0), (0, -0.05, 0))], covariance)


def chain() -> Table:
    """Three sensors along the belt, each overlapping the next."""
    return rig_of([((x, -0.35 * (-1) ** i, 1.0), (x, 0, 0)) for i, x in enumerate((-0.5, 0.0, 0.5))])


@dataclass
class Piece:
    """A fruit of the line; `start_m` is its centre in the world at time 0."""

    number: int
    start_m: F64
    radius_m: float
    color: F64
    slip: Callable[[float], F64] = lambda _t: np.zeros(3)


@dataclass
class Line:
    """A line of fruit under a rig.

    Attributes:
        travelled: the belt's displacement along x, metres, at a time.
        noise_m, lasting_m: standard deviations of a centre: of each capture, and what stays for a sensor and fruit.
        dropout: share of views missing. clutter: false views per capture.
        silent: by sensor, the (from, to) it gives nothing in.
        pose_error: by sensor, (ω, v) by which its true pose differs from the rig's.
        merging: share of captures in which a sensor does not separate two fruit that touch.
    """

    table: Table
    pieces: list[Piece]
    travelled: Callable[[float], float]
    rate_hz: float = 5.0
    duration_s: float = 20.0
    noise_m: float = 0.003
    lasting_m: float = 0.003
    dropout: float = 0.0
    clutter: float = 0.0
    merging: dict[str, float] = field(default_factory=dict)
    silent: dict[str, tuple[float, float]] = field(default_factory=dict)
    pose_error: dict[str, F64] = field(default_factory=dict)
    clock: dict[str, float] = field(default_factory=dict)
    seed: int = 0

    @property
    def rig(self) -> Rig:
        return self.table.rig

    def position_m(self, piece: Piece, time_s: float) -> F64:
        """Return the true centre in the reference frame."""
        moved = piece.start_m + np.array([self.travelled(time_s), 0.0, 0.0]) + piece.slip(time_s)
        return self.table.world.apply(moved)

    def observations(self) -> list[Observation]:
        return list(self._captures())

    def _captures(self) -> Iterator[Observation]:
        rng = np.random.default_rng(self.seed)
        lasting: dict[tuple[str, int], F64] = {}
        names = list(self.rig.mounts)
        step = 1.0 / self.rate_hz / len(names)
        for k in range(int(self.duration_s / step)):
            sensor = names[k % len(names)]
            time_s = k * step + rng.uniform(-0.1, 0.1) * step
            first, last = self.silent.get(sensor, (np.inf, np.inf))
            if not first <= time_s < last:
                yield self._capture(sensor, k // len(names), time_s, rng, lasting)

    def _capture(
        self, sensor: str, sequence: int, time_s: float, rng: np.random.Generator, lasting: dict[tuple[str, int], F64]
    ) -> Observation:
        mount = self.rig.mounts[sensor]
        back = _true_pose(mount.pose, self.pose_error.get(sensor)).inverse()
        shown: list[Shown] = []
        for piece in self.pieces:
            true = back.apply(self.position_m(piece, time_s))
            inside = _inside_m(true)
            if inside < -0.6 * piece.radius_m or rng.uniform() < self.dropout:
                continue
            error = lasting.setdefault((sensor, piece.number), rng.normal(size=3) * self.lasting_m)
            whole = inside >= piece.radius_m
            pushed = 0.0 if whole else 0.4 * (piece.radius_m - inside)
            centre = true * (1.0 - pushed / np.linalg.norm(true[:2])) if not whole else true
            centre = np.array([centre[0], centre[1], true[2]]) + error + rng.normal(size=3) * self.noise_m
            shown.append((centre, piece.radius_m, piece.color, whole, False, piece.number))
        shown = _merged(shown, self.merging.get(sensor, 0.0), rng)
        for _ in range(rng.poisson(self.clutter)):
            ray = np.array([rng.uniform(-0.5, 0.5), rng.uniform(-0.4, 0.4), 1.0])
            z = -mount.surface.plane.offset_m / float(mount.surface.plane.normal @ ray) * 0.97
            shown.append((ray * z, 0.02, rng.uniform(0, 255, 3), True, False, -1))
        views = tuple(self._view(sensor, sequence, time_s, *one, rng=rng) for one in shown)
        return Observation(sensor, sequence, time_s + self.clock.get(sensor, 0.0), views)

    def _view(
        self,
        sensor: str,
        sequence: int,
        time_s: float,
        centre: F64,
        radius_m: float,
        color: F64,
        whole: bool,
        shared: bool,
        number: int,
        rng: np.random.Generator,
    ) -> FruitView:
        plane = self.rig.mounts[sensor].surface.plane
        radius_px = 580.0 * radius_m / centre[2]
        u, v = KINECT.project(centre[None])[0]
        normals = rng.normal(size=(60, 3))
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        normals = normals[normals @ centre < 0.0]
        patch = np.clip(GRAIN + color + rng.normal(scale=2.0, size=3), 0, 255).astype(np.uint8)
        covariance = (self.noise_m**2 + self.lasting_m**2) * np.eye(3)
        mean = centre - 0.6 * radius_m * centre / np.linalg.norm(centre)
        return FruitView(
            sensor=sensor,
            sequence=sequence,
            time_s=time_s,
            box_px=(int(u - radius_px), int(v - radius_px), int(2 * radius_px), int(2 * radius_px)),
            outline_px=np.zeros((0, 2), np.float32),
            points_m=(centre + radius_m * normals).astype(np.float32),
            edge_px=np.full(len(normals), 9.0, np.float32),
            area_px=int(np.pi * radius_px**2),
            centre_m=centre,
            centre_covariance_m2=covariance,
            mean_m=mean,
            mean_covariance_m2=covariance,
            height_m=float(plane.height_m(centre)) + radius_m,
            features=np.full(1, number, np.float32),
            patch=patch,
            whole=whole,
            shared=shared,
            outline_free=np.zeros(0, bool),
        )


def _true_pose(pose: Pose, error: F64 | None) -> Pose:
    if error is None:
        return pose
    turn = rotation_from_vector(error[:3])
    return Pose(turn @ pose.rotation, turn @ pose.translation_m + error[3:])


def _inside_m(point: F64) -> float:
    """Return how far a point of the optical frame lies inside the picture's borders, metres at its depth."""
    u, v = KINECT.project(point[None])[0]
    return float(min(u, v, KINECT.width - u, KINECT.height - v) * point[2] / 580.0)


def _merged(shown: list[Shown], share: float, rng: np.random.Generator) -> list[Shown]:
    left, result = list(shown), []
    while left:
        one = left.pop(0)
        touching = next((k for k, o in enumerate(left) if np.linalg.norm(o[0] - one[0]) < 1.15 * (o[1] + one[1])), None)
        if touching is not None and rng.uniform() < share:
            other = left.pop(touching)
            one = (0.5 * (one[0] + other[0]), 1.4 * one[1], 0.5 * (one[2] + other[2]), one[3] and other[3], False, -1)
        elif touching is not None:
            other = left[touching]
            left[touching] = (*other[:4], True, other[5])
            one = (*one[:4], True, one[5])
        result.append(one)
    return result


COLORS = np.array([[225, 200, 60], [180, 40, 40], [120, 170, 60], [60, 70, 45], [40, 40, 40], [230, 130, 40]], float)


def pieces(
    count: int,
    seed: int = 0,
    lanes: int = 3,
    spacing_m: float = 0.12,
    first_m: float = -0.9,
    touching: float = 0.0,
    even: bool = False,
) -> list[Piece]:
    """Return fruit in lanes across the belt, entering one after another from negative x."""
    rng = np.random.default_rng(seed)
    result: list[Piece] = []
    x = first_m
    for i in range(count):
        radius = rng.uniform(0.028, 0.045)
        color = COLORS[rng.integers(len(COLORS))]
        lane = (i % lanes - (lanes - 1) / 2.0) * 0.13
        if result and rng.uniform() < touching:
            near = result[-1]
            angle = rng.uniform(-np.pi, np.pi)
            offset = (near.radius_m + radius) * 1.02 * np.array([np.cos(angle), np.sin(angle), 0.0])
            start = near.start_m + offset
            start[2] = radius
        else:
            start = np.array([x, lane + (0.0 if even else rng.uniform(-0.02, 0.02)), radius])
        if any(np.linalg.norm(start - o.start_m) < 1.0 * (radius + o.radius_m) for o in result[-12:]):
            start = np.array([x, lane, radius])
        result.append(Piece(i, start, radius, color))
        if i % lanes == lanes - 1:
            x -= spacing_m if even else spacing_m * rng.uniform(0.9, 1.6)
    return result
