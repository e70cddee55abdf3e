"""One closed surface through all views of a fruit, the views shifted onto it, all in one least-squares problem.

The unknowns are the surface (an ellipsoid and harmonics upon it), the fruit's
centre over the belt, one common shift and the edge fattening of each sensor
(what is left of depth bias, pose error and how far its outlines lie), and one
small shift and turn for each view (what the belt's motion does not explain).
Every one has a prior as wide as physics says, so where the views decide they
decide, and what nobody saw is what fruit usually are: round about one axis,
smooth, and standing on the belt. Gauss–Newton with the views' own unknowns
eliminated (Schur complement); Student weights against samples that lie.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from fruitgui.frame import F64
from fruitgui.geometry.rotation import rotation_from_vector
from fruitgui.measurement.evidence import Evidence
from fruitgui.measurement.harmonics import Real
from fruitgui.measurement.prior import Prior
from fruitgui.measurement.residuals import PER_SENSOR, Residuals, residuals
from fruitgui.measurement.shape import SIX, Shape
from fruitgui.measurement.state import State

CONTACT_SIGMA_M = 0.7e-3
"""How far a fruit's lowest point may seem to be from the belt: flatness of the belt and of the fitted plane."""

ANYWHERE_M = 0.3
"""How far the centre may be from where it was: nothing, but enough when all else fails."""

LEAST_CHI2 = 0.6
"""Covariances follow the residuals, but not below this: residuals lower than the physics say are partly luck."""

LEAST_VIEW_WEIGHT = 0.2
"""A view that counts less than this tells of something else."""

LONGEST_STEP = 0.35
"""Most that one step changes the logarithm of an axis."""


@dataclass(frozen=True, slots=True, eq=False)
class Fit:
    """A surface through all views, and how sure it is.

    Attributes:
        state: the unknowns.
        covariance: (6 + K, 6 + K) of the stretch and the harmonics' weights, scaled by the residuals.
        edge_covariance: (S, 6 + K + S) of each sensor's mean fattening, pixels, with those and with each other.
        chi2: (V,) mean square of each view's normalised residuals: one where the noise is as the physics says.
        view_weight: (V,) how much each view counted, 0–1.
        sight: (V, 3) unit vectors from the sensor to the fruit, as it lies, of the views that counted.
    """

    state: State
    covariance: F64
    edge_covariance: F64
    chi2: F64
    view_weight: F64
    sight: F64


@dataclass(frozen=True, slots=True, eq=False)
class _System:
    """Normal equations over [shape, centre, sensors], and what gives the views' own unknowns back."""

    H: F64
    b: F64
    inverse: F64
    coupling: F64
    b_view: F64


def improve(state: State, evidence: Evidence, prior: Prior, steps: int) -> Fit:
    """Return the fit after some Gauss–Newton steps."""
    for _ in range(steps):
        seen = residuals(state, evidence, turning=len(prior.view_information) == 6)
        system = _normal_equations(state, evidence, seen, prior)
        unknowns = -np.asarray(np.linalg.solve(system.H, system.b), dtype=np.float64)
        state = _moved(state, unknowns, seen, system)
    count = 6 + len(state.shape.weights)
    usual = max(LEAST_CHI2, float(np.average(seen.chi2, weights=seen.view_weight + 1e-9)))
    sight = np.matmul(state.turn, evidence.sight[:, : evidence.points].mean(axis=1)[..., None])[..., 0]
    counted = seen.view_weight > LEAST_VIEW_WEIGHT
    covariance = np.asarray(np.linalg.inv(system.H), dtype=np.float64) * usual
    sensors = np.arange(len(evidence.sensors))
    means = np.zeros((len(sensors), len(covariance)))
    for axis in (3, 4):
        means[sensors, count + 3 + PER_SENSOR * sensors + axis] = 0.5
    with_edges = means @ covariance
    edge_covariance = np.hstack([with_edges[:, :count], with_edges @ means.T])
    return Fit(state, covariance[:count, :count], edge_covariance, seen.chi2, seen.view_weight, sight[counted])


