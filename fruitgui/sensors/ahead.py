"""Frames decoded ahead in a thread of their own, while the line works on the one before."""

from __future__ import annotations

import queue
import threading
from collections.abc import Iterator
from types import TracebackType
from typing import Generic, Self, TypeVar

T = TypeVar("T")

_LOOK_S = 0.05
_END_S = 10.0


class ReadAhead(Generic[T]):
    """Draws from an iterator in a thread, at most `depth` items ahead; gives them in the same order.

    Decoding leaves Python's lock for most of its time (zstd, JPEG), so a second
    core takes it over. An error of the iterator is raised where its item would
    have come. One owner iterates and closes; use as a context manager.
    """

    def __init__(self, source: Iterator[T], depth: int = 4) -> None:
        self._source = source
        self._items: queue.Queue[tuple[T | None, BaseException | None]] = queue.Queue(max(depth, 1))
        self._stop = threading.Event()
        self._thread: threading.Thread | None = None
        self._ended = False

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, _kind: type[BaseException] | None, _error: BaseException | None, _trace: TracebackType | None
    ) -> None:
        self.close()

    def __iter__(self) -> Self:
        return self

    def __next__(self) -> T:
        if self._ended:
            raise StopIteration
        if self._thread is None:
            self._thread = threading.Thread(target=self._draw, name="read-ahead", daemon=True)
            self._thread.start()
        item, error = self._items.get()
        if error is None:
            return item  # type: ignore[return-value]  # no error means an item
        self._ended = True
        self._thread.join(_END_S)
        raise error

    def close(self) -> None:
        """End the thread; nothing more is given. Any number of times."""
        self._ended = True
        self._stop.set()
        if self._thread is not None:
            self._thread.join(_END_S)

    def _draw(self) -> None:
        last: BaseException = StopIteration()
        try:
            for item in self._source:
                if not self._put((item, None)):
                    break
        except BaseException as error:  # noqa: BLE001 - handed to the owner, who raises it
            last = error
        close = getattr(self._source, "close", None)
        if close is not None:
            close()
        self._put((None, last))

    def _put(self, item: tuple[T | None, BaseException | None]) -> bool:
        """Hand over an item; false once the owner has closed."""
        while not self._stop.is_set():
            try:
                self._items.put(item, timeout=_LOOK_S)
            except queue.Full:
                continue
            return True
        return False
