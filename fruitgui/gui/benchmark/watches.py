"""What else is watched while the line runs: pictures that reach the screen, and memory."""

from __future__ import annotations

import sys
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PySide6.QtCore import QEvent, QObject

from fruitgui.gui.benchmark.figure import Figure
from fruitgui.gui.widgets.sensor_picture import SensorPicture

EVERY_S = 1.0
MB = 1e6
MOST_MB = 1.0
"""For a thousand fruit more, in the long run: a day of them is then a quarter of a gigabyte at most."""


class PictureCount(QObject):
    """Counts the different pictures of each sensor that were painted."""

    def __init__(self, pictures: dict[str, SensorPicture], parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._names = {picture: sensor for sensor, picture in pictures.items()}
        self._last: dict[str, object] = {}
        self._count: Counter[str] = Counter()
        for picture in pictures.values():
            picture.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        """Note a painting."""
        if event.type() == QEvent.Type.Paint and isinstance(watched, SensorPicture):
            sensor, shown = self._names[watched], watched.shown
            if shown is not self._last.get(sensor):
                self._last[sensor] = shown
                self._count[sensor] += 1
        return False

    def take(self) -> dict[str, int]:
        """Return how many were painted since the last time."""
        taken, self._count = self._count, Counter()
        return dict(taken)


@dataclass(frozen=True, slots=True)
class Held:
    """What the process held at one time: fruit that it had counted, its memory, and Python's blocks of it."""

    time_s: float
    fruit: int
    resident_mb: float
    blocks: int


class Memory:
    """Looks once a second at what the process holds."""

    def __init__(self) -> None:
        self._held: list[Held] = []

    def look(self, fruit: int) -> None:
        """Note what is held, if the last look was long enough ago."""
        now_s = time.monotonic()
        if not self._held or now_s - self._held[-1].time_s >= EVERY_S:
            self._held.append(Held(now_s, fruit, resident_mb(), sys.getallocatedblocks()))

    def figures(self, fruit_per_hour: float) -> Iterator[Figure]:
        """Give how it grew; the first third is left out, in which caches fill.

        Args:
            fruit_per_hour: that the line's belt brings, to say how long all that was counted takes it.
        """
        held = self._held[len(self._held) // 3 :]
        if len(held) < 3 or held[-1].fruit <= held[0].fruit:
            yield Figure("memory", "looked at too few times")
            return
        fruit = np.array([one.fruit for one in held]) - held[0].fruit
        resident_mb, blocks = (np.array([getattr(one, name) for one in held]) for name in ("resident_mb", "blocks"))
        by_mb, by_block = (1000.0 * float(np.polyfit(fruit, y, 1)[0]) for y in (resident_mb, blocks))
        took_min = (held[-1].time_s - held[0].time_s) / 60.0
        more = (
            f"{resident_mb[0]:.0f} MB, {resident_mb[-1]:.0f} MB after {took_min:.1f} minutes and {fruit[-1]} fruit; "
            f"most {resident_mb.max():.0f} MB; {by_block:+.0f} blocks of Python's"
        )
        asked = f"<= {MOST_MB:+.0f} MB"
        yield Figure("memory for 1000 fruit more", f"{by_mb:+.2f} MB", asked, by_mb <= MOST_MB, more)
        counted = self._held[-1].fruit - self._held[0].fruit
        more = f"{counted} fruit; this belt brings {fruit_per_hour:.0f} an hour"
        yield Figure("belt's time that was counted", f"{counted / fruit_per_hour:.2f} hours", "", None, more)


def resident_mb() -> float:
    """Return the memory that this process holds; not a number where the system does not say."""
    status = Path("/proc/self/status")
    if not status.exists():
        return float("nan")
    line = next(line for line in status.read_text(encoding="ascii").splitlines() if line.startswith("VmRSS"))
    return int(line.split()[1]) * 1024 / MB