def _moved(state: State, unknowns: F64, seen: Residuals, system: _System) -> State:
    count = 6 + len(state.shape.weights)
    stretch = unknowns[:6] * min(1.0, LONGEST_STEP / max(float(np.abs(unknowns[:6]).max()), 1e-9))
    sensors = unknowns[count + 3 :].reshape(-1, PER_SENSOR)
    pull = system.b_view + (unknowns @ system.coupling).reshape(system.b_view.shape)
    local = -np.matmul(system.inverse, pull[..., None])[..., 0]
    turn, turned = state.turn, state.turned
    if local.shape[1] == 6:
        turned = True
        turns = np.stack([rotation_from_vector(np.clip(w, -0.15, 0.15)) for w in local[:, 3:]])
        turn = np.matmul(turns, turn)
    return replace(
        state,
        shape=_stretched(state.shape, state.body, stretch, unknowns[6:count]),
        centre_m=state.centre_m + unknowns[count : count + 3],
        offset_m=state.offset_m + sensors[:, :3],
        edge_px=state.edge_px + sensors[:, 3:],
        shift_m=state.shift_m + local[:, :3],
        turn=turn,
        turned=turned,
        along_m=seen.along,
    )


def _stretched(shape: Shape, body: F64, stretch: F64, weights: F64) -> Shape:
    """Return the shape with A ← (1 + S)⁻¹·A, kept symmetric in the body's frame, and more weight on g."""
    S = np.empty((3, 3))
    for value, (i, j) in zip(stretch, SIX, strict=True):
        S[i, j] = S[j, i] = value
    moved = np.linalg.solve(np.eye(3) + S, shape.matrix @ body)
    values, vectors = np.linalg.eigh(moved.T @ moved)
    root = (vectors * np.sqrt(values)) @ vectors.T
    return Shape(root @ body.T, shape.weights + weights, shape.degree)


def _normal_equations(state: State, evidence: Evidence, seen: Residuals, prior: Prior) -> _System:
    """Build the equations over [shape, centre, sensors] and eliminate the views' own unknowns."""
    J, local = seen.by_common, seen.by_view
    count = 6 + len(state.shape.weights)
    weight = seen.weight.astype(np.float32)
    pull = (seen.weight * seen.distance).astype(np.float32)
    weighted, by_view = J * weight, local.transpose(1, 2, 0)
    coupled = np.matmul(weighted.transpose(1, 0, 2), by_view).astype(np.float64)
    D = np.matmul((local * weight).transpose(1, 0, 2), by_view)
    b_view = np.matmul(local.transpose(1, 0, 2), pull[..., None])[..., 0].astype(np.float64)
    b_view[:, :3] += prior.view_information[:3] * state.shift_m
    if len(local) == 6:
        b_view[:, 3:] += prior.view_information[3:] * _turned(state.turn)
    inverse = np.linalg.inv(D + np.diag(prior.view_information))
    left, coupling = _rows(np.matmul(coupled, inverse).transpose(1, 0, 2)), _rows(coupled.transpose(1, 0, 2))
    H = _rows(weighted) @ _rows(J).T - left @ coupling.T
    b = _rows(J) @ pull.reshape(-1) - left @ b_view.reshape(-1)
    for k, sigma_m in enumerate(evidence.offset_sigma_m.tolist()):
        here = slice(count + 3 + PER_SENSOR * k, count + 3 + PER_SENSOR * (k + 1))
        information, drawn = prior.of_sensor(sigma_m, state.offset_m[k], state.edge_px[k])
        H[here, here] += information
        b[here] += drawn
    centre = slice(count, count + 3)
    H[centre, centre] += np.eye(3) / ANYWHERE_M**2
    prior.add(H, b, state.shape, state.body)
    _add_contact(H, b, state)
    return _System(H, b, inverse, coupling, b_view)


def _rows(values: Real) -> Real:
    """Return values (C, …) as (C, N)."""
    return values.reshape(len(values), -1)


def _turned(turn: F64) -> F64:
    """Return the rotation vectors (V, 3) of small rotations (V, 3, 3), to first order."""
    return 0.5 * np.stack(
        [turn[:, 2, 1] - turn[:, 1, 2], turn[:, 0, 2] - turn[:, 2, 0], turn[:, 1, 0] - turn[:, 0, 1]], axis=1
    )


def _add_contact(H: F64, b: F64, state: State) -> None:
    """Add what the belt says: the fruit's lowest point lies on it."""
    surface = state.shape.surface()
    lowest = int(np.argmin(surface.points_m[:, 2]))
    gap = state.centre_m[2] + surface.points_m[lowest, 2]
    count = 6 + len(state.shape.weights)
    row = np.zeros(len(b))
    row[:count] = surface.change(lowest, np.array([0.0, 0.0, 1.0]))[0]
    row[count + 2] = 1.0
    information = 1.0 / CONTACT_SIGMA_M**2
    H += information * np.outer(row, row)
    b += information * row * gap
