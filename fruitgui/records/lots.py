"""Lots: started, paused, ended, and found again after a crash."""

from __future__ import annotations

import hashlib
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from sqlalchemy import func, select
from sqlalchemy.dialects.sqlite import insert
from sqlalchemy.orm import Session

from fruitgui.errors import InputError
from fruitgui.records.database import Database
from fruitgui.records.tables import FruitRow, LotRow, PauseRow, StationCopyRow

ASKED = "asked"
"""Why a lot paused: a person said so."""

NOT_RUNNING = "not_running"
"""Why a lot paused: the program was not running."""


@dataclass(frozen=True, slots=True)
class Pause:
    """A time in which a lot stood still.

    Attributes:
        from_s, to_s: Unix seconds; it goes on where there is no end.
        why: `asked`, `not_running`, or a person's words.
    """

    from_s: float
    to_s: float | None
    why: str


@dataclass(frozen=True, slots=True)
class LotPlan:
    """What is known of a lot when it starts.

    Attributes:
        name, grower, recipe, note: for people.
        reference_sensor: id of the sensor whose frame and clock the fruit are in.
        station_text: of the station's file.
        model: name of the model's file; None where untrained.
        size_bands, outlets: as the recipe has them, anything that JSON can hold.
    """

    name: str
    grower: str = ""
    recipe: str = ""
    note: str = ""
    reference_sensor: str = ""
    station_text: str | None = None
    model: str | None = None
    size_bands: Mapping[str, Any] = field(default_factory=dict)
    outlets: Sequence[Any] = ()


@dataclass(frozen=True, slots=True)
class Lot:
    """A lot as it is kept.

    Attributes:
        key: unique in the store.
        name, grower, recipe, note, reference_sensor, model, size_bands, outlets: see `LotPlan`.
        station_sha256: of the station's text, see `Lots.station_text`.
        started_s, ended_s: Unix seconds; open where there is no end.
        pauses: in order.
    """

    key: int
    name: str
    grower: str
    recipe: str
    note: str
    reference_sensor: str
    station_sha256: str | None
    model: str | None
    size_bands: Mapping[str, Any]
    outlets: Sequence[Any]
    started_s: float
    ended_s: float | None
    pauses: tuple[Pause, ...]

    @property
    def paused(self) -> bool:
        """Whether it stands still now."""
        return bool(self.pauses) and self.pauses[-1].to_s is None

    def ran_s(self, now_s: float) -> float:
        """Return how long it has run until now or its end, pauses left out."""
        end_s = now_s if self.ended_s is None else self.ended_s
        paused_s = sum((end_s if one.to_s is None else one.to_s) - one.from_s for one in self.pauses)
        return max(end_s - self.started_s - paused_s, 0.0)


class Lots:
    """The lots of a store."""

    def __init__(self, database: Database, now_s: Callable[[], float] = time.time) -> None:
        self._database = database
        self._now_s = now_s

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
                raise InputError("lot_open", f"Lot {open_lot.name} is still open.", "End it first.")
            row = LotRow(
                name=name, grower=plan.grower.strip(), recipe=plan.recipe, note=plan.note,
                reference_sensor=plan.reference_sensor, station_sha256=_station_copy(session, plan.station_text),
                model=plan.model, size_bands=dict(plan.size_bands), outlets=list(plan.outlets),
                started_s=self._now_s(), ended_s=None,
            )  # fmt: skip
            session.add(row)
            session.flush()
            return _lot(session, row)

    def get(self, lot: int) -> Lot:
        """Return a lot.

        Raises:
            InputError: there is none of that key.
        """
        with self._database.reading() as session:
            return _lot(session, lot_row(session, lot))

    def open_lot(self) -> Lot | None:
        """Return the lot that was not ended: it runs, or a crash left it open. None where all are ended."""
        with self._database.reading() as session:
            row = _open(session)
            return None if row is None else _lot(session, row)

    def pause(self, lot: int, why: str = ASKED) -> Lot:
        """Let a lot stand still; one that does already stays as it is."""
        with self._database.writing() as session:
            row = _still_open(session, lot)
            if _open_pause(session, lot) is None:
                session.add(PauseRow(lot_id=lot, from_s=self._now_s(), to_s=None, why=why))
            return _lot(session, row)

    def resume(self, lot: int) -> Lot:
        """Let a lot go on; one that runs already stays as it is."""
        with self._database.writing() as session:
            row = _still_open(session, lot)
            pause = _open_pause(session, lot)
            if pause is not None:
                pause.to_s = self._now_s()
            return _lot(session, row)

    def take_up(self, lot: int) -> Lot:
        """Go on with a lot that a crash left open: the time since its last fruit becomes a pause."""
        with self._database.writing() as session:
            row = _still_open(session, lot)
            pause = _open_pause(session, lot)
            if pause is None:
                pause = PauseRow(lot_id=lot, from_s=_last_sign_s(session, row), why=NOT_RUNNING)
                session.add(pause)
            pause.to_s = max(self._now_s(), pause.from_s)
            return _lot(session, row)

    def end(self, lot: int) -> Lot:
        """End a lot; one that is ended stays as it is. Fruit that still wait for the disk may be added after."""
        with self._database.writing() as session:
            row = lot_row(session, lot)
            if row.ended_s is None:
                row.ended_s = self._now_s()
                pause = _open_pause(session, lot)
                if pause is not None:
                    pause.to_s = row.ended_s
            return _lot(session, row)

    def describe(self, lot: int, name: str, grower: str, note: str) -> Lot:
        """Change what people call a lot.

        Raises:
            InputError: no name is left, or there is no such lot.
        """
        with self._database.writing() as session:
            row = lot_row(session, lot)
            row.name, row.grower, row.note = _name(name), grower.strip(), note
            return _lot(session, row)

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


def lot_row(session: Session, lot: int) -> LotRow:
    """Return a lot's row.

    Raises:
        InputError: there is none of that key.
    """
    row = session.get(LotRow, lot)
    if row is None:
        raise InputError("no_such_lot", f"There is no lot with the key {lot}.", "Choose a lot from the list.")
    return row


def lots_of(session: Session, rows: Sequence[LotRow]) -> list[Lot]:
    """Return rows as lots, with their pauses."""
    session.flush()
    pauses: dict[int, list[Pause]] = {row.id: [] for row in rows}
    found = select(PauseRow).where(PauseRow.lot_id.in_(pauses)).order_by(PauseRow.from_s, PauseRow.id)
    for pause in session.scalars(found):
        pauses[pause.lot_id].append(Pause(pause.from_s, pause.to_s, pause.why))
    return [
        Lot(
            row.id, row.name, row.grower, row.recipe, row.note, row.reference_sensor, row.station_sha256, row.model,
            row.size_bands, tuple(row.outlets), row.started_s, row.ended_s, tuple(pauses[row.id]),
        )
        for row in rows
    ]  # fmt: skip


def _lot(session: Session, row: LotRow) -> Lot:
    return lots_of(session, [row])[0]


def _open(session: Session) -> LotRow | None:
    return session.scalar(select(LotRow).where(LotRow.ended_s.is_(None)))


def _still_open(session: Session, lot: int) -> LotRow:
    row = lot_row(session, lot)
    if row.ended_s is not None:
        raise InputError("lot_ended", f"Lot {row.name} is ended.", "Start another.")
    return row


def _open_pause(session: Session, lot: int) -> PauseRow | None:
    return session.scalar(select(PauseRow).where(PauseRow.lot_id == lot, PauseRow.to_s.is_(None)))


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
