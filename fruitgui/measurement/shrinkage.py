"""How far shifts of kinds are drawn towards their mean, and how much was learned from the references by it."""

from __future__ import annotations

import numpy as np

from fruitgui.frame import F64

KINDS_APART = 0.02
"""How far shifts of kinds differ where too few kinds have references to tell."""


def learned(information: F64, apart2: float) -> float:
    """Return how many numbers shrunken shifts and their mean are worth (trace of the hat matrix): fewer than kinds."""
    own, shared = information / (information + 1.0 / apart2), 1.0 / (1.0 / information + apart2)
    return float(own.sum() + (1.0 - own) @ shared / shared.sum())


def between(means: F64, variances: F64) -> tuple[float, tuple[float, float]]:
    """Return (variance of shifts between kinds, (their mean, its standard deviation)), by moments.

    DerSimonian & Laird 1986, drawn towards a usual variance where kinds are few.
    """
    prior = KINDS_APART**2
    if len(means) > 1:
        excess = float(np.var(means, ddof=1) - variances.mean())
        prior = (prior + (len(means) - 1) * max(excess, 0.0)) / len(means)
    weight = 1.0 / (variances + prior)
    return max(prior, 1e-8), (float(np.average(means, weights=weight)), float(weight.sum() ** -0.5))
