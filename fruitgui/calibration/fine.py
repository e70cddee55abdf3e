"""The exact shift and heading between two reliefs: robust, symmetric point-to-plane ICP on the tops that both see.

Opposed sensors see opposite halves of a fruit; only what faces both is common.
Pairs are kept where both normals agree and where the nearest point is not on the
rim of what the other sensor saw. The symmetric objective (Rusinkiewicz 2019,
"A symmetric objective function for ICP") is exact on spheres and cylinders.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.calibration.flat import Shift
from fruitgui.calibration.relief import Relief
from fruitgui.frame import F64, Bools, Ints

SCHEDULE_M = (0.03, 0.03, 0.02, 0.02, 0.015, 0.012, 0.01, 0.008, 0.008, 0.008, 0.008, 0.008)
SAME_NORMAL = float(np.cos(np.radians(30.0)))
ROBUST_M = 0.0015
THING_STD_PER_M = 6e-4
"""How far one thing's place errs across the belt, for each square metre of distance (product of both sensors')."""


@dataclass(frozen=True, slots=True, eq=False)
class Matched:
    """Pairs of points that are the same place under a shift.

    Attributes:
        source, target: (M,) indices into the reliefs' points.
        residual_m: (M,) distance along the mean normal.
        jacobian: (M, 3) of the residual by (dx, dy, dθ about `centre_m`).
        weight: (M,) robust weights.
        centre_m: (2,) where the turn is taken about, target's frame.
    """

    source: Ints
    target: Ints
    residual_m: F64
    jacobian: F64
    weight: F64
    centre_m: F64


@dataclass(frozen=True, slots=True, eq=False)
class Fit:
    """A refined shift with what supports it.

    Attributes:
        shift: source belt frame → target belt frame.
        matched: the pairs at the solution.
        things: (K,) names of the source's things that are matched at all.
        bias_m, rms_m, pairs: (K,) weighted mean residual, spread and count per such thing.
    """

    shift: Shift
    matched: Matched
    things: Ints
    bias_m: F64
    rms_m: F64
    pairs: Ints


class Target:
    """A relief made ready to be searched for nearest points."""

    def __init__(self, relief: Relief) -> None:
        from scipy.spatial import cKDTree

        self.relief = relief
        self.tree = cKDTree(relief.points_m)
        self.rim = _rim(relief)


def _rim(relief: Relief) -> Bools:
    """Return which points lie on the rim of what was seen of their thing: their neighbours lie all to one side."""
    from scipy.spatial import cKDTree

    points = relief.points_m
    if len(points) < 12:
        return np.ones(len(points), dtype=bool)
    tree = cKDTree(points)
    distances, near = tree.query(points, k=11)
    centre = points[near[:, 1:]].mean(axis=1)
    return np.asarray(np.linalg.norm(centre - points, axis=1) > 0.45 * distances[:, -1])


def refine(source: Relief, target: Target, start: Shift, schedule_m: tuple[float, ...] = SCHEDULE_M) -> Fit | None:
    """Improve a shift from within some 20 mm; None where too few points meet to say anything."""
    shift = start
    matched = None
    for reach_m in schedule_m:
        matched = match(source, target, shift, reach_m)
        if len(matched.source) < 30:
            return None
        step = _step(matched)
        shift = shift.about(matched.centre_m, step)
        if reach_m == schedule_m[-1] and np.abs(step).max() < 2e-6:
            break
    final = match(source, target, shift, schedule_m[-1])
    return _fit(source, shift, final) if len(final.source) >= 30 else None


def settle(source: Relief, target: Target, start: Shift, rounds: int = 8) -> Fit | None:
    """Improve x and y of a shift whose heading is known; None where too few points meet to say anything."""
    shift = start
    for _ in range(rounds):
        matched = match(source, target, shift, SCHEDULE_M[-1])
        if len(matched.source) < 30:
            return None
        step = np.zeros(3)
        step[:2] = _step(matched, free=2)
        shift = shift.about(matched.centre_m, step)
        if np.abs(step).max() < 2e-6:
            break
    final = match(source, target, shift, SCHEDULE_M[-1])
    return _fit(source, shift, final) if len(final.source) >= 30 else None


def match(source: Relief, target: Target, shift: Shift, reach_m: float) -> Matched:
    """Pair the source's points with the target's nearest ones under a shift."""
    mapped, normals = shift.apply(source.points_m), shift.turn(source.normals)
    distance, near = target.tree.query(mapped, distance_upper_bound=reach_m)
    found = np.nonzero(np.isfinite(distance))[0]
    near = near[found]
    both = normals[found] + target.relief.normals[near]
    agree = (normals[found] * target.relief.normals[near]).sum(axis=1) > SAME_NORMAL
    keep = agree & ~target.rim[near]
    found, near, both = found[keep], near[keep], both[keep]
    both /= np.maximum(np.linalg.norm(both, axis=1, keepdims=True), 1e-12)
    p, q = mapped[found], target.relief.points_m[near]
    residual = ((p - q) * both).sum(axis=1)
    centre = p[:, :2].mean(axis=0) if len(p) else np.zeros(2)
    arm = p[:, :2] - centre
    lever = both[:, 1] * arm[:, 0] - both[:, 0] * arm[:, 1]
    jacobian = np.stack([both[:, 0], both[:, 1], lever], axis=1)
    scale = max(ROBUST_M, 1.4826 * float(np.median(np.abs(residual)))) if len(residual) else ROBUST_M
    weight = 1.0 / (1.0 + (residual / (2.0 * scale)) ** 2) ** 2
    return Matched(found, near, residual, jacobian, weight, centre)


def _step(matched: Matched, free: int = 3) -> F64:
    J, w = matched.jacobian[:, :free], matched.weight
    H = (J * w[:, None]).T @ J
    H += np.diag([1e-6, 1e-6, 1e-8][:free]) * max(w.sum(), 1.0)
    return np.asarray(-np.linalg.solve(H, (J * w[:, None]).T @ matched.residual_m))


def _fit(source: Relief, shift: Shift, matched: Matched) -> Fit:
    names, thing = np.unique(source.thing[matched.source], return_inverse=True)
    weight = np.bincount(thing, matched.weight)
    bias = np.bincount(thing, matched.weight * matched.residual_m) / weight
    square = np.bincount(thing, matched.weight * matched.residual_m**2) / weight
    return Fit(shift, matched, names.astype(np.intp), bias, np.sqrt(square), np.bincount(thing).astype(np.intp))


def covariance(source: Relief, target: Relief, fit: Fit, *, turning: bool = True) -> F64:
    """Return the (3, 3) covariance of (x, y, θ about the matched points' centre), things as independent witnesses.

    Of x and y alone, (2, 2), where the heading is known and not `turning`.

    Errors of neighbouring pixels are correlated (matching window, steps, the shape of the normals'
    window), so points of one thing count as one witness: H⁻¹ (Σ g gᵀ) H⁻¹ over things, with g the pull
    of a thing, enlarged for few things, and never less than what 1 mm of common error per thing gives. What stands
    still in a sensor's noise moves a thing as a whole, farther with distance squared: that comes on top.
    """
    matched = fit.matched
    free = 3 if turning else 2
    J, w, r = matched.jacobian[:, :free], matched.weight, matched.residual_m
    H = (J * w[:, None]).T @ J
    _, thing = np.unique(source.thing[matched.source], return_inverse=True)
    count = int(thing.max()) + 1
    pulls = np.stack([np.bincount(thing, w * r * J[:, k], count) for k in range(free)], axis=1)
    shapes = np.einsum("ni,nj,n->nij", J, J, w)
    expected = np.zeros((free, free))
    for k in range(count):
        mine = thing == k
        lean = (J[mine] * w[mine, None]).sum(axis=0)
        expected += np.outer(lean, lean) + shapes[mine].sum(axis=0) * w[mine].sum() * 0.1
    H_inverse = np.linalg.pinv(H)
    seen = pulls.T @ pulls * count / max(count - free, 1)
    prior = expected * 0.0005**2
    blend = (count * seen + 6 * prior) / (count + 6)
    spread = np.asarray(H_inverse @ blend @ H_inverse)
    place = (THING_STD_PER_M * source.distance_m * target.distance_m) ** 2 / count
    spread[:2, :2] += np.eye(2) * place
    if turning:
        spread[2, 2] += place / float(source.points_m[matched.source, :2].var(axis=0).sum())
    return spread


def held_out_m(source: Relief, fit: Fit) -> float:
    """Return the rms over things of the mean residual of each when only the others decide the shift (linearised)."""
    matched = fit.matched
    J, w, r = matched.jacobian, matched.weight, matched.residual_m
    names, thing = np.unique(source.thing[matched.source], return_inverse=True)
    if len(names) < 3:
        return float("nan")
    off = []
    for k in range(len(names)):
        mine, rest = thing == k, thing != k
        H = (J[rest] * w[rest, None]).T @ J[rest] + 1e-9 * np.eye(3)
        step = -np.linalg.solve(H, (J[rest] * w[rest, None]).T @ r[rest])
        off.append(np.average(r[mine] + J[mine] @ step, weights=w[mine]))
    return float(np.sqrt(np.mean(np.square(off))))
