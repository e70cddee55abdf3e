"""How far the ends of a long fruit reach beyond the smooth surface: nipples of lemons, tips of necks.

Harmonics of low degree round such ends off by some millimetres, which is
nothing in volume and much in length. The outlines show them. What fattening
and raggedness do to outlines they do across the fruit too, so only the
difference between how outlines exceed the surface along the fruit and across
it counts.
"""

from __future__ import annotations

import numpy as np

from fruitgui.frame import F64
from fruitgui.geometry.rig import Rig
from fruitgui.measurement.callipers import length_and_diameter
from fruitgui.measurement.evidence import Evidence
from fruitgui.measurement.fit import Fit
from fruitgui.measurement.residuals import LOW_M
from fruitgui.tracking.track import Track

LONG = 1.12
"""Length over diameter from which a fruit has ends."""

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
    place = fit.state.place_m(evidence)
    views = evidence.views_of(track)
    good = [
        k
        for k, view in enumerate(views)
        if view.whole and not view.shared and len(view.outline_px) >= 8 and fit.view_weight[k] > 0.5
    ]
    chosen = good[:: max(1, len(good) // MOST_VIEWS)]
    found = np.full((len(chosen), len(directions)), np.nan)
    for row, k in enumerate(chosen):
        camera = rig.mounts[views[k].sensor].intrinsics
        u, v = np.rint(views[k].outline_px).astype(np.intp).T
        rays = camera.rays()[np.clip(v, 0, camera.height - 1), np.clip(u, 0, camera.width - 1)]
        axes = evidence.axes[evidence.sensor[k]]
        sight = rays @ axes[:2] + axes[2]
        sight /= np.sqrt((sight * sight).sum(axis=1, keepdims=True))
        middle = place[k] - evidence.sensor_place_m[evidence.sensor[k]]
        offset = (sight @ middle)[:, None] * sight - middle
        turn = fit.state.turn[k]
        found[row] = _beyond(offset, sight, directions @ turn, surface_m @ turn, float(place[k, 2]))
    return found


def _beyond(offset: F64, sight: F64, directions: F64, surface_m: F64, height_m: float) -> F64:
    """Return the excess (4,) of one outline: rays pass the centre by `offset` (N, 3) with directions `sight`."""
    extreme = (directions @ offset.T).argmax(axis=1)
    toward = sight[extreme]
    flat = directions - (directions * toward).sum(axis=1, keepdims=True) * toward
    sine = np.sqrt((flat * flat).sum(axis=1))
    flat /= np.maximum(sine, SIDEWAYS)[:, None]
    beyond = (offset[extreme] * flat).sum(axis=1) - (flat @ surface_m.T).max(axis=1)
    shown = (sine >= SIDEWAYS) & (height_m + offset[extreme, 2] >= LOW_M)
    return np.where(shown, beyond, np.nan)
