"""What is done to a lot and its line beside the window, and what is said of it."""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass

from PySide6.QtCore import QCoreApplication

from fruitgui.errors import WorldError
from fruitgui.gui.beginning import Begun
from fruitgui.gui.going_on import GoingOn
from fruitgui.gui.numbers import count_text
from fruitgui.gui.tasks import Job
from fruitgui.gui.told import Told
from fruitgui.progress import Cancelled, Progress
from fruitgui.records.lot import Lot
from fruitgui.records.store import Store
from fruitgui.station.live import LineApart

log = logging.getLogger(__name__)
translate = QCoreApplication.translate

STARTS, IN_VIEW = "starts", "in view"
"""What a job of the line's is at."""


@dataclass(frozen=True, slots=True, eq=False)
class EndedLot:
    """A lot that was ended, and how many fruit count in it."""

    lot: Lot
    fruit: int


def starting(begin: Callable[[Cancelled], Begun], take: Callable[[Begun], None]) -> Job[Begun]:
    """Return the job that begins a lot and hands over what it made at once: the window may close before it is told."""

    def job(progress: Progress, cancelled: Cancelled) -> Begun:
        progress(0.0, STARTS)
        made = begin(cancelled)
        take(made)
        return made

    return job


def ending(store: Store, line: LineApart, lot: Lot, owed: GoingOn) -> Job[EndedLot]:
    """Return the job that stops a line, counts what is in view, and ends its lot."""

    def job(progress: Progress, cancelled: Cancelled) -> EndedLot:  # noqa: ARG001 - it ends within seconds
        progress(0.0, IN_VIEW)
        line.stop()
        line.keep_rest()
        owed.keep()
        return _with_count(store, store.lots.end(lot.key))

    return job


def ending_left_open(store: Store, lot: Lot) -> Job[EndedLot]:
    """Return the job that ends a lot of an earlier start as it is."""

    def job(progress: Progress, cancelled: Cancelled) -> EndedLot:  # noqa: ARG001 - one row of a table
        return _with_count(store, store.lots.end_left_open(lot.key))

    return job


def leaving(store: Store, line: LineApart, lot: Lot, owed: GoingOn) -> Job[Lot]:
    """Return the job that stops a line, counts what is in view, and leaves its lot open."""

    def job(progress: Progress, cancelled: Cancelled) -> Lot:  # noqa: ARG001 - it ends within seconds
        line.stop()
        line.keep_rest()
        owed.keep()
        return store.lots.pause(lot.key)

    return job


def pausing(store: Store, lot: Lot, owed: GoingOn) -> Job[Lot]:
    """Return the job that keeps that a lot is paused."""

    def job(progress: Progress, cancelled: Cancelled) -> Lot:  # noqa: ARG001 - one row of a table
        owed.keep()
        return store.lots.pause(lot.key)

    return job


def resuming(store: Store, lot: Lot, since_s: float) -> Job[Lot]:
    """Return the job that keeps that a lot goes on, since a time of the store's."""

    def job(progress: Progress, cancelled: Cancelled) -> Lot:  # noqa: ARG001 - one row of a table
        return store.lots.resume(lot.key, since_s)

    return job


def kept_rest(line: LineApart, timeout_s: float) -> bool:
    """Keep what a line that is over still holds, as far as there is time; tell whether that was all."""
    try:
        line.keep_rest(timeout_s)
    except WorldError as error:
        log.warning("%d fruit that waited for the disk were let go: %s", line.state.sink.waiting, error.what)
        return False
    return not line.state.sink.waiting


def _with_count(store: Store, ended: Lot) -> EndedLot:
    return EndedLot(ended, sum(one.fruit for one in store.lots.totals(ended.key)))


def doing(said: str) -> str:
    """Return what a job is at in the language in force."""
    words = {
        STARTS: translate("Running", "Starting the line"),
        IN_VIEW: translate("Running", "Counting the fruit still in view"),
    }
    return words.get(said, said)


def ended_told(ended: EndedLot) -> Told:
    """Return what is said of a lot that was ended."""
    text = translate("Running", "Lot {name} is ended with {count} fruit.")
    return Told(text.format(name=ended.lot.name, count=count_text(ended.fruit)))


def sensors_changed_told() -> Told:
    """Return what is said where the line lost its sensors."""
    return Told(
        translate("Running", "The sensors were changed, so the line was stopped."),
        translate("Running", "The lot is still open: go on with it on the live screen."),
    )
