"""How long the window's thread does not listen: the lateness of a timer that should come every few milliseconds."""

from __future__ import annotations

import sys
import threading
import time
import traceback
from collections import Counter
from dataclasses import dataclass, field
from math import floor

from PySide6.QtCore import QObject, Qt, QTimer

from fruitgui.gui.benchmark.figure import Figure

BEAT_MS = 5
LONG_MS = 50.0
STEP_MS = 0.25
"""How exactly it is kept how late a beat was."""


@dataclass(slots=True)
class Blocks:
    """How late beats were; they are counted as they come, so that an hour of them needs no more room than a minute.

    Attributes:
        beats: how many there were. over: those of which a person may feel how late they were.
        longest_ms: the longest that a key or a touch had to wait.
        most_work_ms: the most that the thread itself worked from one beat to the next; the rest of a block it waited
            for a core or for Python, which other threads or programs had. On a machine with a free core, no block is
            much longer.
    """

    beats: int = 0
    over: int = 0
    longest_ms: float = 0.0
    most_work_ms: float = 0.0
    _steps: Counter[int] = field(default_factory=Counter)

    def add(self, late_ms: float, work_ms: float) -> None:
        """Count a beat that came so late, after so much work of the thread since the beat before."""
        self.beats += 1
        self.over += late_ms > LONG_MS
        self.longest_ms, self.most_work_ms = max(self.longest_ms, late_ms), max(self.most_work_ms, work_ms)
        self._steps[floor(late_ms / STEP_MS)] += 1

    def quantile_ms(self, share: float) -> float:
        """Return the lateness that a share of the beats stays below, to the step."""
        left = share * self.beats
        for step in sorted(self._steps):
            left -= self._steps[step]
            if left <= 0.0:
                return min((step + 1) * STEP_MS, self.longest_ms)
        return 0.0

    def figure(self, when: str) -> Figure:
        """Return them as a figure: the longest block, and what goes with it."""
        more = (
            f"own work {self.most_work_ms:.0f} ms; 99.9 % {self.quantile_ms(0.999):.0f} ms, "
            f"99 % {self.quantile_ms(0.99):.0f} ms; over {LONG_MS:.0f} ms: {self.over} of {self.beats}"
        )
        met = self.longest_ms <= LONG_MS
        return Figure(f"longest block, {when}", f"{self.longest_ms:.0f} ms", f"<= {LONG_MS:.0f} ms", met, more)


class Heartbeat(QObject):
    """Beats on the thread that it lives on."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._blocks = Blocks()
        self.last_s = time.perf_counter()
        self._worked_s = 0.0
        self._timer = QTimer(self, interval=BEAT_MS, timerType=Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self._beat)

    def start(self) -> None:
        """Begin to beat, or begin anew: what was done since the last beat is nobody's."""
        self.last_s, self._worked_s = time.perf_counter(), time.thread_time()
        self._timer.start()

    def stop(self) -> None:
        """Beat no more."""
        self._timer.stop()

    def take(self) -> Blocks:
        """Return what was noted since the last time."""
        taken, self._blocks = self._blocks, Blocks()
        return taken

    def _beat(self) -> None:
        now_s, worked_s = time.perf_counter(), time.thread_time()
        self._blocks.add((now_s - self.last_s) * 1e3 - BEAT_MS, (worked_s - self._worked_s) * 1e3)
        self.last_s, self._worked_s = now_s, worked_s


class Blame:
    """Looks where the window's thread is whenever its heart is late; costs a little itself.

    Args:
        heart: to watch.
        late_ms: from here on it looks.
    """

    def __init__(self, heart: Heartbeat, late_ms: float) -> None:
        self._heart = heart
        self._late_s = late_ms / 1e3
        self._main = threading.get_ident()
        self._stop = threading.Event()
        self._seen: Counter[str] = Counter()
        self._thread = threading.Thread(target=self._watch, name="blame", daemon=True)

    def start(self) -> None:
        """Begin to watch the thread that calls this."""
        self._thread.start()

    def stop(self) -> str:
        """Return the places where it was found, the most frequent first."""
        self._stop.set()
        self._thread.join()
        return "\n".join(f"{count} times late here:\n{where}" for where, count in self._seen.most_common())

    def _watch(self) -> None:
        told_s = 0.0
        while not self._stop.wait(BEAT_MS / 1e3):
            last_s = self._heart.last_s
            if last_s == told_s or time.perf_counter() - last_s < self._late_s:
                continue
            told_s = last_s
            frame = sys._current_frames().get(self._main)  # the one way to see another thread's place
            self._seen["".join(traceback.format_stack(frame)[-6:])] += 1
