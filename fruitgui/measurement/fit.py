"""One closed surface through all views of a fruit, the views shifted onto it, all in one least-squares problem.

The unknowns are the surface (an ellipsoid and harmonics upon it), the fruit's
centre over the belt, one common shift for each sensor (what is left of depth
bias and pose error) and one small shift for each view (what the belt's motion
does not explain). Every one has a prior as wide as physics says, so where the
views decide they decide, and what nobody saw is what fruit usually are: round
about one axis, smooth, and standing on the belt. Gauss–Newton with the views'
shifts eliminated (Schur complement); Student weights against points that lie.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from fruitgui.frame import F64
from fruitgui.measurement.evidence import Evidence
from fruitgui.measurement.prior import Prior, shape_prior
from fruitgui.measurement.shape import Shape, ball

SIX = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
"""Entries of the symmetric stretch S of the ellipsoid, in the order of the unknowns."""

CONTACT_SIGMA_M = 0.7e-3
"""How far a fruit's lowest point may seem to be from the belt: flatness of the belt and of the fitted plane."""

HEIGHT_SIGMA_M = 0.7e-3
"""How far a sensor's, or a view's, heights may be off after they were taken from its own belt."""

FLOOR_SIGMA_M = 0.5e-3
"""Roughness of fruit and lens, in every point."""

FARTHEST_M = 12e-3
"""Farthest along its sight that the surface is looked for from a point."""

FREEDOM = 4.0
"""Degrees of freedom of the Student distribution of the residuals."""


@dataclass(frozen=True, slots=True, eq=False)
class Fit:
    """A surface through all views.

    Attributes:
        shape: the surface about its centre, axes of the belt frame through `shape.matrix`.
        body: (3, 3) rotation from the ball's own frame into the belt frame.
        centre_m: (3,) in the belt frame, at the middle of the track.
        path_m: (V, 3) what the belt had carried it by at each view.
        offset_m: (S, 3) of each sensor.
        shift_m: (V, 3) of each view, beyond all that.
        along_m: (V, M) from each point along its sight to the surface.
        covariance: of the stretch (6) and the harmonics' weights (K), scaled by the residuals.
        chi2: mean square of the normalised residuals: one where the noise is as the physics says.
        residual_m: (V,) root mean square distance of each view's points from the surface.
        weight: (V,) how much each view counted, 0–1.
    """

    shape: Shape
    body: F64
    centre_m: F64
    path_m: F64
    offset_m: F64
    shift_m: F64
    along_m: F64
    covariance: F64
    chi2: float
    residual_m: F64
    weight: F64

    def place_m(self, evidence: Evidence) -> F64:
        """Return the centre (V, 3) in every view."""
        return np.asarray(self.centre_m + self.path_m + self.offset_m[evidence.sensor] + self.shift_m)


@dataclass(frozen=True, slots=True, eq=False)
class _Residuals:
    """Distances of the points from the surface (V, M), their weights, and how they change with the unknowns."""

    distance: F64
    weight: F64
    by_shape: F64
    by_shift: F64
    along: F64
    chi2: F64
    view_weight: F64


def start(evidence: Evidence, path_m: F64) -> Fit:
    """Return a ball of the height seen, where the views' centres are, before anything is fitted."""
    views, sensors = len(evidence.points_m), len(evidence.sensors)
    centre = np.median(evidence.centre_m - path_m, axis=0)
    centre[2] = 0.5 * evidence.height_m
    return Fit(
        shape=ball(max(0.5 * evidence.height_m, 5e-3)),
        body=np.eye(3),
        centre_m=centre,
        path_m=path_m,
        offset_m=np.zeros((sensors, 3)),
        shift_m=np.zeros((views, 3)),
        along_m=np.zeros(evidence.used.shape),
        covariance=np.zeros((6, 6)),
        chi2=1.0,
        residual_m=np.zeros(views),
        weight=np.ones(views),
    )


def improve(fit: Fit, evidence: Evidence, prior: Prior, steps: int) -> Fit:
    """Return the fit after some Gauss–Newton steps."""
    for _ in range(steps):
        fit = _step(fit, evidence, prior)
    return fit


