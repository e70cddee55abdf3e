"""All sensors together: shifts of pairs, solved for one place each (pose graph over shift and heading).

Every sensor knows its own belt, so what the loops must close is only (x, y, θ).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from fruitgui.calibration.flat import Shift, wrapped
from fruitgui.frame import F64

LOOP_BOUND = 25.0
"""Squared, normalised error per edge beyond which a loop does not close (3 degrees of freedom, 5e-6 of true ones
after the floor below)."""

EDGE_FLOOR = np.diag([0.00015, 0.00015, 0.00015]) ** 2
"""Errors that pairs do not know of (m, m, rad): what a sensor bends in the picture."""


@dataclass(frozen=True, slots=True, eq=False)
class Edge:
    """One registered pair: `shift` maps the source's belt frame into the target's.

    Attributes:
        covariance: (3, 3) of (x, y, θ) about the target belt frame's origin.
        weight: evidence behind it, to tell which of two contradicting edges to trust.
        textured: whether the belt's texture bears it out.
    """

    source: str
    target: str
    shift: Shift
    covariance: F64
    weight: float
    textured: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Solution:
    """Where every sensor of one linked group stands.

    Attributes:
        places: belt frame of each sensor → belt frame of the reference.
        covariances: (3, 3) of (x, y, θ) about the reference belt frame's origin.
        paths: the sensors from each one to the reference, along the most certain edges.
        used, dropped: edges that decided, and edges that contradicted.
        contradiction: largest squared, normalised error of a used edge.
    """

    places: dict[str, Shift]
    covariances: dict[str, F64]
    paths: dict[str, tuple[str, ...]]
    used: tuple[Edge, ...]
    dropped: tuple[Edge, ...]
    contradiction: float


def groups(sensors: Sequence[str], edges: Sequence[Edge]) -> list[tuple[str, ...]]:
    """Return the linked groups of sensors, in the order of `sensors`."""
    left = list(sensors)
    found = []
    while left:
        group = {left[0]}
        while True:
            near = {s for e in edges for s in (e.source, e.target) if e.source in group or e.target in group}
            if near <= group:
                break
            group |= near
        found.append(tuple(sensor for sensor in sensors if sensor in group))
        left = [sensor for sensor in left if sensor not in group]
    return found


def solve(reference: str, edges: Sequence[Edge]) -> Solution:
    """Place every sensor that edges link to the reference; drop edges that contradict well-supported loops.

    An edge is dropped only when its removal leaves the graph linked and it is the one that contradicts;
    `contradiction` stays above LOOP_BOUND where no such edge could be told.
    """
    used, dropped = list(edges), []
    while True:
        solution = _solved(reference, used)
        errors = [_error(edge, solution[0]) for edge in used]
        if not errors or max(errors) <= LOOP_BOUND:
            break
        wrong = _wrong_edge(reference, used)
        if wrong is None:
            break
        dropped.append(used.pop(wrong))
    places, covariances = solution
    paths = {sensor: _path(sensor, reference, used) for sensor in places}
    return Solution(places, covariances, paths, tuple(used), tuple(dropped), max(errors, default=0.0))


def _wrong_edge(reference: str, edges: list[Edge]) -> int | None:
    """Return the edge without which everything closes, if it alone does that or has by far the least behind it."""
    sensors = sorted({s for edge in edges for s in (edge.source, edge.target)})
    closing = []
    for k in range(len(edges)):
        rest = edges[:k] + edges[k + 1 :]
        if len(groups(sensors, rest)) > 1:
            continue
        places, _ = _solved(reference, rest)
        if max((_error(edge, places) for edge in rest), default=0.0) <= LOOP_BOUND:
            closing.append(k)
    if not closing:
        return None
    closing.sort(key=lambda k: edges[k].weight)
    if len(closing) > 1 and edges[closing[0]].weight > 0.5 * edges[closing[1]].weight:
        return None
    return closing[0]


def _information(edge: Edge) -> F64:
    return np.asarray(np.linalg.inv(edge.covariance + EDGE_FLOOR))


def _misclosure(edge: Edge, places: dict[str, Shift]) -> F64:
    """Return (x, y, θ) of target⁻¹ ∘ source ∘ measured⁻¹, in the target's belt frame."""
    predicted = places[edge.target].inverse().after(places[edge.source])
    gap = predicted.after(edge.shift.inverse())
    return np.array([gap.x_m, gap.y_m, gap.heading_rad])


