"""Pictures that the line has drawn, with their colours, which never left this process."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
from dataclasses import replace

from fruitgui.frame import U8, Frame
from fruitgui.station.live.state import Preview

KEPT = 32
"""Colours that wait for the line to say what is in them; some twenty pictures are on their way at most."""


class Gallery:
    """Keeps what is given to the line, and hangs what it says of it. One thread keeps, another hangs."""

    def __init__(self) -> None:
        self._colors: deque[tuple[str, float, U8]] = deque(maxlen=KEPT)
        self._previews: dict[str, Preview] = {}

    @property
    def previews(self) -> dict[str, Preview]:
        """The newest picture of each sensor, by its id in the feed."""
        return dict(self._previews)

    def keep(self, frame: Frame) -> None:
        """Keep a frame's colours for a while."""
        self._colors.append((frame.sensor, frame.time_s, frame.color))

    def show(self, previews: Iterable[Preview]) -> None:
        """Show pictures that came without their colours; one whose colours are gone is left out."""
        for one in previews:
            for sensor, time_s, color in reversed(self._colors.copy()):
                if sensor == one.sensor and time_s == one.time_s:
                    self._previews[sensor] = replace(one, color=color)
                    break
