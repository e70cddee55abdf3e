"""All of a workspace in one zip: both databases, the station, the settings and the models."""

from __future__ import annotations

import contextlib
import hashlib
import json
import sqlite3
import tempfile
import time
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from fruitgui.files import written_whole
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress, stop_if
from fruitgui.records.migrating import PICTURES, RECORDS, opened
from fruitgui.records.told import told

SCHEMA = "fruitgui.backup/1"
MANIFEST = "backup.json"
FOLDER = "backups"
SMALL_FILES = ("*.json", "*.fruit", "models/*.fruit")
"""What is backed up beside the databases."""

PAGES = 1_000
"""Pages of a database that are copied between two looks at whether to stop."""

CHUNK = 1 << 20


@dataclass(frozen=True, slots=True)
class Backup:
    """What a backup holds.

    Attributes:
        path: of the zip.
        made_s: Unix seconds.
        files: name within the workspace → (bytes, SHA-256).
    """

    path: Path
    made_s: float
    files: dict[str, tuple[int, str]]


def backup_path(folder: Path, now_s: float) -> Path:
    """Return where a backup of this moment belongs."""
    return folder / FOLDER / f"backup-{datetime.fromtimestamp(now_s):%Y-%m-%d-%H%M%S}.zip"


def back_up(
    folder: Path,
    path: Path,
    now_s: float | None = None,
    progress: Progress = no_progress,
    cancelled: Cancelled = never_cancelled,
) -> Backup:
    """Write a backup of a workspace, whole or not at all; counting goes on meanwhile.

    Args:
        folder: the workspace; its store may be open.
        path: of the zip; its folder is made.
        now_s: Unix seconds; the present where not given.
        progress, cancelled: see `progress`.

    Raises:
        WorldError: a file is damaged, or there is no room.
        CancelledByUserError: a person stopped it; nothing is left.
    """
    with contextlib.suppress(OSError):  # `written_whole` says what is wrong with the folder
        path.parent.mkdir(parents=True, exist_ok=True)
    made_s = time.time() if now_s is None else now_s
    files: dict[str, tuple[int, str]] = {}
    with written_whole(path) as beside, zipfile.ZipFile(beside, "w") as archive:
        # Pictures first: a picture too few is a fruit without it, one too many would be shown with another fruit.
        for at, schema in enumerate((PICTURES, RECORDS)):
            told_of = _part(progress, at)
            with _copied(folder / schema.file, path.parent, told_of, cancelled) as copy:
                if copy is not None:
                    files[schema.file] = _add(archive, copy, schema.file, cancelled)
        for name in _small_files(folder):
            files[name] = _add(archive, folder / name, name, cancelled)
        archive.writestr(MANIFEST, json.dumps(_manifest(made_s, files), indent=1))
    progress(1.0, path.name)
    return Backup(path, made_s, files)


def _part(progress: Progress, at: int) -> Progress:
    return lambda share, doing: progress(0.5 * (at + share), doing)


def _small_files(folder: Path) -> list[str]:
    found = {path for pattern in SMALL_FILES for path in folder.glob(pattern) if path.is_file()}
    return sorted(path.relative_to(folder).as_posix() for path in found if not path.name.startswith("."))


def _manifest(made_s: float, files: dict[str, tuple[int, str]]) -> dict[str, Any]:
    return {
        "schema": SCHEMA,
        "made_s": made_s,
        "files": {name: {"bytes": size, "sha256": sha256} for name, (size, sha256) in files.items()},
    }


@contextlib.contextmanager
def _copied(path: Path, room: Path, progress: Progress, cancelled: Cancelled) -> Iterator[Path | None]:
    """Give a copy of a database as it is at one moment, made in the folder `room`; None where there is none."""
    if not path.exists():
        yield None
        return
    with tempfile.TemporaryDirectory(prefix=".backup-", dir=room) as name:
        copy = Path(name) / path.name
        _copy(path, copy, progress, cancelled)
        yield copy


def _copy(path: Path, copy: Path, progress: Progress, cancelled: Cancelled) -> None:
    def copied(_status: int, left: int, pages: int) -> None:
        stop_if(cancelled)
        progress(1.0 - left / max(pages, 1), path.name)

    with told(path), opened(path) as source, contextlib.closing(sqlite3.connect(copy)) as target:
        source.execute("BEGIN")  # holds one state of the file, or each fruit that is counted would start the copy again
        source.execute("SELECT count(*) FROM sqlite_master").fetchone()
        source.backup(target, pages=PAGES, progress=copied)


def _add(archive: zipfile.ZipFile, path: Path, name: str, cancelled: Cancelled) -> tuple[int, str]:
    """Put a file into the zip; return its size and SHA-256."""
    info = zipfile.ZipInfo.from_file(path, name, strict_timestamps=False)
    # Pictures are coded already.
    info.compress_type = zipfile.ZIP_STORED if name == PICTURES.file else zipfile.ZIP_DEFLATED
    with path.open("rb") as source, archive.open(info, "w", force_zip64=True) as target:
        return copy_counted(source, target, cancelled)


def copy_counted(source: Any, target: Any, cancelled: Cancelled, most: int | None = None) -> tuple[int, str]:  # noqa: ANN401 - any binary stream
    """Copy a stream, at most so many bytes and one more; return how many there were, and their SHA-256."""
    size, digest = 0, hashlib.sha256()
    while chunk := source.read(CHUNK if most is None else min(CHUNK, most + 1 - size)):
        stop_if(cancelled)
        target.write(chunk)
        digest.update(chunk)
        size += len(chunk)
    return size, digest.hexdigest()
