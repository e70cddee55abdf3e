"""What a sensor that counts in steps had measured before its driver rounded it to whole millimetres.

Structured light counts disparity in steps, so its inverse depths are equally spaced, 1/z = base + k · step
(Khoshelham & Elberink 2012, eq. 3). The driver rounds depth to millimetres. Where a step is nearly a whole number of
millimetres (6 mm at 1.45 m) ten steps in a row are rounded the same way, by up to half a millimetre, which tilts a
belt, and no number of captures averages that out. Where the steps show in what was read, they tell what
it was rounded from.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fruitgui.frame import F32, F64, Frame, Ints

ROUNDED_M = 0.0005
FEWEST_LEVELS = 12
LEAST_READINGS = 5
CLEAR_STEP_M = 0.0025
SHARE_OF_STEP = 0.3
"""Rounding by more than this share of a step no longer tells which step it was."""

LEAST_EXPLAINED = 0.98
SLACK = 1.3
"""Levels are fitted to what was rounded, so that a few lie a little farther from it than rounding goes."""


def inverse_depths(frames: Sequence[Frame]) -> F32:
    """Return the inverse depth (1/m) of every reading in whole millimetres, (65536,); 0 for none."""
    millimetres = np.arange(65536)
    inverse = np.zeros(65536)
    inverse[1:-1] = 1000.0 / millimetres[1:-1]
    counts = np.zeros(65536, dtype=np.intp)
    for frame in frames:
        counts += np.bincount(frame.depth_mm.ravel(), minlength=65536)
    counts[[0, -1]] = 0
    found = steps(inverse, counts)
    if found is None:
        return inverse.astype(np.float32)
    base, step = found
    near = base + step * np.round((inverse - base) / step)
    rounded = ROUNDED_M * inverse**2
    same = (np.abs(near - inverse) <= SLACK * rounded) & (rounded < SHARE_OF_STEP * step) & (inverse > 0)
    return np.where(same, near, inverse).astype(np.float32)


def steps(inverse: F64, counts: Ints) -> tuple[float, float] | None:
    """Return (base, step) of equally spaced inverse depths (1/m) that explain what was read; None where none do."""
    read = np.nonzero(counts >= LEAST_READINGS)[0]
    q, weight = inverse[read], counts[read].astype(np.float64)
    gaps = q[:-1] - q[1:]
    clear = gaps / q[1:] ** 2 > CLEAR_STEP_M
    if clear.sum() < FEWEST_LEVELS or clear.mean() < 0.2:
        return None
    first = float(np.median(gaps[clear]))
    telling = ROUNDED_M * q**2 < SHARE_OF_STEP * first
    if telling.sum() < FEWEST_LEVELS:
        return None
    q, weight = q[telling], weight[telling]
    base, step = _fitted(q, *_most_even(q, first))
    near = base + step * np.round((q - base) / step)
    explained = np.abs(near - q) <= SLACK * ROUNDED_M * q**2
    return (base, step) if (weight * explained).sum() >= LEAST_EXPLAINED * weight.sum() else None


def _most_even(q: F64, first: float) -> tuple[float, float]:
    """Return base and step, near a first guess of the step, that bring all levels most nearly to whole numbers."""
    trials = first * np.arange(0.85, 1.15, 0.1 * first / float(np.ptp(q)))
    turns = np.exp(2j * np.pi * q[:, None] / trials).sum(axis=0)
    best = int(np.abs(turns).argmax())
    step = float(trials[best])
    return float(np.angle(turns[best]) / (2 * np.pi) * step), step


def _fitted(q: F64, base: float, step: float) -> tuple[float, float]:
    """Return base and step by least squares, rounding errors growing with the square of distance taken into account."""
    for _ in range(3):
        count = np.round((q - base) / step)
        step, base = (float(x) for x in np.polyfit(count, q, 1, w=1.0 / q**2))
    return base, step
