"""How a frame was lit by its sensor's projector."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Lit:
    """How a frame was lit.

    Attributes:
        since_s: its own projector had been on.
        frames: read since then, before this one.
        others: that take turns, and may shine as well as it comes.
        settled: its depth is of use.
        rehearsed: it was captured while the projectors were tried, and is none of those that are measured.
    """

    since_s: float
    frames: int
    others: tuple[str, ...]
    settled: bool
    rehearsed: bool


ALWAYS = Lit(0.0, 0, (), settled=True, rehearsed=False)
"""How frames of a sensor are lit that takes no turns."""
