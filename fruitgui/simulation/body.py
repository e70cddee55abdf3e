"""Bodies on the belt: how they come to rest, touch, and where they are at a time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.random import Generator

from fruitgui.frame import F64
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rotation import rotation_between, rotation_from_vector
from fruitgui.simulation.mesh import Mesh
from fruitgui.simulation.motion import AT_REST, Wobble

DOWN = np.array([0.0, 0.0, -1.0])


@dataclass(frozen=True, slots=True, eq=False)
class Body:
    """One thing on the belt.

    The world's frame lies on the belt: x along its travel, y across, z up,
    z = 0 on it, the origin amid the sensors.

    Attributes:
        fruit_id: its number, from 1.
        kind: what it is.
        mesh: in resting orientation, centred on its centre of volume.
        start_m: (x, y) of the centre at time 0.
        wobble: its own motion.
        foreign: not a fruit.
        touching: it touches another body.
        jump_m: (x, y) by which someone shoves it at `jump_s`.
        jump_s: when that happens.
    """

    fruit_id: int
    kind: str
    mesh: Mesh
    start_m: tuple[float, float]
    wobble: Wobble = AT_REST
    foreign: bool = False
    touching: bool = False
    jump_m: tuple[float, float] = (0.0, 0.0)
    jump_s: float = float("inf")

    def pose(self, time_s: float, travel_m: float) -> Pose:
        """Return the pose from the mesh's frame into the world at a time at which the belt has moved `travel_m`.

        The lowest vertex lies on the belt.
        """
        rest_m = lift_m = self.rest_m()
        rotation = np.eye(3)
        if self.wobble.turn_rad(time_s):
            rotation = self.wobble.rotation(time_s)
            lift_m = -float((self.mesh.vertices_m @ rotation[2]).min())
        x, y = np.array(self.start_m) + self.wobble.moved_m(time_s, rest_m)
        shoved = self.jump_m if time_s >= self.jump_s else (0.0, 0.0)
        return Pose(rotation, np.array([x + shoved[0] + travel_m, y + shoved[1], lift_m]))

    def rest_m(self) -> float:
        """Return the height of the centre above the belt at rest."""
        return -float(self.mesh.vertices_m[:, 2].min())

    def at(self, start_m: tuple[float, float]) -> Body:
        """Return the same body placed elsewhere."""
        return replace(self, start_m=start_m)

    def reach_m(self) -> float:
        """Return the largest horizontal distance of its surface from its centre, at rest."""
        return float(np.linalg.norm(self.mesh.vertices_m[:, :2], axis=1).max())


def at_rest(mesh: Mesh, rng: Generator, lying: float | None = None) -> Mesh:
    """Return the mesh as it comes to rest on a plane, at a random heading.

    A body rests where the height of its centre over the plane has a local
    minimum over orientations; that minimum is sought from a random start.

    Args:
        mesh: centred, its stem (or thin) axis along z.
        rng: the source of chance.
        lying: angle between the stem axis and straight up to start from, radians; None for any.
    """
    direction = _unit(rng.normal(size=3)) if lying is None else _tilted(lying, rng)
    vertices = mesh.vertices_m[::2] if len(mesh.vertices_m) > 4000 else mesh.vertices_m
    vertices = np.ascontiguousarray(vertices.T)
    height, step = float((direction @ vertices).max()), 0.3
    while step > 0.002:
        trials = direction + step * rng.normal(size=(24, 3))
        trials /= np.linalg.norm(trials, axis=1, keepdims=True)
        heights = (trials @ vertices).max(axis=1)
        best = int(heights.argmin())
        if heights[best] < height:
            direction, height = trials[best], float(heights[best])
        else:
            step *= 0.6
    heading = rotation_from_vector(np.array([0.0, 0.0, rng.uniform(0, 2 * np.pi)]))
    return mesh.turned(heading @ rotation_between(direction, DOWN))


def _tilted(angle_rad: float, rng: Generator) -> F64:
    around = rng.uniform(0, 2 * np.pi)
    return np.array([np.sin(angle_rad) * np.cos(around), np.sin(angle_rad) * np.sin(around), -np.cos(angle_rad)])


def _unit(vector: F64) -> F64:
    return np.asarray(vector / np.linalg.norm(vector))


def push_together(
    standing: Sequence[Body], partner: Body, moving: Body, heading_rad: float, gap_m: float = 0.0
) -> Body:
    """Return `moving` placed so that it touches one of `standing`, coming from `heading_rad` towards `partner`.

    It is moved along a straight line until the first vertex of either mesh
    meets a triangle of the other; `gap_m` is left between.
    """
    toward = -np.array([np.cos(heading_rad), np.sin(heading_rad), 0.0])
    away_m = 1.2 * sum(2 * _radius(body.mesh) for body in (*standing, moving))
    start = np.array([*partner.start_m, 0.0]) - toward * away_m
    start[2] = moving.rest_m()
    travel_m = min(_free_way_m(body, moving.mesh, start, toward) for body in standing)
    if not np.isfinite(travel_m):
        travel_m = away_m
    place = start + toward * (travel_m - gap_m - 1e-6)
    return moving.at((float(place[0]), float(place[1])))


def _free_way_m(standing: Body, mesh: Mesh, start: F64, toward: F64) -> float:
    """Return how far a mesh at `start` can go `toward` (unit) before it meets a body; inf if it passes."""
    anchor = np.array([*standing.start_m, standing.rest_m()])
    ahead = _first_hit(mesh.vertices_m + start - anchor, toward, standing.mesh)
    behind = _first_hit(standing.mesh.vertices_m + anchor - start, -toward, mesh)
    return min(ahead, behind)


def _radius(mesh: Mesh) -> float:
    return float(np.linalg.norm(mesh.vertices_m, axis=1).max())


def _first_hit(origins: F64, direction: F64, mesh: Mesh) -> float:
    from fruitgui.simulation.rays import Caster

    rays = np.hstack([origins, np.tile(direction, (len(origins), 1))]).astype(np.float32)
    return float(Caster(mesh).distances(rays).min())
