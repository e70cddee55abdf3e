"""A backup as it is read: what it says that it holds, and all of it checked."""

from __future__ import annotations

import contextlib
import json
import os
import tempfile
import zipfile
import zlib
from collections.abc import Iterator
from errno import ENOSPC
from pathlib import Path, PurePosixPath
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from fruitgui.errors import InputError, WorldError
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress
from fruitgui.records.backup import FOLDER, MANIFEST, SMALL_FILES, Backup, copy_counted
from fruitgui.records.condition import check_whole
from fruitgui.records.migrating import PICTURES, RECORDS, refuse_newer
from fruitgui.records.told import FULL

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


def find_backups(folder: Path) -> list[Path]:
    """Return the backups that lie in a workspace, the newest first, whole or not."""
    return sorted((folder / FOLDER).glob("backup-*.zip"), reverse=True)


def last_good_backup(folder: Path, cancelled: Cancelled = never_cancelled) -> Backup | None:
    """Return the newest backup of a workspace that is whole and that this program can read; None where none is.

    Raises:
        CancelledByUserError: a person stopped it.
    """
    for path in find_backups(folder):
        try:
            return check_backup(path, cancelled)
        except (InputError, WorldError):
            continue
    return None


def check_backup(path: Path, cancelled: Cancelled = never_cancelled) -> Backup:
    """Unpack a backup beside itself, check all of it, and forget it again; return what it holds.

    Raises:
        InputError: it is no backup, or not whole.
        WorldError: its databases are damaged or newer; or it cannot be read, or there is no room.
        CancelledByUserError: a person stopped it.
    """
    with cleaned_up(path.parent) as name:
        return unpack(path, Path(name), no_progress, cancelled)


def cleaned_up(folder: Path) -> tempfile.TemporaryDirectory[str]:
    """Return a folder within another one, which goes when it is left; gone already is no error.

    Raises:
        WorldError: it cannot be made.
    """
    try:
        return tempfile.TemporaryDirectory(prefix=".unpacked-", dir=folder, ignore_cleanup_errors=True)
    except OSError as error:
        raise cannot_unpack(folder, error) from error


def unpack(path: Path, into: Path, progress: Progress, cancelled: Cancelled) -> Backup:
    """Unpack a backup into an empty folder, and check all of it; see `check_backup` for what is raised."""
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
        raise cannot_unpack(into, error) from error


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


def cannot_unpack(folder: Path, error: OSError) -> WorldError:
    """Return what is said where a folder does not take what a backup holds."""
    return WorldError(
        FULL if error.errno == ENOSPC else "cannot_write",
        f"A backup cannot be unpacked in {folder}: {error.strerror or error}.",
        "Check that the folder may be written to and has room for all that the backup holds.",
        file=folder,
    )
