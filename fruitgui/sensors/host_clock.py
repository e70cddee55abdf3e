"""A device's clock brought to the host's."""

from __future__ import annotations

import math
from collections import deque
from itertools import pairwise
from typing import Protocol

_BINS, _BIN_S = 60, 1.0
_FASTEST = 200e-6
"""No quartz is off by more than this part of the time."""
_EARLY_S, _LATE_S = 0.05, 0.5
"""A picture that comes earlier than it was taken, or so much later than usual, says that the device's clock jumped."""
_YOUNG_S = 2.0
"""At the beginning it was the first pictures that came late: a host that opens a device is busy."""

_JUMPED_FRAMES, _INSISTS_S = 3, 0.2
"""So many pictures with strange times are a jump. Those that are only late must have come over so long, too: what
waited for a host that stood still comes all at once."""
_SHORTEST_STEP_S = 1e-4

_SOONER_S, _STEADY_S = 0.005, 0.5
"""A clock is known once, for so long, no picture came sooner than all before by more than this."""
_DOUBTED_S, _TRUSTED_S = 2.0, 10.0
"""It is doubted no longer than this, and not again for so long: some give no better times, ever."""


class DeviceClock(Protocol):
    """Brings a device's times to another clock; see `HostClock`."""

    @property
    def jumps(self) -> int:
        """How often the device's clock leapt."""

    @property
    def sure(self) -> bool:
        """Whether the time that was given last can be believed."""

    def time_s(self, device_s: float, arrived_s: float) -> float:
        """Return when a capture was taken."""


class HostClock:
    """Gives capture times in the host's monotonic clock to times in a device's clock, in their order.

    A picture may come late but never early, so of each second the one that came
    soonest counts, and the line below all of these that lies closest to them
    (as Moon, Skelly and Towsley, INFOCOM 1999, for packets) is the device's
    clock in the host's: what is left over is the least time that a picture
    takes. A clock that jumps is noticed, and its line begun anew. The first
    times on a line may be too late by as much as a busy host was, and are not sure.

    Attributes:
        jumps: how often it did.
    """

    def __init__(self) -> None:
        self._soonest: deque[tuple[float, float]] = deque(maxlen=_BINS)
        self._line = (0.0, 0.0)
        self._odd, self._odd_from_s = 0, 0.0
        self._newest_s = -math.inf
        self._given_s: float | None = None
        self._held_back_s = 0.0
        self._doubt = _Doubt()
        self.jumps = 0

    @property
    def sure(self) -> bool:
        """Whether the time that was given last can be believed to some ms, or is as good as any will be."""
        return self._doubt.over and self._held_back_s <= _SOONER_S

    def hear(self, device_s: float, arrived_s: float) -> None:
        """Take in a picture whose time nobody asks for: colour comes all the time, depth only in its turns."""
        if not self._soonest or self._is_usual(device_s, arrived_s - device_s):
            self._learn(device_s, arrived_s)

    def time_s(self, device_s: float, arrived_s: float) -> float:
        """Return when a picture was taken; always later than the one before.

        Args:
            device_s: when it was taken, by the device's clock. arrived_s: when it came, by the host's.
        """
        late_s = arrived_s - device_s
        if self._soonest and not (device_s > self._newest_s and self._is_usual(device_s, late_s)):
            return self._odd_one(device_s, late_s, arrived_s)
        self._odd, self._newest_s = 0, device_s
        self._learn(device_s, arrived_s)
        return self._later(self._soonest[-1][0], device_s)

    def _learn(self, device_s: float, arrived_s: float) -> None:
        late_s = arrived_s - device_s
        fell = not self._soonest or self._off_s(device_s, late_s)[0] < -_SOONER_S
        self._doubt.hear(device_s, arrived_s, fell=fell)
        self._note(device_s, late_s)

    def _off_s(self, device_s: float, late_s: float) -> tuple[float, float]:
        """Return by how much later than the soonest a picture came, and how unsure that is."""
        offset_s, drift = self._line
        since_s = device_s - self._soonest[-1][0]
        return late_s - offset_s - drift * since_s, 2.0 * _FASTEST * max(since_s, 0.0)

    def _is_usual(self, device_s: float, late_s: float) -> bool:
        off_s, unsure_s = self._off_s(device_s, late_s)
        young = device_s - self._soonest[0][0] < _YOUNG_S
        return -(_YOUNG_S if young else _EARLY_S) - unsure_s <= off_s <= _LATE_S + unsure_s

    def _odd_one(self, device_s: float, late_s: float, arrived_s: float) -> float:
        """Believe for once the device where a picture is only late, and else the host; begin anew where it insists.

        A host that stands still is likelier than a clock that leaps by just what was left out. The time at which it
        awoke would show a fruit a second time, farther on.
        """
        self._odd_from_s = arrived_s if self._odd == 0 else self._odd_from_s
        self._odd += 1
        only_late = device_s > self._newest_s and self._off_s(device_s, late_s)[0] > 0.0
        if only_late and (self._odd < _JUMPED_FRAMES or arrived_s - self._odd_from_s < _INSISTS_S):
            return self._later(self._soonest[-1][0], device_s)
        self._doubt.begin(arrived_s)
        if self._odd < _JUMPED_FRAMES:
            return self._forward(arrived_s)
        self._odd, self._newest_s = 0, device_s
        self.jumps += 1
        self._soonest.clear()
        self._learn(device_s, arrived_s)
        return self._later(device_s, device_s)

    def _note(self, device_s: float, late_s: float) -> None:
        if not self._soonest or _bin(device_s) > _bin(self._soonest[-1][0]):
            self._soonest.append((device_s, late_s))
        elif late_s < self._soonest[-1][1]:
            self._soonest[-1] = (device_s, late_s)
        else:
            return
        self._line = _line_below(list(self._soonest))

    def _later(self, origin_s: float, device_s: float) -> float:
        offset_s, drift = self._line
        return self._forward(device_s + offset_s + drift * (device_s - origin_s))

    def _forward(self, time_s: float) -> float:
        given_s = time_s if self._given_s is None else max(time_s, self._given_s + _SHORTEST_STEP_S)
        self._given_s, self._held_back_s = given_s, given_s - time_s
        return given_s


