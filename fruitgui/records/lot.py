"""What a lot is, and how it is read from its rows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from sqlalchemy import select
from sqlalchemy.orm import Session

from fruitgui.errors import InputError
from fruitgui.records.spells import Spell, Trouble, spells_of, troubles_of
from fruitgui.records.tables import LotRow, PauseRow

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
        spells: in which sensors gave nothing or too little, in order.
        troubles: what else left it in doubt, in order.
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
    spells: tuple[Spell, ...] = ()
    troubles: tuple[Trouble, ...] = ()

    @property
    def paused(self) -> bool:
        """Whether it stands still now."""
        return bool(self.pauses) and self.pauses[-1].to_s is None

    def gone_on(self, since_s: float) -> Lot:
        """Return it as it is where its pause ended then."""
        if not self.paused:
            return self
        return replace(self, pauses=(*self.pauses[:-1], replace(self.pauses[-1], to_s=since_s)))

    def ran_s(self, now_s: float) -> float:
        """Return how long it has run until now or its end, pauses left out."""
        end_s = now_s if self.ended_s is None else self.ended_s
        paused_s = sum((end_s if one.to_s is None else one.to_s) - one.from_s for one in self.pauses)
        return max(end_s - self.started_s - paused_s, 0.0)


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
    """Return rows as lots, with their pauses and spells."""
    session.flush()
    keys = [row.id for row in rows]
    spells, troubles = spells_of(session, keys), troubles_of(session, keys)
    pauses: dict[int, list[Pause]] = {row.id: [] for row in rows}
    found = select(PauseRow).where(PauseRow.lot_id.in_(pauses)).order_by(PauseRow.from_s, PauseRow.id)
    for pause in session.scalars(found):
        pauses[pause.lot_id].append(Pause(pause.from_s, pause.to_s, pause.why))
    return [
        Lot(
            row.id, row.name, row.grower, row.recipe, row.note, row.reference_sensor, row.station_sha256, row.model,
            row.size_bands, tuple(row.outlets), row.started_s, row.ended_s, tuple(pauses[row.id]),
            tuple(spells[row.id]), tuple(troubles[row.id]),
        )
        for row in rows
    ]  # fmt: skip


def lot_of(session: Session, row: LotRow) -> Lot:
    """Return a row as a lot, with its pauses and spells."""
    return lots_of(session, [row])[0]
