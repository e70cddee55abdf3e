"""What many fruit tell about how far each sensor fattens edges, and what that tells about each fruit's volume.

One fruit's views hardly tell a fat edge from a larger fruit: the two errors
go together, and they are most of a volume's. But fattening is the device's,
the same for all fruit. Its mean over taught fruit is known several times
better than one fruit can say, and by the covariance that the fit states it
puts the volume right (a Kalman update with a fattening that was measured).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from fruitgui.frame import F64
from fruitgui.measurement.fruit import Quantity, Size

LEAST_TAUGHT = 3
"""Fruit that a sensor must have seen before its fattening counts as known."""

CONSTANT_PX = 0.06
"""How far a sensor's fattening changes from fruit to fruit at least: with distance, slope and colour."""

STRANGE_SIGMAS = 5.0
"""Fattening farther from what was taught is another device's, or the fit went wrong: nothing is concluded."""

LEAST_LEFT = 0.1
"""Part of a volume's variance that stays whatever is known of edges."""


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
    edges, volume = size.edges, size.volume_m3
    if edges is None:
        return volume
    known = [k for k, sensor in enumerate(edges.sensors) if sensor in fattening_px]
    if not known:
        return volume
    taught = [fattening_px[edges.sensors[k]] for k in known]
    apart = np.array([one.value for one in taught]) - edges.fattening_px[known]
    spread = edges.covariance_px2[np.ix_(known, known)] + np.diag([one.std**2 for one in taught])
    gain = np.linalg.solve(spread, edges.with_volume_px[known])
    if apart @ np.linalg.solve(spread, apart) > STRANGE_SIGMAS**2:
        return volume
    value = volume.value * float(np.exp(gain @ apart))
    variance = (volume.std / volume.value) ** 2
    left = max(variance - float(gain @ edges.with_volume_px[known]), LEAST_LEFT * variance)
    return Quantity(value, value * float(np.sqrt(left)))
