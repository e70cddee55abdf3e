"""Whether a sensor's depth still drifts after it was switched on: the belt is a yardstick that does not move.

Depth of a device that warms up creeps: minutes for structured light, 40 to 50 for an Azure Kinect (Tölgyessy et al.
2021). What creeps slowly goes on for long, so steady is judged by how far the creeping would go on, not by how little
it went.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from fruitgui.frame import F64

TOLERANCE = 1e-3
"""Drift of depth, as a share of it, that does not matter: it makes volumes wrong by three times as much."""

AHEAD_S = 1200.0
"""Drift is steady where it would not go beyond the tolerance in so long: about how slowly such devices warm up."""

WINDOW_MIN = 4
"""Minutes over which the creeping is measured: from ten looks a minute, to a tenth of the tolerance."""

LEAVES = 2.0
"""What was steady is so until it creeps this many times as fast: nothing flickers."""


class Warmth(StrEnum):
    """How a sensor's depth is: too little was seen of it, it drifts, or it is steady."""

    UNKNOWN = "unknown"
    DRIFTING = "drifting"
    STEADY = "steady"


@dataclass(frozen=True, slots=True)
class Warmup:
    """How a sensor's depth has moved since it was first looked at.

    Attributes:
        state: unknown for the first minutes.
        watched_s: how long it was looked at.
        since_s: how long it has been steady; 0 where it is not.
        drifted_m: how much farther the belt is read to be than at first.
        rate_m_s: how fast that changes now; None for the first minutes.
    """

    state: Warmth
    watched_s: float
    since_s: float
    drifted_m: float
    rate_m_s: float | None


NOT_WATCHED = Warmup(Warmth.UNKNOWN, 0.0, 0.0, 0.0, None)


def warmup(times_s: Sequence[float], offs_m: Sequence[float], distance_m: float) -> Warmup:
    """Return how a sensor's depth moves.

    Args:
        times_s: (N,) of looks at the belt, ascending, seconds.
        offs_m: (N,) how much farther than at first it was read to be.
        distance_m: of the belt.
    """
    if not len(times_s):
        return NOT_WATCHED
    times, offs = np.asarray(times_s, dtype=np.float64), np.asarray(offs_m, dtype=np.float64)
    watched_s = float(times[-1] - times[0])
    minutes, means = _by_minute(times, offs)
    drifted_m = float(means[-1] - means[0])
    rates = _rates(minutes, means)
    if not len(rates):
        return Warmup(Warmth.UNKNOWN, watched_s, 0.0, drifted_m, None)
    begun = _steady_from(np.abs(rates) * AHEAD_S, TOLERANCE * distance_m)
    rate_m_s = float(rates[-1])
    if begun is None:
        return Warmup(Warmth.DRIFTING, watched_s, 0.0, drifted_m, rate_m_s)
    since_s = max(float(times[-1] - times[0] - 60.0 * minutes[begun]), 0.0)
    return Warmup(Warmth.STEADY, watched_s, since_s, drifted_m, rate_m_s)


def _by_minute(times: F64, offs: F64) -> tuple[F64, F64]:
    """Return minutes since the first look that have ended, and the mean of each; at least one."""
    minute = ((times - times[0]) // 60.0).astype(int)
    ended = minute < max(int(minute[-1]), 1)
    count = np.bincount(minute[ended])
    sums = np.bincount(minute[ended], offs[ended])
    seen = np.nonzero(count)[0]
    return seen.astype(np.float64), np.asarray(sums[seen] / count[seen])


def _rates(minutes: F64, means: F64) -> F64:
    """Return the slope (m/s) of every window of so many minutes that were looked at, the oldest first."""
    windows = len(minutes) - WINDOW_MIN + 1
    if windows < 1:
        return np.zeros(0)
    x = np.lib.stride_tricks.sliding_window_view(minutes, WINDOW_MIN) * 60.0
    y = np.lib.stride_tricks.sliding_window_view(means, WINDOW_MIN)
    x = x - x.mean(axis=1, keepdims=True)
    return np.asarray((x * (y - y.mean(axis=1, keepdims=True))).sum(axis=1) / (x**2).sum(axis=1))


def _steady_from(ahead_m: F64, tolerance_m: float) -> int | None:
    """Return the window from which on all is steady; None where it is not now. Windows are numbered by their start."""
    begun: int | None = None
    for number, one in enumerate(ahead_m):
        if one > tolerance_m * (LEAVES if begun is not None else 1.0):
            begun = None
        elif begun is None:
            begun = number
    return begun
