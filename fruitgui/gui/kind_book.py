"""What each kind looks like and weighs, the same on every screen and from day to day."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from PySide6.QtCore import QObject, Signal

from fruitgui.gui.theme.kinds import KindMark, Marks, kind_mark, kind_marks
from fruitgui.station.kinds_file import KindNote, KindNotes


class KindBook(QObject):
    """The notes on kinds as the window holds them.

    Args:
        notes: as they were kept.
        keep: keeps notes; what could not be kept comes back through `take`.

    Attributes:
        changed: a density was typed, or taken away.
    """

    changed = Signal()

    def __init__(self, notes: KindNotes, keep: Callable[[KindNotes], None], parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._notes = notes
        self._keep = keep

    @property
    def densities_g_ml(self) -> Mapping[str, float]:
        """The densities that a person typed, by kind."""
        return self._notes.typed_densities()

    def looks(self, kinds: Iterable[str]) -> Marks:
        """Return the marks of kinds; one that never had a mark gets one, and keeps it."""
        kept = self._kept()
        marks = kind_marks(kinds, kept.values())
        new = {kind: mark for kind, mark in marks.items() if mark.number >= 0 and kind not in kept}
        if new:
            self._note(new)
        return marks

    def take(self, notes: KindNotes) -> None:
        """Take what is kept, where that is not what is held: it was taken back, or could not be written."""
        if notes != self._notes:
            self._notes = notes
            self.changed.emit()

    def type_densities(self, densities_g_ml: Mapping[str, float | None]) -> None:
        """Keep what a person typed of kinds; None for nothing."""
        notes = self._notes
        for kind, density_g_ml in densities_g_ml.items():
            if density_g_ml != notes.of(kind).density_g_ml:
                notes = notes.with_density(kind, density_g_ml)
        if notes != self._notes:
            self._notes = notes
            self._keep(notes)
            self.changed.emit()

    def _kept(self) -> dict[str, KindMark]:
        notes = self._notes.kinds.items()
        return {kind: kind_mark(kind, one.mark, one.letters) for kind, one in notes if one.mark is not None}

    def _note(self, marks: Mapping[str, KindMark]) -> None:
        notes = {
            kind: self._notes.of(kind).model_copy(update={"mark": mark.number, "letters": mark.letters})
            for kind, mark in marks.items()
        }
        everything: dict[str, KindNote] = {**self._notes.kinds, **notes}
        self._notes = self._notes.model_copy(update={"kinds": everything})
        self._keep(self._notes)
