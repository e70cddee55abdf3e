"""What went wrong while the line ran: each thing said once, with how often it happened."""

from __future__ import annotations

import threading
from collections.abc import Iterable
from dataclasses import replace

from fruitgui.station.live.state import LiveWarning

MOST = 50


class Warnings:
    """A bounded list that any thread adds to.

    Args:
        unmatched: sensors that the station or the feed lacks, in words.
    """

    def __init__(self, unmatched: Iterable[str] = ()) -> None:
        self._lock = threading.Lock()
        self._said: dict[tuple[str, tuple[str, ...]], LiveWarning] = {}
        self._unmatched = tuple(LiveWarning("sensor_not_matched", text) for text in unmatched)

    def add(self, code: str, text: str, sensors: tuple[str, ...]) -> None:
        """Say something; the latest words win where it was said before of the same sensors."""
        with self._lock:
            before = self._said.pop((code, sensors), None)
            said = LiveWarning(code, text, sensors)
            self._said[code, sensors] = said if before is None else replace(said, count=before.count + 1)
            while len(self._said) > MOST:
                del self._said[next(iter(self._said))]

    def all(self) -> tuple[LiveWarning, ...]:
        """Return everything said, the latest last."""
        with self._lock:
            return (*self._unmatched, *self._said.values())
