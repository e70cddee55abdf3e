"""What a person says against the machine, kept beside what the machine said."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from sqlalchemy import select
from sqlalchemy.orm import Session

from fruitgui.errors import InputError
from fruitgui.records import totals
from fruitgui.records.counting import next_number
from fruitgui.records.database import Database
from fruitgui.records.lot import lot_row
from fruitgui.records.tables import CorrectionRow, FruitRow
from fruitgui.station.labels import LONGEST_KIND


@dataclass(frozen=True, slots=True)
class Correction:
    """One word of a person on one fruit.

    Attributes:
        kind: that it is; None where this says nothing of the kind.
        counted: whether it counts; None where this says nothing of that.
        note, who: in people's words.
        when_s: Unix seconds.
    """

    kind: str | None
    counted: bool | None
    note: str
    who: str
    when_s: float


class Corrections:
    """The corrections of a store; none is ever changed, the newest holds."""

    def __init__(self, database: Database, now_s: Callable[[], float] = time.time) -> None:
        self._database = database
        self._now_s = now_s

    def name(self, fruit: Sequence[int], kind: str, who: str = "", note: str = "") -> None:
        """Say what some fruit are.

        Raises:
            InputError: there is no such fruit, or the kind is no word.
            WorldError: it cannot be kept.
        """
        kind = checked_kind(kind)
        with self._database.writing() as session:
            self._correct(session, fruit, Correction(kind, None, note, who, self._now_s()))

    def leave_out(self, fruit: Sequence[int], who: str = "", note: str = "") -> None:
        """Say that some fruit do not count: counted twice, or none at all. See `name` for errors."""
        with self._database.writing() as session:
            self._correct(session, fruit, Correction(None, False, note, who, self._now_s()))

    def put_back(self, fruit: Sequence[int], who: str = "", note: str = "") -> None:
        """Say that some fruit count after all. See `name` for errors."""
        with self._database.writing() as session:
            self._correct(session, fruit, Correction(None, True, note, who, self._now_s()))

    def add(self, lot: int, kind: str, who: str = "", note: str = "") -> int:
        """Add a fruit that the machine missed; return its key. It has no measurements. See `name` for errors."""
        kind = checked_kind(kind)
        with self._database.writing() as session:
            lot_row(session, lot)
            # It counts from its correction on, like one that is put back.
            row = FruitRow(
                lot_id=lot, number=next_number(session, lot), counted_s=self._now_s(), kind=kind, counted=False, views=0
            )
            session.add(row)
            session.flush()
            self._correct(session, [row.id], Correction(kind, True, note, who, self._now_s()))
            return row.id

    def of(self, fruit: int) -> tuple[Correction, ...]:
        """Return all that was said of a fruit, in order."""
        with self._database.reading() as session:
            return corrections_of(session, fruit)

    def _correct(self, session: Session, fruit: Sequence[int], said: Correction) -> None:
        rows = {key: fruit_row(session, key) for key in fruit}
        totals.take_out(session, rows.values())
        for key, row in rows.items():
            row.kind = row.kind if said.kind is None else said.kind
            row.counted = row.counted if said.counted is None else said.counted
            session.add(
                CorrectionRow(
                    fruit_id=key, kind=said.kind, counted=said.counted, note=said.note, who=said.who, when_s=said.when_s
                )
            )
        totals.add(session, rows.values())


def corrections_of(session: Session, fruit: int) -> tuple[Correction, ...]:
    """Return all that was said of a fruit, in order."""
    rows = session.scalars(select(CorrectionRow).where(CorrectionRow.fruit_id == fruit).order_by(CorrectionRow.id))
    return tuple(Correction(row.kind, row.counted, row.note, row.who, row.when_s) for row in rows)


def fruit_row(session: Session, fruit: int) -> FruitRow:
    """Return a fruit's row.

    Raises:
        InputError: there is none of that key.
    """
    row = session.get(FruitRow, fruit)
    if row is None:
        raise InputError("no_such_fruit", f"There is no fruit with the key {fruit}.", "Choose a fruit from the list.")
    return row


def checked_kind(kind: str) -> str:
    """Return a kind without space around it.

    Raises:
        InputError: it is empty, too long, or not printable.
    """
    kind = kind.strip()
    if not kind or len(kind) > LONGEST_KIND or not kind.isprintable():
        raise InputError(
            "bad_kind",
            f"{kind[:80]!r} cannot be a kind.",
            f"Name a kind with 1 to {LONGEST_KIND} printable letters.",
            values={"most": str(LONGEST_KIND)},
        )
    return kind
