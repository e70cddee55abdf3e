"""How far the ends of a long fruit reach beyond the smooth surface: nipples of lemons, tips of necks.

Harmonics of low degree round such ends off by some millimetres, which is
nothing in volume and much in length. The outlines show them. What fattening
and raggedness do to outlines they do across the fruit too, so only the
difference between how outlines exceed the surface along the fruit and across
it counts.
"""

from __future__ import annotations

import numpy as np

from fruitgui.frame import F64, Bools
from fruitgui.geometry.rig import Rig
from fruitgui.measurement.callipers import length_and_diameter
from fruitgui.measurement.evidence import Evidence
from fruitgui.measurement.fit import Fit
from fruitgui.measurement.residuals import LOW_M
from fruitgui.measurement.samples import evenly, own_places, sights
from fruitgui.tracking.track import Track

LONG = 1.12
"""Length over diameter from which a fruit has ends."""

PLACES = 120
"""Places of an outline that are looked at: two pixels apart at most, which loses a tenth of one at an end."""

MOST_VIEWS = 14
LEAST_VIEWS = 5
"""Outlines looked at, and how many must show an end."""

SIDEWAYS = 0.7
"""Sine of the angle between sight and direction from which an outline shows the extent in that direction."""

LARGEST_SHARE = 0.12
"""No end reaches farther beyond the surface, as a share of the length."""


def excess_m(fit: Fit, evidence: Evidence, track: Track, rig: Rig) -> float:
    """Return how much longer the outlines are than the surface, metres; zero where too few show it.

    Args:
        fit: of the surface.
        evidence: on which it was fitted.
        track: whose outlines are looked at.
        rig: the sensors.
    """
    surface = fit.state.shape.surface()
    surface_m = surface.points_m
    length, diameter = length_and_diameter(surface)
    if length.direction is None or diameter.direction is None:
        return 0.0
    along, across = length.direction, diameter.direction
    found = _exceeding(fit, evidence, track, rig, np.stack([along, -along, across, -across]), surface_m)
    if (np.isfinite(found).sum(axis=0) < LEAST_VIEWS).any():
        return 0.0
    ends = np.nanmedian(found, axis=0)
    limit = LARGEST_SHARE * float(np.ptp(surface_m @ along))
    return float(np.clip(ends[0] + ends[1] - ends[2] - ends[3], -limit, limit))


def _exceeding(fit: Fit, evidence: Evidence, track: Track, rig: Rig, directions: F64, surface_m: F64) -> F64:
    """Return how far each outline exceeds the surface along each direction, (V, 4); NaN where it does not show."""
    views = evidence.views_of(track)
    good = [k for k, view in enumerate(views) if len(view.outline_px) >= 8 and fit.view_weight[k] > 0.5]
    chosen = good[:: max(1, len(good) // MOST_VIEWS)]
    if not chosen:
        return np.full((0, len(directions)), np.nan)
    sight, own = np.empty((len(chosen), PLACES, 3)), np.empty((len(chosen), PLACES), dtype=bool)
    for row, k in enumerate(chosen):
        around = evenly(len(views[k].outline_px), PLACES)
        axes = evidence.axes[evidence.sensor[k]]
        sight[row] = sights(views[k].outline_px[around], rig.mounts[views[k].sensor].intrinsics) @ axes[:2] + axes[2]
        own[row] = own_places(views[k])[around]
    sight /= np.sqrt((sight * sight).sum(axis=2, keepdims=True))
    place, turn = fit.state.place_m(evidence)[chosen], fit.state.turn[chosen]
    middle = (place - evidence.sensor_place_m[evidence.sensor[chosen]])[:, None]
    offset = (sight * middle).sum(axis=2, keepdims=True) * sight - middle
    return _beyond(offset, sight, own, directions @ turn, turn, surface_m, place[:, 2:])


def _beyond(offset: F64, sight: F64, own: Bools, directions: F64, turn: F64, surface_m: F64, height_m: F64) -> F64:
    """Return the excess (C, 4) of outlines whose sights (C, P, 3) pass the centre by `offset` (C, P, 3)."""
    reach = np.matmul(directions, offset.transpose(0, 2, 1))
    extreme = reach.argmax(axis=2)
    row = np.arange(len(offset))[:, None]
    toward, passing = sight[row, extreme], offset[row, extreme]
    flat = directions - (directions * toward).sum(axis=2, keepdims=True) * toward
    sine = np.sqrt((flat * flat).sum(axis=2))
    flat /= np.maximum(sine, SIDEWAYS)[..., None]
    surface_reach = (np.matmul(flat, turn.transpose(0, 2, 1)) @ surface_m.T).max(axis=2)
    shown = own[row, extreme] & (sine >= SIDEWAYS) & (height_m + passing[..., 2] >= LOW_M)
    return np.where(shown, (passing * flat).sum(axis=2) - surface_reach, np.nan)