def _step(fit: Fit, evidence: Evidence, prior: Prior) -> Fit:
    seen = _residuals(fit, evidence)
    H, b, back = _normal_equations(fit, evidence, seen, prior)
    unknowns = -np.linalg.solve(H, b)
    count = 6 + len(fit.shape.weights)
    unknowns[:6] *= min(1.0, 0.35 / max(float(np.abs(unknowns[:6]).max()), 1e-9))
    sensors = unknowns[count + 3 :].reshape(-1, 3)
    E, C, b_shift = back
    coupled = np.einsum("vgd,g->vd", C, unknowns[:count]) + np.einsum(
        "vde,ve->vd", _shift_information(seen), unknowns[count : count + 3] + sensors[evidence.sensor]
    )
    shift = -np.einsum("vde,ve->vd", E, b_shift + coupled)
    normalised = float(np.average(seen.chi2, weights=seen.view_weight + 1e-9))
    return replace(
        fit,
        shape=_stretched(fit.shape, fit.body, unknowns[:6], unknowns[6:count]),
        centre_m=fit.centre_m + unknowns[count : count + 3],
        offset_m=fit.offset_m + sensors,
        shift_m=fit.shift_m + shift,
        along_m=seen.along,
        covariance=np.linalg.inv(H)[:count, :count] * max(1.0, normalised),
        chi2=normalised,
        residual_m=np.sqrt(
            np.sum(seen.distance**2 * evidence.used, axis=1) / np.maximum(evidence.used.sum(axis=1), 1)
        ),
        weight=seen.view_weight,
    )


def _stretched(shape: Shape, body: F64, stretch: F64, weights: F64) -> Shape:
    """Return the shape with A ← (1 − S)·A, kept symmetric in the body's frame, and more weight on g."""
    moved = np.linalg.solve(np.eye(3) + symmetric(stretch), shape.matrix @ body)
    values, vectors = np.linalg.eigh(moved.T @ moved)
    root = (vectors * np.sqrt(values)) @ vectors.T
    return Shape(root @ body.T, shape.weights + weights, shape.degree)


def symmetric(six: F64) -> F64:
    """Return the symmetric (3, 3) matrix of six entries in the order of `SIX`."""
    S = np.empty((3, 3))
    for value, (i, j) in zip(six, SIX, strict=True):
        S[i, j] = S[j, i] = value
    return S


def _residuals(fit: Fit, evidence: Evidence) -> _Residuals:
    """Linearise about where each point's sight meets the surface.

    The noise lies along the sight. Taken at the noisy point itself, slopes and
    weights would go with the noise and pull the surface inwards by σ²-terms
    (millimetres at 1 m).
    """
    p = evidence.points_m - fit.place_m(evidence)[:, None, :] + fit.along_m[..., None] * evidence.sight
    views, count = p.shape[:2]
    q = p.reshape(-1, 3) @ fit.shape.matrix.T
    rho = np.sqrt(np.einsum("nd,nd->n", q, q))
    u = q / rho[:, None]
    level, slope, harmonics = _dent(fit.shape, u)
    outward = u - slope
    gradient = outward @ fit.shape.matrix / rho[:, None]
    steep = np.sqrt(np.einsum("nd,nd->n", gradient, gradient))
    normal = gradient / steep[:, None]
    distance = (np.log(rho) - level) / steep
    by_shape = np.empty((len(u), 6 + harmonics.shape[1]))
    for k, (i, j) in enumerate(SIX):
        by_shape[:, k] = outward[:, i] * u[:, j] if i == j else outward[:, i] * u[:, j] + outward[:, j] * u[:, i]
    by_shape[:, 6:] = harmonics
    by_shape /= -steep[:, None]
    normal = normal.reshape(views, count, 3)
    facing = -np.einsum("vmd,vmd->vm", evidence.sight, normal)
    distance = distance.reshape(views, count) + fit.along_m * facing
    weight, chi2, view_weight = _weights(distance, facing, evidence)
    along = np.clip(distance / np.maximum(facing, 0.15), -FARTHEST_M, FARTHEST_M)
    return _Residuals(distance, weight, by_shape.reshape(views, count, -1), -normal, along, chi2, view_weight)


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


