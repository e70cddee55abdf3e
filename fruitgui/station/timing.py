"""How long the stages of a run took."""

from __future__ import annotations

import time
from collections import defaultdict
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np


class Stopwatch:
    """Adds up the time of named stages, and keeps that of each frame.

    Frame times are counted in bins of 0.1 ms, so that a long recording takes no more memory than a short one.
    """

    BIN_S = 1e-4
    BINS = 20_000

    def __init__(self) -> None:
        self._began_s = time.perf_counter()
        self._stages_s: dict[str, float] = defaultdict(float)
        self._frames = np.zeros(self.BINS, dtype=np.int64)

    @contextmanager
    def stage(self, name: str) -> Iterator[None]:
        """Time a stage."""
        began_s = time.perf_counter()
        try:
            yield
        finally:
            self.add(name, time.perf_counter() - began_s)

    def add(self, name: str, duration_s: float) -> None:
        """Add a duration to a stage."""
        self._stages_s[name] += duration_s

    def frame(self, duration_s: float) -> None:
        """Note how long one frame took to perceive and track."""
        self._frames[min(int(duration_s / self.BIN_S), self.BINS - 1)] += 1

    @property
    def frames(self) -> int:
        """Frames noted."""
        return int(self._frames.sum())

    def value(self) -> dict[str, Any]:
        """Return the report's timing: milliseconds, stages as the mean per frame."""
        frames = max(self.frames, 1)
        return {
            "frames": self.frames,
            "wall_s": time.perf_counter() - self._began_s,
            "frame_ms": {"p50": self._percentile_ms(0.50), "p99": self._percentile_ms(0.99)},
            "stages_ms": {name: total_s / frames * 1e3 for name, total_s in self._stages_s.items()},
        }

    def _percentile_ms(self, share: float) -> float:
        if self.frames == 0:
            return 0.0
        at = int(np.searchsorted(np.cumsum(self._frames), share * self.frames))
        return (at + 0.5) * self.BIN_S * 1e3
