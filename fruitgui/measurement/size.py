"""From a track to the size of its fruit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from fruitgui.geometry.rig import Rig
from fruitgui.measurement.callipers import Extent, length_and_diameter, perimeter, volume
from fruitgui.measurement.evidence import Evidence, gather
from fruitgui.measurement.fit import Fit, improve
from fruitgui.measurement.fruit import Edges, Quantity, Size
from fruitgui.measurement.harmonics import basis
from fruitgui.measurement.path import carried
from fruitgui.measurement.prior import FATTENING_PX, shape_prior
from fruitgui.measurement.restless import TURN_SIGMA_RAD, is_restless
from fruitgui.measurement.rough import rough_size
from fruitgui.measurement.shape import Shape, Surface
from fruitgui.measurement.state import State, first_state
from fruitgui.measurement.tips import LONG, excess_m
from fruitgui.tracking.track import Track

DEGREE = 6
"""Highest degree of the harmonics: necks, hollows and shoulders; finer things hold no volume."""

THIN, COARSE_STEPS, FINE_STEPS = 2, 4, 4
"""The ellipsoid takes every second sample; fewer steps than these leave the length 0.5 mm worse, more gain nothing."""

SEEN_COSINE = 0.35
"""A surface is seen where it faces a sensor at least so much; beyond, its points lie at the picture's edge."""

SYSTEMATIC = 0.005
"""What no number of views averages out: the device's own scale, the plane of the belt."""

END_SIGMA_M = 1.0e-3
"""How well the two ends of a long fruit are known together: half a pixel at 1 m."""

LONG_FOR_FRUIT_M, OVERSHOOT = 0.14, 1.6
"""A surface longer than fruit mostly are, and so much longer than its outlines, grew where nobody saw it."""

LARGEST_M = 0.6
"""No surface longer than this is a fruit's: the fit went wrong."""

DENIED = 5.0
"""Standard deviations of a sensor's shift along the belt beyond which its views are of something else, or elsewhere."""

COARSE, FINE = 4e-3, 1.5e-3
"""Standard deviation of a view's own shift along the belt before and after its path is known, metres."""


def measure(track: Track, rig: Rig) -> Size:
    """Return the size of a fruit from all its views together.

    There always is one: where the views hold too few points for a surface, it
    comes from outlines and heights alone, with a wide standard deviation.
    """
    fitted = _fitted(track, rig)
    if fitted is None:
        return rough_size(track, rig)
    evidence, fit = fitted
    size = replace(size_of(fit, evidence.sensors), spoilt=float(evidence.spoilt.mean()))
    if size.length_m.value > LONG_FOR_FRUIT_M:
        rough = rough_size(track, rig)
        if size.length_m.value > OVERSHOOT * rough.length_m.value:
            return rough
    return _with_ends(size, fit, evidence, track, rig)


def _fitted(track: Track, rig: Rig) -> tuple[Evidence, Fit] | None:
    """Return the surface and the views that it goes through: all of them, or those of one sensor that others deny."""
    evidence = gather(track, rig)
    fit = None if evidence is None else _sound_fit(evidence)
    if evidence is None or fit is None:
        return None
    return _undenied(fit, evidence)


def _undenied(fit: Fit, evidence: Evidence) -> tuple[Evidence, Fit]:
    """Return a fit and its views, or those of the sensor with most views where the others deny what it sees.

    A surface that is large enough goes through a fruit in two places, and leaves no residuals that tell. The places do:
    beside how the belt carried it, no sensor sees a fruit elsewhere by more than its pose is unsure.
    """
    if _apart_m(fit, evidence) < DENIED * evidence.offset_sigma_m.max():
        return evidence, fit
    alone = evidence.seen_by(int(np.bincount(evidence.sensor).argmax()))
    fit_alone = _sound_fit(alone)
    return (evidence, fit) if fit_alone is None else (alone, fit_alone)


def _apart_m(fit: Fit, evidence: Evidence) -> float:
    """Return how far apart sensors see the fruit, beside how the belt carried it."""
    left_m = (fit.state.place_m(evidence) - evidence.way_m)[:, :2]
    means_m = np.array([left_m[evidence.sensor == sensor].mean(axis=0) for sensor in np.unique(evidence.sensor)])
    return float(np.linalg.norm(means_m[:, None] - means_m[None], axis=2).max())


def _sound_fit(evidence: Evidence) -> Fit | None:
    try:
        fit = fit_surface(evidence)
    except np.linalg.LinAlgError:
        return None
    return fit if _is_sound(fit) else None


