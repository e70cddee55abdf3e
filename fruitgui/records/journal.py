"""The journal of teaching: each step as it was done, taken back or done again. Nothing in it is ever changed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass
from typing import Literal

from sqlalchemy import select
from sqlalchemy.orm import Session

from fruitgui.records.tables import JournalRow, TaughtRow

Taught = Literal["kind", "volume_ml", "mass_g"]
"""What can be taught of a fruit."""

READ_AT_ONCE = 64


@dataclass(frozen=True, slots=True)
class Change:
    """What one step changed of one fruit.

    Attributes:
        taught: key of the taught fruit.
        what: was changed.
        before, after: a kind, a number, or None.
    """

    taught: int
    what: Taught
    before: str | float | None
    after: str | float | None


@dataclass(frozen=True, slots=True)
class Step:
    """One step that can be taken back, or done again.

    Attributes:
        key: in the journal.
        changes: of a step of its own.
        who: did it.
        when_s: Unix seconds.
    """

    key: int
    changes: tuple[Change, ...]
    who: str
    when_s: float


def do(session: Session, changes: Sequence[Change], who: str, when_s: float) -> None:
    """Make changes, and write them down as one step; what was taken back before can no longer be done again."""
    real = [change for change in changes if change.before != change.after]
    if real:
        _set(session, ((change.taught, change.what, change.after) for change in real))
        session.add(JournalRow(act="do", changes=[asdict(change) for change in real], who=who, when_s=when_s))


def undo(session: Session, who: str, when_s: float) -> Step | None:
    """Take the newest step back; return it, or None where there is none."""
    step = to_undo(session)
    if step is not None:
        _set(session, ((change.taught, change.what, change.before) for change in step.changes))
        session.add(JournalRow(act="undo", step_id=step.key, changes=[], who=who, when_s=when_s))
    return step


def redo(session: Session, who: str, when_s: float) -> Step | None:
    """Do again what was taken back last; return it, or None where there is none."""
    step = to_redo(session)
    if step is not None:
        _set(session, ((change.taught, change.what, change.after) for change in step.changes))
        session.add(JournalRow(act="redo", step_id=step.key, changes=[], who=who, when_s=when_s))
    return step


def to_undo(session: Session) -> Step | None:
    """Return the step that `undo` would take back.

    Going back in time, each step taken back hides one that was done.
    """
    hidden = 0
    for row in _backwards(session):
        if row.act == "undo":
            hidden += 1
        elif hidden:
            hidden -= 1
        else:
            return _step(session, row)
    return None


def to_redo(session: Session) -> Step | None:
    """Return the step that `redo` would do again; a new step since then leaves none."""
    again = 0
    for row in _backwards(session):
        if row.act == "do":
            return None
        if row.act == "redo":
            again += 1
        elif again:
            again -= 1
        else:
            return _step(session, row)
    return None


def _backwards(session: Session) -> Iterator[JournalRow]:
    newest_first = select(JournalRow).order_by(JournalRow.id.desc())
    yield from session.scalars(newest_first.execution_options(yield_per=READ_AT_ONCE))


def _step(session: Session, row: JournalRow) -> Step:
    """Return the step that a row did, or speaks of."""
    own = row if row.step_id is None else session.get_one(JournalRow, row.step_id)
    return Step(own.id, tuple(Change(**change) for change in own.changes), own.who, own.when_s)


def _set(session: Session, values: Iterable[tuple[int, Taught, str | float | None]]) -> None:
    for key, what, value in values:
        row = session.get(TaughtRow, key)
        if row is not None:  # it may have been removed since
            setattr(row, what, value)
