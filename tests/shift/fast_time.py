"""A process's clock that runs as fast as the process can follow."""

from __future__ import annotations

import contextlib
import queue
import threading
import time
from collections.abc import Callable
from typing import Any

SLOWEST, FASTEST = 0.02, 4.0
"""What the machine is late by grows with the rate: where it is kept from a thread for 50 ms, 0.2 s of the devices' time
have gone at the fastest, and no more."""

_SLICE_S = 0.05


class FastTime:
    """Lets Python's monotonic clock run `rate` times as fast, and all that waits wait so much shorter.

    Waiting for locks and threads themselves stays as it is: it is work, not time.
    """

    def __init__(self, rate: float = 1.0) -> None:
        self._real_s: Callable[[], float] = time.monotonic
        self._sleep: Callable[[float], None] = time.sleep
        self._lock = threading.Lock()
        self._rate = rate
        self._from_real_s = self._real_s()
        self._from_s = self._from_real_s

    @property
    def rate(self) -> float:
        """How fast it runs."""
        return self._rate

    def run_at(self, rate: float) -> None:
        """Run at another rate from now on."""
        with self._lock:
            self._from_s, self._from_real_s = self._now_s()
            self._rate = min(max(rate, SLOWEST), FASTEST)

    def now_s(self) -> float:
        """Return the time."""
        with self._lock:
            return self._now_s()[0]

    def really_sleep(self, seconds: float) -> None:
        """Sleep by the wall's clock."""
        self._sleep(seconds)

    def real_s(self) -> float:
        """Return the wall's monotonic clock."""
        return self._real_s()

    def install(self) -> None:
        """Take the place of the clock, for the rest of the process."""

        def wait(condition: Any, timeout: float | None = None) -> bool:  # noqa: ANN401 - its own parts are used
            """As `Condition.wait`, but the wait for one and the same notice goes on where the rate changes."""
            notice = threading.Lock()
            notice.acquire()
            condition._waiters.append(notice)
            state = condition._release_save()
            noticed = False
            try:
                noticed = notice.acquire() if timeout is None else self._acquired(notice, self.now_s() + timeout)
                return noticed
            finally:
                condition._acquire_restore(state)
                if not noticed:
                    with contextlib.suppress(ValueError):
                        condition._waiters.remove(notice)

        def sleep(seconds: float) -> None:
            end_s = self.now_s() + seconds
            while self.now_s() < end_s:
                self._sleep(self._slice_s(end_s))

        modules: list[Any] = [time, threading, queue]
        modules[0].monotonic = self.now_s
        modules[0].sleep = sleep
        modules[1]._time = self.now_s
        modules[2].time = self.now_s
        modules[1].Condition.wait = wait

    def _acquired(self, notice: threading.Lock, end_s: float) -> bool:
        while not notice.acquire(timeout=self._slice_s(end_s)):
            if self.now_s() >= end_s:
                return False
        return True

    def _slice_s(self, end_s: float) -> float:
        """Return how long to wait by the wall's clock until some time comes, or until the rate is another."""
        return min(max((end_s - self.now_s()) / self._rate, 0.0), _SLICE_S)

    def _now_s(self) -> tuple[float, float]:
        real_s = self._real_s()
        return self._from_s + (real_s - self._from_real_s) * self._rate, real_s
