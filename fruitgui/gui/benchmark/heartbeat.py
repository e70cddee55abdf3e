"""How long the window's thread does not listen: the lateness of a timer that should come every few milliseconds."""

from __future__ import annotations

import sys
import threading
import time
import traceback
from collections import Counter
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QObject, Qt, QTimer

from fruitgui.frame import F64
from fruitgui.gui.benchmark.figure import Figure

BEAT_MS = 5
LONG_MS = 50.0


@dataclass(frozen=True, slots=True, eq=False)
class Blocks:
    """How late each beat was.

    Attributes:
        late_ms: (N,) beyond the beat itself, in order.
        work_ms: (N,) what the thread itself worked since the beat before; the rest of a block it waited for a core or
            for Python, which other threads or programs had.
    """

    late_ms: F64
    work_ms: F64

    @property
    def longest_ms(self) -> float:
        """The longest that a key or a touch had to wait."""
        return float(self.late_ms.max(initial=0.0))

    @property
    def most_work_ms(self) -> float:
        """The most that the thread worked at one go; on a machine with a free core, no block is much longer."""
        return float(self.work_ms.max(initial=0.0))

    @property
    def over(self) -> int:
        """How many a person may feel."""
        return int((self.late_ms > LONG_MS).sum())

    def quantile_ms(self, share: float) -> float:
        """Return the lateness that a share of the beats stays below."""
        return float(np.quantile(self.late_ms, share)) if len(self.late_ms) else 0.0

    def figure(self, when: str) -> Figure:
        """Return them as a figure: the longest block, and what goes with it."""
        more = (
            f"own work {self.most_work_ms:.0f} ms; 99.9 % {self.quantile_ms(0.999):.0f} ms, "
            f"99 % {self.quantile_ms(0.99):.0f} ms; over {LONG_MS:.0f} ms: {self.over} of {len(self.late_ms)}"
        )
        met = self.longest_ms <= LONG_MS
        return Figure(f"longest block, {when}", f"{self.longest_ms:.0f} ms", f"<= {LONG_MS:.0f} ms", met, more)


class Heartbeat(QObject):
    """Beats on the thread that it lives on."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._late_ms: list[float] = []
        self._work_ms: list[float] = []
        self.last_s = time.perf_counter()
        self._worked_s = 0.0
        self._timer = QTimer(self, interval=BEAT_MS, timerType=Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self._beat)

    def start(self) -> None:
        """Begin to beat."""
        self.last_s, self._worked_s = time.perf_counter(), time.thread_time()
        self._timer.start()

    def stop(self) -> None:
        """Beat no more."""
        self._timer.stop()

    def take(self) -> Blocks:
        """Return what was noted since the last time."""
        late_ms, self._late_ms = self._late_ms, []
        work_ms, self._work_ms = self._work_ms, []
        return Blocks(np.array(late_ms), np.array(work_ms))

    def _beat(self) -> None:
        now_s, worked_s = time.perf_counter(), time.thread_time()
        self._late_ms.append((now_s - self.last_s) * 1e3 - BEAT_MS)
        self._work_ms.append((worked_s - self._worked_s) * 1e3)
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
