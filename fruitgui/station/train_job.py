"""Training a model from labelled recordings."""

from __future__ import annotations

import contextlib
from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from fruitgui.classification.account import Training
from fruitgui.classification.evidence import LabelledFruit
from fruitgui.classification.model import KindModel
from fruitgui.classification.training import train
from fruitgui.errors import InputError
from fruitgui.measurement.fruit import Size
from fruitgui.measurement.references import CorrectionFit, Reference, fit_correction
from fruitgui.measurement.size import measure
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress
from fruitgui.station.judging import FEATURES, evidence
from fruitgui.station.labels import Label, read_labels
from fruitgui.station.model import Model, write_model
from fruitgui.station.observing import Watching
from fruitgui.station.pointing import Pointer, assign
from fruitgui.station.prelude import look_ahead
from fruitgui.station.source import RecordingSource
from fruitgui.station.station import Station
from fruitgui.station.station_file import read_station
from fruitgui.station.timing import Stopwatch
from fruitgui.tracking.tracker import Tracker

MOST_WARNINGS = 20
"""Warnings of one sort that are said one by one; beyond that their number says enough."""


@dataclass(frozen=True, slots=True, eq=False)
class Taught:
    """One fruit that was labelled, measured.

    Attributes:
        labelled: for the classifier.
        size: as fitted.
        volume_m3, mass_kg: measured by a person, or None.
    """

    labelled: LabelledFruit
    size: Size
    volume_m3: float | None
    mass_kg: float | None


@dataclass(frozen=True, slots=True, eq=False)
class TrainOutcome:
    """What training came to.

    Attributes:
        model: written to the file.
        training: kinds, held-out confusion, curve.
        correction: of volumes, with residuals.
        warnings: what a person should know.
    """

    model: Model
    training: Training[KindModel]
    correction: CorrectionFit
    warnings: tuple[str, ...]

    def value(self, path: Path) -> dict[str, Any]:
        """Return the result as JSON."""
        counted = self.training.confusion
        right = counted.right
        return {
            "model": str(path),
            "kinds": [{"kind": one.kind, "samples": one.views, "fruit": one.fruit} for one in self.training.taught],
            "confusion": {"kinds": list(counted.kinds), "counts": counted.counts.tolist()},
            "right": {"value": _finite(right.value), "low": right.low, "high": right.high, "n": right.trials},
            "volume": self.correction.value(),
            "warnings": list(self.warnings),
        }

    def lines(self, path: Path) -> list[str]:
        """Return what to tell a person."""
        taught = [f"  {one.kind:<24} {one.fruit:>4} fruit {one.views:>6} samples" for one in self.training.taught]
        return [
            f"Model: {path}",
            "Taught:",
            *taught,
            "Held out, by fruit (rows: what it is; columns: what it was taken for):",
            *_confusion_lines(self.training),
            *self.correction.lines(),
        ]


def _finite(value: float) -> float | None:
    return value if np.isfinite(value) else None


def _confusion_lines(training: Training[KindModel]) -> list[str]:
    counted = training.confusion
    letters = [chr(ord("A") + at % 26) for at in range(len(counted.kinds))]
    lines = ["  " + " " * 24 + "".join(f"{letter:>5}" for letter in letters)]
    for letter, kind, row in zip(letters, counted.kinds, counted.counts, strict=True):
        if row.sum():
            lines.append(f"  {letter} {kind:<22}" + "".join(f"{count:>5}" for count in row))
    right = counted.right
    if right.trials:
        share = f"{right.value:.1%} (95 % interval {right.low:.1%} to {right.high:.1%})"
        lines.append(f"  right: {share} of {right.trials}")
    return lines


def train_recordings(
    labelled: Sequence[tuple[RecordingSource, Path]],
    station_path: Path,
    out: Path,
    seed: int = 0,
    progress: Progress = no_progress,
    cancelled: Cancelled = never_cancelled,
) -> TrainOutcome:
    """Train on recordings with their labels files, and write the model.

    Raises:
        InputError: a file cannot be used, or no label points at a fruit.
        WorldError: the model cannot be written.
    """
    station = read_station(station_path)
    labels = [read_labels(path) for _, path in labelled]
    taught: list[Taught] = []
    warnings: list[str] = []
    for number, ((source, path), read) in enumerate(zip(labelled, labels, strict=True)):
        progress(0.8 * number / len(labelled), f"Watching {source.path.name}")
        one = _Labelled(source, station, read.labels, f"{number}", cancelled)
        taught += one.taught()
        warnings += [*one.warnings(path), *read.warnings[:MOST_WARNINGS]]
    if not taught:
        raise InputError(
            "no_label_matched",
            "No row of the labels points at a fruit that crossed the belt.",
            "Check that labels and recordings belong together and are given in the same order.",
            file=labelled[0][1],
        )
    made_from = {
        "recordings": [source.path.name for source, _ in labelled],
        "labels": [path.name for _, path in labelled],
    }
    outcome = train_taught(taught, made_from, out, seed, _later(progress), cancelled)
    return replace(outcome, warnings=(*dict.fromkeys(warnings), *outcome.warnings))


