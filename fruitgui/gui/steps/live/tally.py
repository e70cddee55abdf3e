"""What a lot amounts to so far, added up as fruit are counted; no widgets, no database."""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from math import isfinite, sqrt

import numpy as np

from fruitgui.frame import F64, Ints
from fruitgui.measurement.fruit import Quantity
from fruitgui.measurement.sums import SharedSum
from fruitgui.records.totals import KindTotal
from fruitgui.station.fruit import Fruit
from fruitgui.station.report import ML_PER_M3

RATE_OVER_S = 120.0
"""A rate is over the last two minutes: long enough to be calm, short enough to show a change."""

SHORTEST_S = 10.0
BINS = 40
NARROWEST_ML = 20.0
STEP_ML = 0.25
"""Volumes are counted in steps of this, so that no more is kept of more fruit. Bins are whole steps wide."""


@dataclass(slots=True)
class KindSum:
    """The fruit of one kind.

    Attributes:
        count: of them. measured: of these, how many have a volume.
        volume: sum of their volumes, ml. square_ml2: of the squares.
        mass_kg: sum of their masses; None where none has one.
    """

    count: int = 0
    measured: int = 0
    volume: SharedSum = field(default_factory=SharedSum)
    square_ml2: float = 0.0
    mass_kg: float | None = None

    def add(self, fruit: Fruit) -> None:
        """Add a fruit."""
        self.count += 1
        if isfinite(fruit.volume_m3.value):
            self.measured += 1
            volume_ml, std_ml = fruit.volume_m3.value * ML_PER_M3, fruit.volume_m3.std * ML_PER_M3
            self.volume += SharedSum.of(volume_ml, std_ml, fruit.volume_shared_m3 * ML_PER_M3)
            self.square_ml2 += volume_ml**2
        if fruit.mass_kg is not None:
            self.mass_kg = (self.mass_kg or 0.0) + fruit.mass_kg.value

    @property
    def volume_ml(self) -> float:
        """All volumes together."""
        return self.volume.value

    @property
    def mean_ml(self) -> Quantity | None:
        """Mean volume, and how well it is known."""
        return self.volume.mean(self.measured)

    @property
    def spread_ml(self) -> float | None:
        """Standard deviation between the fruit; None below two."""
        if self.measured < 2:
            return None
        return sqrt(max(self.square_ml2 - self.volume.value**2 / self.measured, 0.0) / (self.measured - 1))


@dataclass(slots=True)
class Tally:
    """A lot so far: sums by kind, how fast they come, and their volumes.

    Made from what the records hold when a lot is taken up, and kept up by `count`.
    """

    sums: dict[str, KindSum] = field(default_factory=dict)
    _counted: deque[tuple[float, str]] = field(default_factory=deque)
    _volumes: dict[str, Counter[int]] = field(default_factory=dict)
    _began_s: float | None = None

    @classmethod
    def of(cls, totals: Iterable[KindTotal]) -> Tally:
        """Return the tally of a lot that has some fruit already."""
        return cls({one.kind: _sum_of(one) for one in totals})

    @property
    def count_all(self) -> int:
        """All fruit of the lot."""
        return sum(one.count for one in self.sums.values())

    def count(self, fruit: Fruit, now_s: float) -> None:
        """Add a fruit that is counted at `now_s`, by the host's monotonic clock."""
        volume_ml = fruit.volume_m3.value * ML_PER_M3
        self.add(fruit)
        if isfinite(volume_ml):
            self._volumes.setdefault(fruit.kind, Counter())[int(volume_ml // STEP_ML)] += 1
        self._forget(now_s)
        self._counted.append((now_s, fruit.kind))
        self._began_s = now_s if self._began_s is None else self._began_s

    def add(self, fruit: Fruit) -> None:
        """Add a fruit to the sums alone."""
        self.sums.setdefault(fruit.kind, KindSum()).add(fruit)

    def take(self, totals: Iterable[KindTotal]) -> None:
        """Take the sums that the records hold; how fast fruit come, and their volumes, stay as the machine saw them."""
        self.sums = {one.kind: _sum_of(one) for one in totals}

    def per_minute(self, now_s: float) -> Mapping[str, float]:
        """Return how many fruit of each kind come in a minute, over the last two."""
        self._forget(now_s)
        began_s = now_s if self._began_s is None else self._began_s
        over_s = min(max(now_s - began_s, SHORTEST_S), RATE_OVER_S)
        rates: dict[str, float] = {}
        for _, kind in self._counted:
            rates[kind] = rates.get(kind, 0.0) + 60.0 / over_s
        return rates

    def histogram(self) -> Histogram | None:
        """Return the volumes of what was counted since the tally was made, in bins; None before the first."""
        if not self._volumes:
            return None
        together: Counter[int] = sum(self._volumes.values(), Counter())
        low, high = round_ends(*_steps(together))
        return Histogram(low, high, {kind: _binned(counts, low, high) for kind, counts in self._volumes.items()})

    def _forget(self, now_s: float) -> None:
        """Let go of what is too long ago to count for a rate."""
        while self._counted and self._counted[0][0] < now_s - RATE_OVER_S:
            self._counted.popleft()


@dataclass(frozen=True, slots=True, eq=False)
class Histogram:
    """Counts in equal bins from `low_ml` to `high_ml`, by kind."""

    low_ml: float
    high_ml: float
    counts: Mapping[str, Ints]


def round_ends(volumes_ml: F64, counts: Ints) -> tuple[float, float]:
    """Return round ends between which nearly all of so many fruit (N,) of each volume (N,), in order, lie."""
    share = np.cumsum(counts) / counts.sum()
    low, high = (float(volumes_ml[np.searchsorted(share, part)]) for part in (0.005, 0.995))
    middle, half = (low + high) / 2.0, max((high - low) * 0.6, NARROWEST_ML)
    step = 10.0 if half < 150.0 else 50.0
    return max(float(np.floor((middle - half) / step)) * step, 0.0), float(np.ceil((middle + half) / step)) * step


def _steps(counts: Counter[int]) -> tuple[F64, Ints]:
    """Return the volumes (N,) at the middles of all steps that hold fruit, in order, and how many each holds (N,)."""
    steps = sorted(counts)
    return (np.array(steps) + 0.5) * STEP_ML, np.array([counts[step] for step in steps], dtype=np.intp)


def _binned(counts: Counter[int], low_ml: float, high_ml: float) -> Ints:
    """Return how many fruit (`BINS`,) are in each bin; what lies beyond the ends is in the outermost."""
    volumes_ml, fruit = _steps(counts)
    return np.histogram(np.clip(volumes_ml, low_ml, high_ml), BINS, (low_ml, high_ml), weights=fruit)[0].astype(np.intp)


def _sum_of(total: KindTotal) -> KindSum:
    volume, volume_ml = total.volume, total.volume.value * ML_PER_M3
    spread_ml = total.volume_spread_m3 * ML_PER_M3
    square_ml2 = volume_ml**2 / total.measured if total.measured else 0.0
    if isfinite(spread_ml):
        square_ml2 += spread_ml**2 * (total.measured - 1)
    inside = SharedSum(
        volume_ml, volume.variance * ML_PER_M3**2, volume.shared * ML_PER_M3, volume.shared_square * ML_PER_M3**2
    )
    mass_kg = total.mass_kg.value if total.weighed else None
    return KindSum(total.fruit, total.measured, inside, square_ml2, mass_kg)
