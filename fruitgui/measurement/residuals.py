"""How far the samples lie from a surface, what that distance weighs, and how it changes with the unknowns."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F32, F64
from fruitgui.measurement.evidence import Evidence
from fruitgui.measurement.shape import Shape
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
"""Points count only where the surface faces the sensor more than this, wholly from 0.2 more."""

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
        by_common: (V, M, 6 + K + 5) single precision; change with what views share: the stretch, the harmonics'
            weights, the sensor's shift (3) and its fattening along the picture's x and y (2), in pixels.
        by_view: (V, M, 3 or 6) single precision; change with the view's shift (3) and turn (3).
        along: (V, M) from each sample along its sight to where it was linearised next.
        chi2: (V,) mean normalised square of the view's points.
        view_weight: (V,) what the view counts.
    """

    distance: F64
    weight: F64
    by_common: F32
    by_view: F32
    along: F64
    chi2: F64
    view_weight: F64


def residuals(state: State, evidence: Evidence, *, turning: bool = False) -> Residuals:
    """Linearise about where each point's sight meets the surface, and where each outline's sight passes it closest.

    The noise lies along the sight. Taken at the noisy point itself, slopes and
    weights would go with the noise and pull the surface inwards by σ²-terms
    (a millimetre at 1 m).
    """
    rim, matrix = evidence.points, state.shape.matrix
    p, sight = _in_body(state, evidence)
    toward = sight[:, rim:] @ matrix.T
    curved = np.einsum("vmd,vmd->vm", toward, toward)
    along = state.along_m.copy()
    along[:, rim:] -= np.einsum("vmd,vmd->vm", p[:, rim:] @ matrix.T, toward) / curved
    p += along[..., None] * sight
    views, count = along.shape
    distance, normal, by_shape, steep = _distances(state.shape, p.reshape(-1, 3))
    distance, normal, steep = distance.reshape(along.shape), normal.reshape(p.shape), steep.reshape(along.shape)
    facing = -np.einsum("vmd,vmd->vm", sight, normal)
    shift = -np.matmul(normal, state.turn) if state.turned else -normal
    by_view = np.concatenate([shift, _cross(p, normal)], axis=2) if turning else shift
    by_edge = _by_edge(shift, evidence)
    distance[:, :rim] += along[:, :rim] * facing[:, :rim]
    fattening = state.edge_px[evidence.sensor][:, None, :] - OUTSIDE_PX
    distance[:, rim:] += np.sum(by_edge[:, rim:] * fattening, axis=2)
    height = np.matmul(p[:, rim:], state.turn[:, :, 2:])[..., 0] + state.centre_m[2]
    weight, chi2, view_weight = _weights(distance, facing, height, evidence)
    following = np.empty_like(along)
    following[:, :rim] = distance[:, :rim] / np.maximum(facing[:, :rim], 0.15)
    following[:, rim:] = state.along_m[:, rim:] + facing[:, rim:] * steep[:, rim:] / curved
    np.clip(following, -FARTHEST_M, FARTHEST_M, out=following)
    shared = [by_shape.reshape(views, count, -1), shift.astype(np.float32), by_edge.astype(np.float32)]
    by_common: F32 = np.concatenate(shared, axis=2)
    return Residuals(distance, weight, by_common, by_view.astype(np.float32), following, chi2, view_weight)


def _in_body(state: State, evidence: Evidence) -> tuple[F64, F64]:
    """Return samples and sights (V, M, 3) about the fruit's centre, as it lies."""
    p = evidence.samples_m - state.place_m(evidence)[:, None, :]
    if not state.turned:
        return p, evidence.sight
    back = state.turn.transpose(0, 2, 1)
    return np.matmul(p, back), np.matmul(evidence.sight, back)


def _cross(a: F64, b: F64) -> F64:
    """Return the cross products (V, M, 3); numpy's own is several times slower."""
    ax, ay, az = a[..., 0], a[..., 1], a[..., 2]
    bx, by, bz = b[..., 0], b[..., 1], b[..., 2]
    return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx], axis=-1)


def _distances(shape: Shape, p: F64) -> tuple[F64, F64, F32, F64]:
    """Return, for points (N, 3) about the centre: distance, normal, change with the shape, and steepness.

    The many columns of the change are in single precision: they only weigh
    the steps, and halve the time.
    """
    q = p @ shape.matrix.T
    rho = np.sqrt(np.einsum("nd,nd->n", q, q))
    u = q / rho[:, None]
    log, outward = np.log(rho), u
    by_shape = np.empty((len(u), 6 + len(shape.weights)), dtype=np.float32)
    if shape.basis is not None:
        by_shape[:, 6:], level, slope = shape.basis.with_slope(u.astype(np.float32), shape.weights)
        log, outward = log - level, u - slope
    ux, uy, uz = u.T
    nx, ny, nz = outward.T
    by_shape[:, 0], by_shape[:, 1], by_shape[:, 2] = nx * ux, ny * uy, nz * uz
    by_shape[:, 3], by_shape[:, 4], by_shape[:, 5] = nx * uy + ny * ux, nx * uz + nz * ux, ny * uz + nz * uy
    gradient = (outward @ shape.matrix) / rho[:, None]
    steep = np.sqrt(np.einsum("nd,nd->n", gradient, gradient))
    by_shape *= (-1.0 / steep[:, None]).astype(np.float32)
    return log / steep, gradient / steep[:, None], by_shape, steep


def _by_edge(shift: F64, evidence: Evidence) -> F64:
    """Return the change (V, M, 2) of the outlines' distances with a pixel of fattening along the picture's x and y."""
    rim = evidence.points
    by_edge = np.zeros((*shift.shape[:2], 2))
    in_picture = np.matmul(shift[:, rim:], evidence.axes[evidence.sensor][:, :2].transpose(0, 2, 1))
    by_edge[:, rim:] = -(in_picture**2) * evidence.pixel_m[:, rim:, None]
    return by_edge


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
    return weight * evidence.share, chi2, view_weight
