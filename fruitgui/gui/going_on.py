"""A lot that goes on while the disk is full: fruit are counted, and that it went on is kept once there is room."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

from fruitgui.errors import WorldError
from fruitgui.gui.queries import Queries
from fruitgui.records.lots import Lots

AGAIN_S = 2.0
"""Between two tries; as fruit wait for the disk, see `BufferedSink`."""


class GoingOn:
    """What the records still have to be told. Until they are, they say that the lot is paused, as after a crash.

    Args:
        lots: that keep it.
        queries: try again beside the window.
        clock_s: tells when.
    """

    def __init__(self, lots: Lots, queries: Queries, clock_s: Callable[[], float] = time.monotonic) -> None:
        self._lots = lots
        self._queries = queries
        self._clock_s = clock_s
        self._keeping = threading.Lock()
        self._owed: tuple[int, float] | None = None
        self._again_s = 0.0

    def owe(self, lot: int, since_s: float) -> None:
        """Note that a lot went on at that time of day, Unix seconds, which could not be kept."""
        self._owed = lot, since_s

    def keep(self) -> None:
        """Keep it now, before anything else is done to the lot; on any thread but the window's.

        Raises:
            WorldError: the records cannot take it.
        """
        with self._keeping:  # twice, the second time would end a pause that began meanwhile
            if self._owed is not None:
                self._lots.resume(*self._owed)
                self._owed = None

    def try_again(self) -> None:
        """Try to keep it, now and then."""
        if self._owed is not None and self._clock_s() >= self._again_s:
            self._again_s = self._clock_s() + AGAIN_S
            self._queries.ask("going on", self._keep_if_it_can_be, _nothing)

    def _keep_if_it_can_be(self) -> None:
        try:
            self.keep()
        except WorldError:
            return  # it was said when it came up, and is said of the fruit that wait


def _nothing(_done: None) -> None:
    """Nobody waits for it."""
