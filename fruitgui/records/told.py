"""What a database says when it fails, told to a person."""

from __future__ import annotations

import contextlib
import sqlite3
from collections.abc import Iterator
from pathlib import Path

from sqlalchemy.exc import DBAPIError

from fruitgui.errors import WorldError

FULL = "disk_full"
READ_ONLY = "store_read_only"
LOCKED = "store_locked"
DAMAGED = "store_damaged"
FAILED = "store_failed"

_CODES = {
    sqlite3.SQLITE_FULL: FULL,
    sqlite3.SQLITE_READONLY: READ_ONLY,
    sqlite3.SQLITE_PERM: READ_ONLY,
    sqlite3.SQLITE_CANTOPEN: READ_ONLY,
    sqlite3.SQLITE_BUSY: LOCKED,
    sqlite3.SQLITE_LOCKED: LOCKED,
    sqlite3.SQLITE_CORRUPT: DAMAGED,
    sqlite3.SQLITE_NOTADB: DAMAGED,
}

_SAID = {
    FULL: (
        "The disk is full; {name} cannot take more.",
        "Make room on the disk, or keep crops for fewer days. Nothing that was counted is lost.",
    ),
    READ_ONLY: (
        "{name} cannot be written or opened.",
        "Check that its folder exists and may be written to.",
    ),
    LOCKED: (
        "Another program holds {name}.",
        "Close other programs that have this line's folder open, and try again.",
    ),
    DAMAGED: (
        "{name} is damaged ({detail}).",
        "Set it aside and restore the last good backup.",
    ),
    FAILED: (
        "{name} could not be read or written ({detail}).",
        "Check the disk; if this comes back, restore the last good backup.",
    ),
}


@contextlib.contextmanager
def told(path: Path) -> Iterator[None]:
    """Turn what the database at `path` fails with into one sentence and a remedy.

    Raises:
        WorldError: `disk_full`, `store_read_only`, `store_locked`, `store_damaged` or `store_failed`.
    """
    try:
        yield
    except DBAPIError as error:
        if not isinstance(error.orig, (sqlite3.OperationalError, sqlite3.DatabaseError)) or _is_ours(error.orig):
            raise
        raise failure(path, error.orig) from error
    except sqlite3.DatabaseError as error:
        if _is_ours(error):
            raise
        raise failure(path, error) from error


def _is_ours(error: sqlite3.Error) -> bool:
    """Return whether the program asked for what cannot be; that is a mistake of ours, not of the world."""
    return isinstance(error, (sqlite3.IntegrityError, sqlite3.ProgrammingError, sqlite3.InterfaceError))


def damaged(path: Path, what: str) -> WorldError:
    """Return that a file is damaged, and how that shows."""
    said, remedy = _SAID[DAMAGED]
    return WorldError(DAMAGED, said.format(name=path, detail=what), remedy, file=path)


def gone(path: Path) -> WorldError:
    """Return that a file is not where it was opened."""
    said, remedy = _SAID[READ_ONLY]
    return WorldError(READ_ONLY, said.format(name=path), remedy, file=path)


def failure(path: Path, error: sqlite3.Error) -> WorldError:
    """Return what a database's error means to a person."""
    code = _CODES.get(getattr(error, "sqlite_errorcode", sqlite3.SQLITE_ERROR) & 0xFF, FAILED)
    what, remedy = _SAID[code]
    return WorldError(code, what.format(name=path, detail=str(error)), remedy, file=path)