def _weights(distance: F64, facing: F64, evidence: Evidence) -> tuple[F64, F64, F64]:
    """Return weights (V, M) in 1/m², and for each view its mean normalised square and its own weight (V,)."""
    variance = (evidence.depth_sigma_m * facing) ** 2 + (0.5 * evidence.pixel_m) ** 2 + FLOOR_SIGMA_M**2
    normalised = distance**2 / variance
    student = (FREEDOM + 1.0) / (FREEDOM + normalised)
    trusted = evidence.used * np.clip((facing - 0.05) / 0.2, 0.0, 1.0)
    chi2 = np.sum(normalised * student * trusted, axis=1) / np.maximum(trusted.sum(axis=1), 1e-9)
    usual = max(float(np.median(chi2)), 0.3)
    view_weight = np.minimum(1.0, (2.5 * usual / np.maximum(chi2, 1e-9)) ** 2)
    return student * trusted * view_weight[:, None] / variance, chi2, view_weight


def _shift_information(seen: _Residuals) -> F64:
    weighted = seen.by_shift * seen.weight[..., None]
    return np.asarray(np.matmul(weighted.transpose(0, 2, 1), seen.by_shift))


def _normal_equations(
    fit: Fit, evidence: Evidence, seen: _Residuals, prior: Prior
) -> tuple[F64, F64, tuple[F64, F64, F64]]:
    """Return the matrix and gradient over [shape, centre, sensors], the views' shifts eliminated."""
    views, points, count = seen.by_shape.shape
    weighted = seen.by_shape * seen.weight[..., None]
    flat = weighted.reshape(-1, count)
    D = _shift_information(seen)
    C = np.matmul(weighted.transpose(0, 2, 1), seen.by_shift)
    b_view = np.einsum("vmd,vm->vd", seen.by_shift, seen.weight * seen.distance)
    E = np.linalg.inv(D + np.diag(prior.shift_information))
    b_shift = b_view + prior.shift_information * fit.shift_m
    CE, DE = np.matmul(C, E), np.matmul(D, E)
    C_left = C - np.matmul(CE, D)
    D_left = D - np.matmul(DE, D)
    b_left = b_view - np.einsum("vde,ve->vd", DE, b_shift)
    sensors = len(evidence.sensors)
    size = count + 3 + 3 * sensors
    H, b = np.zeros((size, size)), np.zeros(size)
    H[:count, :count] = flat.T @ seen.by_shape.reshape(-1, count) - np.tensordot(CE, C, axes=([0, 2], [0, 2]))
    b[:count] = seen.distance.reshape(-1) @ flat - np.einsum("vgd,vd->g", CE, b_shift)
    for k in range(sensors):
        mine = evidence.sensor == k
        here = slice(count + 3 + 3 * k, count + 6 + 3 * k)
        H[:count, here] = C_left[mine].sum(axis=0)
        H[here, here] = D_left[mine].sum(axis=0)
        H[count : count + 3, here] = H[here, here]
        b[here] = b_left[mine].sum(axis=0)
        H[:count, count : count + 3] += H[:count, here]
        H[count : count + 3, count : count + 3] += H[here, here]
        b[count : count + 3] += b[here]
        information = prior.sensor_information(evidence.offset_sigma_m[k])
        H[here, here] += np.diag(information)
        b[here] += information * fit.offset_m[k]
    lower = np.tril_indices(size, -1)
    H[lower] = H.T[lower]
    prior.add(H, b, fit.shape, fit.body)
    _add_contact(H, b, fit)
    return H, b, (E, C, b_shift)


def _add_contact(H: F64, b: F64, fit: Fit) -> None:
    """Add what the belt says: the fruit's lowest point lies on it."""
    from fruitgui.measurement.callipers import support_change

    surface = fit.shape.surface_m()
    lowest = int(np.argmin(surface[:, 2]))
    gap = fit.centre_m[2] + surface[lowest, 2]
    count = 6 + len(fit.shape.weights)
    row = np.zeros(len(b))
    row[:count] = support_change(fit.shape, lowest, np.array([0.0, 0.0, 1.0]))
    row[count + 2] = 1.0
    information = 1.0 / CONTACT_SIGMA_M**2
    H += information * np.outer(row, row)
    b += information * row * gap


__all__ = ["Fit", "improve", "shape_prior", "start", "symmetric"]
