"""How a running sensor is."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from enum import StrEnum

from fruitgui.errors import FruitguiError
from fruitgui.sensors.sensor import ColorLock

RATE_OVER_S = 3.0
"""The rate is that of the last seconds, not of the whole shift."""

RATE_OVER_ROUNDS = 8
"""The rate of a sensor that takes turns is that of so many rounds: within one, its frames come all at once."""

SILENT_AFTER_S = 0.8
SILENT_AFTER_PERIODS = 4.0
"""A sensor is silent when it owes a frame for so long, or for so many of its periods where those are longer."""

SLOW_SHARE = 0.75
"""Below this share of what a device promises, its rate is a problem."""

LOST_SHARE = 0.02
"""From this share of lost pictures on, they are a problem."""


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
        nominal_hz: as the sensor says of itself, what its turns leave of it; 0 where it does not.
        frames: handed on since the feed was started.
        drops: frames that the device numbered and nobody got.
        damaged: frames that lost a part on their way; nobody got those either.
        clock_leaps: how often the device's clock leapt; its frames' times went on by the host's.
        age_s: of the newest frame; None before the first.
        reopened: how often it was opened again.
        useless: pictures come, but all damaged, for as long as one without any would be silent.
        hangs: its driver does not come back from a call.
        blinded_by: sensors whose driver hangs while their projectors may be on, in what should be this one's turn.
        color_lock: whether exposure and white balance stay as they are.
        abandoned: its thread hangs in the driver and was left behind.
    """

    sensor: str
    state: Running
    error: FruitguiError | None = None
    rate_hz: float = 0.0
    nominal_hz: float = 0.0
    frames: int = 0
    drops: int = 0
    damaged: int = 0
    clock_leaps: int = 0
    age_s: float | None = None
    reopened: int = 0
    useless: bool = False
    hangs: bool = False
    blinded_by: tuple[str, ...] = ()
    color_lock: ColorLock = ColorLock.UNKNOWN
    abandoned: bool = False


class Pulse:
    """Counts a sensor's frames; times are the host's monotonic clock. One thread writes, any may read."""

    def __init__(self) -> None:
        self.frames = 0
        self.drops = 0
        self.damaged = 0
        self.clock_leaps = 0
        self._leaps_before = 0
        self._last_sequence: int | None = None
        self._arrivals: deque[float] = deque(maxlen=256)

    def begin(self) -> None:
        """Forget the device's counts: it was opened anew."""
        self._leaps_before = 0
        self.begin_turn()

    def begin_turn(self) -> None:
        """Forget the device's numbering: it was dark."""
        self._last_sequence = None

    def number(self, sequence: int) -> None:
        """Note the number of a frame that was read, of use or not."""
        if self._last_sequence is not None and sequence > self._last_sequence + 1:
            self.drops += sequence - self._last_sequence - 1
        self._last_sequence = sequence

    def leap(self, leaps: int) -> None:
        """Note how often the device's clock has leapt since it was opened."""
        self.clock_leaps += max(leaps - self._leaps_before, 0)
        self._leaps_before = leaps

    def beat(self, now_s: float) -> None:
        """Count a frame that is handed on."""
        self._arrivals.append(now_s)
        self.frames += 1

    def newest_s(self) -> float | None:
        """Return when the newest frame came."""
        return self._arrivals[-1] if self._arrivals else None

    def rate_hz(self, now_s: float, round_s: float = 0.0) -> float:
        """Return frames per second lately; it falls while none come.

        Args:
            now_s: the time.
            round_s: after which its turn comes again; 0 for a sensor that takes none.
        """
        over_s = max(RATE_OVER_S, RATE_OVER_ROUNDS * round_s)
        lately = [at for at in list(self._arrivals) if at > now_s - over_s]
        if len(lately) < 2:
            return len(lately) / over_s
        if round_s:
            return len(lately) / max(now_s - lately[0], round_s)
        between_s = (lately[-1] - lately[0]) / (len(lately) - 1)
        return 1.0 / max(between_s, (now_s - lately[-1]) / 1.5, 1e-6)


def silent_after_s(nominal_hz: float) -> float:
    """Return after how long without a frame a sensor is silent."""
    return max(SILENT_AFTER_S, SILENT_AFTER_PERIODS / nominal_hz if nominal_hz > 0 else 0.0)
