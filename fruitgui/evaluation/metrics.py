"""Figures with the interval that holds them: rates exactly, means by resampling fruit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from fruitgui.classification.intervals import rate
from fruitgui.frame import F64

RESAMPLINGS = 2000


@dataclass(frozen=True, slots=True)
class Metric:
    """A figure and its 95 % interval.

    Attributes:
        value: the figure; None where nothing was there to count.
        low, high: ends of the interval.
        n: how many things it is made from.
    """

    value: float | None
    low: float | None
    high: float | None
    n: int

    def to_dict(self) -> dict[str, Any]:
        """Return the report's object."""
        return {"value": self.value, "low": self.low, "high": self.high, "n": self.n}


def share(successes: int, trials: int) -> Metric:
    """Return a rate with its exact interval (Clopper & Pearson 1934)."""
    if trials == 0:
        return Metric(None, None, None, 0)
    counted = rate(successes, trials)
    return Metric(counted.value, counted.low, counted.high, trials)


def mean(values: Sequence[float] | F64, seed: int = 0) -> Metric:
    """Return a mean with its bootstrap percentile interval (Efron 1979)."""
    array = np.asarray(values, dtype=np.float64)
    if array.size == 0:
        return Metric(None, None, None, 0)
    drawn = np.random.default_rng(seed).integers(array.size, size=(RESAMPLINGS, array.size))
    low, high = np.quantile(array[drawn].mean(axis=1), [0.025, 0.975])
    return Metric(float(array.mean()), float(low), float(high), int(array.size))
