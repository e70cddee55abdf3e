"""Fruit of which most are unknown though there is a model: it was taught under other light, or on another belt.

A belt whose own colour is another one (wet, dirty, dyed) looks to the model like other light, and every fruit on it
like one that was never taught.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence

from fruitgui.classification.evidence import UNKNOWN
from fruitgui.classification.intervals import Rate, rate

LAST_FRUIT = 30
"""So many fruit in a row tell: a lot that begins well and goes wrong is told within some twenty fruit."""

LEAST_FRUIT = 12
"""Fewer tell nothing: a few foreign things may come together."""

HALF = 0.5
"""Things that were never taught pass among the fruit, but are not the most of them."""

WHY = (
    "the light or the belt's own colour (wet, dirty, another belt) may differ from when they were taught. "
    "Clean the belt, or name some of these fruit and train again."
)


def mostly_unknown(kinds: Sequence[str]) -> bool:
    """Tell whether clearly more than half of some fruit are unknown; not before they are enough to tell."""
    return len(kinds) >= LEAST_FRUIT and _share(kinds).low > HALF


def mostly_known(kinds: Sequence[str]) -> bool:
    """Tell whether clearly more than half of some fruit are of taught kinds; not before they are enough to tell."""
    return len(kinds) >= LEAST_FRUIT and _share(kinds).high < HALF


def unknown_warnings(kinds: Sequence[str]) -> list[str]:
    """Return what to say of a run with a model, given the kinds of its fruit in the order in which they left."""
    if mostly_unknown(kinds):
        return [f"{kinds.count(UNKNOWN)} of {len(kinds)} fruit are unknown to the model: {WHY}"]
    for first in range(len(kinds) - LAST_FRUIT + 1):
        some = kinds[first : first + LAST_FRUIT]
        if mostly_unknown(some):
            where = f"Of fruit {first + 1} to {first + LAST_FRUIT}"
            return [f"{where}, {some.count(UNKNOWN)} are unknown to the model: {WHY}"]
    return []


class UnknownWatch:
    """Watches the last fruit that a model named. Not for several threads."""

    def __init__(self) -> None:
        self._last: deque[str] = deque(maxlen=LAST_FRUIT)
        self._said = False

    def see(self, kind: str) -> str | None:
        """Take the kind of a fruit; return what is to be said, once until most are clearly of taught kinds again."""
        self._last.append(kind)
        kinds = tuple(self._last)
        if self._said:
            self._said = not mostly_known(kinds)
            return None
        self._said = mostly_unknown(kinds)
        if not self._said:
            return None
        return f"{kinds.count(UNKNOWN)} of the last {len(kinds)} fruit are unknown to the model: {WHY}"


def _share(kinds: Sequence[str]) -> Rate:
    return rate(kinds.count(UNKNOWN), len(kinds))
