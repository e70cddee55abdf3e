"""A store of fruit that is a list."""

from __future__ import annotations

import threading
from collections.abc import Sequence

from fruitgui.errors import WorldError
from fruitgui.station.fruit import Fruit
from fruitgui.station.sink import CountedFruit, Crop


class MemorySink:
    """Keeps fruit in memory; can be told to be full. A `FruitSink`."""

    def __init__(self) -> None:
        self.kept: list[tuple[CountedFruit, tuple[Crop, ...]]] = []
        self.full = threading.Event()

    def commit(self, lot: int, fruit: Fruit, crops: Sequence[Crop]) -> CountedFruit:
        if self.full.is_set():
            raise WorldError("disk_full", "The disk is full.", "Free some room.")
        number = len(self.kept) + 1
        counted = CountedFruit(number, lot, number, fruit)
        self.kept.append((counted, tuple(crops)))
        return counted
