"""Crops of fruit: kept beside the records, and let go when they are old."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import Literal, cast

from sqlalchemy import delete, func, insert, select

from fruitgui.progress import Cancelled, never_cancelled
from fruitgui.records.database import Database
from fruitgui.records.picture_tables import CropRow
from fruitgui.station.sink import Coding, Content, Crop

Owner = Literal["fruit", "taught"]
"""Whose crops they are: a counted fruit's, which age out, or a taught fruit's, which stay."""

AT_ONCE = 500
"""Crops that are let go in one transaction, so that counting waits for a moment at most."""

DAY_S = 86_400.0

LONGEST_REST_DAYS = 400.0
"""From season to season, and a month. An empty battery or a slip in setting the clock makes it years."""


class Crops:
    """The crops of a store."""

    def __init__(self, database: Database, now_s: Callable[[], float] = time.time) -> None:
        self._database = database
        self._now_s = now_s

    def keep(self, owner: Owner, crops: Sequence[tuple[int, Crop]]) -> None:
        """Keep crops, each with the key of its fruit; all that were kept of those fruit before are replaced.

        Raises:
            WorldError: they cannot be kept; none is.
        """
        if not crops:
            return
        kept_s = self._now_s()
        keys = {key for key, _ in crops}
        with self._database.writing() as session:
            session.execute(delete(CropRow).where(CropRow.owner == owner, CropRow.owner_id.in_(keys)))
            session.execute(insert(CropRow), [_values(owner, key, crop, kept_s) for key, crop in crops])

    def of(self, owner: Owner, key: int) -> tuple[Crop, ...]:
        """Return the crops of one fruit, in order of their numbers; none where they aged out."""
        wanted = select(CropRow).where(CropRow.owner == owner, CropRow.owner_id == key)
        with self._database.reading() as session:
            return tuple(_crop(row) for row in session.scalars(wanted.order_by(CropRow.number, CropRow.content)))

    def first(self, owner: Owner, keys: Sequence[int], content: Content = "colour") -> dict[int, Crop]:
        """Return one crop of each fruit that has any: the lowest number. For grids and lists."""
        lowest = (
            select(CropRow.owner_id, func.min(CropRow.number))
            .where(CropRow.owner == owner, CropRow.owner_id.in_(keys), CropRow.content == content)
            .group_by(CropRow.owner_id)
        )
        with self._database.reading() as session:
            return {
                key: _crop(row)
                for key, number in session.execute(lowest).all()
                for row in session.scalars(
                    select(CropRow).where(
                        CropRow.owner == owner, CropRow.owner_id == key, CropRow.number == number,
                        CropRow.content == content,
                    )
                )
            }  # fmt: skip

    def let_go(self, owner: Owner, keys: Sequence[int]) -> None:
        """Remove the crops of some fruit."""
        with self._database.writing() as session:
            session.execute(delete(CropRow).where(CropRow.owner == owner, CropRow.owner_id.in_(keys)))

    def age_out(self, days: float, cancelled: Cancelled = never_cancelled) -> int:
        """Remove the crops of counted fruit that are older, and give their room back to the disk; return how many.

        None is, where the newest of them are older than a line rests: then it is the computer's clock that is wrong.
        Counting goes on meanwhile. Stops early, without harm, when cancelled. Zero days or fewer keep all.
        """
        if days <= 0:
            return 0
        newest = select(func.max(CropRow.kept_s)).where(CropRow.owner == "fruit")
        with self._database.reading() as session:
            newest_s = session.scalar(newest)
        if newest_s is None or self._now_s() - newest_s > LONGEST_REST_DAYS * DAY_S:
            return 0
        before_s = self._now_s() - days * DAY_S
        gone, more = 0, True
        while more and not cancelled():
            with self._database.writing() as session:
                old = select(CropRow.id).where(CropRow.owner == "fruit", CropRow.kept_s < before_s).limit(AT_ONCE)
                found = session.scalars(old).all()
                session.execute(delete(CropRow).where(CropRow.id.in_(found)))
            gone += len(found)
            more = len(found) == AT_ONCE
            self._database.give_room_back()
        return gone


def _values(owner: Owner, key: int, crop: Crop, kept_s: float) -> dict[str, object]:
    return {
        "owner": owner, "owner_id": key, "number": crop.number, "content": crop.content, "sensor": crop.sensor,
        "time_s": crop.time_s, "left_px": crop.left_px, "top_px": crop.top_px, "coding": crop.coding,
        "kept_s": kept_s, "data": crop.data,
    }  # fmt: skip


def _crop(row: CropRow) -> Crop:
    return Crop(
        row.number, cast("Content", row.content), row.sensor, row.time_s, row.left_px, row.top_px,
        cast("Coding", row.coding), row.data,
    )  # fmt: skip
