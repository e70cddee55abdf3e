"""Running the line over a recording, as fast as the machine allows."""

from __future__ import annotations

import contextlib
import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fruitgui.frame import F64
from fruitgui.measurement.paper import paper_volume
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress
from fruitgui.station.fruit import Fruit
from fruitgui.station.judging import FEATURES, PaperVolume
from fruitgui.station.kinds_file import read_kind_notes, with_typed_densities
from fruitgui.station.line import Line
from fruitgui.station.model import Model, read_model
from fruitgui.station.observing import Watching
from fruitgui.station.prelude import Prelude, look_ahead
from fruitgui.station.report import report_value
from fruitgui.station.silences import Silences
from fruitgui.station.source import RecordingSource
from fruitgui.station.station import Station
from fruitgui.station.station_file import read_station
from fruitgui.station.timing import Stopwatch
from fruitgui.station.unknowns import unknown_warnings
from fruitgui.tracking.speed import mean_velocity, way_velocity
from fruitgui.tracking.track import Track
from fruitgui.tracking.tracker import Tracker


@dataclass(frozen=True, slots=True)
class RunOptions:
    """What a person wishes of a run.

    Attributes:
        model: file of the model; None takes the one that the station names.
        paper: add each fruit's volume by the source's method.
        belt_speed_m_s: where it is known; None takes the station's, or lets the tracks tell.
    """

    model: Path | None = None
    paper: bool = False
    belt_speed_m_s: float | None = None


def model_of(station: Station, station_path: Path, given: Path | None) -> Model | None:
    """Return the model to use: the one given, or the one that the station names beside it; None where there is none.

    Densities that a person typed for this line, kept beside the station too, stand for those that were learned.

    Raises:
        InputError: the file cannot be used.
    """
    if given is None and station.model is not None:
        given = station_path.parent / station.model
    if given is None:
        return None
    return with_typed_densities(read_model(given, FEATURES), read_kind_notes(station_path.parent))


def named_model(station_path: Path) -> Path | None:
    """Return the model's file that a station names, beside it; None where it names none.

    Raises:
        InputError: the station cannot be used.
    """
    name = read_station(station_path).model
    return None if name is None else station_path.parent / name


def run_recording(
    source: RecordingSource,
    station_path: Path,
    options: RunOptions,
    progress: Progress = no_progress,
    cancelled: Cancelled = never_cancelled,
) -> dict[str, Any]:
    """Return the report of a recording, `fruitgui.report/1`.

    Raises:
        InputError: recording, station or model cannot be used.
    """
    station = read_station(station_path)
    model = model_of(station, station_path, options.model)
    watch = Stopwatch()
    progress(0.0, "Looking at the first fruit")
    prelude = look_ahead(Watching(source, station), station, options.belt_speed_m_s, watch, cancelled)
    run = _Run(prelude, model, paper_volume if options.paper else None, watch)
    with contextlib.closing(prelude.seen):
        run.go(progress)
    return run.report(station)


class _Run:
    """One recording through one line."""

    def __init__(self, prelude: Prelude, model: Model | None, paper: PaperVolume | None, watch: Stopwatch) -> None:
        rig = prelude.watching.rig
        self._prelude = prelude
        self._watch = watch
        self._named = model is not None
        self._tracker = Tracker(rig, prelude.belt)
        self._line = Line(rig, self._tracker, model, paper, watch)
        self._frames: Counter[str] = Counter()
        self._silences = Silences()
        self._fruit: list[Fruit] = []

    def go(self, progress: Progress) -> None:
        """Feed every frame."""
        for seen in self._prelude.seen:
            began_s = time.perf_counter()
            tracks = self._line.follow(seen.observation)
            self._watch.frame(seen.perceived_s + time.perf_counter() - began_s)
            self._take(tracks)
            self._frames[seen.observation.sensor] += 1
            self._silences.hear(seen.observation.sensor, seen.observation.time_s)
            if self._watch.frames % 50 == 0:
                share = self._prelude.watching.share_seen
                progress(share, f"{self._watch.frames} frames, {len(self._fruit)} fruit")
        self._take(self._tracker.finish())

    def _take(self, tracks: Sequence[Track]) -> None:
        for track in tracks:
            self._prelude.watching.rig_watch.see_track(track)
        self._fruit += self._line.fruit(tracks)

    def _belt_velocity_m_s(self) -> F64 | None:
        """Return what the fruit's ways tell, or, where none went far, what following them did."""
        told = mean_velocity(one for fruit in self._fruit if (one := way_velocity(fruit.path)) is not None)
        belt = self._tracker.belt
        return belt.velocity_m_s if told is None and belt is not None else told

    def _unknown_warnings(self) -> list[str]:
        return unknown_warnings([one.kind for one in self._fruit]) if self._named else []

    def report(self, station: Station) -> dict[str, Any]:
        """Return the report."""
        watching = self._prelude.watching
        return report_value(
            station.reference,
            self._fruit,
            watching.sensors_value(self._frames),
            self._belt_velocity_m_s(),
            [*watching.warnings(), *self._prelude.warnings, *self._silences.warnings(), *self._unknown_warnings()],
            self._watch.value(),
        )
