"""The time of day within a lot: it goes on evenly, whatever is done to the computer's clock meanwhile."""

from __future__ import annotations

import time
from collections.abc import Callable


def _since_boot_s() -> float:
    """Return seconds that nothing sets; those in which the computer slept count, where the system tells them."""
    boottime = getattr(time, "CLOCK_BOOTTIME", None)
    return time.monotonic() if boottime is None else time.clock_gettime(boottime)


class SteadyClock:
    """Tells the time of day, Unix seconds, as the computer had it when `set` was called last.

    Args:
        day_s: the computer's time of day, which a person, the network or an empty battery may set.
        even_s: seconds that go on evenly.
    """

    def __init__(self, day_s: Callable[[], float] = time.time, even_s: Callable[[], float] = _since_boot_s) -> None:
        self._day_s = day_s
        self._even_s = even_s
        self._ahead_s = 0.0
        self.set()

    def __call__(self) -> float:
        """Return the time of day."""
        return self._even_s() + self._ahead_s

    def set(self, least_s: float = 0.0) -> None:
        """Take the computer's time of day, or a later one than that: what goes on began before it."""
        self._ahead_s = max(self._day_s(), least_s) - self._even_s()
