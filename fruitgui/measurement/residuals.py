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

PER_SENSOR = 5
"""Unknowns of each sensor: a shift (3) and its edges' fattening (2)."""

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
        by_common: (6 + K + 3 + 5 S, V, M) single precision; change with what views share: the stretch, the harmonics'
            weights, the centre (3), and of each sensor its shift (3) and its fattening along the picture's x and y
            (2), in pixels.
        by_view: (3 or 6, V, M) single precision; change with the view's shift (3) and turn (3).
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
    toward = _through(matrix, sight[:, :, rim:])
    curved = _dot(toward, toward)
    along = state.along_m.copy()
    along[:, rim:] -= _dot(_through(matrix, p[:, :, rim:]), toward) / curved
    p += along * sight
    distance, normal, by_common, steep = _distances(state.shape, p, 3 + PER_SENSOR * len(evidence.sensors))
    facing = -_dot(sight, normal)
    shift = -normal
    if state.turned:
        shift = np.matmul(shift.transpose(1, 2, 0), state.turn).transpose(2, 0, 1)
    by_view: F32 = np.concatenate([shift, _cross(p, normal)] if turning else [shift]).astype(np.float32)
    by_edge = _by_edge(shift, evidence)
    _fill_sensors(by_common[6 + len(state.shape.weights) :], shift, by_edge, evidence)
    distance[:, :rim] += along[:, :rim] * facing[:, :rim]
    fattening = (state.edge_px[evidence.sensor] - OUTSIDE_PX).T[:, :, None]
    distance[:, rim:] += (by_edge * fattening).sum(axis=0)
    height = np.matmul(p[:, :, rim:].transpose(1, 2, 0), state.turn[:, :, 2:])[..., 0] + state.centre_m[2]
    weight, chi2, view_weight = _weights(distance, facing, height, evidence)
    following = np.empty_like(along)
    following[:, :rim] = distance[:, :rim] / np.maximum(facing[:, :rim], 0.15)
    following[:, rim:] = state.along_m[:, rim:] + facing[:, rim:] * steep[:, rim:] / curved
    np.clip(following, -FARTHEST_M, FARTHEST_M, out=following)
    return Residuals(distance, weight, by_common, by_view, following, chi2, view_weight)


def _in_body(state: State, evidence: Evidence) -> tuple[F64, F64]:
    """Return samples and sights about the fruit's centre, as it lies; (3, V, M), for long runs in memory."""
    p, sight = evidence.samples_m - state.place_m(evidence)[:, None, :], evidence.sight
    if state.turned:
        back = state.turn.transpose(0, 2, 1)
        p, sight = np.matmul(p, back), np.matmul(sight, back)
    return np.ascontiguousarray(p.transpose(2, 0, 1)), np.ascontiguousarray(sight.transpose(2, 0, 1))


def _through(matrix: F64, vectors: F64) -> F64:
    """Return a matrix (3, 3) times vectors (3, …)."""
    return np.asarray((matrix @ vectors.reshape(3, -1)).reshape(vectors.shape))


def _dot(a: F64, b: F64) -> F64:
    """Return the scalar products of vectors (3, …)."""
    return np.asarray(a[0] * b[0] + a[1] * b[1] + a[2] * b[2])


def _cross(a: F64, b: F64) -> F64:
    """Return the cross products of vectors (3, …); numpy's own is several times slower."""
    ax, ay, az = a
    bx, by, bz = b
    return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx])


def _fill_sensors(rows: F32, shift: F64, by_edge: F64, evidence: Evidence) -> None:
    """Fill in the change with the centre, and with each sensor's shift and fattening in its own views."""
    rows[:3], rows[3:] = shift, 0.0
    for number in range(len(evidence.sensors)):
        first, mine = 3 + PER_SENSOR * number, (evidence.sensor == number)[:, None]
        np.multiply(rows[:3], mine, out=rows[first : first + 3])
        rows[first + 3 : first + PER_SENSOR, :, evidence.points :] = by_edge * mine


def _distances(shape: Shape, p: F64, more: int) -> tuple[F64, F64, F32, F64]:
    """Return, for points (3, V, M) about the centre: distance, normal, change with the shape, and steepness.

    The many rows of the change are in single precision: they only weigh the
    steps, and halve the time. So many `more` rows are left to be filled.
    """
    q = _through(shape.matrix, p)
    rho = np.sqrt(_dot(q, q))
    u = q / rho
    log, outward = np.log(rho), u
    count = 6 + len(shape.weights)
    by_shape = np.empty((count + more, *rho.shape), dtype=np.float32)
    single = u.astype(np.float32)
    if shape.basis is not None:
        harmonics = by_shape[6:count].reshape(count - 6, -1)
        level, slope = shape.basis.with_slope(single.reshape(3, -1), shape.weights, harmonics)
        log, outward = log - level.reshape(rho.shape), u - slope.reshape(u.shape)
    ux, uy, uz = single
    nx, ny, nz = outward.astype(np.float32)
    by_shape[0], by_shape[1], by_shape[2] = nx * ux, ny * uy, nz * uz
    by_shape[3], by_shape[4], by_shape[5] = nx * uy + ny * ux, nx * uz + nz * ux, ny * uz + nz * uy
    gradient = _through(shape.matrix.T, outward) / rho
    steep = np.sqrt(_dot(gradient, gradient))
    by_shape[:count] *= (-1.0 / steep).astype(np.float32)
    return log / steep, gradient / steep, by_shape, steep


def _by_edge(shift: F64, evidence: Evidence) -> F64:
    """Return the change (2, V, R) of the outlines' distances with a pixel of fattening along the picture's x and y."""
    rim = evidence.points
    in_picture = np.matmul(evidence.axes[evidence.sensor][:, :2], shift[:, :, rim:].transpose(1, 0, 2))
    return np.asarray(-np.square(in_picture).transpose(1, 0, 2) * evidence.pixel_m[:, rim:])


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
