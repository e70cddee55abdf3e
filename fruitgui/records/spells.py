"""Times in which sensors were away while a lot ran: what was not seen is not counted, and a lot says so for good."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from sqlalchemy import select
from sqlalchemy.orm import Session

from fruitgui.records.database import Database
from fruitgui.records.tables import LotRow, SpellRow
from fruitgui.station.live.blind import Blind


@dataclass(frozen=True, slots=True)
class Spell:
    """A time in which sensors were away.

    Attributes:
        from_s, to_s: Unix seconds; it goes on where there is no end.
        blind: who was away, and what of the belt nobody saw.
    """

    from_s: float
    to_s: float | None
    blind: Blind

    def lasted_s(self, now_s: float) -> float:
        """Return how long it lasted, until now where it goes on."""
        return max((now_s if self.to_s is None else self.to_s) - self.from_s, 0.0)


class Spells:
    """Writes spells down as they begin and end."""

    def __init__(self, database: Database, now_s: Callable[[], float] = time.time) -> None:
        self._database = database
        self._now_s = now_s

    def note(self, lot: int, blind: Blind | None) -> None:
        """Note what is not seen from now on; None where all is. What was noted before ends, unless it is the same.

        Of a lot that is ended, or not there, nothing is noted.

        Raises:
            WorldError: it cannot be kept.
        """
        with self._database.writing() as session:
            row = session.get(LotRow, lot)
            if row is None or row.ended_s is not None:
                return
            now_s = self._now_s()
            before = list(session.scalars(select(SpellRow).where(SpellRow.lot_id == lot, SpellRow.to_s.is_(None))))
            if len(before) == 1 and blind is not None and _spell(before[0]).blind == blind:
                return
            _end(before, now_s)
            if blind is not None:
                session.add(SpellRow(
                    lot_id=lot, from_s=now_s, to_s=None, sensors=list(blind.sensors),
                    lanes_m=None if blind.lanes_m is None else [list(lane) for lane in blind.lanes_m],
                    width_m=blind.width_m, share=blind.share,
                ))  # fmt: skip


def end_spells(session: Session, lot: int, at_s: float) -> None:
    """End what goes on in a lot: the line does not run on."""
    _end(session.scalars(select(SpellRow).where(SpellRow.lot_id == lot, SpellRow.to_s.is_(None))), at_s)


def spells_of(session: Session, lots: Iterable[int]) -> dict[int, list[Spell]]:
    """Return the spells of lots, by their keys, in order."""
    found: dict[int, list[Spell]] = {lot: [] for lot in lots}
    rows = select(SpellRow).where(SpellRow.lot_id.in_(found)).order_by(SpellRow.from_s, SpellRow.id)
    for row in session.scalars(rows):
        found[row.lot_id].append(_spell(row))
    return found


def _end(rows: Iterable[SpellRow], at_s: float) -> None:
    for row in rows:
        row.to_s = max(at_s, row.from_s)  # the computer's clock may have been set back


def _spell(row: SpellRow) -> Spell:
    lanes = None if row.lanes_m is None else tuple((float(begin), float(end)) for begin, end in row.lanes_m)
    return Spell(row.from_s, row.to_s, Blind(tuple(map(str, row.sensors)), lanes, row.width_m, row.share))
