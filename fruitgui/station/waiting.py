"""Counting goes on when the store cannot take fruit: they wait in memory, in order, until it can."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from fruitgui.errors import FruitguiError, InputError, WorldError
from fruitgui.station.fruit import Fruit
from fruitgui.station.sink import CountedFruit, Crop, FruitSink

MOST_WAITING = 50_000
"""Fruit that wait at most, some 10 kB each: half an hour of a line at its fastest, or a night of a slow one."""

MOST_WITH_CROPS = 2_000
"""Fruit that wait with their crops at most; pictures weigh more than all else that is known of a fruit."""

MOST_AT_ONCE = 100
"""Waiting fruit that one call keeps at most, so that a line that was held up gets on with its frames."""

RETRY_S = 2.0
"""How long a store that failed is left alone; asking a full disk at each fruit would only slow the line."""


@dataclass(frozen=True, slots=True)
class SinkState:
    """How a sink fares.

    Attributes:
        waiting: fruit that are not durable yet, and are not shown as counted.
        without_crops: fruit whose crops could not be kept, since the start.
        lost: fruit that found no room in memory either, or whose lot is none, since the start.
        problem: why fruit wait, or crops are missing; None while all is well.
    """

    waiting: int = 0
    without_crops: int = 0
    lost: int = 0
    problem: FruitguiError | None = None

    @property
    def unkept(self) -> int:
        """Fruit that wait because the disk takes nothing; the program's end loses them."""
        return 0 if self.problem is None else self.waiting


@dataclass(frozen=True, slots=True, eq=False)
class _Waiting:
    lot: int
    fruit: Fruit
    crops: tuple[Crop, ...]


class BufferedSink:
    """Keeps fruit in another sink; what that cannot take waits, and is kept in order when it can.

    Any thread may call; one at a time gets through.

    Args:
        sink: keeps fruit.
        most: fruit that wait at most.
        most_with_crops: of these, so many with their crops.
        clock_s: tells when to try again.
    """

    def __init__(
        self,
        sink: FruitSink,
        most: int = MOST_WAITING,
        most_with_crops: int = MOST_WITH_CROPS,
        clock_s: Callable[[], float] = time.monotonic,
    ) -> None:
        self._sink = sink
        self._most = most
        self._most_with_crops = most_with_crops
        self._clock_s = clock_s
        self._lock = threading.Lock()
        self._queue: deque[_Waiting] = deque()
        self._retry_at_s = -float("inf")
        self._problem: FruitguiError | None = None
        self._without_crops = 0
        self._lost = 0

    @property
    def state(self) -> SinkState:
        """How it fares; newest word, never waits for the disk."""
        return SinkState(len(self._queue), self._without_crops, self._lost, self._problem)

    def take(self, lot: int, fruit: Fruit, crops: Sequence[Crop]) -> tuple[CountedFruit, ...]:
        """Take a fruit; return those that became durable by this call, in order: this one, earlier ones, or none."""
        with self._lock:
            self._append(_Waiting(lot, fruit, tuple(crops)))
            return self._drain() if self._clock_s() >= self._retry_at_s else ()

    def retry(self) -> tuple[CountedFruit, ...]:
        """Try to keep what waits, now; return what became durable. A timer or a person asks for it."""
        with self._lock:
            return self._drain()

    def _append(self, one: _Waiting) -> None:
        if len(self._queue) >= self._most:
            self._lost += 1
            return
        if len(self._queue) >= self._most_with_crops and one.crops:
            self._without_crops += 1
            one = _Waiting(one.lot, one.fruit, ())
        self._queue.append(one)

    def _drain(self) -> tuple[CountedFruit, ...]:
        counted: list[CountedFruit] = []
        self._problem = None
        while self._queue and len(counted) < MOST_AT_ONCE:
            try:
                counted.append(self._keep(self._queue[0]))
            except WorldError as error:
                self._problem = error
                self._retry_at_s = self._clock_s() + RETRY_S
                break
            except InputError as error:  # it can never be kept, and those behind it can
                self._problem = error
                self._lost += 1
            self._queue.popleft()
        return tuple(counted)

    def _keep(self, one: _Waiting) -> CountedFruit:
        kept = self._sink.commit(one.lot, one.fruit, one.crops)
        if kept.crops_problem is not None:
            self._problem = kept.crops_problem
            self._without_crops += 1
        return kept
