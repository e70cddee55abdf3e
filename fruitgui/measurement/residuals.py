"""How far the samples lie from a surface, what that distance weighs, and how it changes with the unknowns."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F64
from fruitgui.measurement.evidence import Evidence
from fruitgui.measurement.shape import SIX, Shape
from fruitgui.measurement.state import State

FLOOR_SIGMA_M = 0.5e-3
"""Roughness of fruit and lens, in every point."""

RIM_SIGMA_PX = 1.8
"""Raggedness of an outline: a pixel's own width, and drop-outs."""

OUTSIDE_PX = 0.4
"""An outline runs through the centres of the outermost pixels, on average this far inside the true edge."""

FARTHEST_M = 12e-3
"""Farthest along its sight that the surface is looked for from a point."""

FACING = 0.05
"""x"""

FREEDOM = 4.0
"""Degrees of freedom of the Student distribution of the residuals."""

LOW_M, LOW_SHARE = 9e-3, 0.25
"""Outlines are not trusted below this height, nor below this share of the fruit's: there the belt cuts them."""


@dataclass(frozen=True, slots=True, eq=False)
class Residuals:
    """Distances of the samples from the surface, linearised.

    Attributes:
        distance: (V, M) metres, positive outside; for outlines, what fattening does not explain.
        weight: (V, M) 1/m².
        by_shape: (V, M, 6 + K) change with the stretch and the harmonics' weights.
        by_view: (V, M, 6) change with the view's shift (3) and turn (3).
        by_edge: (V, M, 2) change with the sensor's fattening along the picture's x and y, in pixels.
        along: (V, M) from each sample along its sight to where it was linearised next.
        chi2: (V,) mean normalised square of the view's points.
        view_weight: (V,) what the view counts.
    """

    distance: F64
    weight: F64
    by_shape: F64
    by_view: F64
    by_edge: F64
    along: F64
    chi2: F64
    view_weight: F64


def residuals(state: State, evidence: Evidence) -> Residuals:
    """Linearise about where each point's sight meets the surface, and where each outline's sight passes it closest.

    The noise lies along the sight. Taken at the noisy point itself, slopes and
    weights would go with the noise and pull the surface inwards by σ²-terms
    (a millimetre at 1 m).
    """
    sight = np.matmul(evidence.sight, state.turn.transpose(0, 2, 1))
    p = np.matmul(evidence.samples_m - state.place_m(evidence)[:, None, :], state.turn.transpose(0, 2, 1))
    along = state.along_m.copy()
    along[:, evidence.points :] += _closest(p[:, evidence.points :], sight[:, evidence.points :], state.shape.matrix)
    p += along[..., None] * sight
    views, count = along.shape
    distance, normal, outward, u, steep, harmonics = _distances(state.shape, p.reshape(-1, 3))
    by_shape = np.empty((len(u), 6 + harmonics.shape[1]))
    for k, (i, j) in enumerate(SIX):
        by_shape[:, k] = outward[:, i] * u[:, j] if i == j else outward[:, i] * u[:, j] + outward[:, j] * u[:, i]
    by_shape[:, 6:] = harmonics
    by_shape /= -steep[:, None]
    distance, normal = distance.reshape(views, count), normal.reshape(views, count, 3)
    facing = -np.einsum("vmd,vmd->vm", sight, normal)
    by_view = np.concatenate([-np.matmul(normal, state.turn), np.cross(p, normal)], axis=2)
    height = np.einsum("vmd,vd->vm", p[:, evidence.points :], state.turn[:, :, 2]) + state.centre_m[2]
    by_edge = _by_edge(by_view, evidence)
    _correct(distance, facing, along, by_edge, state, evidence)
    weight, chi2, view_weight = _weights(distance, facing, height, evidence)
    next_along = _next_along(distance, facing, steep.reshape(views, count), state, evidence, sight)
    return Residuals(
        distance, weight, by_shape.reshape(views, count, -1), by_view, by_edge, next_along, chi2, view_weight
    )


def _closest(p: F64, sight: F64, matrix: F64) -> F64:
    """Return how far along each sight (V, M) the ellipsoid is passed closest."""
    q, d = p @ matrix.T, sight @ matrix.T
    return np.asarray(-np.einsum("vmd,vmd->vm", q, d) / np.einsum("vmd,vmd->vm", d, d))


