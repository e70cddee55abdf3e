"""A file that takes its name when it is whole; until then it lies beside, under a name that says what it is."""

from __future__ import annotations

import contextlib
import errno
import io
import os
from pathlib import Path

from fruitgui.errors import InputError, WorldError

_FULL = frozenset({errno.ENOSPC, errno.EDQUOT, errno.EFBIG})
"""What systems say where a disk is full, a person's share of it used up, or a file as large as files may be."""

UNFINISHED = ".part"
"""What follows a recording's name while it is being made, and stays there where the machine died over it."""


def unfinished(path: Path) -> Path:
    """Return where a recording lies while it is being made."""
    return path.with_name(path.name + UNFINISHED)


class PartFile:
    """The file being made. A link is followed first, so that it stays one.

    Attributes:
        beside: where it lies until it is kept.
        raw: to write to.

    Raises:
        InputError: something unfinished lies there: a recording that was cut off, or one that is being made.
        WorldError: the folder is missing or not writable, or the name is that of something that is no file.
    """

    def __init__(self, path: Path) -> None:
        self._path = path.resolve()
        self.beside = unfinished(self._path)
        if self._path.exists() and not self._path.is_file():
            raise WorldError(
                "cannot_write", f"{path} is not a regular file.", "Name a file that may be replaced.", file=path
            )
        try:
            self.raw: io.FileIO = self.beside.open("xb", buffering=0)
        except FileExistsError as error:
            raise InputError(
                "unfinished_recording",
                f"{self.beside} is there: a recording that was cut off, or one that is being made right now.",
                f"Save what is in it (fruitgui record --recover {self.beside.name} --out OTHER.mcap), or delete it.",
                file=self.beside,
            ) from error
        except OSError as error:
            raise cannot_write(path, error) from error

    def keep(self) -> None:
        """Give the file its name. Raises `OSError`; it then stays where it is."""
        os.fsync(self.raw.fileno())
        self.raw.close()
        self.beside.replace(self._path)

    def leave(self) -> None:
        """Leave the file where it is, as far as it is written."""
        with contextlib.suppress(OSError):
            self.raw.close()

    def discard(self) -> None:
        """Leave nothing behind."""
        self.leave()
        with contextlib.suppress(OSError):
            self.beside.unlink(missing_ok=True)


def is_full(error: OSError) -> bool:
    """Tell whether an error says that there is no more room."""
    return error.errno in _FULL


def cannot_finish(path: Path, error: OSError) -> WorldError:
    """Return why a recording does not get its name, and where it lies."""
    beside = unfinished(path)
    return WorldError(
        "recording_not_finished",
        f"{path} cannot be finished: {error.strerror}.",
        f"What was recorded is in {beside.name}: fruitgui record --recover {beside.name} --out OTHER.mcap saves it.",
        file=beside,
    )


def cannot_write(path: Path, error: OSError) -> WorldError:
    """Return why a recording cannot be written, as a person is told."""
    code = "disk_full" if is_full(error) else "cannot_write"
    return WorldError(
        code, f"Cannot write {path}: {error.strerror}.", "Check that the disk has room and is there.", file=path
    )
