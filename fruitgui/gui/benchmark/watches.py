"""What else is watched while the line runs: pictures that reach the screen, and memory."""

from __future__ import annotations

import contextlib
import os
import sys
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QEvent, QObject

from fruitgui.frame import F64
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
    """What was held at one time.

    Attributes:
        time_s: when. fruit: that were counted.
        resident_mb: memory of the window's process. blocks: Python's of it.
        beside_mb: memory of the line's process and its helpers.
    """

    time_s: float
    fruit: int
    resident_mb: float
    blocks: int
    beside_mb: float


class Memory:
    """Looks once a second at what the window's process holds, and those beside it."""

    def __init__(self) -> None:
        self._held: list[Held] = []

    def look(self, fruit: int) -> None:
        """Note what is held, if the last look was long enough ago."""
        now_s = time.monotonic()
        if not self._held or now_s - self._held[-1].time_s >= EVERY_S:
            self._held.append(_held(now_s, fruit))

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
        took_min = (held[-1].time_s - held[0].time_s) / 60.0
        blocks = 1000.0 * float(np.polyfit(fruit, [one.blocks for one in held], 1)[0])
        took = f"after {took_min:.1f} minutes and {fruit[-1]} fruit; {blocks:+.0f} blocks of Python's"
        yield _growth("memory for 1000 fruit more", fruit, np.array([one.resident_mb for one in held]), took)
        beside = np.array([one.beside_mb for one in held])
        yield _growth("the same, line and helpers", fruit, beside, f"of {len(beside_pids())} processes")
        counted = self._held[-1].fruit - self._held[0].fruit
        more = f"{counted} fruit; this belt brings {fruit_per_hour:.0f} an hour"
        yield Figure("belt's time that was counted", f"{counted / fruit_per_hour:.2f} hours", "", None, more)


def _held(now_s: float, fruit: int) -> Held:
    beside_mb = sum(resident_mb(pid) for pid in beside_pids())
    return Held(now_s, fruit, resident_mb(os.getpid()), sys.getallocatedblocks(), beside_mb)


def _growth(name: str, fruit: NDArray[Any], memory_mb: F64, more: str) -> Figure:
    """Return by how much memory grows for a thousand fruit, by a line through all looks."""
    by_mb = 1000.0 * float(np.polyfit(fruit, memory_mb, 1)[0])
    told = f"{memory_mb[0]:.0f} MB, {memory_mb[-1]:.0f} MB, most {memory_mb.max():.0f} MB {more}"
    return Figure(name, f"{by_mb:+.2f} MB", f"<= {MOST_MB:+.0f} MB", by_mb <= MOST_MB, told)


def resident_mb(pid: int) -> float:
    """Return the memory that a process holds, 0 where it has ended; not a number where the system does not say."""
    if not Path("/proc/self/status").exists():
        return float("nan")
    try:
        lines = Path(f"/proc/{pid}/status").read_text(encoding="ascii").splitlines()
    except OSError:
        return 0.0
    return sum(int(line.split()[1]) * 1024 / MB for line in lines if line.startswith("VmRSS"))


def beside_pids() -> list[int]:
    """Return all processes that this one started, and those that they started."""
    found, asked = [], [os.getpid()]
    while asked:
        for children in Path(f"/proc/{asked.pop()}/task").glob("*/children"):
            with contextlib.suppress(OSError):
                asked += (pids := [int(pid) for pid in children.read_text(encoding="ascii").split()])
                found += pids
    return found