def _distances(shape: Shape, p: F64) -> tuple[F64, F64, F64, F64, F64, F64]:
    """Return, for points (N, 3) about the centre: distance, normal, and the parts of the change with the shape."""
    q = p @ shape.matrix.T
    rho = np.sqrt(np.einsum("nd,nd->n", q, q))
    u = q / rho[:, None]
    level, slope, harmonics = _dent(shape, u)
    outward = u - slope
    gradient = outward @ shape.matrix / rho[:, None]
    steep = np.sqrt(np.einsum("nd,nd->n", gradient, gradient))
    return (np.log(rho) - level) / steep, gradient / steep[:, None], outward, u, steep, harmonics


def _dent(shape: Shape, u: F64) -> tuple[F64, F64, F64]:
    """Return g (N,), its tangential gradient (N, 3) and the harmonics (N, K) at unit vectors."""
    harmonics = shape.basis
    if harmonics is None:
        return np.zeros(len(u)), np.zeros((len(u), 3)), np.zeros((len(u), 0))
    table = harmonics.monomials(u)
    values = table @ harmonics.matrix
    slope = table @ np.stack([s @ shape.weights for s in harmonics.slope], axis=1)
    slope -= np.einsum("nd,nd->n", slope, u)[:, None] * u
    return values @ shape.weights, slope, values


def _by_edge(by_view: F64, evidence: Evidence) -> F64:
    """Return the change (V, M, 2) of the outlines' distances with a pixel of fattening along the picture's x and y."""
    rim = evidence.points
    by_edge = np.zeros((*by_view.shape[:2], 2))
    in_picture = np.matmul(by_view[:, rim:, :3], evidence.axes[evidence.sensor][:, :2].transpose(0, 2, 1))
    by_edge[:, rim:] = -(in_picture**2) * evidence.pixel_m[:, rim:, None]
    return by_edge


def _correct(
    distance: F64, facing: F64, along: F64, by_edge: F64, state: State, evidence: Evidence
) -> None:
    """Refer points' distances to where they were seen, and outlines' to what fattening explains; in place."""
    rim = evidence.points
    distance[:, :rim] += along[:, :rim] * facing[:, :rim]
    fattening = state.edge_px[evidence.sensor][:, None, :] - OUTSIDE_PX
    distance[:, rim:] += np.sum(by_edge[:, rim:] * fattening, axis=2)


def _weights(distance: F64, facing: F64, height: F64, evidence: Evidence) -> tuple[F64, F64, F64]:
    """Return weights (V, M) in 1/m², and for each view its mean normalised square and its own weight (V,)."""
    rim = evidence.points
    variance = (evidence.depth_sigma_m * facing) ** 2 + (0.5 * evidence.pixel_m) ** 2 + FLOOR_SIGMA_M**2
    variance[:, rim:] = (RIM_SIGMA_PX * evidence.pixel_m[:, rim:]) ** 2 + FLOOR_SIGMA_M**2
    normalised = distance**2 / variance
    student = (FREEDOM + 1.0) / (FREEDOM + normalised)
    trusted = evidence.used.astype(np.float64)
    trusted[:, :rim] *= np.clip((facing[:, :rim] - FACING) / 0.2, 0.0, 1.0)
    low = max(LOW_M, LOW_SHARE * evidence.height_m)
    trusted[:, rim:] *= np.clip((height - low) / 4e-3, 0.0, 1.0)
    chi2 = np.sum((normalised * student * trusted)[:, :rim], axis=1) / np.maximum(trusted[:, :rim].sum(axis=1), 1e-9)
    usual = max(float(np.median(chi2)), 0.3)
    view_weight = np.minimum(1.0, (2.5 * usual / np.maximum(chi2, 1e-9)) ** 2)
    weight = student * trusted * view_weight[:, None] / variance
    weight[:, :rim] *= evidence.share[:, None]
    return weight, chi2, view_weight


def _next_along(distance: F64, facing: F64, steep: F64, state: State, evidence: Evidence, sight: F64) -> F64:
    """Return where to linearise next: points' sights meet the surface; outlines' pass it (a Newton step beyond the ellipsoid's)."""
    rim = evidence.points
    along = np.empty_like(distance)
    along[:, :rim] = distance[:, :rim] / np.maximum(facing[:, :rim], 0.15)
    d = sight[:, rim:] @ state.shape.matrix.T
    curved = np.einsum("vmd,vmd->vm", d, d)
    along[:, rim:] = state.along_m[:, rim:] + facing[:, rim:] * steep[:, rim:] / curved
    return np.asarray(np.clip(along, -FARTHEST_M, FARTHEST_M))
