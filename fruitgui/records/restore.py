"""A workspace put back to a backup: checked whole before anything is touched, and what was there is kept aside."""

from __future__ import annotations

import shutil
from datetime import datetime
from pathlib import Path

from fruitgui.errors import InputError, WorldError
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress
from fruitgui.records.backup import Backup
from fruitgui.records.unpacking import cannot_unpack, cleaned_up, unpack

READY = ".restoring"
"""Folder of a restore that is checked and ready; whatever happens from then on, the next start finishes it."""


def restore(
    folder: Path,
    path: Path,
    now_s: float,
    progress: Progress = no_progress,
    cancelled: Cancelled = never_cancelled,
) -> Path | None:
    """Put a workspace back to a backup; return the folder with what was there before, None where nothing was.

    Its store must be closed. What is not in the backup stays; what is replaced is kept in that folder, `aside-…`. A
    crash in the middle is finished by the next `open_store`.

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
    prepare_restore(folder, path, now_s, progress, cancelled)
    return finish_restore(folder)


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
    with cleaned_up(folder) as name:
        unpacked = Path(name) / "files"
        unpacked.mkdir()
        backup = unpack(path, unpacked, progress, cancelled)
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
        with cleaned_up(folder) as name:
            (folder / READY).rename(Path(name) / "files")  # at once: half of it must never be put in place
    except OSError as error:
        raise cannot_unpack(folder, error) from error


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
