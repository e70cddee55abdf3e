"""From a track to the size of its fruit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from fruitgui.frame import F64
from fruitgui.geometry.rig import Rig
from fruitgui.measurement.callipers import Extent, length_and_diameter, perimeter, volume
from fruitgui.measurement.evidence import Evidence, gather
from fruitgui.measurement.fit import Fit, improve
from fruitgui.measurement.fruit import Quantity, Size
from fruitgui.measurement.harmonics import basis
from fruitgui.measurement.path import carried
from fruitgui.measurement.prior import FATTENING_PX, shape_prior
from fruitgui.measurement.shape import Shape
from fruitgui.measurement.state import State, first_state
from fruitgui.tracking.track import Track

DEGREE = 6
THIN, STEPS0, STEPS = 2, 5, 4


def measure(track: Track, rig: Rig) -> Size | None:
    """Return the size of a fruit from all its views together; None where no view has points enough."""
    evidence = gather(track, rig)
    if evidence is None:
        return None
    fit = fit_surface(evidence, rig.belt_frame().turn(track.velocity_m_s))
    return size_of(fit)


def fit_surface(evidence: Evidence, velocity_m_s: F64, degree: int | None = None) -> Fit:
    """Return the closed surface through all views, coarse to fine: ball, ellipsoid, harmonics."""
    degree = DEGREE if degree is None else degree
    path, _ = carried(evidence, evidence.centre_m, velocity_m_s, degree=1)
    few = evidence.thinned(THIN)
    state = improve(first_state(few, path, FATTENING_PX), few, shape_prior(0, 4e-3, axis_known=False), STEPS0).state
    state = _upon_axes(_along_path(state, evidence, velocity_m_s, 3), degree)
    state = replace(state, along_m=np.zeros(evidence.used.shape))
    return improve(state, evidence, shape_prior(degree, 1.5e-3, axis_known=True), STEPS)


def _along_path(state: State, evidence: Evidence, velocity_m_s: F64, degree: int) -> State:
    """Return the state with the path drawn anew through where the views now are."""
    place = state.place_m(evidence)
    path, _ = carried(evidence, place, velocity_m_s, degree)
    centre = state.centre_m.copy()
    centre[:2] = np.median(place - path, axis=0)[:2]
    left = place - centre - path - state.offset_m[evidence.sensor]
    return replace(state, centre_m=centre, path_m=path, shift_m=left)


def _upon_axes(state: State, degree: int) -> State:
    """Return the state in the frame of its ellipsoid's axes, z the axis of revolution, with room for harmonics."""
    values, vectors = np.linalg.eigh(state.shape.matrix.T @ state.shape.matrix)
    logs = np.log(values)
    order = [0, 1, 2] if logs[2] - logs[1] > logs[1] - logs[0] else [1, 2, 0]
    body = vectors[:, order]
    body[:, 2] *= np.sign(np.linalg.det(body))
    weights = np.zeros(len(basis(degree).degree)) if degree >= 3 else np.zeros(0)
    return replace(state, body=body, shape=Shape(np.diag(np.sqrt(values[order])) @ body.T, weights, degree))


def size_of(fit: Fit) -> Size:
    """Return the sizes of a fitted surface, each with its standard deviation."""
    surface = fit.state.shape.surface()
    length, diameter = length_and_diameter(surface)
    return Size(
        volume_m3=_quantity(volume(surface), fit),
        length_m=_quantity(length, fit),
        diameter_m=_quantity(diameter, fit),
        perimeter_m=_quantity(perimeter(surface), fit),
        coverage=0.0,
    )


def _quantity(extent: Extent, fit: Fit) -> Quantity:
    return Quantity(extent.value, float(np.sqrt(extent.gradient @ fit.covariance @ extent.gradient)))
