"""How the belt ran, told by the ways of the fruit that crossed.

The follower's own velocity is made to predict the next capture: it leans a
hundredth or two on what sensors see of fruit that only begin to come into view.
A finished fruit's way is smoothed over all its views and is ten times truer.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from fruitgui.frame import F64
from fruitgui.tracking.follow import RUNNING_SHARE
from fruitgui.tracking.track import PathPoint

LEAST_WAY_M = 0.1
"""A way this long tells a speed to a hundredth: its ends are known to about a millimetre."""

LEAST_STEP_S = 0.09
"""Steps between captures of two sensors may be shorter than any speed can be told from."""


def way_velocity(path: Sequence[PathPoint]) -> F64 | None:
    """Return one fruit's mean velocity (3,) while it ran, m/s, reference frame; None where its way is too short."""
    time_s, position_m = _spaced(path)
    if len(time_s) < 2:
        return None
    step_s, step_m = np.diff(time_s), np.diff(position_m, axis=0)
    speed_m_s = np.linalg.norm(step_m, axis=1) / step_s
    ran = speed_m_s > RUNNING_SHARE * float(np.quantile(speed_m_s, 0.9))
    way_m = np.cumsum(step_m[ran], axis=0)
    if len(way_m) < 2 or float(np.linalg.norm(way_m[-1])) < LEAST_WAY_M:
        return None
    return _slope(np.cumsum(step_s[ran]), way_m)


def _slope(run_s: F64, way_m: F64) -> F64:
    """Return the velocity (3,) of a line through ways (n, 3): the ends, cut by the picture's edge, weigh no more."""
    about = run_s - run_s.mean()
    return np.asarray(about @ (way_m - way_m.mean(axis=0)) / (about @ about))


def _spaced(path: Sequence[PathPoint]) -> tuple[F64, F64]:
    """Return times (n,) and positions (n, 3) of the points that lie at least `LEAST_STEP_S` apart."""
    kept: list[PathPoint] = []
    for point in path:
        if not kept or point.time_s - kept[-1].time_s >= LEAST_STEP_S:
            kept.append(point)
    return np.array([point.time_s for point in kept]), np.array([point.position_m for point in kept])


def mean_velocity(velocities_m_s: Iterable[F64]) -> F64 | None:
    """Return what most fruit's velocities (3,) say the belt's was; None where there are none.

    The median: a hand that goes its own way does not count.
    """
    known = list(velocities_m_s)
    return np.asarray(np.median(known, axis=0)) if known else None
