"""What a lot remembers of how its line ran: what was not seen, a moved rig, clocks that leapt, a line broken off."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from functools import partial

from fruitgui.gui.queries import Queries
from fruitgui.records.lot import Lot
from fruitgui.records.spells import MOMENTS, MomentSort, Spells
from fruitgui.station.live import LiveState, LiveWarning
from fruitgui.station.live.blind import Blind


class LotNotes:
    """Writes down what changes: what lasts as it begins and ends, what happens at a moment each time.

    Args:
        queries: write beside the window.
        spells: keep it.
    """

    def __init__(self, queries: Queries, spells: Spells) -> None:
        self._queries = queries
        self._spells = spells
        self._lasting: dict[tuple[int, str], object] = {}
        self._moments: Counter[tuple[MomentSort, tuple[str, ...]]] = Counter()

    def note(self, lot: Lot, state: LiveState | None) -> None:
        """Note how the line is, None where none runs any more; what happens in a pause is nothing to the lot."""
        new = self._new_moments(() if state is None else state.warnings)
        if state is None or lot.paused:
            self._note_lasting(lot.key, None, None, ())
            return
        moved = {name for one in state.warnings if one.code == "calibration_stale" for name in one.sensors}
        self._note_lasting(lot.key, state.blind, state.sparse, tuple(sorted(moved)))
        for sort, sensors in new.elements():
            self._queries.change(partial(self._spells.note_moment, lot.key, sort, sensors), _nothing)

    def _note_lasting(self, lot: int, blind: Blind | None, sparse: Blind | None, moved: tuple[str, ...]) -> None:
        spells = self._spells
        self._note_changed(lot, "away", blind, partial(spells.note, lot, blind, "away"))
        self._note_changed(lot, "sparse", sparse, partial(spells.note, lot, sparse, "sparse"))
        self._note_changed(lot, "moved", moved or None, partial(spells.note_moved, lot, moved))

    def _note_changed(self, lot: int, sort: str, now: object, keep: Callable[[], None]) -> None:
        if now != self._lasting.get((lot, sort)):
            self._lasting[lot, sort] = now
            self._queries.change(keep, _nothing)

    def _new_moments(self, warnings: Sequence[LiveWarning]) -> Counter[tuple[MomentSort, tuple[str, ...]]]:
        """Return what happened, to whom, and how often since this was asked last."""
        before = self._moments
        said = ((sort, one) for one in warnings for sort in MOMENTS if sort == one.code)
        self._moments = Counter({(sort, one.sensors): one.count for sort, one in said})
        return self._moments - before


def _nothing(_done: None) -> None:
    """Nobody waits for it."""
