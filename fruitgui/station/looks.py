"""Looking at something now and then, on a thread of its own: a help that must not hold up or end anything else."""

from __future__ import annotations

import logging
import threading
import time
from abc import ABC, abstractmethod

log = logging.getLogger(__name__)


class Looks(ABC):
    """Looks again and again, from `start` to `stop`; subclasses say at what, and keep what they saw.

    Args:
        name: of the thread.
        rest_s: it rests at least so long between two looks.
        rest_share: and so many times as long as a look took.
        begin_s: before its first look.
    """

    def __init__(self, name: str, rest_s: float, rest_share: float = 0.0, begin_s: float = 0.0) -> None:
        self._rest_s, self._rest_share, self._begin_s = rest_s, rest_share, begin_s
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)

    @abstractmethod
    def look(self) -> None:
        """Look once; what is raised is logged."""

    def start(self) -> None:
        """Begin. Once only."""
        self._thread.start()

    def stop(self) -> None:
        """Let it end after what it does just now; waits for nothing."""
        self._stop.set()

    @property
    def stopping(self) -> bool:
        """Whether it shall end, or has."""
        return self._stop.is_set()

    @property
    def running(self) -> bool:
        """Whether its thread has not ended yet."""
        return self._thread.is_alive()

    def wait(self, timeout_s: float) -> bool:
        """Return whether it has ended, in that time."""
        if self._thread.ident is not None:
            self._thread.join(timeout_s)
        return not self._thread.is_alive()

    def _run(self) -> None:
        self._stop.wait(self._begin_s)
        while not self._stop.is_set():
            began_s = time.monotonic()
            try:
                self.look()
            except Exception:  # the edge of a thread
                log.exception("while looking (%s)", self._thread.name)
            self._stop.wait(max(self._rest_s, self._rest_share * (time.monotonic() - began_s)))
