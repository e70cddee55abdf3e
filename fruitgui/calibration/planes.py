"""Planes in one picture, found in inverse depth, where a plane is linear in the pixel's ray.

n·X + d = 0 with X = z (x, y, 1) gives 1/z = a·(x, y, 1) with a = −n/d. Noise and
steps of structured light are uniform in 1/z, so one threshold holds at every
distance and least squares are the right squares.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.calibration.still import INVERSE_NOISE, INVERSE_STEP, Still
from fruitgui.frame import F64, Bools
from fruitgui.geometry.plane import Plane

ON_PLANE = INVERSE_STEP + 2.0 * INVERSE_NOISE
"""Readings of a plane lie within this of it, 1/m (6 mm at 1 m)."""


@dataclass(frozen=True, slots=True, eq=False)
class PlaneFit:
    """A plane with how sure it is.

    Attributes:
        plane: in the optical frame, normal to the sensor's side.
        coefficients: (3,) the a of 1/z = a·(x, y, 1).
        covariance: (3, 3) of the coefficients, correlated noise included.
        spread: robust standard deviation of the averaged inverse depth about the plane, 1/m.
    """

    plane: Plane
    coefficients: F64
    covariance: F64
    spread: float


def plane_of(coefficients: F64) -> Plane:
    """Return the plane of 1/z = a·(x, y, 1), normal to the sensor's side."""
    length = float(np.linalg.norm(coefficients))
    return Plane(-coefficients / length, 1.0 / length)


def coefficients_of(plane: Plane) -> F64:
    """Return the a of 1/z = a·(x, y, 1) of a plane that does not hold the sensor."""
    return np.asarray(-plane.normal / plane.offset_m)


def rays_of(still: Still, stride: int = 1) -> F64:
    """Return homogeneous rays (x, y, 1) of every `stride`-th pixel: (H/stride, W/stride, 3)."""
    rays = still.intrinsics.rays()[::stride, ::stride].astype(np.float64)
    return np.concatenate([rays, np.ones((*rays.shape[:2], 1))], axis=2)


def candidates(still: Still, most: int = 5) -> list[F64]:
    """Return coefficients of the planes in view, the one with most pixels first."""
    stride = max(1, round(still.intrinsics.width / 160))
    inverse = still.inverse_depth[::stride, ::stride].astype(np.float64)
    rays = rays_of(still, stride)
    free: Bools = inverse > 0
    readings = int(free.sum())
    rng = np.random.default_rng(0)
    found: list[F64] = []
    while len(found) < most and free.sum() > max(60, 0.03 * readings):
        best = _best_of_samples(inverse, rays, free, rng)
        if best is None:
            break
        on = free & (np.abs(inverse - rays @ best) < ON_PLANE)
        if on.sum() < max(50, 0.03 * readings):
            break
        found.append(_least_squares(rays[on], inverse[on]))
        free &= np.abs(inverse - rays @ found[-1]) > ON_PLANE
    return found


def _best_of_samples(inverse: F64, rays: F64, free: Bools, rng: np.random.Generator, trials: int = 400) -> F64 | None:
    """Return the plane through three near pixels that most free pixels agree with."""
    v, u = np.nonzero(free)
    first = rng.integers(0, len(v), trials)
    reach = max(6, inverse.shape[1] // 6)
    corners = [(v[first], u[first])]
    for _ in range(2):
        near_v = np.clip(v[first] + rng.integers(-reach, reach + 1, trials), 0, inverse.shape[0] - 1)
        near_u = np.clip(u[first] + rng.integers(-reach, reach + 1, trials), 0, inverse.shape[1] - 1)
        corners.append((near_v, near_u))
    usable = np.all([free[corner] for corner in corners], axis=0)
    A = np.stack([rays[corner][usable] for corner in corners], axis=1)
    q = np.stack([inverse[corner][usable] for corner in corners], axis=1)
    solid = np.abs(np.linalg.det(A)) > 1e-4
    if not solid.any():
        return None
    planes = np.linalg.solve(A[solid], q[solid][..., None])[..., 0]
    thin = slice(None, None, max(1, len(v) // 3000))
    near = np.abs(inverse[v, u][thin, None] - rays[v, u][thin] @ planes.T) < ON_PLANE
    return np.asarray(planes[int(near.sum(axis=0).argmax())])


def _least_squares(rays: F64, inverse: F64) -> F64:
    """Return the coefficients nearest to all; rays part enough for the normal equations, which are quick."""
    hessian = rays.T @ rays
    if np.linalg.matrix_rank(hessian) < len(hessian):
        return np.asarray(np.linalg.lstsq(rays, inverse, rcond=None)[0])
    return np.asarray(np.linalg.solve(hessian, rays.T @ inverse))


def refine(still: Still, coefficients: F64, allowed: Bools) -> tuple[PlaneFit, Bools]:
    """Fit a plane to all pixels of `allowed` that agree with it, and tell which do.

    Noise is correlated between neighbours and so are the steps: the covariance comes from how the
    picture's tiles pull in different directions (sandwich estimator over 12×16 tiles), not from
    the count of pixels.
    """
    usable = allowed & still.seen
    rays, inverse = rays_of(still)[usable], still.inverse_depth[usable].astype(np.float64)
    bound = ON_PLANE
    for _ in range(4):
        off = np.abs(inverse - rays @ coefficients)
        near = off < bound
        A = rays[near]
        coefficients = _least_squares(A, inverse[near])
        spread = 1.4826 * float(np.median(off[near]))
        bound = float(np.clip(3.5 * spread, 0.25 * ON_PLANE, ON_PLANE))
    on = np.zeros_like(usable)
    on[usable] = near
    covariance = _tile_covariance(A, inverse[near] - A @ coefficients, on)
    return PlaneFit(plane_of(coefficients), coefficients, covariance, spread), on


def _tile_covariance(A: F64, r: F64, on: Bools) -> F64:
    """Return the sandwich covariance of the coefficients with whole tiles as independent observations.

    Args:
        A: (N, 3) rays of the pixels that are on the plane.
        r: (N,) how far their inverse depths are off.
        on: (H, W) which pixels these are.
    """
    v, u = np.nonzero(on)
    tile = (v * 12 // on.shape[0]) * 16 + u * 16 // on.shape[1]
    pulls = np.stack([np.bincount(tile, A[:, k] * r, 192) for k in range(3)], axis=1)
    inverse_hessian = np.linalg.inv(A.T @ A)
    tiles = max(int((np.bincount(tile, minlength=192) > 0).sum()), 4)
    return np.asarray(inverse_hessian @ (pulls.T @ pulls) @ inverse_hessian * tiles / (tiles - 3))
