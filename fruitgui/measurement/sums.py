"""Sums and means of measurements that err partly together."""

from __future__ import annotations

import math
from dataclasses import dataclass

from fruitgui.measurement.correction import PRIOR_CHANCE
from fruitgui.measurement.fruit import Quantity

USUAL_SHARE = math.sqrt(1.0 - PRIOR_CHANCE**2)
"""Of the standard deviation of a fit that no reference corrected, and of which nothing else is known, the part that
fruit of a kind share: what `PRIOR_CHANCE` leaves."""


@dataclass(frozen=True, slots=True)
class SharedSum:
    """A sum of measurements of which each errs partly by itself, partly as all the others do.

    Attributes:
        value: of the sum.
        variance: sum of the measurements' variances, all they err by.
        shared: sum of the standard deviations of their shared parts. shared_square: of the squares of these.
    """

    value: float = 0.0
    variance: float = 0.0
    shared: float = 0.0
    shared_square: float = 0.0

    @classmethod
    def of(cls, value: float, std: float, shared: float | None = None) -> SharedSum:
        """Return one measurement; where its shared part is not known, the usual part of its std is taken for it."""
        known = shared if shared is not None and math.isfinite(shared) else USUAL_SHARE * std
        return cls(value, std**2, known, known**2)

    def __add__(self, more: SharedSum) -> SharedSum:
        """Return both together."""
        return SharedSum(
            self.value + more.value,
            self.variance + more.variance,
            self.shared + more.shared,
            self.shared_square + more.shared_square,
        )

    @property
    def quantity(self) -> Quantity:
        """The sum with its standard deviation: own parts add as squares, shared parts as they are."""
        own = max(self.variance - self.shared_square, 0.0)
        return Quantity(self.value, math.sqrt(own + max(self.shared, 0.0) ** 2))

    def mean(self, count: int) -> Quantity | None:
        """Return the mean of so many measurements with its standard deviation; None where there are none."""
        whole = self.quantity
        return Quantity(whole.value / count, whole.std / count) if count else None
