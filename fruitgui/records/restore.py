"""A workspace from a backup: checked whole before anything is touched, and what was there is kept aside."""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import tempfile
import zipfile
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime
from errno import ENOSPC
from pathlib import Path, PurePosixPath
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from fruitgui.errors import FruitguiError, InputError, WorldError
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress
from fruitgui.records.backup import FOLDER, MANIFEST, SMALL_FILES, Backup, copy_counted
from fruitgui.records.condition import check_whole
from fruitgui.records.migrating import PICTURES, RECORDS, refuse_newer
from fruitgui.records.told import FULL

READY = ".restoring"
"""Folder of a restore that is checked and ready; whatever happens from then on, the next start finishes it."""

MANIFEST_BYTES = 1 << 20
MOST_FILES = 10_000
REMEDY = "Choose another backup."


class _File(BaseModel):
    model_config = ConfigDict(extra="ignore")
    bytes: Annotated[int, Field(ge=0)]
    sha256: Annotated[str, Field(pattern="^[0-9a-f]{64}$")]


class _Manifest(BaseModel):
    model_config = ConfigDict(extra="ignore")
    # `schema` is a method of pydantic's models.
    version: Annotated[Literal["fruitgui.backup/1"], Field(alias="schema")]
    made_s: float
    files: Annotated[dict[str, _File], Field(max_length=MOST_FILES)]


@dataclass(frozen=True, slots=True)
class Restored:
    """What a restore did.

    Attributes:
        backup: that was used.
        aside: folder with what was there before; None where nothing was.
    """

    backup: Backup
    aside: Path | None


def find_backups(folder: Path) -> list[Path]:
    """Return the backups that lie in a workspace, the newest first, whole or not."""
    return sorted((folder / FOLDER).glob("backup-*.zip"), reverse=True)


def contents(path: Path) -> Backup:
    """Return what a backup says that it holds; quick, and nothing is checked yet.

    Raises:
        InputError: it is no backup.
        WorldError: it cannot be read.
    """
    with _told(path, path.parent), zipfile.ZipFile(path) as archive:
        return _backup(path, _read_manifest(path, archive))


def last_good_backup(folder: Path, cancelled: Cancelled = never_cancelled) -> Backup | None:
    """Return the newest backup of a workspace that is whole and that this program can read; None where none is.

    Raises:
        CancelledByUserError: a person stopped it.
    """
    for path in find_backups(folder):
        try:
            return check_backup(path, cancelled=cancelled)
        except (InputError, WorldError):
            continue
    return None


def check_backup(path: Path, progress: Progress = no_progress, cancelled: Cancelled = never_cancelled) -> Backup:
    """Unpack a backup beside itself, check all of it, and forget it again; return what it holds.

    Raises:
        InputError: it is no backup, or not whole.
        WorldError: its databases are damaged or newer; or it cannot be read, or there is no room.
        CancelledByUserError: a person stopped it.
    """
    with _cleaned_up(path.parent) as name:
        return _unpack(path, Path(name), progress, cancelled)


def restore(
    folder: Path,
    path: Path,
    now_s: float,
    progress: Progress = no_progress,
    cancelled: Cancelled = never_cancelled,
) -> Restored:
    """Put a workspace back to a backup. Its store must be closed.

    What is not in the backup stays; what is replaced is kept in a folder `aside-…`. A crash in the middle is finished
    by the next `open_store`.

    Args:
        folder: the workspace.
        path: of the backup.
        now_s: Unix seconds, for the name of the folder aside.
        progress, cancelled: see `progress`; nothing is stopped once files are replaced.

    Raises:
        InputError: it is no backup, or not whole; nothing was changed.
        WorldError: its databases are damaged or newer, or there is no room; nothing was changed.
        CancelledByUserError: a person stopped it; nothing was changed.
    """
    backup = prepare_restore(folder, path, now_s, progress, cancelled)
    return Restored(backup, finish_restore(folder))


def prepare_restore(
    folder: Path,
    path: Path,
    now_s: float,
    progress: Progress = no_progress,
    cancelled: Cancelled = never_cancelled,
) -> Backup:
    """Check a backup and lay it ready; the next `open_store` puts it in place. The store may be open meanwhile.

    See `restore` for what is given and raised. What was laid ready before is forgotten.
    """
    with _cleaned_up(folder) as name:
        unpacked = Path(name) / "files"
        unpacked.mkdir()
        backup = _unpack(path, unpacked, progress, cancelled)
        aside = f"aside-{datetime.fromtimestamp(now_s):%Y-%m-%d-%H%M%S}"
        (Path(name) / "aside").write_text(aside, encoding="utf-8")
        forget_restore(folder)
        Path(name).rename(folder / READY)
    return backup


def is_prepared(folder: Path) -> bool:
    """Return whether the next `open_store` will put a backup in place."""
    return (folder / READY).exists()


def refuse_while_prepared(folder: Path) -> None:
    """Do nothing where no backup waits to be put in place: what is counted until then would be kept aside.

    Raises:
        InputError: `restore_waits`.
    """
    if is_prepared(folder):
        raise InputError(
            "restore_waits",
            "A backup is put in place at the next start; what is counted until then would be kept aside.",
            "Start again first, or leave everything as it is after all.",
            file=folder,
        )


def forget_restore(folder: Path) -> None:
    """Leave everything as it is after all: what was laid ready is removed.

    Raises:
        WorldError: it cannot be removed.
    """
    if not is_prepared(folder):
        return
    try:
        with _cleaned_up(folder) as name:
            (folder / READY).rename(Path(name) / "files")  # at once: half of it must never be put in place
    except OSError as error:
        raise _cannot_unpack(folder, error) from error


