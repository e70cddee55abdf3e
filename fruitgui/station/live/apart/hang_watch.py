"""Whether a line hangs, judged by what comes of it while it is listened to.

Time is counted in looks, not by a clock: where a machine slept, or is so busy that nobody gets to look, no line hangs.
"""

from __future__ import annotations

from dataclasses import dataclass

LOOK_S = 0.25
"""Between two looks."""

MOST_SILENT = 20
"""Looks, five seconds: a line says ten times a second how it is, whatever it works at."""

MOST_UNTAKEN = 80
"""Looks, twenty seconds: a line takes no frame up while all helpers measure long tracks, or clocks are judged."""

MOST_LOADING = 240
"""Looks, a minute, until a line says for the first time how it is: it loads, and starts its helpers."""


@dataclass(frozen=True, slots=True)
class Signs:
    """What came of a line until now.

    Attributes:
        answers: how often it said how it is. given, taken: frames.
        heard: whether somebody waits for what it says; where nobody does, it may have to wait with saying more.
    """

    answers: int
    given: int
    taken: int
    heard: bool


class HangWatch:
    """Looks at one process."""

    def __init__(self) -> None:
        self._before = Signs(0, 0, 0, heard=False)
        self._silent = self._untaken = 0

    def look(self, now: Signs) -> bool:
        """Look once; return whether the line hangs."""
        before, self._before = self._before, now
        silent = now.heard and now.answers == before.answers
        untaken = now.heard and now.taken == before.taken and now.given > now.taken
        self._silent = self._silent + 1 if silent else 0
        self._untaken = self._untaken + 1 if untaken else 0
        if not now.answers:
            return self._silent >= MOST_LOADING
        return self._silent >= MOST_SILENT or self._untaken >= MOST_UNTAKEN
