"""The jobs that the teaching screen starts: lessons, a look through, labels in and out."""

from __future__ import annotations

import re
import time
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QCoreApplication

from fruitgui.gui.tasks import Job
from fruitgui.gui.view_pictures import ViewPictures, view_pictures
from fruitgui.measurement.fruit import Size
from fruitgui.progress import Cancelled, Progress
from fruitgui.records.insight import Insight, look_through
from fruitgui.records.labels_file import LabelsRead, import_labels, write_labels
from fruitgui.records.lesson import Lesson, watch_line, watch_recording
from fruitgui.records.store import Store
from fruitgui.records.teaching import Brief
from fruitgui.sensors.feed import Feed
from fruitgui.station.station import Station
from fruitgui.station.workflow import TaughtFacts

translate = QCoreApplication.translate
SEED = 0

Loaded = tuple[list[Brief], TaughtFacts | None]
Seen = tuple[int, tuple[ViewPictures, ...], Size]


def loading(store: Store) -> Callable[[], Loaded]:
    """Return what reads all that is taught."""
    return lambda: (store.teaching.briefs(), store.teaching.facts())


def looking_at(store: Store, key: int) -> Callable[[], Seen]:
    """Return what reads all views of a fruit, with its size."""
    return lambda: (key, view_pictures(store.crops.of("taught", key)), store.teaching.get(key).fruit.size)


def watching(store: Store, feed: Feed, station: Station) -> Job[Lesson]:
    """Return the job that lets fruit come in from the sensors that run."""
    source = translate("Teach", "Line, {time}").format(time=time.strftime("%Y-%m-%d %H:%M:%S"))

    def job(progress: Progress, cancelled: Cancelled) -> Lesson:
        return watch_line(store, feed, station, source, _so_far, progress, cancelled)

    return job


def opening(store: Store, path: Path, station: Station) -> Job[Lesson]:
    """Return the job that lets the fruit of a recording come in."""

    def job(progress: Progress, cancelled: Cancelled) -> Lesson:
        return watch_recording(store, path, station, _so_far, progress, cancelled)

    return job


def _so_far(frames: int, fruit: int) -> str:
    return f"{fruit} {frames}"


def lesson_words(doing: str) -> str:
    """Return how far a lesson is; as it is where that is no two numbers."""
    match = re.fullmatch(r"(?P<fruit>\d+) (?P<frames>\d+)", doing)
    said = translate("Teach", "{fruit} fruit came in, {frames} pictures were looked at")
    return doing if match is None else said.format(**match.groupdict())


def looking_words(_doing: str) -> str:
    """Return what is being done while the fruit are looked through, whatever the core is at."""
    return translate("Teach", "Learning from what is named so far")


def looking_through(store: Store, saved: Callable[[], None]) -> Job[Insight]:
    """Return the job that trains on what is named so far and looks at everything with it.

    Args:
        store: holds what is taught.
        saved: waits until what was named just now is in the store.
    """

    def job(progress: Progress, cancelled: Cancelled) -> Insight:
        saved()
        return look_through(store.teaching, SEED, progress, cancelled)

    return job


def exporting(store: Store, source: str, path: Path) -> Job[int]:
    """Return the job that writes what is taught of a source as a labels file."""

    def job(progress: Progress, cancelled: Cancelled) -> int:  # noqa: ARG001 - a file of some kilobytes
        progress(0.0, path.name)
        return write_labels(store.teaching, source, path)

    return job


def importing(store: Store, source: str, path: Path) -> Job[LabelsRead]:
    """Return the job that names the fruit of a source as a labels file says."""

    def job(progress: Progress, cancelled: Cancelled) -> LabelsRead:  # noqa: ARG001 - a file of some kilobytes
        progress(0.0, path.name)
        return import_labels(store.teaching, source, path)

    return job
