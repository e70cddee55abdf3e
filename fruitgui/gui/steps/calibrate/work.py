"""What the screen has done beside the window: calibrate, and draw what the sensors see."""

from __future__ import annotations

from dataclasses import dataclass

from fruitgui.gui.tasks import Job
from fruitgui.progress import Cancelled, Progress, stop_if
from fruitgui.sensors.feed import Feed
from fruitgui.station.calibrate_job import CalibrationOutcome, calibrate_again, corrected_stills
from fruitgui.station.depths import DeviceDepths, corrections_of
from fruitgui.station.fused_cloud import SensorCloud, fused_clouds
from fruitgui.station.station import Station
from fruitgui.station.stills import collect_stills

CAPTURED, CALIBRATED = 0.35, 0.9
"""Shares of the job that are done after its parts."""

CHECK_STILLS = 3


@dataclass(frozen=True, slots=True, eq=False)
class Calibrated:
    """What calibrating came to, with what is drawn of it."""

    outcome: CalibrationOutcome
    clouds: tuple[SensorCloud, ...]


def calibrating(
    feed: Feed, reference: str, before: Station | None, depths: DeviceDepths | None = None
) -> Job[Calibrated]:
    """Return the job of calibrating the sensors of a feed, their depth put right by what was measured of them."""
    serials = {name: info.serial for name, info in feed.infos.items()}

    def job(progress: Progress, cancelled: Cancelled) -> Calibrated:
        stills = collect_stills(
            feed, progress=lambda share, doing: progress(CAPTURED * share, doing), cancelled=cancelled
        )

        def later(share: float, doing: str) -> None:
            progress(CAPTURED + (CALIBRATED - CAPTURED) * share, doing)

        outcome = calibrate_again(stills, reference, serials, before, depths, later, cancelled)
        stop_if(cancelled)
        progress(CALIBRATED, "Drawing")
        corrected = corrected_stills(stills, corrections_of(serials, depths, before))
        return Calibrated(outcome, fused_clouds(corrected, before, outcome.station))

    return job


def drawing(feed: Feed, station: Station) -> Job[tuple[SensorCloud, ...]]:
    """Return the job of drawing what the sensors of a feed see, placed as a station has them."""

    def job(progress: Progress, cancelled: Cancelled) -> tuple[SensorCloud, ...]:
        stills = collect_stills(feed, CHECK_STILLS, lambda share, doing: progress(CAPTURED * share, doing), cancelled)
        progress(CALIBRATED, "Drawing")
        serials = {name: info.serial for name, info in feed.infos.items()}
        corrected = corrected_stills(stills, corrections_of(serials, None, station))
        return fused_clouds(corrected, station, station)

    return job
