"""Fruit that left, in order, each being measured beside while those before it are kept."""

from __future__ import annotations

import queue
from collections import deque
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any

from fruitgui.station.live.bench import Bench
from fruitgui.station.live.first_look import Leaving
from fruitgui.station.live.following import Parted
from fruitgui.station.live.helper import Weigh


@dataclass(frozen=True, slots=True, eq=False)
class Weighing:
    """A fruit that left and is being measured.

    Attributes:
        parted: the fruit.
        lot: into which it counts; None lets it pass uncounted.
        answer: what comes from the helper that measures it; None where no helper was up.
    """

    parted: Parted
    lot: int | None
    answer: Future[Any] | None


class Weighings:
    """Takes fruit from a queue, as many at a time as there are helpers to measure them. One thread takes.

    Args:
        leaving: fruit that left; None behind the last.
        bench: measures them.
    """

    def __init__(self, leaving: queue.Queue[Leaving | None], bench: Bench) -> None:
        self._leaving = leaving
        self._bench = bench
        self._ahead = max(1, len(bench.helpers))
        self._begun: deque[Weighing] = deque()
        self._over = False

    @property
    def waiting(self) -> int:
        """How many were not taken yet."""
        return self._leaving.qsize() + len(self._begun)

    def take(self, timeout_s: float) -> Weighing | None:
        """Return the next fruit, or None behind the last.

        Raises:
            queue.Empty: none left in that time.
        """
        while not self._over and len(self._begun) < self._ahead:
            try:
                leaving = self._leaving.get(block=not self._begun, timeout=timeout_s)
            except queue.Empty:
                if not self._begun:
                    raise
                break
            if leaving is None:
                self._over = True
            else:
                parted, lot = leaving
                self._begun.append(Weighing(parted, lot, self._bench.hand(Weigh(parted.track))))
        return self._begun.popleft() if self._begun else None
