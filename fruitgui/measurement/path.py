"""Where the belt carried a fruit, from where its views were."""

from __future__ import annotations

import numpy as np

from fruitgui.frame import F64
from fruitgui.measurement.evidence import Evidence


def carried(evidence: Evidence, place_m: F64, degree: int) -> tuple[F64, float]:
    """Return how far the belt carried the fruit at each view (V, 3), zero on average, and the scatter about it, metres.

    The way that tracking told and a polynomial in time upon it, common to all
    sensors, beside one offset for each sensor and, where they saw enough of it,
    one slope: a depth bias stretches the path that a sensor sees. Where the
    views are too few the way that tracking told decides.
    """
    path = np.zeros_like(place_m)
    times = evidence.time_s
    if len(times) < 2 or np.ptp(times) <= 0:
        return path, 0.0
    design = _design(evidence, degree)
    target = place_m[:, :2] - evidence.way_m[:, :2]
    weight = np.ones(len(times))
    ridge = np.diag([1e-6] * design.shape[1])
    for _ in range(4):
        weighted = design * weight[:, None]
        solution = np.linalg.solve(design.T @ weighted + ridge, weighted.T @ target)
        left = target - design @ solution
        distance = np.linalg.norm(left, axis=1)
        scatter = max(float(np.median(distance)), 2e-4)
        weight = 1.0 / (1.0 + (distance / (3.0 * scatter)) ** 2)
    sensors = len(evidence.sensors)
    path[:, :2] = evidence.way_m[:, :2] + design[:, sensors:] @ solution[sensors:]
    path -= path.mean(axis=0)
    return path, scatter / 1.18


def _design(evidence: Evidence, degree: int) -> F64:
    """Return columns: one offset for each sensor, powers of time, one slope for each sensor but the first."""
    half = max(float(np.abs(evidence.time_s).max()), 1e-9)
    t = evidence.time_s / half
    offsets = (evidence.sensor[:, None] == np.arange(len(evidence.sensors))).astype(np.float64)
    counts = offsets.sum(axis=0)
    powers = [t**k for k in range(1, min(degree, max(1, (len(t) - 2) // 3)) + 1)] if len(t) >= 4 else []
    slopes = [offsets[:, k] * t for k in range(1, len(counts)) if powers and counts.min() >= 6]
    return np.column_stack([offsets, *powers, *slopes])
