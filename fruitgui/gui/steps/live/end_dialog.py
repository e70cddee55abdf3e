"""What is asked before a lot ends: an ended lot cannot be taken up again."""

from __future__ import annotations

from PySide6.QtWidgets import QDialog, QPushButton, QWidget

from fruitgui.gui.numbers import count_text
from fruitgui.gui.widgets.cards import label
from fruitgui.gui.widgets.risk import lay_out_risk
from fruitgui.records.lot import Lot


class EndDialog(QDialog):
    """Asks once; accepted is a yes. Return and Escape leave the lot open: only the button itself ends it.

    Args:
        lot: that would end.
        fruit: counted so far, see `show_fruit`.
        running: the line runs, so that fruit in view are counted first.
    """

    def __init__(self, lot: Lot, fruit: int, *, running: bool, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._count, self._after = label("", "strong"), label("")
        self.end, self.leave = QPushButton(self.tr("End lot")), QPushButton(self.tr("Leave it open"))
        title = label(self.tr("End lot {name}?").format(name=lot.name), "page")
        lay_out_risk(self, (title, self._count, self._after), self.end, self.leave)
        self._after.setText(self._what_follows(running=running, paused=lot.paused))
        self.setWindowTitle(self.tr("End lot"))
        self.show_fruit(fruit)

    def show_fruit(self, fruit: int) -> None:
        """Show how many fruit are counted by now: the line goes on while it is asked."""
        self._count.setText(self.tr("Fruit counted so far: {count}").format(count=count_text(fruit)))

    def _what_follows(self, *, running: bool, paused: bool) -> str:
        parts = []
        if running and not paused:
            parts.append(self.tr("What is in view is counted first, then the line stops."))
        parts.append(self.tr("A lot that is ended cannot be taken up again."))
        if running and not paused:
            parts.append(self.tr("To go on with it later, pause it."))
        else:
            parts.append(self.tr("Left open, you can go on with it at any time."))
        return " ".join(parts)
