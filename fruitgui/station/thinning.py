"""Keeping an even choice of something that may go on for ever."""

from __future__ import annotations

from typing import Generic, TypeVar

T = TypeVar("T")


class Thinned(Generic[T]):
    """Between `most // 2` and `most` items, evenly spread over all that were added, the first one among them."""

    def __init__(self, most: int) -> None:
        self._most = most
        self._stride = 1
        self._added = 0
        self._items: list[T] = []

    def add(self, item: T) -> None:
        """Take an item, or let it go."""
        if self._added % self._stride == 0:
            if len(self._items) == self._most:
                del self._items[1::2]
                self._stride *= 2
            if self._added % self._stride == 0:
                self._items.append(item)
        self._added += 1

    def items(self) -> list[T]:
        """Return what was kept, in order."""
        return list(self._items)
