"""Sums per lot and kind, changed in the very transaction that changes what they sum up."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from math import nan, sqrt

import numpy as np
from sqlalchemy import delete, select
from sqlalchemy.dialects.sqlite import insert
from sqlalchemy.orm import Session

from fruitgui.frame import F64
from fruitgui.measurement.fruit import Quantity
from fruitgui.measurement.sums import SharedSum
from fruitgui.records.tables import FruitRow, TotalRow

SHARING = (
    "The ± of a total adds what each fruit errs by alone as squares, and what fruit err by together (the rig's scale, "
    "a kind's volume correction, its density) as it is: that part does not average out."
)

_SUMS = (
    "fruit", "measured", "volume_m3", "volume_variance_m6", "volume_square_m6",
    "volume_shared_m3", "volume_shared_square_m6",
    "weighed", "mass_kg", "mass_variance_kg2", "mass_square_kg2",
    "mass_shared_kg", "mass_shared_square_kg2",
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class KindTotal:
    """All counted fruit of one kind in one lot.

    Attributes:
        kind: that holds, corrected or the machine's.
        fruit: how many.
        measured, weighed: of these, how many have a volume, a mass.
        volume, mass: sums over those, m³ and kg, see `SHARING`.
        volume_spread_m3: standard deviation between fruit; NaN below two.
    """

    kind: str
    fruit: int
    measured: int
    volume: SharedSum
    volume_spread_m3: float
    weighed: int
    mass: SharedSum

    @property
    def volume_m3(self) -> Quantity:
        """All volumes together."""
        return self.volume.quantity

    @property
    def mass_kg(self) -> Quantity:
        """All masses together."""
        return self.mass.quantity

    @property
    def mean_volume_m3(self) -> Quantity | None:
        """Mean of the measured fruit, and how well the measurements tell it."""
        return self.volume.mean(self.measured)


def add(session: Session, rows: Collection[FruitRow]) -> None:
    """Add fruit that count to the sums of their lot and kind."""
    _change(session, rows, 1)


def take_out(session: Session, rows: Collection[FruitRow]) -> None:
    """Take fruit that counted out of the sums of their lot and kind, before anything in their rows is changed."""
    _change(session, rows, -1)
    session.execute(delete(TotalRow).where(TotalRow.lot_id.in_({row.lot_id for row in rows}), TotalRow.fruit == 0))


def _change(session: Session, rows: Collection[FruitRow], sign: int) -> None:
    sums: dict[tuple[int, str], F64] = {}
    for row in rows:
        if row.counted:
            key = (row.lot_id, row.kind)
            sums[key] = sums.get(key, np.zeros(len(_SUMS))) + sign * np.array(_parts(row))
    for (lot, kind), values in sums.items():
        added = insert(TotalRow).values(lot_id=lot, kind=kind, **dict(zip(_SUMS, values.tolist(), strict=True)))
        more = {name: getattr(TotalRow, name) + added.excluded[name] for name in _SUMS}
        session.execute(added.on_conflict_do_update(index_elements=["lot_id", "kind"], set_=more))


def _parts(row: FruitRow) -> list[float]:
    return [
        1,
        *_moments(row.volume_m3, row.volume_std_m3, row.volume_shared_m3),
        *_moments(row.mass_kg, row.mass_std_kg, row.mass_shared_kg),
    ]


def _moments(value: float | None, std: float | None, shared: float | None) -> list[float]:
    """Return what a measurement adds to the sums, in the order of `_SUMS`; fruit of before said nothing of sharing."""
    if value is None:
        return [0, 0.0, 0.0, 0.0, 0.0, 0.0]
    one = SharedSum.of(value, std or 0.0, shared)
    return [1, value, one.variance, value**2, one.shared, one.shared_square]


def totals(session: Session, lots: Collection[int]) -> dict[int, tuple[KindTotal, ...]]:
    """Return the sums of some lots, the most frequent kind first."""
    found: dict[int, list[KindTotal]] = {lot: [] for lot in lots}
    wanted = select(TotalRow).where(TotalRow.lot_id.in_(lots)).order_by(TotalRow.fruit.desc(), TotalRow.kind)
    for row in session.scalars(wanted):
        found[row.lot_id].append(_total(row))
    return {lot: tuple(kinds) for lot, kinds in found.items()}


def _total(row: TotalRow) -> KindTotal:
    return KindTotal(
        kind=row.kind,
        fruit=row.fruit,
        measured=row.measured,
        volume=SharedSum(row.volume_m3, row.volume_variance_m6, row.volume_shared_m3, row.volume_shared_square_m6),
        volume_spread_m3=_spread(row.measured, row.volume_m3, row.volume_square_m6),
        weighed=row.weighed,
        mass=SharedSum(row.mass_kg, row.mass_variance_kg2, row.mass_shared_kg, row.mass_shared_square_kg2),
    )


def _spread(count: int, total: float, squares: float) -> float:
    return sqrt(max(squares - total**2 / count, 0.0) / (count - 1)) if count > 1 else nan
