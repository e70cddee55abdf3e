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
    doing = translate("Depth", "Taking pictures: keep hands away")

    def job(progress: Progress, cancelled: Cancelled) -> Taken:
        still = take_still(feed, sensor, lambda share, _: progress(share, doing), cancelled)
        return Taken(still, belt_of(still) if bare else None)

    return job


def working_out(measured: Measurements) -> Job[Worked]:
    """Return the job of working out the correction."""
    doing = translate("Depth", "Working out the correction")

    def job(progress: Progress, cancelled: Cancelled) -> Worked:
        return Worked(measure_depth(measured, lambda share, _: progress(share, doing), cancelled))

    return job
