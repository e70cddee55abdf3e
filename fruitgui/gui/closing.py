"""What is asked before a window closes that would lose fruit: they wait for a disk that is full."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QDialog, QPushButton, QWidget

from fruitgui.gui.numbers import count_text
from fruitgui.gui.widgets.cards import label
from fruitgui.gui.widgets.risk import lay_out_risk


class LossDialog(QDialog):
    """Asks once; accepted closes the window. Return and Escape leave it open: only the button itself closes it."""

    def __init__(self, waiting: int, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.leave, self.stay = QPushButton(self.tr("Close and lose them")), QPushButton(self.tr("Leave it open"))
        self._lay_out(waiting)
        self.setWindowTitle(self.tr("Close"))

    def _lay_out(self, waiting: int) -> None:
        title = label(self.tr("Close, though the disk is full?"), "page")
        count = label(self.tr("Fruit that wait for the disk: {count}").format(count=count_text(waiting)), "strong")
        after = label(
            self.tr(
                "They were not shown as counted, and are lost when the window closes. Make room on the disk: a few "
                "seconds later they are kept."
            )
        )
        lay_out_risk(self, (title, count, after), self.leave, self.stay)


class ClosingQuestion(QObject):
    """Keeps a window open until a person knows what closing it loses.

    Args:
        window: that is to close.
        unkept: how many fruit would be lost now.
    """

    def __init__(self, window: QWidget, unkept: Callable[[], int]) -> None:
        super().__init__(window)
        self._window = window
        self._unkept = unkept
        self._may = False
        self.dialog: LossDialog | None = None

    def keeps_open(self) -> bool:
        """Tell whether the window is to stay open for now, and ask in that case."""
        waiting = self._unkept()
        if self._may or not waiting:
            return False
        if self.dialog is None:
            self.dialog = LossDialog(waiting, self._window)
            self.dialog.finished.connect(self._answered)
            self.dialog.open()
        return True

    def close_unasked(self) -> None:
        """Close the window: the system ends, or a terminal says so, and nobody may be there to answer."""
        self._may = True
        self._window.close()

    def _answered(self, result: int) -> None:
        if self.dialog is not None:
            self.dialog.deleteLater()
            self.dialog = None
        if result == QDialog.DialogCode.Accepted:
            self.close_unasked()