def finish_restore(folder: Path) -> Path | None:
    """Put files that are ready in their places; return the folder with those that were there, None where none were.

    Nothing happens where no restore was under way. It can be cut off anywhere and called again.

    Raises:
        WorldError: a file cannot be moved.
    """
    ready = folder / READY
    if not ready.exists():
        return None
    try:
        aside = folder / (ready / "aside").read_text(encoding="utf-8")
        for file in sorted(path for path in (ready / "files").rglob("*") if path.is_file()):
            _replace(folder, aside, file, file.relative_to(ready / "files"))
        shutil.rmtree(ready)
    except OSError as error:
        raise WorldError(
            "cannot_restore", f"The backup could not be put in place: {error}.",
            "Check that the folder may be written to, and start again: the restore goes on.", file=folder,
        ) from error  # fmt: skip
    return aside if aside.exists() else None


def _replace(folder: Path, aside: Path, file: Path, name: Path) -> None:
    # A database's log first: the old one beside the new database would ruin it.
    for tail in ("-wal", "-shm", ""):
        there = folder / f"{name}{tail}"
        if there.exists():
            kept = aside / f"{name}{tail}"
            kept.parent.mkdir(parents=True, exist_ok=True)
            there.rename(kept)
    (folder / name).parent.mkdir(parents=True, exist_ok=True)
    file.rename(folder / name)


def _cleaned_up(folder: Path) -> tempfile.TemporaryDirectory[str]:
    try:
        return tempfile.TemporaryDirectory(prefix=".unpacked-", dir=folder, ignore_cleanup_errors=True)
    except OSError as error:
        raise _cannot_unpack(folder, error) from error


def _unpack(path: Path, into: Path, progress: Progress, cancelled: Cancelled) -> Backup:
    """Unpack a backup into an empty folder, and check all of it."""
    with _told(path, into), zipfile.ZipFile(path) as archive:
        manifest = _read_manifest(path, archive)
        for at, (name, file) in enumerate(manifest.files.items()):
            progress(at / len(manifest.files), name)
            _unpack_file(path, archive, name, file, into, cancelled)
    for schema in (RECORDS, PICTURES):
        if schema.file in manifest.files:
            refuse_newer(into / schema.file, schema)
            check_whole(into / schema.file, cancelled)
    return _backup(path, manifest)


@contextlib.contextmanager
def _told(path: Path, into: Path) -> Iterator[None]:
    """Turn what reading a zip, or writing its files, fails with into one sentence and a remedy."""
    try:
        yield
    except (zipfile.BadZipFile, zlib.error, NotImplementedError, RuntimeError, EOFError) as error:
        raise _bad(path, f"it is not a sound zip ({error})") from error
    except FileNotFoundError as error:
        raise InputError("cannot_read", f"Cannot read {path}: {error.strerror}.", REMEDY, file=path) from error
    except OSError as error:
        raise _cannot_unpack(into, error) from error


def _backup(path: Path, manifest: _Manifest) -> Backup:
    return Backup(path, manifest.made_s, {name: (one.bytes, one.sha256) for name, one in manifest.files.items()})


def _read_manifest(path: Path, archive: zipfile.ZipFile) -> _Manifest:
    try:
        with archive.open(MANIFEST) as member:
            manifest = _Manifest.model_validate(json.loads(member.read(MANIFEST_BYTES)))
    except KeyError as error:
        raise _bad(path, f"it holds no {MANIFEST}") from error
    except ValidationError as error:
        raise _bad(path, f"{MANIFEST} does not say what it should ({error.errors()[0]['msg']})") from error
    except ValueError as error:
        raise _bad(path, f"{MANIFEST} is not JSON") from error
    for name in manifest.files:
        if name not in (RECORDS.file, PICTURES.file) and not _is_small_file(name):
            raise _bad(path, f"{name[:80]!r} has no business in it")
    return manifest


def _is_small_file(name: str) -> bool:
    """Return whether a name is one that a backup may write: in the workspace or its models, and nowhere else."""
    path = PurePosixPath(name)
    plain = name == path.as_posix() and "\\" not in name and not any(part.startswith(".") for part in path.parts)
    return plain and any(
        len(path.parts) == len(PurePosixPath(pattern).parts) and path.match(pattern) for pattern in SMALL_FILES
    )


def _unpack_file(
    path: Path, archive: zipfile.ZipFile, name: str, file: _File, into: Path, cancelled: Cancelled
) -> None:
    target = into / name
    target.parent.mkdir(parents=True, exist_ok=True)
    try:
        with archive.open(name) as member, target.open("wb") as out:
            found = copy_counted(member, out, cancelled, file.bytes)
            out.flush()
            os.fsync(out.fileno())
    except KeyError as error:
        raise _bad(path, f"it holds no {name}") from error
    if found != (file.bytes, file.sha256):
        raise _bad(path, f"{name} is not what was backed up")


def _bad(path: Path, what: str) -> InputError:
    return InputError("bad_backup", f"{path} is not a whole backup: {what}.", REMEDY, file=path)


def _cannot_unpack(folder: Path, error: OSError) -> FruitguiError:
    return WorldError(
        FULL if error.errno == ENOSPC else "cannot_write",
        f"A backup cannot be unpacked in {folder}: {error.strerror or error}.",
        "Check that the folder may be written to and has room for all that the backup holds.",
        file=folder,
    )
