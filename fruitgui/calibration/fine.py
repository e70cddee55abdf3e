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
from fruitgui.calibration.still import INVERSE_NOISE
from fruitgui.frame import F64, Bools, Ints

SCHEDULE_M = (0.03, 0.03, 0.02, 0.02, 0.015, 0.012, 0.01, 0.008, 0.008, 0.008, 0.008, 0.008)
SAME_NORMAL = float(np.cos(np.radians(30.0)))
ROBUST_M = 0.0015
SHARED_PX = 10.0
"""Points of a fruit that share their errors, at 640 pixels across; in smaller pictures of such a device fewer do, of
larger ones no more points than these are taken."""

KNOWN_AS = 6
"""What is known of the noise counts as much as so many things seen."""

REGISTERED_PX = 0.1
"""How far a driver lays depth beside colour: it rounds to whole pixels and keeps one of those that meet in one."""


@dataclass(frozen=True, slots=True, eq=False)
class Matched:
    """Pairs of points that are the same place under a shift.

    Attributes:
        source, target: (M,) indices into the reliefs' points.
        residual_m: (M,) distance along the mean normal.
        jacobian: (M, 3) of the residual by (dx, dy, dθ about `centre_m`).
        rise: (M,) of the residual by a common error of height.
        weight: (M,) robust weights.
        centre_m: (2,) where the turn is taken about, target's frame.
    """

    source: Ints
    target: Ints
    residual_m: F64
    jacobian: F64
    rise: F64
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
    return Matched(found, near, residual, jacobian, both[:, 2], weight, centre)


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

    Three things err independently of each other:

    - Noise. Neighbours share it (matching window, steps), and much of it stands still, so points of one thing count
      as one witness: H⁻¹ (Σ g gᵀ) H⁻¹ over things, with g the pull of a thing. A few things do not show how far they
      scatter, so what is seen is blended with what the device's noise is known to do.
    - The heights of both belts' planes: where most of what both see leans one way, they pass for a shift.
    - Depth laid on colour: the same for all things of one sensor, so that no residual shows it.
    """
    matched = fit.matched
    free = 3 if turning else 2
    J, w, r = matched.jacobian[:, :free], matched.weight, matched.residual_m
    H = (J * w[:, None]).T @ J
    _, thing = np.unique(source.thing[matched.source], return_inverse=True)
    count = int(thing.max()) + 1
    pulls = np.stack([np.bincount(thing, w * r * J[:, k], count) for k in range(free)], axis=1)
    seen = pulls.T @ pulls * count / max(count - free, 1)
    known = (J * w[:, None] ** 2).T @ J * (_noise_m2(source) + _noise_m2(target))
    lifted = (J * w[:, None]).T @ matched.rise
    height = _height_m2(source, fit.shift.inverse().apply(matched.centre_m)) + _height_m2(target, matched.centre_m)
    H_inverse = np.linalg.pinv(H)
    blend = (count * seen + KNOWN_AS * known) / (count + KNOWN_AS) + np.outer(lifted, lifted) * height
    spread = np.asarray(H_inverse @ blend @ H_inverse)
    spread[:2, :2] += np.eye(2) * (_misplaced_m2(source) + _misplaced_m2(target))
    return spread


def _noise_m2(relief: Relief) -> float:
    """Return the variance of a point's distance as large as if neighbours did not share their errors."""
    standing = 0.5 + 0.5 / relief.still.captures
    shared = SHARED_PX * min(relief.still.intrinsics.width / 640, 1.0) ** 2
    return shared * standing * (INVERSE_NOISE * relief.distance_m**2) ** 2


def _height_m2(relief: Relief, at_m: F64) -> float:
    """Return the variance of the belt's height at a place (2,) of its plane."""
    spread, out = relief.belt.covariance, at_m - relief.frame.translation_m[:2]
    return float(spread[2, 2] + (spread[0, 0] + spread[1, 1]) * (out @ out) / 2)


def _misplaced_m2(relief: Relief) -> float:
    """Return the variance (one axis) of where depth lies on the colour picture, at the things' distance."""
    return float((REGISTERED_PX * relief.distance_m / relief.still.intrinsics.fx) ** 2)


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
