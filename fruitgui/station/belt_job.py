"""The belt's speed and direction, measured from fruit that pass before running sensors."""

from __future__ import annotations

import time
from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from fruitgui.errors import WorldError
from fruitgui.perception.view import Observation
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress, stop_if
from fruitgui.sensors.feed import ByCapture, DropOldest, Feed
from fruitgui.station.lineup import line_up
from fruitgui.station.prelude import belt_of_one_sensor
from fruitgui.station.station import Station
from fruitgui.station.stills import LONGEST_SILENCE_S
from fruitgui.tracking.belt import BeltMotion

LONGEST_S = 30.0
LOOK_BACK_S = 6.0
TRY_EVERY_S = 1.0
SAME = 0.1
"""Two measurements in a row that agree within this share are believed."""

TAKE_S = 0.1


def measure_belt(
    feed: Feed,
    station: Station,
    progress: Progress = no_progress,
    cancelled: Cancelled = never_cancelled,
    longest_s: float = LONGEST_S,
) -> BeltMotion | None:
    """Return the belt's motion as passing fruit show it; None where none passed that would decide it.

    May be asked while a line runs: it has a queue of its own, and lets frames go that it has no time for.

    Raises:
        InputError: the station has none of the sensors.
        WorldError: none of the sensors gave anything for too long; says which they are.
        CancelledByUserError: `cancelled` said so.
    """
    lineup = line_up(station, feed.infos.values())
    perceivers = {sensor: eye.perceiver() for sensor, eye in lineup.eyes.items()}
    order = ByCapture(lineup.offsets_s)
    queue = feed.subscribe(DropOldest(2), order)
    heard_s = time.monotonic()
    until_s, tried_s = heard_s + longest_s, 0.0
    seen: list[Observation] = []
    before: BeltMotion | None = None
    try:
        while (left_s := until_s - time.monotonic()) > 0.0 and not queue.over:
            stop_if(cancelled)
            arrival = queue.take(TAKE_S)
            if arrival is None or arrival.frame.sensor not in perceivers:
                _check_heard(heard_s, perceivers)
                continue
            heard_s = time.monotonic()
            perceiver, frame = perceivers[arrival.frame.sensor], lineup.corrected(arrival.frame)
            seen.append(perceiver.observe(replace(frame, sensor=perceiver.sensor), order.time_s(arrival)))
            seen = [one for one in seen if one.time_s > seen[-1].time_s - LOOK_BACK_S]
            progress(1.0 - left_s / longest_s, f"{sum(len(one.views) for one in seen)} views of passing fruit")
            if seen[-1].time_s - tried_s >= TRY_EVERY_S:
                tried_s = seen[-1].time_s
                motion = belt_of_one_sensor(seen, lineup.rig)
                if motion is not None and before is not None and _agree(motion, before):
                    return motion
                before = motion
    finally:
        queue.close()
    return before


def _check_heard(heard_s: float, sensors: Iterable[str]) -> None:
    """Raise `WorldError` if nothing was heard for too long: that no fruit passed cannot be said then."""
    if time.monotonic() - heard_s > LONGEST_SILENCE_S:
        names = ", ".join(sensors)
        raise WorldError(
            "sensor_silent",
            f"{names} gave nothing for {LONGEST_SILENCE_S:.0f} s.",
            "Check cable and power, and try again.",
            values={"sensor": names},
        )


def _agree(motion: BeltMotion, before: BeltMotion) -> bool:
    apart = float(np.linalg.norm(motion.velocity_m_s - before.velocity_m_s))
    return apart <= SAME * max(motion.speed_m_s, 0.02)
