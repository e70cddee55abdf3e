"""What a long job is at, how far it is, and the button that stops it."""

from __future__ import annotations

from PySide6.QtWidgets import QHBoxLayout, QProgressBar, QPushButton, QVBoxLayout, QWidget

from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import label

STEPS = 1000


class Working(QWidget):
    """One row: words over a bar, and `stop` beside them."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.doing, self.stop = label("", "small"), QPushButton()
        self._bar = QProgressBar()
        self._bar.setRange(0, STEPS)
        self._bar.setTextVisible(False)
        self.stop.setAutoDefault(False)
        words = QVBoxLayout()
        words.addWidget(self.doing)
        words.addWidget(self._bar)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(2 * GRID)
        row.addLayout(words, 1)
        row.addWidget(self.stop)

    @property
    def share(self) -> float:
        """How far it is, 0–1."""
        return self._bar.value() / STEPS

    def show_progress(self, share: float, doing: str) -> None:
        """Show how far it is, 0–1, and what it is at."""
        self._bar.setValue(round(share * STEPS))
        self.doing.setText(doing)
