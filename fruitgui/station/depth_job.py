"""Measuring one device's depth: pictures of what lies before it, and what they come to."""

from __future__ import annotations

from fruitgui.calibration.depth.correct import correct_depth
from fruitgui.calibration.depth.measured import DepthFit, DepthRefusal, Measurements
from fruitgui.calibration.still import Still, average
from fruitgui.errors import InputError
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress, stop_if
from fruitgui.sensors.feed import Feed
from fruitgui.station.stills import collect_stills

FRAMES = 24
"""Half of a reading's error stays from picture to picture: more pictures average nothing more out."""

COLLECTED = 0.9


def take_still(
    feed: Feed, sensor: str, progress: Progress = no_progress, cancelled: Cancelled = never_cancelled
) -> Still:
    """Return what a sensor sees, uncorrected, averaged over its next pictures.

    Raises:
        InputError: the feed has no such sensor.
        WorldError: the sensor gave nothing for too long.
        CancelledByUserError: `cancelled` said so.
    """
    if sensor not in feed.sensors:
        raise InputError("no_such_sensor", f"There is no sensor {sensor}.", "Connect it, and try again.")
    frames = collect_stills(feed, FRAMES, lambda share, doing: progress(COLLECTED * share, doing), cancelled, {sensor})
    progress(COLLECTED, "Averaging")
    return average(frames[sensor])


def measure_depth(
    measured: Measurements, progress: Progress = no_progress, cancelled: Cancelled = never_cancelled
) -> DepthFit | DepthRefusal:
    """Return what the measurements of a device come to.

    Raises:
        CancelledByUserError: `cancelled` said so.
    """
    progress(0.1, "Working out the correction")
    made = correct_depth(measured)
    stop_if(cancelled)
    return made
