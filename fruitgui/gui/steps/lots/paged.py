"""Rows of a long list, of which only some pages are held."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterator, Sequence
from typing import Generic, TypeVar

R = TypeVar("R")


class Pages(Generic[R]):
    """Holds the pages that were looked at last; the rest is asked for again when it is needed.

    Args:
        size: rows on a page.
        most: pages that are held.
    """

    def __init__(self, size: int = 50, most: int = 40) -> None:
        self.size = size
        self.found = 0
        self._most = most
        self._pages: OrderedDict[int, Sequence[R]] = OrderedDict()
        self._stale: set[int] = set()

    def clear(self, found: int = 0) -> None:
        """Forget all rows; there are so many from now on."""
        self.found = found
        self._pages.clear()
        self._stale.clear()

    def make_stale(self) -> None:
        """Keep showing what there is, but ask for it again."""
        self._stale = set(self._pages)

    def row(self, number: int) -> R | None:
        """Return a row; None where its page is not there."""
        page = self._pages.get(number // self.size)
        at = number % self.size
        return page[at] if page is not None and at < len(page) else None

    def wanted(self, first: int, last: int) -> int | None:
        """Return a page that these rows need and that is not there or stale; None where all are there."""
        most = (self.found - 1) // self.size
        for page in range(max(first, 0) // self.size, min(max(last, 0) // self.size, most) + 1):
            if page not in self._pages or page in self._stale:
                return page
        return None

    def put(self, page: int, rows: Sequence[R], found: int) -> None:
        """Take a page that was asked for; `found` is how many rows there are now."""
        self.found = found
        self._pages[page] = rows
        self._pages.move_to_end(page)
        self._stale.discard(page)
        while len(self._pages) > self._most:
            gone, _ = self._pages.popitem(last=False)
            self._stale.discard(gone)

    def held(self) -> Iterator[tuple[int, R]]:
        """Go through the rows that are there, with their numbers."""
        for page, rows in self._pages.items():
            for at, row in enumerate(rows):
                yield page * self.size + at, row
