"""Files of earlier versions are brought up to date, after a copy was set aside; files of later ones are refused."""

from __future__ import annotations

import contextlib
import re
import sqlite3
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from fruitgui.errors import WorldError
from fruitgui.files import written_whole
from fruitgui.records.database import Database
from fruitgui.records.told import damaged, told

NEWER = "store_newer"
_VERSION = re.compile("(?!0000)[0-9]{4}")
SCRIPTS = Path(__file__).parent / "migrations"


@dataclass(frozen=True, slots=True)
class Schema:
    """One of our databases.

    Attributes:
        file: its name in the workspace.
        scripts: folder of its migrations.
        version: that this program reads and writes; the newest of its scripts.
    """

    file: str
    scripts: Path
    version: str


RECORDS = Schema("records.sqlite", SCRIPTS / "records", "0005")
PICTURES = Schema("pictures.sqlite", SCRIPTS / "pictures", "0001")


def version_of(path: Path) -> str | None:
    """Return the version of a file's tables; None where there is no file, or nothing in it yet.

    Raises:
        WorldError: it is damaged, or cannot be opened.
    """
    if not path.exists() or path.stat().st_size == 0:
        return None
    with told(path), opened(path) as connection:
        tables = [name for (name,) in connection.execute("SELECT name FROM sqlite_master WHERE type = 'table'")]
        if "alembic_version" not in tables:
            if tables:
                raise damaged(path, "it holds other tables than ours")
            return None
        row = connection.execute("SELECT version_num FROM alembic_version").fetchone()
    if row is None and len(tables) == 1:
        return None
    version = "" if row is None else str(row[0])
    if not _VERSION.fullmatch(version):
        raise damaged(path, f"it says that its tables are of version {version!r}")
    return version


@contextlib.contextmanager
def opened(path: Path) -> Iterator[sqlite3.Connection]:
    """Give a bare connection that only reads."""
    with contextlib.closing(sqlite3.connect(f"{path.resolve().as_uri()}?mode=ro", uri=True)) as connection:
        yield connection


def refuse_newer(path: Path, schema: Schema) -> None:
    """Do nothing with a file that this program can read.

    Raises:
        WorldError: `store_newer`; or it is damaged, or cannot be opened.
    """
    found = version_of(path)
    if found is not None and found > schema.version:
        raise WorldError(
            NEWER,
            f"{path} was written by a newer version of this program (its tables are {found}, ours {schema.version}).",
            "Start the newer version, or restore a backup that this version made.",
            file=path,
        )


def bring_up_to_date(path: Path, schema: Schema) -> Database:
    """Open a file, made or brought to this program's version; of an older one a copy is left beside it.

    Raises:
        WorldError: as `refuse_newer`; no room for the copy, or it cannot be written. The file is as it was.
    """
    refuse_newer(path, schema)
    found = version_of(path)
    if found is not None and found != schema.version:
        copy_aside(path, found)
    database = Database(path)
    try:
        if found != schema.version:
            _run_scripts(database, schema)
    except BaseException:
        database.close()
        raise
    return database


def copy(path: Path, into: Path) -> None:
    """Copy a database that may be in use, as it is at this moment.

    Raises:
        WorldError: it is damaged, or there is no room.
    """
    with told(path), opened(path) as source, contextlib.closing(sqlite3.connect(into)) as target:
        source.backup(target)


def copy_aside(path: Path, version: str) -> Path:
    """Copy a database beside itself, named by its version; return where."""
    aside = path.with_name(f"{path.stem}.version-{version}{path.suffix}")
    with written_whole(aside) as beside:
        copy(path, beside)
    return aside


def _run_scripts(database: Database, schema: Schema) -> None:
    from alembic import command
    from alembic.config import Config

    config = Config()
    config.set_main_option("script_location", str(SCRIPTS).replace("%", "%%"))
    config.set_main_option("path_separator", "newline")
    config.set_main_option("version_locations", str(schema.scripts).replace("%", "%%"))
    with database.connected() as connection:
        config.attributes["connection"] = connection
        command.upgrade(config, "head")
