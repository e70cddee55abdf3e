"""Lots: started, paused, ended, found again after a crash, and searched."""

from __future__ import annotations

import hashlib

from sqlalchemy import func, select
from sqlalchemy.dialects.sqlite import insert
from sqlalchemy.orm import Session

from fruitgui.errors import InputError
from fruitgui.records.counting import next_number
from fruitgui.records.database import Database
from fruitgui.records.lot import ASKED, NOT_RUNNING, Lot, LotPlan, lot_of, lot_row
from fruitgui.records.lot_search import LotPage, LotQuery, find
from fruitgui.records.spells import end_spells
from fruitgui.records.steady_clock import SteadyClock
from fruitgui.records.tables import FruitRow, LotRow, PauseRow, StationCopyRow
from fruitgui.records.totals import KindTotal, totals


class Lots:
    """The lots of a store; the clock is set between them, never within one."""

    def __init__(self, database: Database, clock: SteadyClock) -> None:
        self._database = database
        self._now_s = clock

    def start(self, plan: LotPlan) -> Lot:
        """Start a lot.

        Raises:
            InputError: it has no name, or another lot is open.
            WorldError: it cannot be kept.
        """
        name = _name(plan.name)
        with self._database.writing() as session:
            open_lot = _open(session)
            if open_lot is not None:
                raise InputError(
                    "lot_open", f"Lot {open_lot.name} is still open.", "End it first.", values={"lot": open_lot.name}
                )
            self._now_s.set()
            row = LotRow(
                name=name, grower=plan.grower.strip(), recipe=plan.recipe, note=plan.note,
                reference_sensor=plan.reference_sensor, station_sha256=_station_copy(session, plan.station_text),
                model=plan.model, size_bands=dict(plan.size_bands), outlets=list(plan.outlets),
                started_s=self._now_s(), ended_s=None,
            )  # fmt: skip
            session.add(row)
            session.flush()
            return lot_of(session, row)

    def get(self, lot: int) -> Lot:
        """Return a lot.

        Raises:
            InputError: there is none of that key.
        """
        with self._database.reading() as session:
            return lot_of(session, lot_row(session, lot))

    def find(self, query: LotQuery) -> LotPage:
        """Return the lots that a query wants, the newest first, each with its totals."""
        with self._database.reading() as session:
            return find(session, query)

    def totals(self, lot: int) -> tuple[KindTotal, ...]:
        """Return a lot's sums, the most frequent kind first."""
        with self._database.reading() as session:
            return totals(session, [lot])[lot]

    def summed(self, lot: int) -> tuple[tuple[KindTotal, ...], int]:
        """Return a lot's sums, and the number of the newest fruit that is in them; 0 where there is none."""
        with self._database.reading() as session:
            return totals(session, [lot])[lot], next_number(session, lot) - 1

    def open_lot(self) -> Lot | None:
        """Return the lot that was not ended: it runs, or a crash left it open. None where all are ended."""
        with self._database.reading() as session:
            row = _open(session)
            return None if row is None else lot_of(session, row)

    def left_open(self) -> Lot | None:
        """Return the lot on which no line runs any more though it was not ended; None where all are.

        What was not seen when it was left ends with its last sign: for how long after that, nobody knows.

        Raises:
            WorldError: that cannot be kept.
        """
        lot = self.open_lot()
        if lot is None or None not in [*(one.to_s for one in lot.spells), *(one.to_s for one in lot.troubles)]:
            return lot
        with self._database.writing() as session:
            row = lot_row(session, lot.key)
            end_spells(session, row.id, _last_sign_s(session, row))
            return lot_of(session, row)

    def pause(self, lot: int, why: str = ASKED) -> Lot:
        """Let a lot stand still; one that does already stays as it is."""
        with self._database.writing() as session:
            row = _still_open(session, lot)
            if _open_pause(session, lot) is None:
                session.add(PauseRow(lot_id=lot, from_s=self._now_s(), to_s=None, why=why))
            return lot_of(session, row)

    def resume(self, lot: int, since_s: float | None = None) -> Lot:
        """Let a lot go on, since now or a time before, Unix seconds; one that runs already stays as it is."""
        with self._database.writing() as session:
            row = _still_open(session, lot)
            pause = _open_pause(session, lot)
            if pause is not None:
                ends_s = self._now_s() if since_s is None else since_s
                pause.to_s = max(ends_s, pause.from_s)  # the computer's clock may have been set back
            return lot_of(session, row)

    def take_up(self, lot: int) -> Lot:
        """Go on with a lot that a crash left open: the time since its last fruit becomes a pause.

        Where the computer's clock was set back meanwhile, the lot's goes on from that fruit.
        """
        with self._database.writing() as session:
            row = _still_open(session, lot)
            pause = _standstill(session, row)
            self._now_s.set(pause.from_s)
            pause.to_s = self._now_s()
            return lot_of(session, row)

    def end_left_open(self, lot: int) -> Lot:
        """End a lot on which no line runs any more: the time since its last fruit is a pause, not part of its run."""
        with self._database.writing() as session:
            row = _still_open(session, lot)
            pause = _standstill(session, row)
            row.ended_s = pause.to_s = max(self._now_s(), pause.from_s)
            return lot_of(session, row)

    def end(self, lot: int) -> Lot:
        """End a lot; one that is ended stays as it is. Fruit that still wait for the disk may be added after."""
        with self._database.writing() as session:
            row = lot_row(session, lot)
            if row.ended_s is None:
                pause = _open_pause(session, lot)
                row.ended_s = max(self._now_s(), row.started_s if pause is None else pause.from_s)
                if pause is not None:
                    pause.to_s = row.ended_s
                end_spells(session, lot, row.ended_s)
                self._now_s.set()
            return lot_of(session, row)

    def station_text(self, lot: int) -> str | None:
        """Return the station's file as it was when the lot started."""
        wanted = (
            select(StationCopyRow.text)
            .join(LotRow, LotRow.station_sha256 == StationCopyRow.sha256)
            .where(LotRow.id == lot)
        )
        with self._database.reading() as session:
            return session.scalar(wanted)