def _error(edge: Edge, places: dict[str, Shift]) -> float:
    gap = _misclosure(edge, places)
    return float(gap @ _information(edge) @ gap)


def _path(sensor: str, reference: str, edges: Sequence[Edge]) -> tuple[str, ...]:
    """Return the sensors from `sensor` to `reference` along the path of least variance (Dijkstra)."""
    best: dict[str, tuple[float, tuple[str, ...]]] = {sensor: (0.0, (sensor,))}
    waiting = {sensor}
    while waiting:
        here = min(waiting, key=lambda name: best[name][0])
        waiting.discard(here)
        for edge in edges:
            if here not in (edge.source, edge.target):
                continue
            there = edge.target if edge.source == here else edge.source
            cost = best[here][0] + float(edge.covariance[0, 0] + edge.covariance[1, 1] + 0.1 * edge.covariance[2, 2])
            if there not in best or cost < best[there][0]:
                best[there] = (cost, (*best[here][1], there))
                waiting.add(there)
    return best[reference][1]


def _started(reference: str, edges: Sequence[Edge]) -> dict[str, Shift]:
    """Return first places by going along the most certain paths."""
    by_pair = {(edge.source, edge.target): edge.shift for edge in edges}
    by_pair |= {(edge.target, edge.source): edge.shift.inverse() for edge in edges}
    sensors = sorted({s for edge in edges for s in (edge.source, edge.target)} | {reference})
    places = {}
    for sensor in sensors:
        path = _path(sensor, reference, edges)
        place = Shift(0.0, 0.0, 0.0)
        for here, there in pairwise(path):
            place = by_pair[here, there].after(place)
        places[sensor] = place
    return places


def _solved(reference: str, edges: Sequence[Edge]) -> tuple[dict[str, Shift], dict[str, F64]]:
    """Minimise Σ eᵀ Ω e over the places by Gauss–Newton; covariances from the information of all edges."""
    places = _started(reference, edges)
    free = [sensor for sensor in places if sensor != reference]
    column = {sensor: 3 * i for i, sensor in enumerate(free)}
    H = np.zeros((3 * len(free), 3 * len(free)))
    for _ in range(8):
        H = np.zeros((3 * len(free), 3 * len(free)))
        g = np.zeros(3 * len(free))
        for edge in edges:
            J, e, omega = _linearised(edge, places, column, len(free))
            H += J.T @ omega @ J
            g += J.T @ omega @ e
        if not free:
            break
        step = -np.asarray(np.linalg.solve(H, g), dtype=np.float64)
        places |= {s: places[s].about(np.zeros(2), step[column[s] : column[s] + 3]) for s in free}
        if np.abs(step).max() < 1e-9:
            break
    spread: F64 = np.asarray(np.linalg.inv(H) if free else H)
    covariances: dict[str, F64] = {s: spread[column[s] : column[s] + 3, column[s] : column[s] + 3] for s in free}
    return places, {reference: np.zeros((3, 3)), **covariances}


def _linearised(edge: Edge, places: dict[str, Shift], column: dict[str, int], free: int) -> tuple[F64, F64, F64]:
    """Return the Jacobian (3, 3·free) of an edge's misclosure by small motions of the places, the misclosure, and Ω.

    A motion (d, dθ) of the source's place about the reference's origin shows in the target's frame as
    the turned motion; the same motion of the target's place shows with the opposite sign.
    """
    e = _misclosure(edge, places)
    back = places[edge.target].inverse()
    A = np.eye(3)
    A[:2, :2] = back.rotation
    # A turn dθ about the reference's origin is a turn about where that origin lies in the target's frame.
    A[:2, 2] = [back.y_m, -back.x_m]
    J = np.zeros((3, 3 * free))
    if edge.source in column:
        J[:, column[edge.source] : column[edge.source] + 3] = A
    if edge.target in column:
        J[:, column[edge.target] : column[edge.target] + 3] -= A
    e[2] = wrapped(float(e[2]))
    return J, e, _information(edge)
