"""One SQLite file: one writer at a time, readers free, and what was committed is on the disk."""

from __future__ import annotations

import contextlib
import sqlite3
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from unicodedata import combining, normalize

from sqlalchemy import Connection, Engine, create_engine, event
from sqlalchemy.orm import Session
from sqlalchemy.pool import QueuePool

from fruitgui.records.told import gone, told

BUSY_S = 2.0
"""How long another program may hold the file; a line that waits longer falls behind."""

_PRAGMAS = (
    "PRAGMA auto_vacuum=INCREMENTAL",  # of a new file only: crops that age out give their room back
    "PRAGMA journal_mode=WAL",
    "PRAGMA synchronous=FULL",  # a commit is on the disk when it returns, whatever happens to the power
    "PRAGMA foreign_keys=ON",
    "PRAGMA journal_size_limit=67108864",
    "PRAGMA cache_size=-2048",  # each connection fills its own with what it wrote; the system has the pages anyway
)


class Database:
    """One file, opened. Any thread may read and write.

    Args:
        path: of the file; made where there is none.

    Raises:
        WorldError: see `told`; of every method too.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._writer = threading.RLock()
        self._file: tuple[int, int] | None = None
        self._engine = _engine(path)
        self._write_engine = self._engine.execution_options(begin="BEGIN IMMEDIATE")

    @contextlib.contextmanager
    def writing(self) -> Iterator[Session]:
        """Give a session; all that was done in it is committed, durably, when the block ends well, or none of it."""
        session = Session(self._write_engine, expire_on_commit=False)
        with told(self.path), self._writer, session, session.begin():
            self._refuse_if_gone()
            yield session

    @contextlib.contextmanager
    def reading(self) -> Iterator[Session]:
        """Give a session that sees one state of the file throughout, whatever is written meanwhile."""
        with told(self.path), Session(self._engine) as session:
            yield session

    @contextlib.contextmanager
    def connected(self) -> Iterator[Connection]:
        """Give the writer's connection, in a transaction that is committed when the block ends well."""
        with told(self.path), self._writer, self._write_engine.begin() as connection:
            yield connection

    def give_room_back(self) -> None:
        """Give pages that hold nothing any more back to the disk."""
        with told(self.path), self._writer, contextlib.closing(self._engine.raw_connection()) as connection:
            bare: Any = connection.driver_connection
            bare.executescript("PRAGMA incremental_vacuum")  # goes on until all are given back, as `execute` does not

    def _refuse_if_gone(self) -> None:
        """Raise where the file was removed, or another lies in its place: what goes into it would be nowhere."""
        try:
            status = self.path.stat()
        except OSError as error:
            raise gone(self.path) from error
        now = status.st_dev, status.st_ino
        if now != (self._file or now):
            raise gone(self.path)
        self._file = now

    def close(self) -> None:
        """Let go of the file; what is under way in other threads ends first or fails."""
        with self._writer:
            self._engine.dispose()


def _engine(path: Path) -> Engine:
    engine = create_engine("sqlite://", creator=lambda: _connect(path), poolclass=QueuePool, max_overflow=-1)
    event.listen(engine, "begin", _begin)
    return engine


def _connect(path: Path) -> sqlite3.Connection:
    # No isolation level: transactions begin where we say so, and tables are made within them.
    connection = sqlite3.connect(path, timeout=BUSY_S, isolation_level=None, check_same_thread=False)
    try:
        for pragma in _PRAGMAS:
            connection.execute(pragma)
        connection.create_function("folded", 1, folded, deterministic=True)
    except sqlite3.Error:
        connection.close()
        raise
    return connection


def folded(text: str) -> str:
    """Return a text for searching, without case and accents: who types `penon` means Peñón."""
    return "".join(letter for letter in normalize("NFKD", text.casefold()) if not combining(letter))


def _begin(connection: Connection) -> None:
    connection.exec_driver_sql(connection.get_execution_options().get("begin", "BEGIN"))
