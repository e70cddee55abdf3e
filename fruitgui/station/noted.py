"""A sink that remembers what it kept, for whoever shows it."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence

from fruitgui.station.fruit import Fruit
from fruitgui.station.sink import CountedFruit, Crop, FruitSink


class NotedSink:
    """Keeps fruit in another sink, and notes what is durable: a `FruitSink`. One thread commits, another drains.

    Args:
        sink: keeps fruit.

    Attributes:
        then: called after each fruit that was kept; it must not raise.
    """

    def __init__(self, sink: FruitSink) -> None:
        self._sink = sink
        self._noted: deque[CountedFruit] = deque()
        self.then: Callable[[], None] = _nothing

    def commit(self, lot: int, fruit: Fruit, crops: Sequence[Crop]) -> CountedFruit:
        """Keep one fruit, see `FruitSink.commit`."""
        counted = self._sink.commit(lot, fruit, crops)
        self._noted.append(counted)
        self.then()
        return counted

    def drain(self) -> list[CountedFruit]:
        """Return what was noted since the last time."""
        return [self._noted.popleft() for _ in range(len(self._noted))]


def _nothing() -> None:
    """Do nothing."""
