"""How a running sensor is."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from enum import StrEnum

from fruitgui.errors import FruitguiError

RATE_OVER_S = 3.0
"""The rate is that of the last seconds, not of the whole shift."""

SILENT_AFTER_S = 1.0
SILENT_AFTER_PERIODS = 3.0
"""A sensor is silent when no frame came for so long, or for so many of its periods where those are longer."""


class Running(StrEnum):
    """What a sensor is doing."""

    STOPPED = "stopped"
    STARTING = "starting"
    RUNNING = "running"
    SILENT = "silent"
    FAILED = "failed"
    ENDED = "ended"


@dataclass(frozen=True, slots=True)
class SensorHealth:
    """A sensor at one moment.

    Attributes:
        sensor: its id.
        state: stopped, starting, running, silent, failed (it is opened again), or ended (a recording that is over).
        error: what failed last; None while it runs.
        rate_hz: frames per second, over the last seconds.
        nominal_hz: as the sensor says of itself; 0 where it does not.
        frames: read since the feed was started.
        drops: frames that the device numbered and nobody got.
        age_s: of the newest frame; None before the first.
        reopened: how often it was opened again.
        abandoned: its thread hangs in the driver and was left behind.
    """

    sensor: str
    state: Running
    error: FruitguiError | None = None
    rate_hz: float = 0.0
    nominal_hz: float = 0.0
    frames: int = 0
    drops: int = 0
    age_s: float | None = None
    reopened: int = 0
    abandoned: bool = False


class Pulse:
    """Counts a sensor's frames; times are the host's monotonic clock. One thread writes, any may read."""

    def __init__(self) -> None:
        self.frames = 0
        self.drops = 0
        self._last_sequence: int | None = None
        self._arrivals: deque[float] = deque(maxlen=256)

    def begin(self) -> None:
        """Forget the device's numbering: it was opened anew."""
        self._last_sequence = None

    def beat(self, sequence: int, now_s: float) -> None:
        """Note a frame."""
        if self._last_sequence is not None and sequence > self._last_sequence + 1:
            self.drops += sequence - self._last_sequence - 1
        self._last_sequence = sequence
        self._arrivals.append(now_s)
        self.frames += 1

    def newest_s(self) -> float | None:
        """Return when the newest frame came."""
        return self._arrivals[-1] if self._arrivals else None

    def rate_hz(self, now_s: float) -> float:
        """Return frames per second over the last seconds; it falls while none come."""
        lately = [at for at in list(self._arrivals) if at > now_s - RATE_OVER_S]
        if len(lately) < 2:
            return len(lately) / RATE_OVER_S
        between_s = (lately[-1] - lately[0]) / (len(lately) - 1)
        return 1.0 / max(between_s, (now_s - lately[-1]) / 1.5, 1e-6)


def silent_after_s(nominal_hz: float) -> float:
    """Return after how long without a frame a sensor is silent."""
    return max(SILENT_AFTER_S, SILENT_AFTER_PERIODS / nominal_hz if nominal_hz > 0 else 0.0)
