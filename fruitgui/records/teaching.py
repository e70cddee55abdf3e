"""Taught fruit: added, named, measured; each step is on the disk at once, and can be taken back."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from sqlalchemy import Select, delete, func, select
from sqlalchemy.orm import Session

from fruitgui.classification.evidence import UNKNOWN, LabelledFruit
from fruitgui.errors import InputError
from fruitgui.records import journal
from fruitgui.records.correcting import checked_kind
from fruitgui.records.crops import Crops
from fruitgui.records.database import Database
from fruitgui.records.journal import Change, Step
from fruitgui.records.tables import SampleRow, TaughtRow
from fruitgui.records.taught import KeptTaught, Sample, TaughtFruit, sample_of, sample_row, taught_of, taught_row
from fruitgui.station.fingerprint import fingerprint
from fruitgui.station.sink import Crop
from fruitgui.station.train_job import Taught
from fruitgui.station.workflow import TaughtFacts

Teachable = tuple[TaughtFruit, Sequence[Crop]]
"""A fruit that may be taught, with its crops."""

READ_AT_ONCE = 200
"""Taught fruit that training reads at once."""


@dataclass(frozen=True, slots=True)
class KindCount:
    """How much was taught of a kind.

    Attributes:
        kind: its name.
        samples: views.
        fruit: distinct pieces.
        measured: of these, with a volume or a mass that a person measured.
    """

    kind: str
    samples: int
    fruit: int
    measured: int


@dataclass(frozen=True, slots=True)
class Brief:
    """What a grid shows of a taught fruit beside its picture.

    Attributes:
        key: in the store.
        source: where it comes from.
        kind: None while it waits to be named.
        volume_ml, mass_g: as a person measured, or None.
        samples: its views.
    """

    key: int
    source: str
    kind: str | None
    volume_ml: float | None
    mass_g: float | None
    samples: int

    @property
    def measured(self) -> bool:
        """Whether it is a reference fruit."""
        return self.volume_ml is not None or self.mass_g is not None


class Teaching:
    """The taught fruit of a store. `who` is whoever sits there, in people's words."""

    def __init__(self, database: Database, crops: Crops, now_s: Callable[[], float] = time.time) -> None:
        self._database = database
        self._crops = crops
        self._now_s = now_s

    def add(self, fruit: Sequence[Teachable]) -> tuple[int, ...]:
        """Keep fruit that may be taught, with their crops; return their keys, in order.

        Raises:
            InputError: a piece of fruit of that source is there already.
            WorldError: they cannot be kept; none is.
        """
        with self._database.writing() as session:
            for one, _ in fruit:
                _refuse_twice(session, one)
            rows = [taught_row(one, self._now_s()) for one, _ in fruit]
            session.add_all(rows)
            session.flush()
            pairs = list(zip(rows, fruit, strict=True))
            session.add_all(sample_row(row.id, sample) for row, (one, _) in pairs for sample in one.samples)
            self._crops.keep("taught", [(row.id, crop) for row, (_, crops) in pairs for crop in crops])
        return tuple(row.id for row in rows)

    def remove(self, taught: Sequence[int]) -> None:
        """Forget some fruit for good, with samples and crops."""
        with self._database.writing() as session:
            session.execute(delete(TaughtRow).where(TaughtRow.id.in_(taught)))
        self._crops.let_go("taught", taught)

    def name(self, taught: Sequence[int], kind: str, who: str = "") -> None:
        """Say what some fruit are; one step.

        Raises:
            InputError: there is no such fruit, or the kind is no word.
            WorldError: it cannot be kept.
        """
        self.change([(key, "kind", checked_kind(kind)) for key in taught], who)

    def clear(self, taught: Sequence[int], who: str = "") -> None:
        """Let some fruit wait to be named again; one step. See `name` for errors."""
        self.change([(key, "kind", None) for key in taught], who)

    def measure(self, taught: int, volume_ml: float | None, mass_g: float | None, who: str = "") -> None:
        """Say what a person measured of a fruit; one step. See `name` for errors.

        Raises:
            InputError: a measure is not above zero.
        """
        for value in (volume_ml, mass_g):
            if value is not None and not 0 < value < float("inf"):
                raise InputError(
                    "bad_measure",
                    f"{value:g} is no measure.",
                    "Type a number above zero.",
                    values={"value": f"{value:g}"},
                )
        self.change([(taught, "volume_ml", volume_ml), (taught, "mass_g", mass_g)], who)

    def change(self, values: Sequence[tuple[int, journal.Taught, str | float | None]], who: str = "") -> None:
        """Set some of what is taught, as one step.

        Raises:
            InputError: there is no such fruit.
            WorldError: it cannot be kept.
        """
        with self._database.writing() as session:
            changes = [Change(key, what, getattr(_row(session, key), what), value) for key, what, value in values]
            journal.do(session, changes, who, self._now_s())

    def undo(self, who: str = "") -> Step | None:
        """Take the newest step back; return it, or None where there is none."""
        with self._database.writing() as session:
            return journal.undo(session, who, self._now_s())

    def redo(self, who: str = "") -> Step | None:
        """Do again what was taken back last; return it, or None where there is none."""
        with self._database.writing() as session:
            return journal.redo(session, who, self._now_s())

    def steps(self) -> tuple[Step | None, Step | None]:
        """Return what `undo` and `redo` would do."""
        with self._database.reading() as session:
            return journal.to_undo(session), journal.to_redo(session)

    def counts(self) -> tuple[KindCount, ...]:
        """Return how much was taught of each kind, by name."""
        measured = TaughtRow.volume_ml.is_not(None) | TaughtRow.mass_g.is_not(None)
        fruit = (
            select(TaughtRow.kind, func.count(), func.count().filter(measured))
            .where(TaughtRow.kind.is_not(None))
            .group_by(TaughtRow.kind)
            .order_by(TaughtRow.kind)
        )
        views = (
            select(TaughtRow.kind, func.count())
            .join(SampleRow, SampleRow.taught_id == TaughtRow.id)
            .group_by(TaughtRow.kind)
        )
        with self._database.reading() as session:
            samples = dict(session.execute(views).all())
            return tuple(
                KindCount(kind, samples.get(kind, 0), count, known)
                for kind, count, known in session.execute(fruit)
                if kind is not None
            )

    def waiting(self) -> int:
        """Return how many fruit wait to be named."""
        with self._database.reading() as session:
            return session.scalar(select(func.count()).where(TaughtRow.kind.is_(None))) or 0

    def sources(self) -> dict[str, int]:
        """Return the number of fruit of each source, the newest source first."""
        newest = func.max(TaughtRow.id).desc()
        with self._database.reading() as session:
            wanted = select(TaughtRow.source, func.count()).group_by(TaughtRow.source).order_by(newest)
            return dict(session.execute(wanted).all())

    def facts(self) -> TaughtFacts | None:
        """Return what the workflow wants to know; None where nothing has a kind."""
        wanted = select(TaughtRow.source, TaughtRow.source_fruit, TaughtRow.kind, TaughtRow.volume_ml, TaughtRow.mass_g)
        named = wanted.where(TaughtRow.kind.is_not(None)).order_by(TaughtRow.source, TaughtRow.source_fruit)
        with self._database.reading() as session:
            rows = [list(row) for row in session.execute(named)]
        kinds = {one.kind: (one.samples, one.fruit) for one in self.counts() if one.kind != UNKNOWN}
        return TaughtFacts(fingerprint(rows), kinds) if rows else None

    def briefs(self) -> list[Brief]:
        """Return all fruit, named or not, the newest first."""
        views = select(SampleRow.taught_id, func.count()).group_by(SampleRow.taught_id)
        wanted = select(TaughtRow.id, TaughtRow.source, TaughtRow.kind, TaughtRow.volume_ml, TaughtRow.mass_g)
        with self._database.reading() as session:
            samples = dict(session.execute(views).all())
            rows = session.execute(wanted.order_by(TaughtRow.id.desc()))
            return [Brief(*row, samples.get(row.id, 0)) for row in rows]

    def unnamed(self) -> Iterator[KeptTaught]:
        """Go through all fruit that wait to be named, the oldest first; memory stays flat."""
        wanted = select(TaughtRow).where(TaughtRow.kind.is_(None)).order_by(TaughtRow.id)
        yield from self._walk(wanted)

    def find(self, kind: str | None, first: int = 0, count: int = 100) -> tuple[KeptTaught, ...]:
        """Return some fruit of a kind, or of those that wait to be named (None), the newest first."""
        of_kind = TaughtRow.kind.is_(None) if kind is None else TaughtRow.kind == kind
        wanted = select(TaughtRow).where(of_kind).order_by(TaughtRow.id.desc()).offset(first).limit(count)
        with self._database.reading() as session:
            return tuple(taught_of(session, session.scalars(wanted).all()))

    def get(self, taught: int) -> KeptTaught:
        """Return one fruit.

        Raises:
            InputError: there is none of that key.
        """
        with self._database.reading() as session:
            return taught_of(session, [_row(session, taught)])[0]

    def walk(self, source: str | None = None) -> Iterator[KeptTaught]:
        """Go through all fruit that have a kind, of one source or of all, the oldest first; memory stays flat."""
        wanted = select(TaughtRow).where(TaughtRow.kind.is_not(None)).order_by(TaughtRow.id)
        if source is not None:
            wanted = wanted.where(TaughtRow.source == source)
        yield from self._walk(wanted)

    def _walk(self, wanted: Select[TaughtRow]) -> Iterator[KeptTaught]:
        with self._database.reading() as session:
            for rows in session.scalars(wanted.execution_options(yield_per=READ_AT_ONCE)).partitions():
                yield from taught_of(session, rows)

    def samples(self, source: str) -> list[tuple[int, Sample]]:
        """Return all samples of a source, each with the key of its fruit, named or not."""
        wanted = select(SampleRow).join(TaughtRow).where(TaughtRow.source == source).order_by(SampleRow.id)
        with self._database.reading() as session:
            return [(row.taught_id, sample_of(row)) for row in session.scalars(wanted)]

    def for_training(self) -> list[Taught]:
        """Return all fruit that have a kind as the training job wants them."""
        return [_for_training(one.fruit, one.fruit.kind) for one in self.walk() if one.fruit.kind is not None]


def _for_training(fruit: TaughtFruit, kind: str) -> Taught:
    return Taught(
        LabelledFruit(f"{fruit.source}:{fruit.source_fruit}", kind, fruit.evidence, fruit.sensors, fruit.source),
        fruit.size,
        None if fruit.volume_ml is None else fruit.volume_ml * 1e-6,
        None if fruit.mass_g is None else fruit.mass_g * 1e-3,
    )


def _row(session: Session, taught: int) -> TaughtRow:
    row = session.get(TaughtRow, taught)
    if row is None:
        raise InputError("no_such_fruit", f"There is no taught fruit with the key {taught}.", "Choose one of the list.")
    return row


def _refuse_twice(session: Session, fruit: TaughtFruit) -> None:
    there = select(TaughtRow.id).where(TaughtRow.source == fruit.source, TaughtRow.source_fruit == fruit.source_fruit)
    if session.scalar(there) is not None:
        raise InputError(
            "taught_already", f"Fruit {fruit.source_fruit} of {fruit.source} is kept already.",
            "Remove it first, or teach another source.", values={"source": fruit.source},
        )  # fmt: skip
