"""Files written whole or not at all, and texts read with an error a person understands."""

from __future__ import annotations

import contextlib
import json
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from fruitgui.errors import InputError, WorldError

MAX_TEXT_BYTES = 64 * 1024 * 1024
"""Larger JSON or CSV is not ours; reading it whole would eat the memory."""


@contextlib.contextmanager
def written_whole(path: Path) -> Iterator[Path]:
    """Give a temporary file beside `path`; rename it over `path` when the block ends well.

    A link is followed first, so that it stays one.

    Raises:
        WorldError: the folder is missing or not writable, the disk is full, or `path` is no regular file (a device
            would be replaced by a file).
    """
    try:
        path = path.resolve()
        if path.exists() and not path.is_file():
            raise WorldError(
                "cannot_write", f"{path} is not a regular file.", "Name a file that may be replaced.", file=path
            )
        handle, name = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    except OSError as error:
        raise _cannot_write(path, error) from error
    os.close(handle)
    beside = Path(name)
    try:
        yield beside
        with beside.open("rb+") as written:
            os.fsync(written.fileno())
        umask = os.umask(0)
        os.umask(umask)
        beside.chmod(0o666 & ~umask)
        beside.replace(path)
    except OSError as error:
        raise _cannot_write(path, error) from error
    finally:
        beside.unlink(missing_ok=True)


def _cannot_write(path: Path, error: OSError) -> WorldError:
    return WorldError(
        "cannot_write",
        f"Cannot write {path}: {error.strerror}.",
        "Check that the folder exists, may be written to and has room.",
        file=path,
    )


def write_json(path: Path, value: Any) -> None:  # noqa: ANN401 - JSON is any
    """Write `value` as indented JSON, whole or not at all."""
    text = json.dumps(value, indent=1, allow_nan=False, ensure_ascii=False)
    with written_whole(path) as beside:
        # A file's name may hold bytes that are no text; as an escape they are JSON still.
        beside.write_text(text + "\n", encoding="utf-8", errors="backslashreplace")


def read_text(path: Path) -> str:
    """Return the file's UTF-8 text.

    Raises:
        InputError: missing, unreadable, too large, or not UTF-8.
    """
    try:
        if path.stat().st_size > MAX_TEXT_BYTES:
            raise InputError(
                "file_too_large",
                f"{path} is larger than {MAX_TEXT_BYTES // 2**20} MB.",
                "This does not look like one of our files; name the right one.",
                file=path,
            )
        return path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise InputError(
            "cannot_read",
            f"Cannot read {path}: {error.strerror}.",
            "Check the name and that the file may be read.",
            file=path,
        ) from error
    except UnicodeDecodeError as error:
        raise InputError(
            "not_text",
            f"{path} is not UTF-8 text (byte {error.start}).",
            "Save it as UTF-8, or name the right file.",
            file=path,
            where=f"byte {error.start}",
        ) from error


def read_json(path: Path) -> Any:  # noqa: ANN401 - JSON is any
    """Return the parsed JSON of a file.

    Raises:
        InputError: unreadable or not JSON, with line and column.
    """
    try:
        return json.loads(read_text(path))
    except json.JSONDecodeError as error:
        where = f"line {error.lineno}, column {error.colno}"
        raise InputError(
            "not_json",
            f"{path} is not JSON ({where}: {error.msg}).",
            "Name a file that this program wrote.",
            file=path,
            where=where,
        ) from error
    except (RecursionError, ValueError) as error:  # ValueError: an integer of thousands of digits
        why = "nests too deeply" if isinstance(error, RecursionError) else "holds a number that is far too long"
        raise InputError(
            "not_json", f"{path} {why} to be one of our files.", "Name a file that this program wrote.", file=path
        ) from error
