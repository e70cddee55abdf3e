"""Frames of several sensors put in order of time, with bounded waiting and bounded memory.

Messages may arrive up to two seconds late. Each sensor's messages wait two
seconds of its own stamps, then become pairs; pairs of all sensors leave in
order of the reference clock. A sensor that falls silent is waited for no
longer than that, and sensors whose clocks differ by more than two seconds
leave as they come, each in its own order.
"""

from __future__ import annotations

import heapq
import itertools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from fruitgui.sensors.recordings.pairing import Pair, Pairing
from fruitgui.sensors.recordings.raw import RawMessage

LATEST_NS = 2_000_000_000
"""Messages later than this are dropped."""

MAX_HELD_BYTES = 1024 * 1024 * 1024
"""When more waits than this, it leaves early."""


@dataclass(slots=True)
class _Arrivals:
    """How far one sensor has come, in its own stamps."""

    offset_ns: int
    began_at_ns: int
    first_ns: int
    newest_ns: int
    second_ns: int
    released_ns: int
    heard_at_ns: int
    pairing: Pairing = field(default_factory=Pairing)
    late: int = 0
    repeated: int = 0

    def note(self, stamp_ns: int) -> None:
        if stamp_ns > self.newest_ns:
            self.newest_ns, self.second_ns = stamp_ns, self.newest_ns
        elif self.second_ns < stamp_ns < self.newest_ns:
            self.second_ns = stamp_ns

    @property
    def now_ns(self) -> int:
        """The newest stamp; one stamp alone that lies far ahead is not believed yet."""
        return self.newest_ns if self.newest_ns - self.second_ns <= LATEST_NS else self.second_ns

    @property
    def elapsed_ns(self) -> int:
        """Time of the recording by this sensor, whatever its clock says."""
        return self.began_at_ns + self.now_ns - self.first_ns


class Merge:
    """Takes messages as they come, gives pairs in order."""

    def __init__(self, offsets_ns: Mapping[str, int]) -> None:
        self._offsets_ns = offsets_ns
        self._sensors: dict[str, _Arrivals] = {}
        self._waiting: list[tuple[int, int, str, Pair]] = []
        self._count = itertools.count()
        self._elapsed_ns = 0
        self._waiting_bytes = 0

    def add(self, sensor: str, stamp_ns: int, message: RawMessage, *, depth: bool) -> Iterator[tuple[str, Pair]]:
        """Take a message; yield the (sensor, pair) that can leave now."""
        arrivals = self._arrivals(sensor, stamp_ns)
        if stamp_ns <= arrivals.released_ns:
            arrivals.late += depth
            return
        if not arrivals.pairing.add(stamp_ns, message, depth=depth):
            arrivals.repeated += depth
        arrivals.note(stamp_ns)
        self._elapsed_ns = max(self._elapsed_ns, arrivals.elapsed_ns)
        arrivals.heard_at_ns = self._elapsed_ns
        self._take(sensor, arrivals.now_ns - LATEST_NS - arrivals.pairing.tolerance_ns)
        self._take_from_silent()
        if self._held_bytes() > MAX_HELD_BYTES:
            yield from self.finish()
        yield from self._leaving(self._limit_ns())

    def finish(self) -> Iterator[tuple[str, Pair]]:
        """Yield everything that waits."""
        for sensor in self._sensors:
            self._take_all(sensor)
        yield from self._leaving(None)

    def dropped(self, sensor: str) -> dict[str, int]:
        """Return how many frames of a sensor were left out, by cause."""
        arrivals = self._sensors.get(sensor)
        if arrivals is None:
            return {}
        return {
            "more than 2 s late": arrivals.late,
            "stamped like another": arrivals.repeated,
            "colour without depth or depth without colour": arrivals.pairing.unmatched,
        }

    def _arrivals(self, sensor: str, stamp_ns: int) -> _Arrivals:
        if sensor not in self._sensors:
            before = stamp_ns - 1
            self._sensors[sensor] = _Arrivals(
                self._offsets_ns.get(sensor, 0), self._elapsed_ns, stamp_ns, before, before,
                stamp_ns - 10**18, self._elapsed_ns,
            )  # fmt: skip
        return self._sensors[sensor]

    def _take(self, sensor: str, limit_ns: int) -> None:
        arrivals = self._sensors[sensor]
        if limit_ns <= arrivals.released_ns:
            return
        arrivals.released_ns = limit_ns
        for pair in arrivals.pairing.take(limit_ns):
            self._waiting_bytes += _size(pair)
            heapq.heappush(self._waiting, (pair.time_ns + arrivals.offset_ns, next(self._count), sensor, pair))

    def _take_all(self, sensor: str) -> None:
        arrivals = self._sensors[sensor]
        self._take(sensor, arrivals.newest_ns + arrivals.pairing.tolerance_ns)

    def _silent(self, arrivals: _Arrivals) -> bool:
        return self._elapsed_ns - arrivals.heard_at_ns > LATEST_NS

    def _take_from_silent(self) -> None:
        for sensor, arrivals in self._sensors.items():
            if arrivals.pairing.held_bytes and self._silent(arrivals):
                self._take_all(sensor)

    def _limit_ns(self) -> int:
        """Return the reference time up to which no sensor will add anything more."""
        limits = [
            arrivals.released_ns + arrivals.offset_ns
            for arrivals in self._sensors.values()
            if not self._silent(arrivals)
        ]
        return max(min(limits), max(limits) - LATEST_NS)

    def _leaving(self, limit_ns: int | None) -> Iterator[tuple[str, Pair]]:
        while self._waiting and (limit_ns is None or self._waiting[0][0] <= limit_ns):
            _, _, sensor, pair = heapq.heappop(self._waiting)
            self._waiting_bytes -= _size(pair)
            yield sensor, pair

    def _held_bytes(self) -> int:
        return self._waiting_bytes + sum(arrivals.pairing.held_bytes for arrivals in self._sensors.values())


def _size(pair: Pair) -> int:
    return len(pair.color.data) + len(pair.depth.data)
