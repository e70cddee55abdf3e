"""The exact pose between two views that already lie nearly on each other: both views' patches slid onto the other's.

Each chosen patch is looked up where it falls in the other view's picture, so no search for neighbours is needed;
both directions count alike, so it does not matter which view is called the source. Distances are taken in inverse
depth, where noise is uniform (Khoshelham & Elberink 2012).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.calibration.patches import Patches
from fruitgui.frame import F64, Bools, Intrinsics, Ints
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rotation import rotation_from_vector

LEAST_SPREAD = 1.0e-3
"""Residuals of patches of a Kinect v1 spread by at least this, 1/m."""

CUT = 3.5
"""Spreads beyond which a patch has no say (Tukey)."""

FEWEST = 40
LONGEST_STEP = 0.15
AT_REST = 2e-6
NEAREST_M = 0.3
ERRS = 2.0
"""Poses err by this many times what their residuals say (135 pairs of three simulated tables): folds and rims of things
lead whole tiles astray together."""

TILE = 0.08
"""Size of a tile, in rays: a twelfth of the picture."""


@dataclass(frozen=True, slots=True)
class Stage:
    """One step of a schedule: patches take part within `reach_m` and `lean_cos` of each other; `spread` in 1/m."""

    reach_m: float
    lean_cos: float
    spread: float


def _schedule(steps: int, reach_m: tuple[float, float], lean_cos: tuple[float, float],
              spread: tuple[float, float]) -> tuple[Stage, ...]:  # fmt: skip
    reaches, spreads = np.geomspace(*reach_m, steps), np.geomspace(*spread, steps)
    return tuple(Stage(*row) for row in zip(reaches, np.linspace(*lean_cos, steps), spreads, strict=True))


NEARLY = _schedule(12, (0.03, 0.02), (0.88, 0.88), (0.002, LEAST_SPREAD)) + (Stage(0.02, 0.88, LEAST_SPREAD),) * 18
"""From where both views lie within about a centimetre of each other."""

ROUGHLY = _schedule(24, (0.12, 0.03), (0.6, 0.88), (0.010, 0.002)) + NEARLY
"""From a guess that may be off by a hand's breadth."""


@dataclass(frozen=True, slots=True, eq=False)
class Slid:
    """Where sliding came to rest.

    Attributes:
        pose: source → target, with the covariance that the patches give it.
        spread: of the residuals, 1/m; `LEAST_SPREAD` for sound simulated Kinects, more where depth is bent.
    """

    pose: Pose
    spread: float


@dataclass(frozen=True, slots=True, eq=False)
class _Pulls:
    """Residuals (M,) of both directions, 1/m, their derivatives (M, 6) by (ω, v), and the tile each comes from (M,)."""

    jacobian: F64
    residual: F64
    tile: Ints


def slide(source: Patches, target: Patches, start: Pose, schedule: tuple[Stage, ...], thinned: int = 1) -> Slid | None:
    """Return where two views come to rest on each other; None where too little of them meets."""
    pose, spread = start, LEAST_SPREAD
    cut = slice(None, None, thinned)
    for stage in schedule:
        pulls = _pulls(source, target, pose, stage, cut)
        if pulls is None:
            return None
        spread = max(stage.spread, 1.4826 * float(np.median(np.abs(pulls.residual))))
        step, covariance = _step(pulls, spread)
        turn = rotation_from_vector(step[:3])
        pose = Pose(turn @ pose.rotation, turn @ pose.translation_m + step[3:], covariance)
        if stage == schedule[-1] and float(np.linalg.norm(step)) < AT_REST:
            break
    return Slid(pose, spread)


def _step(pulls: _Pulls, spread: float) -> tuple[F64, F64]:
    """Return the step (ω, v) of robust least squares, and the covariance of where it leads.

    Errors of neighbouring patches go together, so tiles of the picture are what counts as independent (sandwich
    estimator), beside what the residuals alone say.
    """
    weight = np.clip(1.0 - (pulls.residual / (CUT * spread)) ** 2, 0.0, None) ** 2
    weighted = pulls.jacobian * weight[:, None]
    H = weighted.T @ pulls.jacobian
    inverse = np.linalg.inv(H + 1e-8 * np.trace(H) * np.eye(6))
    each = weighted * pulls.residual[:, None]
    tiles = np.stack([np.bincount(pulls.tile, each[:, k]) for k in range(6)], axis=1)
    step = -inverse @ each.sum(axis=0)
    covariance = ERRS**2 * inverse @ (spread**2 * H + tiles.T @ tiles) @ inverse
    return step * min(1.0, LONGEST_STEP / float(np.linalg.norm(step))), np.asarray(covariance)


def _pulls(source: Patches, target: Patches, pose: Pose, stage: Stage, cut: slice) -> _Pulls | None:
    inverse = pose.inverse()
    there, a, _ = _met(source.points_m[cut], source.normals[cut], target, pose, stage)
    back, b, kept = _met(target.points_m[cut], target.normals[cut], source, inverse, stage)
    if len(there) + len(back) < FEWEST:
        return None
    here, turned = target.points_m[cut][kept], pose.turn(b)
    forward = np.hstack([np.cross(there, a), a]) / there[:, 2:]
    backward = -np.hstack([np.cross(here, turned), turned]) / back[:, 2:]
    residuals = [((plane * points).sum(axis=1) - 1.0) / points[:, 2] for plane, points in ((a, there), (b, back))]
    # Both directions' tiles lie in the target's picture: what they say of one place is not independent.
    return _Pulls(np.vstack([forward, backward]), np.concatenate(residuals), _tiles(np.vstack([there, here])))


def _tiles(local_m: F64) -> Ints:
    cell = np.clip(np.floor(local_m[:, :2] / local_m[:, 2:] / TILE).astype(np.intp) + 32, 0, 63)
    return np.asarray(64 * cell[:, 1] + cell[:, 0])


def _met(points_m: F64, normals: F64, other: Patches, pose: Pose, stage: Stage) -> tuple[F64, F64, Bools]:
    """Return where patches lie in the other view's frame, the planes a (M, 3) there, and which (N,) meet one at all."""
    local = pose.apply(points_m)
    v, u, inside = pixels(other.camera, local)
    a = other.planes[v // other.stride, u // other.stride].astype(np.float64)
    length = np.linalg.norm(a, axis=1)
    facing = -(pose.turn(normals) * a).sum(axis=1)
    near = np.abs((a * local).sum(axis=1) - 1.0) < stage.reach_m * length
    met = inside & (length > 0) & near & (facing > stage.lean_cos * length)
    return local[met], a[met], met


def pixels(camera: Intrinsics, local_m: F64) -> tuple[Ints, Ints, Bools]:
    """Return row and column of the pixel that shows each point (N, 3), zeros outside, and which are inside."""
    ahead = local_m[:, 2] > NEAREST_M
    places = camera.project(np.where(ahead[:, None], local_m, [0.0, 0.0, 1.0]))
    u, v = np.round(np.clip(places, -9.0, 1e5)).astype(np.intp).T
    inside = ahead & (u >= 0) & (v >= 0) & (u < camera.width) & (v < camera.height)
    return np.where(inside, v, 0), np.where(inside, u, 0), inside
