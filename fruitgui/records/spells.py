"""Times in which sensors gave nothing or too little while a lot ran: a lot says for good what may not be counted."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Literal, cast, get_args

from sqlalchemy import select
from sqlalchemy.orm import Session

from fruitgui.records.database import Database
from fruitgui.records.tables import LotRow, SpellRow
from fruitgui.station.live.blind import Blind

MomentSort = Literal["clock_jumped", "mostly_unknown", "line_begun_again"]
"""What happens at a moment, as the line's warnings name it: `clock_jumped`, clocks of sensors leapt; `mostly_unknown`,
most of the last fruit were unknown to the model; `line_begun_again`, the line broke off and went on."""

MOMENTS: tuple[MomentSort, ...] = get_args(MomentSort)

TroubleSort = Literal["moved", MomentSort]
"""`moved`: sensors do not stand as they were calibrated, for as long as that is so."""

SpellSort = Literal["away", "sparse"]
"""`away`: sensors gave nothing. `sparse`: they gave too few pictures for the belt's speed."""

SPELL_SORTS: tuple[SpellSort, ...] = get_args(SpellSort)


@dataclass(frozen=True, slots=True)
class Trouble:
    """A time in which something other than sensors that gave too little left a lot in doubt.

    Attributes:
        sort: what it was.
        from_s, to_s: Unix seconds; it goes on where there is no end, and has none of its own where both are one.
        sensors: their names; none where it is not about sensors.
    """

    sort: TroubleSort
    from_s: float
    to_s: float | None
    sensors: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Spell:
    """A time in which sensors gave nothing, or too little.

    Attributes:
        from_s, to_s: Unix seconds; it goes on where there is no end.
        blind: who it was, and what of the belt nobody saw, or not often enough.
        sort: which of the two.
    """

    from_s: float
    to_s: float | None
    blind: Blind
    sort: SpellSort = "away"

    def lasted_s(self, now_s: float) -> float:
        """Return how long it lasted, until now where it goes on."""
        return max((now_s if self.to_s is None else self.to_s) - self.from_s, 0.0)


class Spells:
    """Writes spells down as they begin and end."""

    def __init__(self, database: Database, now_s: Callable[[], float] = time.time) -> None:
        self._database = database
        self._now_s = now_s

    def note(self, lot: int, blind: Blind | None, sort: SpellSort = "away") -> None:
        """Note what is not seen from now on; None where all is. What was noted before ends, unless it is the same.

        What is not seen and what is not seen often enough are noted apart.

        Of a lot that is ended, or not there, nothing is noted.

        Raises:
            WorldError: it cannot be kept.
        """
        with self._database.writing() as session:
            if not _runs(session, lot):
                return
            now_s = self._now_s()
            before = _going_on(session, lot, sort)
            if len(before) == 1 and blind is not None and _spell(before[0]).blind == blind:
                return
            _end(before, now_s)
            if blind is not None:
                session.add(SpellRow(
                    lot_id=lot, from_s=now_s, to_s=None, sensors=list(blind.sensors),
                    lanes_m=None if blind.lanes_m is None else [list(lane) for lane in blind.lanes_m],
                    width_m=blind.width_m, share=blind.share, sort=sort,
                ))  # fmt: skip

    def note_moved(self, lot: int, sensors: tuple[str, ...]) -> None:
        """Note which sensors do not stand as they were calibrated, from now on; none: all do, or nothing is counted.

        Raises:
            WorldError: it cannot be kept.
        """
        with self._database.writing() as session:
            before = _going_on(session, lot, "moved")
            if not _runs(session, lot) or [tuple(row.sensors) for row in before] == [sensors]:
                return
            now_s = self._now_s()
            _end(before, now_s)
            if sensors:
                session.add(_trouble_row(lot, "moved", sensors, now_s, None))

    def note_moment(self, lot: int, sort: MomentSort, sensors: tuple[str, ...] = ()) -> None:
        """Note what happened now, and to which sensors, where it is about some.

        Raises:
            WorldError: it cannot be kept.
        """
        with self._database.writing() as session:
            if _runs(session, lot):
                now_s = self._now_s()
                session.add(_trouble_row(lot, sort, sensors, now_s, now_s))


def end_spells(session: Session, lot: int, at_s: float) -> None:
    """End what goes on in a lot: the line does not run on."""
    _end(session.scalars(select(SpellRow).where(SpellRow.lot_id == lot, SpellRow.to_s.is_(None))), at_s)


def spells_of(session: Session, lots: Iterable[int]) -> dict[int, list[Spell]]:
    """Return the spells of lots, by their keys, in order."""
    found: dict[int, list[Spell]] = {lot: [] for lot in lots}
    for row in _rows(session, found):
        if row.sort in SPELL_SORTS:
            found[row.lot_id].append(_spell(row))
    return found


def troubles_of(session: Session, lots: Iterable[int]) -> dict[int, list[Trouble]]:
    """Return what else left lots in doubt, by their keys, in order."""
    found: dict[int, list[Trouble]] = {lot: [] for lot in lots}
    for row in _rows(session, found):
        if row.sort not in SPELL_SORTS:
            sort = cast("TroubleSort", row.sort)
            found[row.lot_id].append(Trouble(sort, row.from_s, row.to_s, tuple(map(str, row.sensors))))
    return found


def _rows(session: Session, lots: Mapping[int, object]) -> Iterable[SpellRow]:
    wanted = select(SpellRow).where(SpellRow.lot_id.in_(lots))
    return session.scalars(wanted.order_by(SpellRow.from_s, SpellRow.id))


def _runs(session: Session, lot: int) -> bool:
    row = session.get(LotRow, lot)
    return row is not None and row.ended_s is None


def _going_on(session: Session, lot: int, sort: str) -> list[SpellRow]:
    wanted = select(SpellRow).where(SpellRow.lot_id == lot, SpellRow.sort == sort, SpellRow.to_s.is_(None))
    return list(session.scalars(wanted))


def _trouble_row(lot: int, sort: TroubleSort, sensors: tuple[str, ...], from_s: float, to_s: float | None) -> SpellRow:
    return SpellRow(
        lot_id=lot, from_s=from_s, to_s=to_s, sensors=list(sensors), lanes_m=None, width_m=None, share=0.0, sort=sort
    )


def _end(rows: Iterable[SpellRow], at_s: float) -> None:
    for row in rows:
        row.to_s = max(at_s, row.from_s)  # the computer's clock may have been set back


def _spell(row: SpellRow) -> Spell:
    lanes = None if row.lanes_m is None else tuple((float(begin), float(end)) for begin, end in row.lanes_m)
    blind = Blind(tuple(map(str, row.sensors)), lanes, row.width_m, row.share)
    return Spell(row.from_s, row.to_s, blind, cast("SpellSort", row.sort))
