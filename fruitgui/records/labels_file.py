"""Taught fruit out to, and in from, the labels file: one file for each source."""

from __future__ import annotations

import csv
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from fruitgui.errors import InputError
from fruitgui.files import written_whole
from fruitgui.frame import F64
from fruitgui.records.journal import Taught
from fruitgui.records.taught import KeptTaught, Sample
from fruitgui.records.teaching import Teaching
from fruitgui.station.kind_names import known_kind
from fruitgui.station.labels import Label, read_labels
from fruitgui.station.pointing import NEAREST_FRAME_S

HEADER = ("sensor", "time_s", "u_px", "v_px", "kind", "volume_ml", "fruit", "mass_g")


@dataclass(frozen=True, slots=True)
class LabelsRead:
    """What came in from a labels file.

    Attributes:
        rows: that were used.
        fruit: that were named by them.
        warnings: one for each row that was left out, by line.
    """

    rows: int
    fruit: int
    warnings: tuple[str, ...]


def write_labels(teaching: Teaching, source: str, path: Path) -> int:
    """Write what is taught of a source as a labels file, whole or not at all; return the number of rows.

    Raises:
        InputError: nothing of that source has a kind.
        WorldError: it cannot be written.
    """
    rows = 0
    with written_whole(path) as beside, beside.open("w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out)
        writer.writerow(HEADER)
        for taught in teaching.walk(source):
            for row in _rows(taught):
                writer.writerow(row)
                rows += 1
        if not rows:
            raise InputError("no_labels", f"Nothing of {source} was given a kind.", "Name some of its fruit first.")
    return rows


def _rows(taught: KeptTaught) -> Iterator[tuple[object, ...]]:
    fruit = taught.fruit
    for one in fruit.samples:
        yield (
            one.sensor, one.time_s, one.u_px, one.v_px, fruit.kind, _text(fruit.volume_ml),
            fruit.source_fruit, _text(fruit.mass_g),
        )  # fmt: skip


def _text(value: float | None) -> object:
    return "" if value is None else value


def import_labels(teaching: Teaching, source: str, path: Path, who: str = "") -> LabelsRead:
    """Name the fruit of a source as a labels file says, in one step; each row must point at a sample of a fruit.

    The fruit must be there (the source was watched); rows that point at none are told by line. A kind that people would
    read as one that is taught already is that one.

    Raises:
        InputError: the file cannot be used, or no row points at a fruit.
        WorldError: it cannot be kept.
    """
    read = read_labels(path)
    labels = _as_known(read.labels, (one.kind for one in teaching.counts()))
    pointed = _pointed_at(labels, teaching.samples(source))
    said: dict[int, list[Label]] = defaultdict(list)
    for label in labels:
        if label.line in pointed:
            said[pointed[label.line]].append(label)
    if not said:
        raise InputError(
            "no_label_matched", f"No row of {path} points at a fruit of {source}.",
            "Check that the file belongs to this recording.", file=path,
        )  # fmt: skip
    teaching.change([value for taught, labels in said.items() for value in _values(taught, labels)], who)
    missed = [
        f"{path}: line {label.line}: no fruit of {source} there; the row is left out."
        for label in read.labels
        if label.line not in pointed
    ]
    return LabelsRead(len(pointed), len(said), (*read.warnings, *missed))


def _as_known(labels: Sequence[Label], taught: Iterable[str]) -> list[Label]:
    """Return labels whose kinds are the taught ones, or those of rows before, where people would read them as one."""
    known = list(taught)
    found: dict[str, str] = {}
    for kind in dict.fromkeys(label.kind for label in labels):
        found[kind] = known_kind(kind, known)
        known.append(found[kind])
    return [replace(label, kind=found[label.kind]) for label in labels]


def _values(taught: int, labels: Sequence[Label]) -> Iterator[tuple[int, Taught, str | float]]:
    """Return what the rows of one fruit say; the last row wins."""
    yield taught, "kind", labels[-1].kind
    volumes_ml = [label.volume_ml for label in labels if label.volume_ml is not None]
    masses_g = [label.mass_g for label in labels if label.mass_g is not None]
    if volumes_ml:
        yield taught, "volume_ml", volumes_ml[-1]
    if masses_g:
        yield taught, "mass_g", masses_g[-1]


def _pointed_at(labels: Sequence[Label], samples: Iterable[tuple[int, Sample]]) -> dict[int, int]:
    """Return the fruit that each label points at, by the label's line.

    The samples of a fruit in one sensor are places on its way through the picture; between them it moved evenly.
    """
    best: dict[int, tuple[float, int]] = {}
    for (taught, sensor), trail in _trails(samples).items():
        seen = [label for label in labels if label.sensor == sensor]
        for label, apart in zip(seen, _apart(seen, trail), strict=True):
            if apart <= 1.0:
                best[label.line] = min((float(apart), taught), best.get(label.line, (np.inf, 0)))
    return {line: taught for line, (_, taught) in best.items()}


def _trails(samples: Iterable[tuple[int, Sample]]) -> dict[tuple[int, str], list[Sample]]:
    trails: dict[tuple[int, str], list[Sample]] = defaultdict(list)
    for taught, sample in samples:
        trails[taught, sample.sensor].append(sample)
    return {key: sorted(trail, key=lambda one: one.time_s) for key, trail in trails.items()}


def _apart(labels: Sequence[Label], trail: Sequence[Sample]) -> F64:
    """Return how far each label (L,) is from where the fruit was at that time, in radii; inf before and after it."""
    time_s = np.array([label.time_s for label in labels])
    way = np.array([(one.time_s, one.u_px, one.v_px, one.radius_px) for one in trail])
    u_px, v_px, radius_px = (np.interp(time_s, way[:, 0], way[:, at]) for at in (1, 2, 3))
    apart_px = np.hypot([label.u_px for label in labels] - u_px, [label.v_px for label in labels] - v_px)
    there = (time_s >= way[0, 0] - NEAREST_FRAME_S) & (time_s <= way[-1, 0] + NEAREST_FRAME_S)
    return np.where(there, apart_px / radius_px, np.inf)