def _name(name: str) -> str:
    if not name.strip():
        raise InputError("lot_without_name", "The lot has no name.", "Give it a name or a number.")
    return name.strip()


def _open(session: Session) -> LotRow | None:
    return session.scalar(select(LotRow).where(LotRow.ended_s.is_(None)))


def _still_open(session: Session, lot: int) -> LotRow:
    row = lot_row(session, lot)
    if row.ended_s is not None:
        raise InputError("lot_ended", f"Lot {row.name} is ended.", "Start another.", values={"lot": row.name})
    return row


def _open_pause(session: Session, lot: int) -> PauseRow | None:
    return session.scalar(select(PauseRow).where(PauseRow.lot_id == lot, PauseRow.to_s.is_(None)))


def _standstill(session: Session, lot: LotRow) -> PauseRow:
    """Return the pause in which a lot stands that no line counts into, from its last fruit on."""
    pause = _open_pause(session, lot.id)
    if pause is None:
        pause = PauseRow(lot_id=lot.id, from_s=_last_sign_s(session, lot), why=NOT_RUNNING)
        session.add(pause)
    end_spells(session, lot.id, pause.from_s)
    return pause


def _last_sign_s(session: Session, lot: LotRow) -> float:
    """Return when the lot certainly ran last: at its start, after a pause, or at a fruit."""
    signs = (
        session.scalar(select(func.max(FruitRow.counted_s)).where(FruitRow.lot_id == lot.id)),
        session.scalar(select(func.max(PauseRow.to_s)).where(PauseRow.lot_id == lot.id)),
    )
    return max([lot.started_s, *(sign for sign in signs if sign is not None)])


def _station_copy(session: Session, text: str | None) -> str | None:
    if text is None:
        return None
    sha256 = hashlib.sha256(text.encode()).hexdigest()
    session.execute(insert(StationCopyRow).values(sha256=sha256, text=text).on_conflict_do_nothing())
    return sha256
