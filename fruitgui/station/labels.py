"""The labels file: what an operator said of fruit in pictures."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from fruitgui.errors import InputError
from fruitgui.files import read_text

REQUIRED = ("sensor", "time_s", "u_px", "v_px", "kind")
REMEDY = "The header must be sensor,time_s,u_px,v_px,kind,volume_ml (fruit and mass_g may follow)."
NUMBER_REMEDY = "Write a number with a decimal point, such as 12.5."
MAX_ROWS = 1_000_000
LONGEST_KIND = 64


class _BadCellError(ValueError):
    """What a row says in one column cannot be."""

    def __init__(self, column: str, what: str, remedy: str) -> None:
        super().__init__(f"column {column}: {what}")
        self.column = column
        self.remedy = remedy


@dataclass(frozen=True, slots=True)
class Label:
    """One row: a point on a fruit in one frame's picture, and what that fruit is.

    Attributes:
        line: in the file, from 1 (the header).
        sensor: the sensor's id.
        time_s: capture time of the frame, in that sensor's own clock.
        u_px, v_px: in the colour image.
        kind: as the operator named it.
        volume_ml, mass_g: measured, or None.
        fruit: id of the piece of fruit, or None where the tracks are to say it.
    """

    line: int
    sensor: str
    time_s: float
    u_px: float
    v_px: float
    kind: str
    volume_ml: float | None
    mass_g: float | None
    fruit: str | None


@dataclass(frozen=True, slots=True)
class LabelFile:
    """The usable rows of a labels file, and a warning for each that is not."""

    path: Path
    labels: tuple[Label, ...]
    warnings: tuple[str, ...]


def read_labels(path: Path) -> LabelFile:
    """Return the labels of a file; rows that cannot be read are left out with a warning that names line and column.

    Raises:
        InputError: the file cannot be read, has no such header, or no usable row.
    """
    reader = csv.DictReader(io.StringIO(read_text(path), newline=""), strict=True, skipinitialspace=True)
    labels: list[Label] = []
    bad: list[tuple[int, _BadCellError]] = []
    try:
        missing = [name for name in REQUIRED if name not in (reader.fieldnames or ())]
        if missing:
            raise InputError(
                "bad_labels", f"{path} lacks the columns {', '.join(missing)}.", REMEDY, file=path, where="line 1"
            )
        for row in reader:
            try:
                labels.append(_label(reader.line_num, row))
            except _BadCellError as error:
                bad.append((reader.line_num, error))
            if reader.line_num > MAX_ROWS:
                raise InputError("bad_labels", f"{path} has more than {MAX_ROWS} rows.", "Split it.", file=path)
    except csv.Error as error:
        where = f"line {reader.line_num}"
        raise InputError("bad_labels", f"{path}: {where}: {error}.", REMEDY, file=path, where=where) from error
    if not labels:
        raise _nothing_usable(path, bad)
    warnings = (f"{path}: line {line}, {one}; the row is left out. {one.remedy}" for line, one in bad)
    return LabelFile(path, tuple(labels), tuple(warnings))


def _nothing_usable(path: Path, bad: Sequence[tuple[int, _BadCellError]]) -> InputError:
    if not bad:
        return InputError("bad_labels", f"{path} holds no row below its header.", REMEDY, file=path, where="line 1")
    line, first = bad[0]
    what = f"{path} holds no usable row: line {line}, {first}."
    return InputError("bad_labels", what, first.remedy, file=path, where=f"line {line}, column {first.column}")


def _label(line: int, row: dict[str, str | None]) -> Label:
    kind = (row["kind"] or "").strip()
    sensor = (row["sensor"] or "").strip()
    if not sensor:
        raise _BadCellError("sensor", "it is empty", "Write the sensor's id.")
    if not kind or len(kind) > LONGEST_KIND or not kind.isprintable():
        remedy = f"Write 1 to {LONGEST_KIND} printable letters."
        raise _BadCellError("kind", f"{kind[:40]!r} is no name of a kind", remedy)
    return Label(
        line=line,
        sensor=sensor,
        time_s=_number(row, "time_s"),
        u_px=_number(row, "u_px"),
        v_px=_number(row, "v_px"),
        kind=kind,
        volume_ml=_positive(row, "volume_ml"),
        mass_g=_positive(row, "mass_g"),
        fruit=(row.get("fruit") or "").strip() or None,
    )


def _number(row: dict[str, str | None], name: str) -> float:
    text = (row[name] or "").strip()
    try:
        value = float(text)
    except ValueError as error:
        raise _BadCellError(name, f"{text[:40]!r} is not a number", NUMBER_REMEDY) from error
    if not math.isfinite(value):
        raise _BadCellError(name, f"{text[:40]!r} is not a finite number", NUMBER_REMEDY)
    return value


def _positive(row: dict[str, str | None], name: str) -> float | None:
    if not (row.get(name) or "").strip():
        return None
    value = _number(row, name)
    if value <= 0:
        raise _BadCellError(name, f"{value:g} is not above zero", "Write what was measured, or leave it empty.")
    return value