class _Doubt:
    """Whether a clock's line is known yet.

    What comes sooner than all before shows that those came late. That nothing did for a while, by both clocks, shows
    that they did not: what waited for the host comes all at once.

    Attributes:
        over: whether it is known, or has been doubted for long enough.
    """

    def __init__(self) -> None:
        self._began_s: float | None = None
        self._steady_from_s = (math.inf, math.inf)
        self.over = False

    def begin(self, arrived_s: float) -> None:
        """Begin to doubt, unless that was done lately."""
        if self._began_s is None or arrived_s - self._began_s >= _TRUSTED_S:
            self._began_s, self.over = arrived_s, False

    def hear(self, device_s: float, arrived_s: float, *, fell: bool) -> None:
        """Take in a picture; `fell` tells whether it came sooner than all before."""
        began_s = self._began_s = arrived_s if self._began_s is None else self._began_s
        if fell:
            self._steady_from_s = (device_s, arrived_s)
        device_from_s, from_s = self._steady_from_s
        steady = min(device_s - device_from_s, arrived_s - from_s) >= _STEADY_S
        self.over = self.over or steady or arrived_s - began_s >= _DOUBTED_S


def _bin(device_s: float) -> int:
    return int(device_s // _BIN_S)


def _line_below(points: list[tuple[float, float]]) -> tuple[float, float]:
    """Return (value at the last point, slope) of the line below all points that lies closest to them.

    It goes along the edge of the lower convex hull that passes the middle of the points; its slope is bounded.
    """
    hull: list[tuple[float, float]] = []
    for x, y in sorted(points):
        while len(hull) > 1 and _turns_down(hull[-2], hull[-1], (x, y)):
            hull.pop()
        hull.append((x, y))
    last = points[-1][0]
    middle = sum(x for x, _ in points) / len(points)
    slope = 0.0
    for (x0, y0), (x1, y1) in pairwise(hull):
        if x0 <= middle <= x1 and x1 > x0:
            slope = min(max((y1 - y0) / (x1 - x0), -_FASTEST), _FASTEST)
            break
    offset = min(y - slope * (x - last) for x, y in points)
    return offset, slope


def _turns_down(a: tuple[float, float], b: tuple[float, float], c: tuple[float, float]) -> bool:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) <= 0.0
