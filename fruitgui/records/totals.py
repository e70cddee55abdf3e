"""Sums per lot and kind, changed in the very transaction that changes what they sum up."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from math import nan, sqrt
from typing import Any

from sqlalchemy import Select, case, delete, func, insert, literal, select
from sqlalchemy.dialects.sqlite import insert as insert_or
from sqlalchemy.orm import InstrumentedAttribute, Session

from fruitgui.measurement.fruit import Quantity
from fruitgui.records.tables import FruitRow, TotalRow

INDEPENDENT = (
    "The ± of a total adds the measurements' own variances, as if no two fruit shared an error. What all fruit of a "
    "lot share (the rig's scale, a kind's volume correction) is not in it."
)

_SUMS = (
    "fruit", "measured", "volume_m3", "volume_variance_m6", "volume_square_m6",
    "weighed", "mass_kg", "mass_variance_kg2", "mass_square_kg2",
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class KindTotal:
    """All counted fruit of one kind in one lot.

    Attributes:
        kind: that holds, corrected or the machine's.
        fruit: how many.
        measured, weighed: of these, how many have a volume, a mass.
        volume_m3, mass_kg: sums over those, each std from independent measurements, see `INDEPENDENT`.
        volume_spread_m3, mass_spread_kg: standard deviation between fruit; NaN below two.
    """

    kind: str
    fruit: int
    measured: int
    volume_m3: Quantity
    volume_spread_m3: float
    weighed: int
    mass_kg: Quantity
    mass_spread_kg: float

    @property
    def mean_volume_m3(self) -> Quantity | None:
        """Mean of the measured fruit, and how well the measurements tell it."""
        return _mean(self.volume_m3, self.measured)

    @property
    def mean_mass_kg(self) -> Quantity | None:
        """Mean of the weighed fruit, and how well the measurements tell it."""
        return _mean(self.mass_kg, self.weighed)


def _mean(total: Quantity, count: int) -> Quantity | None:
    return Quantity(total.value / count, total.std / count) if count else None


def add(session: Session, rows: Iterable[FruitRow]) -> None:
    """Add new fruit to the sums of their lot and kind."""
    sums: dict[tuple[int, str], list[float]] = {}
    for row in rows:
        parts = _parts(row)
        key = (row.lot_id, row.kind)
        sums[key] = [a + b for a, b in zip(sums.get(key, [0] * len(parts)), parts, strict=True)]
    for (lot, kind), values in sums.items():
        added = insert_or(TotalRow).values(lot_id=lot, kind=kind, **dict(zip(_SUMS, values, strict=True)))
        more = {name: getattr(TotalRow, name) + added.excluded[name] for name in _SUMS}
        session.execute(added.on_conflict_do_update(index_elements=["lot_id", "kind"], set_=more))


def _parts(row: FruitRow) -> list[float]:
    return [1, *_moments(row.volume_m3, row.volume_std_m3), *_moments(row.mass_kg, row.mass_std_kg)]


def _moments(value: float | None, std: float | None) -> list[float]:
    if value is None:
        return [0, 0.0, 0.0, 0.0]
    return [1, value, (std or 0.0) ** 2, value**2]


def sum_again(session: Session, lot: int, kinds: Collection[str]) -> None:
    """Sum up some kinds of a lot afresh, exactly; for corrections."""
    session.flush()
    session.execute(delete(TotalRow).where(TotalRow.lot_id == lot, TotalRow.kind.in_(kinds)))
    session.execute(insert(TotalRow).from_select(["lot_id", "kind", *_SUMS], _summed(lot, kinds)))


def _summed(lot: int, kinds: Collection[str]) -> Select[Any]:
    return (
        select(
            literal(lot), FruitRow.kind, func.count(),
            *_summed_moments(FruitRow.volume_m3, FruitRow.volume_std_m3),
            *_summed_moments(FruitRow.mass_kg, FruitRow.mass_std_kg),
        )
        .where(FruitRow.lot_id == lot, FruitRow.counted, FruitRow.kind.in_(kinds))
        .group_by(FruitRow.kind)
    )  # fmt: skip


def _summed_moments(
    value: InstrumentedAttribute[float | None], std: InstrumentedAttribute[float | None]
) -> Sequence[Any]:
    variance = case((value.is_not(None), func.coalesce(std * std, 0.0)), else_=0.0)
    return func.count(value), func.total(value), func.total(variance), func.total(value * value)


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
        volume_m3=Quantity(row.volume_m3, sqrt(row.volume_variance_m6)),
        volume_spread_m3=_spread(row.measured, row.volume_m3, row.volume_square_m6),
        weighed=row.weighed,
        mass_kg=Quantity(row.mass_kg, sqrt(row.mass_variance_kg2)),
        mass_spread_kg=_spread(row.weighed, row.mass_kg, row.mass_square_kg2),
    )


def _spread(count: int, total: float, squares: float) -> float:
    return sqrt(max(squares - total**2 / count, 0.0) / (count - 1)) if count > 1 else nan
