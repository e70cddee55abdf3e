"""How frames get from a feed into the line: from sensors that do not wait, or from recordings that do."""

from __future__ import annotations

import math
from dataclasses import dataclass

from fruitgui.sensors.feed import DropOldest, Room, WaitForRoom


@dataclass(frozen=True, slots=True)
class Intake:
    """How frames get in.

    Attributes:
        room: what happens to frames that the line has no time for.
        patience_s: how long a frame waits for an earlier one of another sensor.
        jump_s: a sensor's stamps that leap by more than this against the host's clock are taken for a clock set anew.
    """

    room: Room
    patience_s: float
    jump_s: float


LIVE = Intake(DropOldest(20), patience_s=0.5, jump_s=2.0)
"""Sensors at their own rate, four seconds of 5 Hz held back at most; what is dropped is counted."""

FLAT_OUT = Intake(WaitForRoom(8), patience_s=30.0, jump_s=math.inf)
"""Recordings as fast as the line can: nothing is dropped, and the order never depends on who was quicker."""


class ClockWatch:
    """Notices a sensor whose clock was set anew, say by being plugged in again.

    Args:
        jump_s: a larger leap is a new clock.
    """

    def __init__(self, jump_s: float) -> None:
        self._jump_s = jump_s
        self._lag_s: dict[str, float] = {}

    def leap_s(self, sensor: str, time_s: float, arrived_s: float) -> float:
        """Return what to add to a sensor's stamps from this frame on, so that they go on as before; mostly 0."""
        lag_s = arrived_s - time_s
        before_s = self._lag_s.setdefault(sensor, lag_s)
        leap_s = lag_s - before_s
        if abs(leap_s) > self._jump_s:
            return leap_s
        self._lag_s[sensor] = lag_s
        return 0.0