def train_taught(
    taught: Sequence[Taught],
    made_from: Mapping[str, Any],
    out: Path,
    seed: int = 0,
    progress: Progress = no_progress,
    cancelled: Cancelled = never_cancelled,
) -> TrainOutcome:
    """Train on fruit that were taught, wherever they come from, and write the model.

    Args:
        taught: labelled and measured fruit.
        made_from: what they come from, for people; kept in the model beside the kinds.
        out: the model's file.
        seed: of all chance.
        progress, cancelled: see `progress`.

    Raises:
        InputError: there is not enough to learn from.
        WorldError: the model cannot be written.
        CancelledByUserError: a person stopped it; no file was written.
    """
    training = train([one.labelled for one in taught], FEATURES, seed, progress, cancelled)
    correction = fit_correction(_references(taught))
    kinds = [{"kind": one.kind, "fruit": one.fruit, "samples": one.views} for one in training.taught]
    model = Model(training.model, correction.correction, {**made_from, "kinds": kinds})
    write_model(out, model)
    return TrainOutcome(model, training, correction, training.warnings)


def _later(progress: Progress) -> Progress:
    return lambda share, doing: progress(0.8 + 0.2 * share, doing)


def _references(taught: Iterable[Taught]) -> list[Reference]:
    return [
        Reference(one.labelled.kind, one.size, one.volume_m3, one.mass_kg)
        for one in taught
        if one.volume_m3 is not None or one.mass_kg is not None
    ]


@dataclass(slots=True)
class _Said:
    """What the rows of one fruit say, taken together."""

    kinds: Counter[str] = field(default_factory=Counter)
    volumes_ml: list[float] = field(default_factory=list)
    masses_g: list[float] = field(default_factory=list)
    lines: list[int] = field(default_factory=list)

    def add(self, label: Label) -> None:
        self.kinds[label.kind] += 1
        self.lines.append(label.line)
        if label.volume_ml is not None:
            self.volumes_ml.append(label.volume_ml)
        if label.mass_g is not None:
            self.masses_g.append(label.mass_g)

    @property
    def kind(self) -> str:
        return self.kinds.most_common(1)[0][0]


class _Labelled:
    """One recording with its labels."""

    def __init__(
        self, source: RecordingSource, station: Station, labels: Sequence[Label], prefix: str, cancelled: Cancelled
    ) -> None:
        prelude = look_ahead(Watching(source, station), station, None, Stopwatch(), cancelled)
        self._watching = prelude.watching
        self._rig = prelude.watching.rig
        self._prefix = prefix
        self._tracks = []
        self._pointer = Pointer(labels, self._rig)
        tracker = Tracker(self._rig, prelude.belt)
        with contextlib.closing(prelude.seen) as frames:
            for seen in frames:
                self._pointer.look(seen)
                self._tracks += tracker.update(seen.observation)
        self._tracks += tracker.finish()
        self._pointed = self._pointer.pointed()
        self._labels = assign(self._pointed, self._tracks)
        self._conflicts: list[str] = []

    def taught(self) -> list[Taught]:
        """Return the labelled fruit, measured."""
        fruit = {at: self._fruit_id(at, labels) for at, labels in self._labels.items()}
        said: dict[str, _Said] = defaultdict(_Said)
        for at, labels in self._labels.items():
            for label in labels:
                said[fruit[at]].add(label)
        self._conflicts = [
            f"lines {', '.join(map(str, sorted(one.lines)[:8]))} give one fruit the kinds "
            f"{', '.join(sorted(one.kinds))}; {one.kind} is used."
            for one in said.values()
            if len(one.kinds) > 1
        ]
        return [self._measured(at, fruit[at], said[fruit[at]]) for at in sorted(self._labels)]

    def _fruit_id(self, at: int, labels: Sequence[Label]) -> str:
        named = Counter(label.fruit for label in labels if label.fruit is not None)
        name = named.most_common(1)[0][0] if named else f"track {self._tracks[at].track}"
        return f"{self._prefix}:{name}"

    def _measured(self, at: int, fruit_id: str, said: _Said) -> Taught:
        track = self._tracks[at]
        size = measure(track, self._rig)
        sensors = tuple(sorted({sighting.view.sensor for sighting in track.sightings}))
        labelled = LabelledFruit(fruit_id, said.kind, evidence(track, size), sensors, self._prefix)
        volume_m3 = float(np.median(said.volumes_ml)) * 1e-6 if said.volumes_ml else None
        mass_kg = float(np.median(said.masses_g)) * 1e-3 if said.masses_g else None
        return Taught(labelled, size, volume_m3, mass_kg)

    def warnings(self, path: Path) -> list[str]:
        """Return what went unused, by line."""
        used = {label.line for labels in self._labels.values() for label in labels}
        lost = [one.label for one in self._pointed if one.label.line not in used]
        missed = [f"{path}: line {label.line}: {why}; the row is left out." for label, why in self._pointer.missed()]
        missed += [f"{path}: line {one.line}: that fruit was not followed; the row is left out." for one in lost]
        if len(missed) > MOST_WARNINGS:
            more = f"{path}: {len(missed) - MOST_WARNINGS} more rows are left out for such reasons."
            missed = [*missed[:MOST_WARNINGS], more]
        conflicts = [f"{path}: {text}" for text in self._conflicts[:MOST_WARNINGS]]
        return [*missed, *conflicts, *self._watching.warnings()]
