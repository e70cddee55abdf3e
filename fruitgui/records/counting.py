"""Fruit from the line into the records: durable before anyone is told."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence

from sqlalchemy import func, select
from sqlalchemy.orm import Session

from fruitgui.errors import WorldError
from fruitgui.records import totals
from fruitgui.records.crops import Crops
from fruitgui.records.database import Database
from fruitgui.records.lot import lot_row
from fruitgui.records.packing import columns, known, pack_path
from fruitgui.records.tables import FruitRow, PathRow
from fruitgui.station.fruit import Fruit
from fruitgui.station.sink import CountedFruit, Crop

Finished = tuple[Fruit, Sequence[Crop]]
"""A fruit as it left the line, with its crops."""


class Counting:
    """Takes finished fruit; a `FruitSink`."""

    def __init__(self, database: Database, crops: Crops, now_s: Callable[[], float] = time.time) -> None:
        self._database = database
        self._crops = crops
        self._now_s = now_s

    def commit(self, lot: int, fruit: Fruit, crops: Sequence[Crop]) -> CountedFruit:
        """Keep one fruit, see `FruitSink.commit`."""
        return self.commit_batch(lot, [(fruit, crops)])[0]

    def commit_batch(self, lot: int, finished: Sequence[Finished]) -> tuple[CountedFruit, ...]:
        """Keep some fruit in one transaction: all of them are durable when this returns, or none.

        Raises:
            WorldError: they could not be kept.
            InputError: there is no such lot.
        """
        counted_s = self._now_s()
        with self._database.writing() as session:
            lot_row(session, lot)
            first = next_number(session, lot)
            rows = [_row(lot, first + at, fruit, counted_s) for at, (fruit, _) in enumerate(finished)]
            session.add_all(rows)
            session.flush()
            session.add_all(
                PathRow(fruit_id=row.id, points=pack_path(fruit.path))
                for row, (fruit, _) in zip(rows, finished, strict=True)
            )
            totals.add(session, rows)
        keys = [row.id for row in rows]
        problem = self._keep_crops(keys, finished)
        return tuple(
            CountedFruit(key, lot, first + at, fruit, problem if crops else None)
            for at, (key, (fruit, crops)) in enumerate(zip(keys, finished, strict=True))
        )

    def _keep_crops(self, keys: Sequence[int], finished: Sequence[Finished]) -> WorldError | None:
        """Keep the crops after their fruit: a fruit without pictures is worth more than pictures without fruit."""
        crops = [(key, crop) for key, (_, crops) in zip(keys, finished, strict=True) for crop in crops]
        try:
            self._crops.keep("fruit", crops)
        except WorldError as error:
            return error
        return None


def next_number(session: Session, lot: int) -> int:
    """Return the number of the lot's next fruit."""
    return (session.scalar(select(func.max(FruitRow.number)).where(FruitRow.lot_id == lot)) or 0) + 1


def _row(lot: int, number: int, fruit: Fruit, counted_s: float) -> FruitRow:
    size = fruit.size
    return FruitRow(
        lot_id=lot, number=number, line_number=fruit.fruit, counted_s=counted_s,
        machine_kind=fruit.kind, kind_probability=known(fruit.kind_probability), kind=fruit.kind, counted=True,
        outlet=None, views=fruit.views, first_seen_s=fruit.first_seen_s, last_seen_s=fruit.last_seen_s,
        volume_shared_m3=known(fruit.volume_shared_m3), mass_shared_kg=known(fruit.mass_shared_kg),
        coverage=known(size.coverage), spoilt=known(size.spoilt), paper_volume_m3=known(fruit.volume_paper_m3),
        **columns("volume{}_m3", fruit.volume_m3), **columns("fitted_volume{}_m3", size.volume_m3),
        **columns("mass{}_kg", fruit.mass_kg), **columns("length{}_m", size.length_m),
        **columns("diameter{}_m", size.diameter_m), **columns("perimeter{}_m", size.perimeter_m),
    )  # fmt: skip
