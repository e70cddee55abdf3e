"""One recording in several files, each whole in itself: how they are named, and which belong together."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from fruitgui.errors import InputError
from fruitgui.sensors.recordings.container import open_container
from fruitgui.sensors.recordings.mcap_file import McapFile
from fruitgui.sensors.recordings.part_file import unfinished
from fruitgui.sensors.recordings.raw import MalformedError
from fruitgui.sensors.recordings.records import METADATA, Fields

ABOUT = "recording"
"""Name of the record of text that says which recording a file belongs to, and which part of it it is."""

MOST_PARTS = 9999


@dataclass(frozen=True, slots=True)
class Part:
    """Which part of which recording a file is.

    Attributes:
        recording: an id that no other recording has.
        number: from 1.
    """

    recording: str
    number: int

    def value(self) -> dict[str, str]:
        """Return it as the texts that a file keeps."""
        return {"id": self.recording, "part": str(self.number)}


def read_part(about: Mapping[str, str]) -> Part | None:
    """Return which part a file says it is; None where it does not say."""
    number = about.get("part", "")
    return Part(about["id"], int(number)) if about.get("id") and number.isascii() and number.isdigit() else None


def part_path(path: Path, number: int) -> Path:
    """Return where a part of a recording lies: R.mcap, then R_0002.mcap and so on."""
    return path if number == 1 else path.with_name(f"{path.stem}_{number:04d}{path.suffix}")


def part_of(path: Path) -> Part | None:
    """Return which part of which recording a file is; None where it does not say, or cannot be read."""
    try:
        container = open_container(path)
    except InputError:
        return None
    return _said(container) if isinstance(container, McapFile) else None


def _said(container: McapFile) -> Part | None:
    for opcode, record in container.head():
        try:
            fields = Fields(record)
            if opcode == METADATA and fields.text() == ABOUT:
                return read_part(fields.table())
        except MalformedError:
            continue
    return None


def parts_after(path: Path) -> tuple[Path, ...]:
    """Return the files that go on where a part ends, in order; none where it is the last, or whole in itself.

    The last of them may be unfinished: what is in it is used up to there.
    """
    part = part_of(path)
    return () if part is None else tuple(_following(_first(path, part.number), part))


def _first(path: Path, number: int) -> Path:
    """Return where the first part lies, if the files were not renamed."""
    ending = f"_{number:04d}"
    return path.with_name(path.stem.removesuffix(ending) + path.suffix) if number > 1 else path


def _following(first: Path, part: Part) -> Iterator[Path]:
    for number in range(part.number + 1, MOST_PARTS + 1):
        whole = part_path(first, number)
        path = next((one for one in (whole, unfinished(whole)) if part_of(one) == Part(part.recording, number)), None)
        if path is None:
            return
        yield path
