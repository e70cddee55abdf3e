"""One window has a line's folder at a time: a second one would count into the same lot, and write over its files."""

from __future__ import annotations

import contextlib
import os
from pathlib import Path

from fruitgui.errors import WorldError

NAME = "window.lock"


class Held:
    """A folder that is held until `let_go`, or until the process ends, however it does."""

    def __init__(self, handle: int | None) -> None:
        self._handle = handle

    def let_go(self) -> None:
        """Let others have it. Any number of times."""
        if self._handle is not None:
            os.close(self._handle)
            self._handle = None


def hold(folder: Path) -> Held:
    """Hold a line's folder; where the system has no locks, or the folder cannot be written, nothing is held.

    Raises:
        WorldError: `line_open`, another window holds it.
    """
    try:
        import fcntl

        handle = os.open(folder / NAME, os.O_RDWR | os.O_CREAT, 0o666)
    except (ImportError, OSError):  # what else is wrong with the folder, its files say
        return Held(None)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError as error:
        os.close(handle)
        raise WorldError(
            "line_open",
            f"Another window has the line in {folder} open.",
            "Go on in that window, or close it and try again.",
            file=folder,
        ) from error
    except OSError:  # a file system without locks
        with contextlib.suppress(OSError):
            os.close(handle)
        return Held(None)
    return Held(handle)
