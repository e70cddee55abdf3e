"""Lots found by name, grower and date, a page at a time, each with its totals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from sqlalchemy import ColumnElement, func, or_, select
from sqlalchemy.orm import Session

from fruitgui.records.database import folded
from fruitgui.records.lot import Lot, lots_of
from fruitgui.records.tables import LotRow
from fruitgui.records.totals import KindTotal, totals


@dataclass(frozen=True, slots=True)
class LotQuery:
    """Which lots are wanted.

    Attributes:
        words: each must be part of the name or the grower, whatever its case and accents.
        from_s, to_s: started within, Unix seconds.
        first: of those found, the newest being 0.
        count: on the page.
    """

    words: str = ""
    from_s: float | None = None
    to_s: float | None = None
    first: int = 0
    count: int = 50


@dataclass(frozen=True, slots=True)
class LotLine:
    """A lot in a list.

    Attributes:
        lot: itself.
        kinds: its sums, the most frequent kind first.
    """

    lot: Lot
    kinds: tuple[KindTotal, ...]

    @property
    def fruit(self) -> int:
        """How many were counted."""
        return sum(one.fruit for one in self.kinds)

    @property
    def volume_m3(self) -> float:
        """Of all measured fruit."""
        return sum(one.volume_m3.value for one in self.kinds)

    @property
    def mass_kg(self) -> float:
        """Of all fruit whose mass is known."""
        return sum(one.mass_kg.value for one in self.kinds)


@dataclass(frozen=True, slots=True)
class LotPage:
    """Some of the lots that were found.

    Attributes:
        lots: of this page.
        found: how many there are on all pages.
    """

    lots: tuple[LotLine, ...]
    found: int


def find(session: Session, query: LotQuery) -> LotPage:
    """Return one page of what a query finds."""
    wanted = list(_conditions(query))
    found = session.scalar(select(func.count()).select_from(LotRow).where(*wanted)) or 0
    rows = session.scalars(
        select(LotRow)
        .where(*wanted)
        .order_by(LotRow.started_s.desc(), LotRow.id.desc())
        .offset(query.first)
        .limit(query.count)
    ).all()
    sums = totals(session, [row.id for row in rows])
    return LotPage(tuple(LotLine(lot, sums[lot.key]) for lot in lots_of(session, rows)), found)


def _conditions(query: LotQuery) -> Sequence[ColumnElement[Any]]:
    words = [
        or_(*(func.folded(column).contains(word, autoescape=True) for column in (LotRow.name, LotRow.grower)))
        for word in folded(query.words).split()
    ]
    since = [] if query.from_s is None else [LotRow.started_s >= query.from_s]
    until = [] if query.to_s is None else [LotRow.started_s <= query.to_s]
    return [*words, *since, *until]
