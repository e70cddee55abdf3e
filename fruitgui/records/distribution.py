"""How a measure is spread over the fruit of a lot, counted in the database."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray
from sqlalchemy import Integer, cast, func, select
from sqlalchemy.orm import InstrumentedAttribute, Session

from fruitgui.frame import F64
from fruitgui.records.tables import FruitRow, TotalRow

Measured = Literal["volume_m3", "mass_kg", "length_m", "diameter_m", "perimeter_m"]
"""What can be spread."""

MOST_BINS = 500


@dataclass(frozen=True, slots=True, eq=False)
class Distribution:
    """Counts in bins.

    Attributes:
        measured: what, SI.
        edges: (B + 1,) evenly spaced round numbers; empty where nothing was measured.
        counts: (B,) of each kind that has any.
    """

    measured: Measured
    edges: F64
    counts: Mapping[str, NDArray[np.int64]]


def distribution(session: Session, lot: int, measured: Measured, bins: int) -> Distribution:
    """Return how a measure is spread over the counted fruit of a lot, in about so many bins."""
    column: InstrumentedAttribute[Any] = getattr(FruitRow, measured)
    wanted = [FruitRow.lot_id == lot, FruitRow.counted.is_(True), column.is_not(None)]
    if measured == "volume_m3":  # the index of kinds holds volumes: no row need be read
        wanted.append(FruitRow.kind.in_(select(TotalRow.kind).where(TotalRow.lot_id == lot)))
    least, most = session.execute(select(func.min(column), func.max(column)).where(*wanted)).one()
    if least is None:
        return Distribution(measured, np.empty(0), {})
    width = round_width((most - least) / min(max(bins, 1), MOST_BINS) or abs(most) or 1.0)
    start = math.floor(least / width)
    size = math.floor(most / width) - start + 1
    place = cast(column / width - start, Integer)
    found = session.execute(select(FruitRow.kind, place, func.count()).where(*wanted).group_by(FruitRow.kind, place))
    counted: dict[str, NDArray[np.int64]] = {}
    for kind, at, fruit in found:
        counted.setdefault(kind, np.zeros(size, np.int64))[min(at, size - 1)] += fruit
    return Distribution(measured, (start + np.arange(size + 1)) * width, counted)


def round_width(width: float) -> float:
    """Return the next 1, 2 or 5 times a power of ten."""
    power = 10.0 ** math.floor(math.log10(width))
    return next((step * power for step in (1.0, 2.0, 5.0) if step * power >= width * (1 - 1e-9)), 10.0 * power)
