"""Work that is done in pieces, by this process and by helpers beside it."""

from __future__ import annotations

import multiprocessing
import os
import sys
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from multiprocessing.connection import Connection
from pathlib import Path
from types import TracebackType
from typing import Any, Self, TypeVar

from fruitgui.progress import deaf_children
from fruitgui.station.crew import LEAVE_S, usable_cores

T = TypeVar("T")
R = TypeVar("R")


class Hands:
    """Does one thing with each of many, one helper for every further core.

    Whoever is free takes the next piece, so it does not matter how long each takes, nor who does it. Where there is
    no process to be had, or a helper is lost, its work is done here. The helpers end with `close`.

    Args:
        cores: how many there are; None for all that this process may use.
    """

    def __init__(self, cores: int | None = None) -> None:
        self._cores = usable_cores() if cores is None else cores
        self._helpers: list[_Helper] = []

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, _kind: type[BaseException] | None, _error: BaseException | None, _trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """End the helpers. Any number of times."""
        while self._helpers:
            self._helpers.pop().close()

    def each(self, work: Callable[[T], R], on: Sequence[T]) -> Iterator[tuple[int, R]]:
        """Yield the number of each thing and what came of it, in the order in which they are done.

        Whatever `work` raises is raised here, also where it was a helper that met it.
        """
        self._dismiss([helper for helper in self._helpers if helper.number is not None])
        self._call()
        left = deque(range(len(on)))
        while left:
            for helper in self._free():
                if left and helper.take(work, left[0], on[left[0]]):
                    left.popleft()
            if left:
                number = left.popleft()
                yield number, work(on[number])
            yield from self._collected(wait=False)
        yield from self._collected(wait=True)
        lost = [helper for helper in self._helpers if helper.lost]
        self._dismiss(lost)
        for helper in lost:
            if helper.number is not None:
                yield helper.number, work(on[helper.number])

    def _dismiss(self, helpers: Sequence[_Helper]) -> None:
        """End helpers that are lost, or that still work on what nobody waits for."""
        for helper in helpers:
            self._helpers.remove(helper)
            helper.close()

    def _call(self) -> None:
        try:
            while len(self._helpers) < self._cores - 1:
                self._helpers.append(_Helper())
        except OSError:
            self._cores = 1 + len(self._helpers)

    def _free(self) -> list[_Helper]:
        return [helper for helper in self._helpers if helper.number is None and helper.is_ready()]

    def _collected(self, *, wait: bool) -> Iterator[tuple[int, Any]]:
        for helper in self._helpers:
            done = helper.collect(wait=wait)
            if done is not None:
                yield done


class _Helper:
    """A process that works on what comes through a pipe.

    Attributes:
        number: of the piece that lies with it, None where there is none.
        lost: it is gone; the piece that lies with it is not done.
    """

    def __init__(self) -> None:
        context = multiprocessing.get_context("spawn")
        self.number: int | None = None
        self.lost = self._ready = False
        self._pipe, theirs = context.Pipe()
        self._process = context.Process(target=_help, args=(theirs,), daemon=True)
        with deaf_children():
            self._process.start()
        theirs.close()

    def is_ready(self) -> bool:
        """Tell whether the helper has started: its first word is nothing."""
        if not self.lost and not self._ready and self._pipe.poll():
            self._ready = self._heard() is not None
        return self._ready and not self.lost

    def take(self, work: Callable[[T], R], number: int, on: T) -> bool:
        """Hand a piece over; false where the helper is gone."""
        try:
            self._pipe.send((work, on))
        except OSError:
            self.lost = True
            return False
        self.number = number
        return True

    def collect(self, *, wait: bool) -> tuple[int, Any] | None:
        """Return what came of the piece that lies here, None where it is not done."""
        if self.number is None or self.lost or not (wait or self._pipe.poll()):
            return None
        heard = self._heard()
        if heard is None:
            return None
        number, self.number = self.number, None
        return number, heard[0]

    def _heard(self) -> tuple[Any] | None:
        try:
            heard: tuple[Any] = self._pipe.recv()
        except (EOFError, OSError):
            self.lost = True
            return None
        return heard

    def close(self) -> None:
        """End the process."""
        self._pipe.close()
        self._process.terminate()
        self._process.join(LEAVE_S)


def _help(pipe: Connection) -> None:
    """Do what comes through the pipe, until it is closed; the main of a helper's process."""
    # What breaks here is done again by the other process, breaks there, and is told there.
    with Path(os.devnull).open("w", encoding="utf-8") as nowhere:
        sys.stderr = nowhere
        try:
            pipe.send((None,))
            while True:
                work, on = pipe.recv()
                pipe.send((work(on),))
        except (EOFError, OSError):
            return
