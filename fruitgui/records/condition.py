"""How the databases of a workspace are, before anything is written to them."""

from __future__ import annotations

import sqlite3
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from fruitgui.errors import WorldError
from fruitgui.progress import Cancelled, stop_if
from fruitgui.records.migrating import NEWER, PICTURES, RECORDS, Schema, opened, refuse_newer, version_of
from fruitgui.records.told import DAMAGED, damaged, told
from fruitgui.station import kept_file

State = Literal["missing", "ok", "older", "newer", "damaged", "unreadable"]
"""`older` is brought up to date by opening; `newer` needs a newer program; `unreadable` may be sound: rights, locks,
the disk."""

GLANCE_S = 0.2
"""How long a glance goes through a file; most damage shows at its beginning, or where it is read."""

_STEPS = 20_000
"""Steps of the database between two looks at the clock; some milliseconds."""


@dataclass(frozen=True, slots=True)
class FileCondition:
    """How one database is.

    Attributes:
        path: of the file.
        state: see `State`.
        error: what is wrong, and what to do; None where nothing is.
    """

    path: Path
    state: State
    error: WorldError | None = None


@dataclass(frozen=True, slots=True)
class StoreCondition:
    """How the databases of a workspace are; `open_store` opens them when `usable`."""

    records: FileCondition
    pictures: FileCondition

    @property
    def usable(self) -> bool:
        """Whether the store can be opened."""
        return all(one.state in ("missing", "ok", "older") for one in (self.records, self.pictures))

    @property
    def wrong(self) -> tuple[FileCondition, ...]:
        """The files that keep it from being opened."""
        return tuple(one for one in (self.records, self.pictures) if one.error is not None)


def glance(folder: Path) -> StoreCondition:
    """Look at the databases of a workspace for a moment; nothing is changed, nothing raised."""
    return StoreCondition(*(_condition(folder / schema.file, schema) for schema in (RECORDS, PICTURES)))


def _condition(path: Path, schema: Schema) -> FileCondition:
    try:
        refuse_newer(path, schema)
        found = version_of(path)
        if found is None:
            return FileCondition(path, "missing")
        until_s = time.monotonic() + GLANCE_S
        _check(path, lambda: time.monotonic() > until_s)
    except WorldError as error:
        return FileCondition(path, _BAD.get(error.code, "unreadable"), error)
    return FileCondition(path, "ok" if found == schema.version else "older")


_BAD: dict[str, State] = {NEWER: "newer", DAMAGED: "damaged"}


def check_whole(path: Path, cancelled: Cancelled) -> None:
    """Go through a database from end to end; takes some seconds for each gigabyte.

    Raises:
        WorldError: it is damaged, or cannot be read.
        CancelledByUserError: a person stopped it.
    """
    _check(path, cancelled)
    stop_if(cancelled)


def _check(path: Path, enough: Callable[[], bool]) -> None:
    with told(path), opened(path) as connection:
        connection.set_progress_handler(enough, _STEPS)
        try:
            (said,) = connection.execute("PRAGMA quick_check(1)").fetchone()
        except sqlite3.OperationalError:
            if enough():  # stopped by the handler: nothing was wrong so far
                return
            raise
    if said != "ok":
        raise damaged(path, said)


def set_aside(path: Path) -> Path | None:
    """Rename a damaged database, with all that belongs to it, unharmed; return where, None where that cannot be."""
    aside = kept_file.set_aside(path)
    if aside is not None:
        for tail in ("-wal", "-shm"):
            beside = path.with_name(path.name + tail)
            if beside.exists():
                beside.rename(aside.with_name(aside.name + tail))
    return aside
