"""The fruit of a lot: a page at a time, sorted and filtered; one with its path; distributions."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, Literal, TypeVar

from sqlalchemy import ColumnElement, Select, TextClause, and_, func, select
from sqlalchemy.orm import InstrumentedAttribute

from fruitgui.records.correcting import Correction, corrections_of, fruit_row
from fruitgui.records.crops import Crops
from fruitgui.records.database import Database
from fruitgui.records.distribution import Distribution, Measured, distribution
from fruitgui.records.fruit_record import FruitRecord, fruit_record
from fruitgui.records.packing import unpack_path
from fruitgui.records.tables import CORRECTED, FruitRow, PathRow, TotalRow
from fruitgui.station.sink import Crop
from fruitgui.tracking.track import PathPoint

Order = Literal[
    "number", "kind", "kind_probability", "volume_m3", "mass_kg", "length_m", "diameter_m", "perimeter_m", "views"
]
"""What fruit are sorted by."""

Which = Literal["counted", "left_out", "corrected"]
"""Fruit that count; those that a person left out; those of which a person said something else than the machine."""

T = TypeVar("T")

READ_AT_ONCE = 2_000
"""Rows that a walk through a lot holds in memory."""


@dataclass(frozen=True, slots=True)
class FruitQuery:
    """Which fruit of a lot are wanted.

    Attributes:
        lot: its key.
        kind: that holds; None for all kinds.
        which: that count, or not.
        order: what they are sorted by; what was not measured comes last.
        falling: the largest first.
        first: of those found.
        count: on the page.
    """

    lot: int
    kind: str | None = None
    which: Which = "counted"
    order: Order = "number"
    falling: bool = False
    first: int = 0
    count: int = 100


@dataclass(frozen=True, slots=True)
class FruitPage:
    """Some of the fruit that were found.

    Attributes:
        fruit: of this page.
        found: how many there are on all pages.
    """

    fruit: tuple[FruitRecord, ...]
    found: int


@dataclass(frozen=True, slots=True, eq=False)
class FruitStory:
    """All that is kept of one fruit.

    Attributes:
        fruit: what was measured, and what holds.
        path: reference frame and clock; empty where a person added it.
        corrections: in order.
        crops: none where they aged out.
    """

    fruit: FruitRecord
    path: tuple[PathPoint, ...]
    corrections: tuple[Correction, ...]
    crops: tuple[Crop, ...]


class CountedFruits:
    """The counted fruit of a store, for reading."""

    def __init__(self, database: Database, crops: Crops) -> None:
        self._database = database
        self._crops = crops

    def find(self, query: FruitQuery) -> FruitPage:
        """Return one page of what a query finds."""
        wanted = _conditions(query)
        with self._database.reading() as session:
            found = session.scalar(_counted(query)) or 0
            # Keys are sorted first, and whole rows only of the page: sorting a day's fruit whole takes far longer.
            page = _sorted(select(FruitRow.id).where(*wanted), query).offset(query.first).limit(query.count)
            rows = session.scalars(_sorted(select(FruitRow).where(FruitRow.id.in_(page)), query))
            return FruitPage(tuple(fruit_record(row) for row in rows), found)

    def story(self, fruit: int) -> FruitStory:
        """Return all of one fruit.

        Raises:
            InputError: there is none of that key.
        """
        with self._database.reading() as session:
            row = fruit_row(session, fruit)
            path = session.get(PathRow, fruit)
            record, corrections = fruit_record(row), corrections_of(session, fruit)
        return FruitStory(
            record, () if path is None else unpack_path(path.points), corrections, self._crops.of("fruit", fruit)
        )

    def walk(self, lot: int) -> Iterator[FruitRecord]:
        """Go through a whole lot in order of numbers, those left out too; memory stays flat, and so does the view."""
        wanted = select(FruitRow).where(FruitRow.lot_id == lot).order_by(FruitRow.number)
        with self._database.reading() as session:
            for row in session.scalars(wanted.execution_options(yield_per=READ_AT_ONCE)):
                yield fruit_record(row)

    def distribution(self, lot: int, measured: Measured, bins: int = 30) -> Distribution:
        """Return how a measure is spread over the counted fruit of a lot, by kind."""
        with self._database.reading() as session:
            return distribution(session, lot, measured, bins)


def _conditions(query: FruitQuery) -> list[ColumnElement[bool] | TextClause]:
    wanted = [FruitRow.lot_id == query.lot, _WHICH[query.which]()]
    return wanted if query.kind is None else [*wanted, FruitRow.kind == query.kind]


def _counted(query: FruitQuery) -> Select[int]:
    """Return how many a query finds; those that count are summed up already."""
    if query.which != "counted":
        return select(func.count()).select_from(FruitRow).where(*_conditions(query))
    kinds = [] if query.kind is None else [TotalRow.kind == query.kind]
    return select(func.sum(TotalRow.fruit)).where(TotalRow.lot_id == query.lot, *kinds)


_WHICH: dict[Which, Callable[[], ColumnElement[bool] | TextClause]] = {
    "counted": lambda: FruitRow.counted.is_(True),
    "left_out": lambda: and_(CORRECTED, FruitRow.counted.is_(False)),
    "corrected": lambda: CORRECTED,
}


def _sorted(rows: Select[T], query: FruitQuery) -> Select[T]:
    column: InstrumentedAttribute[Any] = getattr(FruitRow, query.order)
    if query.order == "number":
        return rows.order_by(column.desc() if query.falling else column)
    return rows.order_by((column.desc() if query.falling else column.asc()).nulls_last(), FruitRow.number)
