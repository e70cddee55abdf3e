"""Options that several commands share, and how their texts become values."""

from __future__ import annotations

import argparse
import math
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from fruitgui.errors import InputError

if TYPE_CHECKING:
    from fruitgui.station.source import RecordingSource

LONGEST_OFFSET_S = 1e10
"""Clocks that count from different years differ by less; beyond it a double has no milliseconds left."""

Commands: TypeAlias = "argparse._SubParsersAction[argparse.ArgumentParser]"


def add_recording_options(command: argparse.ArgumentParser) -> None:
    """Add the options of every command that reads a recording."""
    command.add_argument(
        "--topics", action="append", default=[], metavar="S:rgb=/…,info=/…,depth=/…",
        help="where sensor S has its topics, if not under its own name (repeatable)",
    )  # fmt: skip
    command.add_argument("--parts", action="store_true", help="read the files in which the recording goes on, too")
    command.add_argument("--sensors", metavar="ID,…", help="use only these sensors")
    command.add_argument(
        "--clock-offset", action="append", default=[], metavar="S=SECONDS",
        help="added to the stamps of sensor S (repeatable)",
    )  # fmt: skip


def add_json(command: argparse.ArgumentParser) -> None:
    """Add `--json`."""
    command.add_argument("--json", action="store_true", help="print one JSON object instead of text")


def source(options: argparse.Namespace, path: Path) -> RecordingSource:
    """Return where to read from, of the options given."""
    from fruitgui.sensors.recordings import parts_after
    from fruitgui.station.source import RecordingSource

    following = parts_after(path) if options.parts else ()
    offsets_s = _clock_offsets(options.clock_offset)
    return RecordingSource(path, tuple(options.topics), names(options.sensors), following, offsets_s)


def _clock_offsets(texts: list[str]) -> dict[str, float]:
    offsets: dict[str, float] = {}
    for text in texts:
        name, sign, seconds = text.partition("=")
        if not name or not sign:
            raise InputError("usage", f"--clock-offset {text!r} is not S=SECONDS.", "Example: --clock-offset k2=0.25")
        offsets[name] = finite(seconds, f"--clock-offset {name}")
        if abs(offsets[name]) > LONGEST_OFFSET_S:
            raise InputError(
                "usage", f"--clock-offset {name}={seconds} cannot be.", f"Give at most {LONGEST_OFFSET_S:g} seconds."
            )
    return offsets


def finite(text: str, option: str) -> float:
    """Return the finite number in an option's text.

    Raises:
        InputError: it is not one.
    """
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise InputError("usage", f"{option} is {text[:40]!r}, not a finite number.", "Give a plain number.")
    return value


def check_output(path: Path, inputs: Iterable[Path | None] = ()) -> Path:
    """Return `path` if a file can be made there without harm; said before hours of work, not after.

    Raises:
        InputError: its folder is missing, it is no regular file, or it is one of the inputs.
    """
    if path.exists() and not path.is_file():
        what = "a folder" if path.is_dir() else "not a regular file"
        raise InputError("bad_output", f"{path} is {what}.", "Name a file.", file=path)
    if not path.resolve().parent.is_dir():
        raise InputError("bad_output", f"The folder {path.parent} does not exist.", "Make it first.", file=path)
    if path.resolve() in {one.resolve() for one in inputs if one is not None}:
        raise InputError("bad_output", f"{path} is read and would be overwritten.", "Name another file.", file=path)
    return path


def names(text: str | None) -> tuple[str, ...]:
    """Return the ids in the text of `--sensors`; none where it was not given.

    Raises:
        InputError: it holds no id.
    """
    if text is None:
        return ()
    found = tuple(name.strip() for name in text.split(",") if name.strip())
    if not found:
        raise InputError("usage", f"--sensors {text[:40]!r} names no sensor.", "Example: --sensors kinect_1,kinect_2")
    return found
