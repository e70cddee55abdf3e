"""What is done beside the window: take a picture, and work out the correction."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QCoreApplication

from fruitgui.calibration.depth.measured import DepthFit, DepthRefusal, Measurements, SeenFlat
from fruitgui.calibration.still import Still
from fruitgui.gui.tasks import Job
from fruitgui.progress import Cancelled, Progress
from fruitgui.sensors.feed import Feed
from fruitgui.station.depth_job import measure_depth, take_still
from fruitgui.station.depth_watch import belt_of

translate = QCoreApplication.translate


@dataclass(frozen=True, slots=True, eq=False)
class Taken:
    """A picture, and the belt in it where that was asked for."""

    still: Still
    belt: SeenFlat | None


@dataclass(frozen=True, slots=True, eq=False)
class Worked:
    """What the measurements came to."""

    outcome: DepthFit | DepthRefusal


def taking(feed: Feed, sensor: str, *, bare: bool) -> Job[Taken]:
    """Return the job of taking a picture of a sensor's belt, bare or not."""

    def job(progress: Progress, cancelled: Cancelled) -> Taken:
        still = take_still(feed, sensor, progress, cancelled)
        return Taken(still, belt_of(still) if bare else None)

    return job


def working_out(measured: Measurements) -> Job[Worked]:
    """Return the job of working out the correction."""

    def job(progress: Progress, cancelled: Cancelled) -> Worked:
        return Worked(measure_depth(measured, progress, cancelled))

    return job


def taking_words(_doing: str) -> str:
    """Return what a person does while pictures are taken, whatever the core is at."""
    return translate("Depth", "Taking pictures: keep hands away")


def working_words(_doing: str) -> str:
    """Return what is being done while the correction is worked out."""
    return translate("Depth", "Working out the correction")
