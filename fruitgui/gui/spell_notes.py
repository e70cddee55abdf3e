"""What of the belt nobody sees, or not often enough, while a lot runs: kept with the lot whenever that changes."""

from __future__ import annotations

from functools import partial

from fruitgui.gui.queries import Queries
from fruitgui.records.spells import Spells, SpellSort
from fruitgui.station.live import LiveState
from fruitgui.station.live.blind import Blind


class SpellNotes:
    """Writes down when spells of a run begin and end.

    Args:
        queries: write beside the window.
        spells: keep them.
    """

    def __init__(self, queries: Queries, spells: Spells) -> None:
        self._queries = queries
        self._spells = spells
        self._noted: dict[SpellSort, tuple[int, Blind | None]] = {}

    def note(self, lot: int, state: LiveState | None) -> None:
        """Note how a line that counts into a lot is; None where nothing is counted."""
        self._note(lot, "away", None if state is None else state.blind)
        self._note(lot, "sparse", None if state is None else state.sparse)

    def _note(self, lot: int, sort: SpellSort, blind: Blind | None) -> None:
        before = self._noted.get(sort)
        if before == (lot, blind):
            return
        self._noted[sort] = (lot, blind)
        if blind is not None or (before is not None and before[0] == lot):
            self._queries.change(partial(self._spells.note, lot, blind, sort), _nothing)


def _nothing(_done: None) -> None:
    """Nobody waits for it."""
