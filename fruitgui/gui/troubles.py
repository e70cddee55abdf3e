"""What a lot remembers beside absences: a moved rig, clocks that leapt, a model that knew little, a line broken off."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from functools import partial

from fruitgui.gui.queries import Queries
from fruitgui.records.spells import Spells
from fruitgui.station.live import LiveWarning

MOMENTS = ("clock_jumped", "mostly_unknown", "line_begun_again")
"""Warnings that are counted each time: what a lot keeps of them is when they came."""


class Troubles:
    """Writes down what the line's warnings say anew.

    Args:
        queries: write beside the window.
        spells: keep them.
    """

    def __init__(self, queries: Queries, spells: Spells) -> None:
        self._queries = queries
        self._spells = spells
        self._moved: dict[int, tuple[str, ...]] = {}
        self._seen: Counter[tuple[str, tuple[str, ...]]] = Counter()

    def note(self, lot: int, warnings: Sequence[LiveWarning]) -> None:
        """Note what is new in the warnings of a line that counts into a lot."""
        stale = {name for one in warnings if one.code == "calibration_stale" for name in one.sensors}
        self._note_moved(lot, tuple(sorted(stale)))
        for code, sensors in self._new_moments(warnings).elements():
            spells, queries = self._spells, self._queries
            match code:
                case "clock_jumped":
                    queries.change(partial(spells.note_jump, lot, sensors), _nothing)
                case "mostly_unknown":
                    queries.change(partial(spells.note_unknown, lot), _nothing)
                case "line_begun_again":
                    queries.change(partial(spells.note_broken_off, lot), _nothing)

    def rest(self, lot: int, warnings: Sequence[LiveWarning]) -> None:
        """Note that nothing is counted into a lot now: what happens meanwhile is nothing to it."""
        self._note_moved(lot, ())
        self._new_moments(warnings)

    def _note_moved(self, lot: int, sensors: tuple[str, ...]) -> None:
        if sensors != self._moved.get(lot, ()):
            self._moved = {lot: sensors}
            self._queries.change(partial(self._spells.note_moved, lot, sensors), _nothing)

    def _new_moments(self, warnings: Sequence[LiveWarning]) -> Counter[tuple[str, tuple[str, ...]]]:
        """Return what happened at a moment, to whom, and how often since this was asked last."""
        before = self._seen
        self._seen = Counter({(one.code, one.sensors): one.count for one in warnings if one.code in MOMENTS})
        return self._seen - before


def _nothing(_done: None) -> None:
    """Nobody waits for it."""
