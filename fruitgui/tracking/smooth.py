"""The path of a finished fruit, from all its sightings at once.

Gaussian-process regression (Rasmussen & Williams 2006, eq. 2.22-2.24): the
prior is the belt's displacement plus a slip whose velocity fades, the noise is
that of the captures, correlated through each sensor's pose error and through
the part of a centre's error that stays with the side a sensor looks at.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fruitgui.frame import F64
from fruitgui.geometry.rig import Rig
from fruitgui.tracking.consider import pose_covariance, pose_jacobians
from fruitgui.tracking.settings import TrackerSettings
from fruitgui.tracking.track import PathPoint
from fruitgui.tracking.trail import Entry

ANYWHERE_M = 0.5
BELT_JITTER_M = 0.001
"""What the followed belt's displacement is uncertain by from capture to capture."""


def smoothed_path(entries: Sequence[Entry], rig: Rig, settings: TrackerSettings) -> tuple[PathPoint, ...]:
    """Return the fruit's position with covariance at each of the entries, in their order."""
    from scipy.linalg import cholesky, solve_triangular

    m = len(entries)
    y = np.array([entry.position_m for entry in entries])
    travelled = np.array([entry.travelled_m for entry in entries])
    prior = _slip_covariance(np.array([entry.time_s for entry in entries]), settings)
    K = np.kron(prior, np.eye(3))
    start = np.median(y - travelled, axis=0)
    L = cholesky(K + _noise(entries, y, rig, settings), lower=True, check_finite=False)
    both = np.column_stack([K, (y - travelled - start).ravel()])
    both = solve_triangular(L, both, lower=True, check_finite=False)
    known, seen = both[:, :-1], both[:, -1]
    points = travelled + start + (seen @ known).reshape(m, 3)
    # Of the posterior only each point's own covariance is asked for.
    columns = known.T.reshape(m, 3, 3 * m)
    covariance = np.diagonal(prior)[:, None, None] * np.eye(3) - columns @ columns.transpose(0, 2, 1)
    return tuple(PathPoint(entry.time_s, points[i], covariance[i]) for i, entry in enumerate(entries))


def _slip_covariance(time_s: F64, settings: TrackerSettings) -> F64:
    """Return the (m, m) prior covariance, per axis, of where a fruit lies on the belt."""
    t, tau = time_s - time_s.min(), settings.slip_time_s
    fade = np.exp(-t / tau)
    between = np.exp(-np.abs(t[:, None] - t[None]) / tau)
    walk = 2.0 * np.minimum(t[:, None], t[None]) + tau * (fade[:, None] + fade[None] - 1.0 - between)
    slip = settings.slip_speed_m_s**2 * tau * walk
    return np.asarray(slip + ANYWHERE_M**2 + BELT_JITTER_M**2 * np.eye(len(t)))


def _noise(entries: Sequence[Entry], y: F64, rig: Rig, settings: TrackerSettings) -> F64:
    """Return the (3m, 3m) covariance of the measured centres' errors."""
    m = len(entries)
    R = np.array([entry.covariance_m2 for entry in entries])
    L = np.linalg.cholesky(R)
    G = pose_jacobians(y)[:, :, :6]
    N = np.zeros((m, 3, m, 3))
    sensors = np.array([entry.view.sensor for entry in entries])
    for sensor in dict.fromkeys(sensors.tolist()):
        own = np.flatnonzero(sensors == sensor)
        J, S = G[own].reshape(-1, 6), L[own].reshape(-1, 3)
        pose = (J @ pose_covariance(rig, sensor) @ J.T).reshape(len(own), 3, len(own), 3)
        alike = _alike([entries[i] for i in own.tolist()], settings)
        lasting = alike[:, None, :, None] * (S @ S.T).reshape(pose.shape)
        N[own[:, None, None, None], np.arange(3)[None, :, None, None], own[None, None, :, None], np.arange(3)] = (
            pose + lasting
        )
    index = np.arange(m)
    N[index, :, index] += (1.0 - settings.same_side_share) * R
    return np.asarray(N.reshape(3 * m, 3 * m))


def _alike(entries: Sequence[Entry], settings: TrackerSettings) -> F64:
    """Return the (k, k) correlation of one sensor's errors: a fruit carried on shows it another side."""
    travelled = np.array([entry.travelled_m for entry in entries])
    way = np.linalg.norm(travelled[:, None] - travelled[None], axis=2)
    return np.asarray(settings.same_side_share * np.exp(-way / settings.same_side_m))
