"""What a lot amounts to while its line runs: fruit as they are kept, and what people correct meanwhile."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable

from fruitgui.gui.queries import Queries
from fruitgui.gui.steps.live.tally import Tally
from fruitgui.records.lots import Lots
from fruitgui.records.totals import KindTotal
from fruitgui.station.noted import NotedSink
from fruitgui.station.sink import CountedFruit


class Reckoning:
    """Counts each fruit once, whether the records were read before or after it was kept.

    Args:
        lots: tell what a lot amounts to.
        queries: ask them beside the window.
        totals: of the lot so far.
        sink: tells which fruit are kept; None where no line runs.

    Attributes:
        tally: the sum of it.
    """

    def __init__(
        self, lots: Lots, queries: Queries, totals: Iterable[KindTotal] = (), sink: NotedSink | None = None
    ) -> None:
        self._lots = lots
        self._queries = queries
        self._sink = sink
        self.tally = Tally.of(totals)
        self._read_to = 0
        self._meanwhile: list[CountedFruit] | None = None

    def count_kept(self) -> None:
        """Add what was kept since the last time, but for what the records had when they were read."""
        now_s = time.monotonic()
        for counted in () if self._sink is None else self._sink.drain():
            if counted.number > self._read_to:
                self.tally.count(counted.fruit, now_s)
                if self._meanwhile is not None:
                    self._meanwhile.append(counted)

    def read_again(self, lot: int, told: Callable[[], None]) -> None:
        """Read what the lot amounts to now; `told` is called once the tally says so."""
        self._meanwhile = []
        self._queries.ask("reckoning", lambda: self._lots.summed(lot), lambda read: self._take(*read, told))

    def _take(self, totals: tuple[KindTotal, ...], read_to: int, told: Callable[[], None]) -> None:
        self._read_to = read_to
        self.tally.take(totals)
        for counted in self._meanwhile or ():
            if counted.number > read_to:
                self.tally.add(counted.fruit)
        self._meanwhile = None
        told()
