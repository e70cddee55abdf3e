"""The process that a line runs in, and the next one where it ended unasked."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator
from typing import Any

from fruitgui.sensors.feed import Arrival, SensorHealth
from fruitgui.station.live.apart.messages import Start
from fruitgui.station.live.apart.process import LineProcess, Places

MOST_BEGUN_AGAIN = 3
"""A line whose process ended so often is not begun again: something is wrong that goes on."""


class Processes:
    """Begins a process, and another where it died or hung; what is said goes to the one that is there.

    Args:
        pixels: of the largest picture.
        start: returns what a process is to begin with, whose frames lie in these places.
    """

    def __init__(self, pixels: int, start: Callable[[Places], Start]) -> None:
        self._pixels = pixels
        self._start = start
        self._between: Places | None = None
        self._process: LineProcess | None = None

    def begin(self) -> None:
        """Begin the first. Raises `OSError` where there is no process or no memory to be had."""
        self._between = Places(self._pixels)
        self._begin(self._between)

    def heard(self, wanted: Callable[[], bool], said: Callable[[str], None]) -> Iterator[Any]:
        """Give what the line says, from process to process, until one ended and no other goes on.

        Args:
            wanted: whether another is to go on where one ended.
            said: told in words that another goes on, and why.
        """
        process, left = self._process, MOST_BEGUN_AGAIN
        while process is not None:
            yield from process.heard()
            process.close()
            process = self._next(process, said) if left and wanted() else None
            left -= 1

    def give(self, arrival: Arrival, lot: int | None) -> bool:
        """Hand a frame over, see `LineProcess.give`."""
        return self._process is not None and self._process.give(arrival, lot)

    def tell(self, healths: tuple[SensorHealth, ...]) -> None:
        """Say how the sensors are."""
        if self._process is not None:
            self._process.tell(healths)

    def no_more(self) -> None:
        """Say that no frame will come."""
        if self._process is not None:
            self._process.no_more()

    def stop(self, until_s: float, lot: int | None) -> None:
        """Say that the line is to end."""
        if self._process is not None:
            self._process.stop(until_s, lot)

    def close(self) -> None:
        """End the process, whatever it does. Any number of times."""
        if self._process is not None:
            self._process.close()

    def give_back(self) -> None:
        """Give the memory back that was shared. Any number of times."""
        if self._between is not None:
            self._between.give_back()

    @property
    def pid(self) -> int | None:
        """Of the process; None before the first."""
        return None if self._process is None else self._process.pid

    def _begin(self, between: Places) -> LineProcess:
        process = LineProcess(between)
        process.begin(self._start(between))
        self._process = process
        return process

    def _next(self, before: LineProcess, said: Callable[[str], None]) -> LineProcess | None:
        """Begin another; None where there is none to be had."""
        after = None
        with contextlib.suppress(OSError):
            assert self._between is not None  # noqa: S101 - made before the first process
            after = self._begin(self._between)
            why = "did not answer and was ended" if before.hung else "ended"
            said(f"The line's process {why}; another one goes on. Fruit that were in view then may be missing.")
        return after
