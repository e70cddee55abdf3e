"""The end of the line: finished fruit are kept for good, and only then counted."""

from __future__ import annotations

import queue
from collections.abc import Callable, Sequence
from functools import partial
from typing import Protocol, TypeVar

from fruitgui.station.live.state import Finished, LiveWarning
from fruitgui.station.live.warnings import Warnings
from fruitgui.station.sink import CountedFruit
from fruitgui.station.waiting import BufferedSink, SinkState

T = TypeVar("T")
R = TypeVar("R")

RETRY_S = 2.0
LAST_FRUIT = 12
UNKEPT = 256
"""Fruit that wait to be kept and are shown with their pictures once they are; beyond that only their number is."""

Teacher = Callable[[Finished], None]
"""Told of every fruit that left, counted or not; quick, and never raises."""


class Counts(Protocol):
    """Takes finished fruit, in order, on one thread; what it says may be read from any."""

    def count(self, finished: Finished, lot: int | None) -> None:
        """Count a fruit into a lot; None lets it pass uncounted."""

    def retry(self) -> bool:
        """Try again to keep some of what waits; return whether more of it can be tried at once."""

    @property
    def counted(self) -> int:
        """Fruit that were kept since the start, whatever the lot."""

    @property
    def passed(self) -> int:
        """Fruit since the start that were let pass uncounted."""

    @property
    def last(self) -> tuple[tuple[CountedFruit, Finished], ...]:
        """The last fruit counted, the newest first."""

    @property
    def sink_state(self) -> SinkState:
        """How the store fares."""

    @property
    def warnings(self) -> tuple[LiveWarning, ...]:
        """What went wrong with keeping them."""


class Counting:
    """Counts fruit, one after the other.

    Args:
        sink: keeps fruit.
        teacher: told of every fruit.

    Attributes:
        counted, passed: see `Counts`.
    """

    def __init__(self, sink: BufferedSink, teacher: Teacher | None = None) -> None:
        self._sink = sink
        self._teacher = teacher
        self._warnings = Warnings()
        self._unkept: dict[int, Finished] = {}
        self._last: tuple[tuple[CountedFruit, Finished], ...] = ()  # replaced as one: others read it meanwhile
        self.counted = self.passed = self._lost = 0

    @property
    def last(self) -> tuple[tuple[CountedFruit, Finished], ...]:
        """The last fruit counted, the newest first."""
        return self._last

    @property
    def sink_state(self) -> SinkState:
        """How the store fares."""
        return self._sink.state

    @property
    def warnings(self) -> tuple[LiveWarning, ...]:
        """What went wrong with keeping them."""
        return self._warnings.all()

    def count(self, finished: Finished, lot: int | None) -> None:
        """Count a fruit into a lot; None lets it pass uncounted."""
        if self._teacher is not None:
            self._teacher(finished)
        if lot is None:
            self.passed += 1
            return
        self._unkept[finished.fruit.fruit] = finished
        while len(self._unkept) > UNKEPT:
            del self._unkept[next(iter(self._unkept))]
        self._add(self._sink.take(lot, finished.fruit, finished.crops))

    def retry(self) -> bool:
        """Try again to keep some of what waits; return whether more of it can be tried at once."""
        if not self._sink.state.waiting:
            return False
        counted = self._sink.retry()
        self._add(counted)
        return bool(counted) and self._sink.state.waiting > 0

    def _add(self, counted: Sequence[CountedFruit]) -> None:
        """Count what is durable now."""
        for one in counted:
            finished = self._unkept.pop(one.fruit.fruit, None)
            if finished is not None:
                self._last = ((one, finished), *self._last)[:LAST_FRUIT]
            self.counted += 1
        sink = self._sink.state
        if sink.problem is not None:
            self._warnings.add("not_kept", f"{sink.problem.what} {sink.problem.remedy}", ())
        for _ in range(sink.lost - self._lost):
            self._warnings.add("fruit_not_counted", "A fruit could not be counted: no room to wait, or no lot.", ())
        self._lost = sink.lost


def count_all(
    take: Callable[[float], T | None],
    count: Callable[[T], None],
    retry: Callable[[], bool],
    warn: Callable[[str, str, tuple[str, ...]], None],
) -> None:
    """Count one thing after the other, and try again to keep what waits whenever nothing comes; at the end, all of it.

    What cannot be counted is said, and ends nothing.

    Args:
        take: returns the next thing within a time, None behind the last; raises `queue.Empty` where none comes.
        count: counts it.
        retry: keeps what waits.
        warn: told what went wrong: code, text, sensors.
    """

    def attempt(do: Callable[[], R]) -> R | None:
        try:
            return do()
        except Exception as error:  # noqa: BLE001 - one fruit must not end the line; it is said
            warn("fruit_not_counted", f"A fruit was followed but could not be counted: {error}", ())
            return None

    while True:
        try:
            one = take(RETRY_S)
        except queue.Empty:
            attempt(retry)
            continue
        if one is None:
            break
        attempt(partial(count, one))
    while attempt(retry):
        pass
