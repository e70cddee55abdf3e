"""What else is watched while the line runs: pictures that reach the screen, and memory."""

from __future__ import annotations

import sys
import time
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PySide6.QtCore import QEvent, QObject

from fruitgui.gui.widgets.sensor_picture import SensorPicture

EVERY_S = 1.0
MB = 1e6


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

    def words(self) -> str:
        """Return how it grew, as one line; the first third is left out, in which caches fill."""
        held = self._held[len(self._held) // 3 :]
        if len(held) < 3:
            return "looked at too few times"
        time_s = np.array([one.time_s for one in held])
        resident_mb, blocks = (np.array([getattr(one, name) for one in held]) for name in ("resident_mb", "blocks"))
        by_second, by_block = (float(np.polyfit(time_s - time_s[0], y, 1)[0]) for y in (resident_mb, blocks))
        fruit, took_s = held[-1].fruit - held[0].fruit, float(time_s[-1] - time_s[0])
        return (
            f"{resident_mb[0]:.0f} MB, {resident_mb[-1]:.0f} MB after {took_s / 60:.1f} minutes and {fruit} fruit; "
            f"{by_second * 3600:+.0f} MB an hour at this pace, {by_block * 3600:+.0f} blocks an hour"
        )


def resident_mb() -> float:
    """Return the memory that this process holds; not a number where the system does not say."""
    status = Path("/proc/self/status")
    if not status.exists():
        return float("nan")
    line = next(line for line in status.read_text(encoding="ascii").splitlines() if line.startswith("VmRSS"))
    return int(line.split()[1]) * 1024 / MB
