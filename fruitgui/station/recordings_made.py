"""The recordings that were made of a line: where they lie, how a new one is called, and which there are."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from fruitgui.sensors.recordings.part_file import UNFINISHED, unfinished
from fruitgui.sensors.recordings.series import part_path

FOLDER = "recordings"
"""In the workspace."""

ENDING = ".mcap"
_PART = re.compile(r"(.+)_(\d{4})")


@dataclass(frozen=True, slots=True)
class MadeRecording:
    """One recording, with all of its parts.

    Attributes:
        path: of its first part.
        name: that a person gave it.
        made_s: when it ended, seconds since 1970.
        size: bytes of all parts.
        parts: how many there are.
        cut_off: it was not finished; what is in it can be played all the same.
    """

    path: Path
    name: str
    made_s: float
    size: int
    parts: int = 1
    cut_off: bool = False


def recordings_made(folder: Path, making: Path | None = None) -> list[MadeRecording]:
    """Return the recordings in a folder, the newest first; none where there is no such folder.

    Args:
        folder: to look in. Only names, sizes and times are asked for: it is quick.
        making: first part of the one that is being made right now, which is left out.
    """
    endings = (ENDING, ENDING + UNFINISHED)
    files = {path.name: path for path in folder.glob(f"*{ENDING}*") if path.name.endswith(endings)}
    left_out = set() if making is None else {making.name, unfinished(making).name, *_parts(making, files)}
    made = [_made(path, files) for name, path in files.items() if name not in left_out and not _is_part(path, files)]
    return sorted((one for one in made if one is not None), key=lambda one: -one.made_s)


def recording_path(folder: Path, name: str) -> Path:
    """Return where a recording of that name is to lie; where one has it already, with the next number behind it.

    What file systems do not take in a name becomes a dash.
    """
    plain = re.sub(r"[^\w.-]+", "-", name).strip("-.")[:100] or FOLDER
    number, path = 1, folder / f"{plain}{ENDING}"
    while _taken(path):
        number += 1
        path = folder / f"{plain}-{number}{ENDING}"
    return path


def _taken(path: Path) -> bool:
    return any(one.exists() for one in (path, unfinished(path), part_path(path, 2)))


def _parts(first: Path, files: dict[str, Path]) -> Iterator[str]:
    """Yield the names of a recording's further parts, the last of which may be unfinished."""
    number = 2
    while (path := part_path(first, number)).name in files:
        yield path.name
        number += 1
    if unfinished(path).name in files:
        yield unfinished(path).name


def _is_part(path: Path, files: dict[str, Path]) -> bool:
    """Tell whether a file is a further part of another that is there."""
    match = _PART.fullmatch(path.name.removesuffix(UNFINISHED).removesuffix(ENDING))
    return match is not None and int(match[2]) > 1 and match[1] + ENDING in files


def _made(path: Path, files: dict[str, Path]) -> MadeRecording | None:
    names = [path.name, *(_parts(path, files) if path.name.endswith(ENDING) else ())]
    try:
        facts = [files[name].stat() for name in names]
    except OSError:  # gone meanwhile
        return None
    return MadeRecording(
        path=path,
        name=path.name.removesuffix(UNFINISHED).removesuffix(ENDING),
        made_s=max(one.st_mtime for one in facts),
        size=sum(one.st_size for one in facts),
        parts=len(names),
        cut_off=names[-1].endswith(UNFINISHED),
    )