def _with_ends(size: Size, fit: Fit, evidence: Evidence, track: Track, rig: Rig) -> Size:
    """Return the size with the length to the tips of a long fruit, where its outlines show them."""
    if size.length_m.value < LONG * size.diameter_m.value:
        return size
    longer = excess_m(fit, evidence, track, rig)
    length = Quantity(
        size.length_m.value + longer, float(np.linalg.norm([size.length_m.std, 0.3 * longer, END_SIGMA_M]))
    )
    return replace(size, length_m=length)


def _is_sound(fit: Fit) -> bool:
    reach = np.abs(fit.state.shape.surface().points_m).max()
    return bool(np.isfinite(fit.covariance).all() and reach < LARGEST_M / 2.0 and (np.diag(fit.covariance) > 0.0).all())


def fit_surface(evidence: Evidence) -> Fit:
    """Return the closed surface through all views, belt frame, coarse to fine: ball, ellipsoid, harmonics."""
    radius = max(0.5 * evidence.height_m, 2e-3)
    path, _ = carried(evidence, evidence.centre_m, degree=1)
    few = evidence.thinned(THIN)
    prior = shape_prior(0, COARSE, radius, axis_known=False)
    state = improve(first_state(few, path, FATTENING_PX), few, prior, COARSE_STEPS).state
    prior = shape_prior(DEGREE, FINE, radius, axis_known=True)
    state = _upon_axes(_along_path(state, evidence, 3))
    fit = improve(replace(state, along_m=np.zeros(evidence.used.shape)), evidence, prior, FINE_STEPS)
    if not is_restless(fit.state, evidence, prior):
        return fit
    turning = shape_prior(DEGREE, FINE, radius, axis_known=True, turn_sigma_rad=TURN_SIGMA_RAD)
    return improve(fit.state, evidence, turning, FINE_STEPS)


def _along_path(state: State, evidence: Evidence, degree: int) -> State:
    """Return the state with the path drawn anew through where the views now are."""
    place = state.place_m(evidence)
    path, _ = carried(evidence, place, degree)
    centre = state.centre_m.copy()
    centre[:2] = np.median(place - path, axis=0)[:2]
    left = place - centre - path - state.offset_m[evidence.sensor]
    return replace(state, centre_m=centre, path_m=path, shift_m=left)


def _upon_axes(state: State) -> State:
    """Return the state in the frame of its ellipsoid's axes, z the axis of revolution, with room for harmonics."""
    values, vectors = np.linalg.eigh(state.shape.matrix.T @ state.shape.matrix)
    logs = np.log(values)
    order = [0, 1, 2] if logs[2] - logs[1] > logs[1] - logs[0] else [1, 2, 0]
    body = vectors[:, order]
    body[:, 2] *= np.sign(np.linalg.det(body))
    weights = np.zeros(len(basis(DEGREE).degree))
    return replace(state, body=body, shape=Shape(np.diag(np.sqrt(values[order])) @ body.T, weights, DEGREE))


def size_of(fit: Fit, sensors: tuple[str, ...]) -> Size:
    """Return the sizes of a surface fitted to these sensors' views, each with its standard deviation."""
    surface = fit.state.shape.surface()
    length, diameter = length_and_diameter(surface)
    content, around = volume(surface), perimeter(surface)
    lengths = np.stack([one.gradient for one in (length, diameter, around)])
    count = len(content.gradient)
    edges = Edges(
        sensors,
        fit.state.edge_px.mean(axis=1),
        fit.edge_covariance[:, count:],
        fit.edge_covariance[:, :count] @ content.gradient / content.value,
        lengths @ fit.edge_covariance[:, :count].T,
    )
    return Size(
        volume_m3=_quantity(content, fit),
        length_m=_quantity(length, fit),
        diameter_m=_quantity(diameter, fit),
        perimeter_m=_quantity(around, fit),
        coverage=_coverage(fit, surface),
        edges=edges,
        with_volume_m=lengths @ fit.covariance @ content.gradient / content.value,
    )


def _coverage(fit: Fit, surface: Surface) -> float:
    """Return the share of directions from the centre in which some view saw the surface not too slanted."""
    outward = surface.points_m @ fit.state.shape.matrix.T @ fit.state.shape.matrix
    outward /= np.linalg.norm(outward, axis=1, keepdims=True)
    seen = (outward @ fit.sight.T < -SEEN_COSINE).any(axis=1)
    return float(seen.mean())


def _quantity(extent: Extent, fit: Fit) -> Quantity:
    variance = float(extent.gradient @ fit.covariance @ extent.gradient)
    return Quantity(extent.value, float(np.sqrt(variance + (SYSTEMATIC * extent.value) ** 2)))
