"""Which picture of colour belongs to which of depth: the one taken closest to it, by the device's own clock."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

from fruitgui.frame import U8, U16
from fruitgui.sensors.kinect.clock import FRAME_TICKS

SAME_MOMENT_TICKS = FRAME_TICKS // 8
"""Pictures of one moment differ by some 2 ms; less than this apart, no other can be closer."""

_HELD = 3


@dataclass(frozen=True, slots=True, eq=False)
class DepthPicture:
    """One picture of depth.

    Attributes:
        ticks: of the device, counted on. arrived_s: by the host's monotonic clock.
        raw: (height, width) as the device gives it.
        whole: nothing of it was lost.
    """

    ticks: int
    arrived_s: float
    raw: U16
    whole: bool


@dataclass(frozen=True, slots=True, eq=False)
class ColorPicture:
    """One picture of colour, (height, width, 3) RGB."""

    ticks: int
    color: U8
    whole: bool


@dataclass(frozen=True, slots=True, eq=False)
class Pair:
    """A picture of depth with the colour that belongs to it."""

    depth: DepthPicture
    color: ColorPicture

    @property
    def whole(self) -> bool:
        """Whether nothing of either was lost."""
        return self.depth.whole and self.color.whole


class Pairing:
    """Pairs the pictures of one device, in the order of depth. A picture without a partner is let go of.

    Attributes:
        alone: pictures of depth that found no colour.
    """

    def __init__(self) -> None:
        self.alone = 0
        self._depth: deque[DepthPicture] = deque(maxlen=_HELD)
        self._color: deque[ColorPicture] = deque(maxlen=_HELD)

    def clear(self) -> None:
        """Let go of everything."""
        self._depth.clear()
        self._color.clear()

    def add_depth(self, picture: DepthPicture) -> list[Pair]:
        """Take in a picture of depth; return the pairs that are certain now."""
        self.alone += len(self._depth) == _HELD
        self._depth.append(picture)
        return self._certain()

    def add_color(self, picture: ColorPicture) -> list[Pair]:
        """Take in a picture of colour; return the pairs that are certain now."""
        self._color.append(picture)
        return self._certain()

    def _certain(self) -> list[Pair]:
        pairs: list[Pair] = []
        while self._depth and self._color:
            depth = self._depth[0]
            nearest = min(self._color, key=lambda color: abs(color.ticks - depth.ticks))
            apart = abs(nearest.ticks - depth.ticks)
            if apart > SAME_MOMENT_TICKS and self._color[-1].ticks <= depth.ticks:
                break
            self._depth.popleft()
            if 2 * apart <= FRAME_TICKS:
                pairs.append(Pair(depth, nearest))
            else:
                self.alone += 1
        return pairs
