"""Colour and depth of one sensor brought together by their stamps."""

from __future__ import annotations

import bisect
import statistics
from collections import deque
from dataclasses import dataclass, field

from fruitgui.sensors.recordings.raw import RawMessage

_USUAL_PERIOD_NS = 33_333_333
_LONGEST_TOLERANCE_NS = 1_000_000_000
_ROUNDING_NS = 500_000
"""Stamps that went through single precision or whole milliseconds may be this far off."""
_SAME_RATE = 0.75


@dataclass(frozen=True, slots=True)
class Pair:
    """A frame not yet decoded; `time_ns` is the stamp of the depth."""

    time_ns: int
    color: RawMessage
    depth: RawMessage


@dataclass(slots=True)
class _Stream:
    """Messages of one topic that wait, by stamp, and the stream's period."""

    stamps: list[int] = field(default_factory=list)
    messages: dict[int, RawMessage] = field(default_factory=dict)
    gaps: deque[int] = field(default_factory=lambda: deque(maxlen=64))
    newest: int | None = None

    def add(self, stamp: int, message: RawMessage) -> bool:
        """Keep the message; false if one with the same stamp is kept already."""
        if stamp in self.messages:
            return False
        if self.newest is not None and stamp > self.newest:
            self.gaps.append(stamp - self.newest)
        self.newest = stamp if self.newest is None else max(stamp, self.newest)
        bisect.insort(self.stamps, stamp)
        self.messages[stamp] = message
        return True

    def remove(self, stamp: int) -> RawMessage:
        self.stamps.pop(bisect.bisect_left(self.stamps, stamp))
        return self.messages.pop(stamp)

    def nearest(self, stamp: int) -> int | None:
        place = bisect.bisect_left(self.stamps, stamp)
        around = self.stamps[max(place - 1, 0) : place + 1]
        return min(around, key=lambda other: abs(other - stamp), default=None)

    @property
    def period_ns(self) -> int:
        """Median distance of stamps: gaps where a sensor was silent or skipped do not count much."""
        return int(statistics.median(self.gaps)) if self.gaps else 0


class Pairing:
    """Waiting colour and depth of one sensor.

    Colour and depth with the same stamp belong together; else the nearest, if
    each is the other's nearest and they are no more than half a frame apart.
    """

    def __init__(self) -> None:
        self._color = _Stream()
        self._depth = _Stream()
        self.unmatched = 0
        self.held_bytes = 0

    def add(self, stamp_ns: int, message: RawMessage, *, depth: bool) -> bool:
        """Keep a message; false if it repeats one that is kept."""
        added = (self._depth if depth else self._color).add(stamp_ns, message)
        if added:
            self.held_bytes += len(message.data)
        return added

    @property
    def tolerance_ns(self) -> int:
        """Half a frame period, of the faster of the two streams."""
        periods = [stream.period_ns for stream in (self._color, self._depth) if stream.period_ns]
        return min((min(periods) if periods else _USUAL_PERIOD_NS) // 2 + _ROUNDING_NS, _LONGEST_TOLERANCE_NS)

    def take(self, limit_ns: int) -> list[Pair]:
        """Return the pairs whose depth is stamped up to `limit_ns`, in order; what stays alone is counted."""
        pairs = []
        tolerance = self.tolerance_ns
        while self._depth.stamps and self._depth.stamps[0] <= limit_ns:
            stamp = self._depth.stamps[0]
            match = self._match(stamp, tolerance)
            depth = self._removed(self._depth, stamp)
            if match is None:
                self.unmatched += self._depth_counts()
            else:
                pairs.append(Pair(stamp, self._removed(self._color, match), depth))
        self._forget_color(limit_ns - tolerance)
        return pairs

    def _match(self, stamp: int, tolerance: int) -> int | None:
        color = self._color.nearest(stamp)
        if color is None or abs(color - stamp) > tolerance or self._depth.nearest(color) != stamp:
            return None
        return color

    def _forget_color(self, limit_ns: int) -> None:
        while self._color.stamps and self._color.stamps[0] <= limit_ns:
            self._removed(self._color, self._color.stamps[0])
            self.unmatched += self._color_counts()

    def _removed(self, stream: _Stream, stamp: int) -> RawMessage:
        message = stream.remove(stamp)
        self.held_bytes -= len(message.data)
        return message

    def _color_counts(self) -> bool:
        """Colour alone is a lost frame unless the camera simply makes more pictures than depth."""
        return self._color.period_ns > _SAME_RATE * self._depth.period_ns

    def _depth_counts(self) -> bool:
        return self._depth.period_ns > _SAME_RATE * self._color.period_ns or not self._color.period_ns
