"""How frames get from a feed into the line: from sensors that do not wait, or from recordings that do."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from fruitgui.sensors.feed import DropOldest, Room, Running, WaitForRoom


@dataclass(frozen=True, slots=True)
class Intake:
    """How frames get in.

    Attributes:
        room: what happens to frames that the line has no time for.
        patience_s: how long a frame waits for an earlier one of another sensor.
        jump_s: stamps that leap by more than this, back or ahead of the host's clock, are those of a clock set anew.
        away: states in which a sensor gives nothing though it should.
    """

    room: Room
    patience_s: float
    jump_s: float
    away: tuple[Running, ...] = (Running.SILENT, Running.FAILED, Running.STOPPED)


LIVE = Intake(DropOldest(20), patience_s=0.5, jump_s=2.0)
"""Sensors at their own rate, four seconds of 5 Hz held back at most; what is dropped is counted."""

FLAT_OUT = Intake(WaitForRoom(8), patience_s=30.0, jump_s=math.inf, away=(Running.FAILED, Running.STOPPED))
"""Recordings as fast as the line can: nothing is dropped, and the order never depends on who was quicker.

A sensor of a recording is silent whenever the line is not done yet with the others: that tells nothing.
"""


PLAYED = replace(LIVE, away=FLAT_OUT.away)
"""Sensors that this computer plays or computes, at their own rate: one that is late waits for it, not for a cable."""


class ClockWatch:
    """Notices a sensor whose clock was set anew, say by being plugged in again.

    Stamps that run back, or ahead of the host's clock, say so. Stamps that lag behind do not: a busy machine or a
    recording that is played slower gives frames late.

    Args:
        jump_s: a larger leap is a new clock.
    """

    def __init__(self, jump_s: float) -> None:
        self._jump_s = jump_s
        self._last_s: dict[str, tuple[float, float]] = {}
        self._least_lag_s: dict[str, float] = {}

    def leap_s(self, sensor: str, time_s: float, arrived_s: float) -> float:
        """Return what to add to a sensor's stamps from this frame on, so that they go on as before; mostly 0."""
        before_s, heard_s = self._last_s.get(sensor, (time_s, arrived_s))
        lag_s = arrived_s - time_s
        back = time_s < before_s - self._jump_s
        ahead = lag_s < self._least_lag_s.get(sensor, lag_s) - self._jump_s
        leap_s = before_s + max(arrived_s - heard_s, 0.0) - time_s if back or ahead else 0.0
        self._last_s[sensor] = (time_s + leap_s, arrived_s)
        self._least_lag_s[sensor] = min(self._least_lag_s.get(sensor, lag_s), lag_s - leap_s)
        return leap_s
