"""Unknown fruit of a lot, set aside so that a person can name them."""

from __future__ import annotations

from fruitgui.classification.evidence import UNKNOWN
from fruitgui.errors import WorldError
from fruitgui.records.lesson import Gathering
from fruitgui.records.teaching import Teaching
from fruitgui.station.live import Finished


class SetAside:
    """Takes unknown fruit from the line's thread, and keeps them from another; never in the way of counting.

    Args:
        teaching: keeps them.
        source: where they come from, for people.

    Attributes:
        lost: times that some could not be kept; they were counted all the same, and cannot be named.
    """

    def __init__(self, teaching: Teaching, source: str) -> None:
        self._gathering = Gathering(teaching, source)
        self.lost = 0

    @property
    def fruit(self) -> int:
        """How many wait to be named."""
        return self._gathering.fruit

    def take(self, finished: Finished) -> None:
        """Take a fruit that left, if it is unknown: a `Teacher`."""
        if finished.fruit.kind == UNKNOWN:
            self._gathering.take(finished)

    def keep(self) -> None:
        """Keep what was taken."""
        try:
            self._gathering.keep()
        except WorldError:
            self.lost += 1
