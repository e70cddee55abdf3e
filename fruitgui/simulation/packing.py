"""Where things lie on the belt: apart, or really touching."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.random import Generator

from fruitgui.frame import F64
from fruitgui.simulation.body import Body, push_together
from fruitgui.simulation.motion import AT_REST


@dataclass(frozen=True, slots=True, eq=False)
class Cluster:
    """Bodies that lie together.

    Attributes:
        bodies: placed about the cluster's own origin.
        reach_m: radius of the circle about the origin that holds them and all they do.
    """

    bodies: tuple[Body, ...]
    reach_m: float


def clusters(bodies: Sequence[Body], touching: float, rng: Generator, room_m: float = 0.23) -> list[Cluster]:
    """Return the bodies alone or in touching groups of two to four.

    Args:
        bodies: in order; their places are set.
        touching: share of the bodies that touch another.
        rng: the source of chance.
        room_m: a group that reaches farther than this from its middle is made smaller.
    """
    wanted = round(touching * len(bodies))
    waiting, made = list(bodies), []
    while waiting:
        size = min(int(rng.choice([2, 2, 2, 3, 3, 4])), wanted, len(waiting)) if wanted >= 2 else 1
        group = _group(waiting[:size], rng)
        while group.reach_m > room_m and len(group.bodies) > 1:
            group = _group(waiting[: len(group.bodies) - 1], rng)
        waiting = waiting[len(group.bodies) :]
        wanted -= len(group.bodies) if len(group.bodies) > 1 else 0
        made.append(group)
    order = rng.permutation(len(made))
    return [made[index] for index in order]


def _group(bodies: Sequence[Body], rng: Generator) -> Cluster:
    together = len(bodies) > 1
    first = replace(bodies[0], wobble=AT_REST) if together else bodies[0]
    placed = [replace(first, start_m=(0.0, 0.0), touching=together)]
    for body in bodies[1:]:
        partner = placed[int(rng.integers(len(placed)))]
        still = replace(body, wobble=AT_REST)
        placed.append(replace(push_together(placed, partner, still, rng.uniform(0, 2 * np.pi)), touching=True))
    middle = np.mean([body.start_m for body in placed], axis=0)
    moved = tuple(body.at((body.start_m[0] - middle[0], body.start_m[1] - middle[1])) for body in placed)
    reach_m = max(float(np.hypot(*body.start_m)) + body.reach_m() + own_motion_m(body) for body in moved)
    return Cluster(moved, reach_m)


def own_motion_m(body: Body) -> float:
    """Return how far a body's surface may leave its place by rocking, rolling and sliding."""
    wobble = body.wobble
    rest_m = body.rest_m()
    turn_m = (abs(wobble.rock_rad) + abs(wobble.roll_rad)) * rest_m
    grows_m = 0.0
    if turn_m > 0:
        grows_m = float(np.linalg.norm(body.mesh.vertices_m, axis=1).max()) - body.reach_m()
    return turn_m + grows_m + float(np.hypot(*wobble.slide_m))


def scatter(
    groups: Sequence[Cluster], low_m: F64, high_m: F64, rng: Generator, gap_m: float = 0.006, tries: int = 400
) -> list[Body]:
    """Return the bodies of as many groups as fit into a rectangle (low, high) of the belt, none overlapping."""
    taken: list[tuple[float, float, float]] = []
    placed: list[Body] = []
    for group in sorted(groups, key=lambda group: -group.reach_m):
        for _ in range(tries):
            x, y = rng.uniform(low_m, high_m)
            inside = low_m[1] + group.reach_m <= y <= high_m[1] - group.reach_m
            if inside and _free(x, y, group.reach_m + gap_m, taken):
                taken.append((x, y, group.reach_m))
                placed.extend(_shifted(group, x, y))
                break
    return placed


def stream(
    groups: Sequence[Cluster], half_width_m: float, per_metre: float, rng: Generator, gap_m: float = 0.006
) -> list[Body]:
    """Return all bodies laid along the belt, the first at x = 0, later ones behind it (x < 0), about `per_metre`."""
    taken: list[tuple[float, float, float]] = []
    placed: list[Body] = []
    front = 0.0
    for group in groups:
        front -= len(group.bodies) / per_metre
        free_m = max(half_width_m - group.reach_m, 0.0)
        back = 0.0
        while True:
            x, y = front + rng.uniform(-0.08, 0.08) - back, rng.uniform(-free_m, free_m)
            if _free(x, y, group.reach_m + gap_m, taken[-40:]):
                break
            back += 0.004
        taken.append((x, y, group.reach_m))
        placed.extend(_shifted(group, x, y))
    return placed


def _free(x: float, y: float, reach_m: float, taken: Sequence[tuple[float, float, float]]) -> bool:
    return all(np.hypot(x - other_x, y - other_y) >= reach_m + other for other_x, other_y, other in taken)


def _shifted(group: Cluster, x: float, y: float) -> list[Body]:
    return [body.at((body.start_m[0] + x, body.start_m[1] + y)) for body in group.bodies]
