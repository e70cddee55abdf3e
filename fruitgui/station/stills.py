"""Frames of a still scene, collected from running sensors for calibrating."""

from __future__ import annotations

import time
from collections.abc import Collection

from fruitgui.errors import WorldError
from fruitgui.frame import Frame
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress, stop_if
from fruitgui.sensors.feed import Feed
from fruitgui.station.calibrate_job import FRAMES_PER_SENSOR

LONGEST_SILENCE_S = 8.0
"""A sensor that gives nothing for so long is not waited for any longer."""

TAKE_S = 0.1


def collect_stills(
    feed: Feed,
    count: int = FRAMES_PER_SENSOR,
    progress: Progress = no_progress,
    cancelled: Cancelled = never_cancelled,
    sensors: Collection[str] | None = None,
) -> dict[str, list[Frame]]:
    """Return the next `count` frames of each sensor of a running feed, or of some of them, uncorrected.

    Raises:
        WorldError: a sensor gave nothing for too long; says which.
        CancelledByUserError: `cancelled` said so.
    """
    stills: dict[str, list[Frame]] = {one: [] for one in feed.sensors if sensors is None or one in sensors}
    heard_s = dict.fromkeys(stills, time.monotonic())
    queue = feed.subscribe(count)
    try:
        while any(len(frames) < count for frames in stills.values()):
            stop_if(cancelled)
            arrival = queue.take(TAKE_S)
            if arrival is not None and arrival.frame.sensor in stills:
                frames = stills[arrival.frame.sensor]
                frames.extend([arrival.frame] if len(frames) < count else [])
                heard_s[arrival.frame.sensor] = arrival.arrived_s
            _check(stills, heard_s, count)
            have = sum(len(frames) for frames in stills.values())
            progress(have / (count * len(stills)), f"Collected {have} of {count * len(stills)} frames")
    finally:
        queue.close()
    return stills


def _check(stills: dict[str, list[Frame]], heard_s: dict[str, float], count: int) -> None:
    """Raise `WorldError` if a sensor that is still waited for is silent."""
    now_s = time.monotonic()
    for sensor, frames in stills.items():
        if len(frames) < count and now_s - heard_s[sensor] > LONGEST_SILENCE_S:
            raise WorldError(
                "sensor_silent",
                f"Sensor {sensor} gave {len(frames)} of {count} frames and then none for {LONGEST_SILENCE_S:.0f} s.",
                "Check its cable and power, or leave it out of the connection, and try again.",
                values={"sensor": sensor},
            )
