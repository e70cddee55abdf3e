"""What many fruit tell about how far each sensor fattens edges, and what that tells about each fruit's size.

One fruit's views hardly tell a fat edge from a larger fruit: the two errors
go together, and they are most of a volume's and of a length's. But fattening is the device's,
the same for all fruit. Its mean over taught fruit is known several times
better than one fruit can say, and by the covariance that the fit states it
puts the size right (a Kalman update with a fattening that was measured).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from fruitgui.frame import F64, Ints
from fruitgui.measurement.fruit import Edges, Quantity, Size

LEAST_TAUGHT = 3
"""Fruit that a sensor must have seen before its fattening counts as known."""

CONSTANT_PX = 0.06
"""How far a sensor's fattening changes from fruit to fruit at least: with distance, slope and colour."""

STRANGE_SIGMAS = 5.0
"""Fattening farther from what was taught is another device's, or the fit went wrong: nothing is concluded."""

LEAST_LEFT = 0.1
"""Part of a variance that stays whatever is known of edges."""


def learn_fattening(sizes: Sequence[Size]) -> dict[str, Quantity]:
    """Return each sensor's fattening, pixels, its standard deviation telling how far one fruit's may depart from it."""
    found: dict[str, list[tuple[float, float]]] = {}
    for size in sizes:
        if size.edges is not None:
            rows = zip(size.edges.sensors, size.edges.fattening_px, np.diag(size.edges.covariance_px2), strict=True)
            for sensor, value, variance in rows:
                found.setdefault(sensor, []).append((float(value), float(variance)))
    return {sensor: _usual(np.array(rows)) for sensor, rows in sorted(found.items()) if len(rows) >= LEAST_TAUGHT}


def _usual(rows: F64) -> Quantity:
    values, variances = rows.T
    middle = float(np.median(values))
    scatter2 = (1.4826 * float(np.median(np.abs(values - middle)))) ** 2
    own2 = max(scatter2 - float(np.median(variances)), CONSTANT_PX**2)
    return Quantity(middle, float(np.sqrt(own2 + 1.57 * scatter2 / len(values))))


def volume_by_edges(size: Size, fattening_px: Mapping[str, Quantity]) -> Quantity:
    """Return the volume, m³, with what is known of the sensors' edges put in."""
    update, volume = _update(size.edges, fattening_px), size.volume_m3
    if update is None or size.edges is None:
        return volume
    log, less = update.of(size.edges.with_volume_px)
    value = volume.value * float(np.exp(log))
    return Quantity(value, value * _left(volume.std / volume.value, less))


def lengths_by_edges(size: Size, fattening_px: Mapping[str, Quantity]) -> Size:
    """Return a size whose length, diameter and perimeter have what is known of the sensors' edges put in."""
    update = _update(size.edges, fattening_px)
    if update is None or size.edges is None or size.edges.with_lengths_px_m is None:
        return size
    lengths, with_volume = [], size.edges.with_volume_px
    rows = zip((size.length_m, size.diameter_m, size.perimeter_m), size.edges.with_lengths_px_m, strict=True)
    for length, with_edges in rows:
        longer_m, less = update.of(with_edges)
        lengths.append(Quantity(length.value + longer_m, _left(length.std, less)))
    owed_m = (
        None
        if size.with_volume_m is None
        else np.array(
            [
                own - update.common(one, with_volume)
                for own, one in zip(size.with_volume_m, size.edges.with_lengths_px_m, strict=True)
            ]
        )
    )
    return replace(size, length_m=lengths[0], diameter_m=lengths[1], perimeter_m=lengths[2], with_volume_m=owed_m)


def _left(std: float, less: float) -> float:
    """Return the standard deviation that is left of a quantity's once its variance is less by so much."""
    return float(np.sqrt(max(std**2 - less, LEAST_LEFT * std**2)))


@dataclass(frozen=True, slots=True, eq=False)
class _Update:
    """How far taught edges are from those that were found on a fruit.

    Attributes:
        known: (K,) which of the fruit's sensors were taught.
        apart_px: (K,) taught less found.
        spread_px2: (K, K) covariance of that.
    """

    known: Ints
    apart_px: F64
    spread_px2: F64

    def of(self, with_edges: F64) -> tuple[float, float]:
        """Return by how much a quantity grows and its variance shrinks, given its covariance (S,) with the edges."""
        gain = np.linalg.solve(self.spread_px2, with_edges[self.known])
        return float(gain @ self.apart_px), self.common(with_edges, with_edges)

    def common(self, first: F64, second: F64) -> float:
        """Return what two quantities' covariance owes to edges that are known now, given their own (S,) with these."""
        return float(first[self.known] @ np.linalg.solve(self.spread_px2, second[self.known]))


def _update(edges: Edges | None, fattening_px: Mapping[str, Quantity]) -> _Update | None:
    """Return what was taught of a fruit's edges; None where nothing was, or what was is too strange to be theirs."""
    known = [] if edges is None else [k for k, sensor in enumerate(edges.sensors) if sensor in fattening_px]
    if edges is None or not known:
        return None
    taught = [fattening_px[edges.sensors[k]] for k in known]
    apart = np.array([one.value for one in taught]) - edges.fattening_px[known]
    spread = edges.covariance_px2[np.ix_(known, known)] + np.diag([one.std**2 for one in taught])
    if apart @ np.linalg.solve(spread, apart) > STRANGE_SIGMAS**2:
        return None
    return _Update(np.array(known), apart, spread)
