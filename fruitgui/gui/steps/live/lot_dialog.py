"""What is asked when a lot starts: as little as possible."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QCompleter,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QLabel,
    QLineEdit,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from fruitgui.gui.theme.tokens import GRID, TOUCH
from fruitgui.gui.widgets.cards import label
from fruitgui.records.lot import LotPlan


class LotDialog(QDialog):
    """Asks for a lot's name, grower and recipe.

    Args:
        name: that is proposed.
        growers, recipes: that were used before, to choose from while typing.
    """

    def __init__(
        self, name: str, growers: Sequence[str] = (), recipes: Sequence[str] = (), parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.name, self.grower, self.recipe, self.note = QLineEdit(name), QLineEdit(), QLineEdit(), QLineEdit()
        for field, words in ((self.grower, growers), (self.recipe, recipes)):
            completer = QCompleter(list(words), field)
            completer.setCaseSensitivity(Qt.CaseSensitivity.CaseInsensitive)
            field.setCompleter(completer)
        self._buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel, parent=self)
        self._start = QPushButton(self.tr("Start"))
        self._start.setProperty("role", "main")
        self._start.setDefault(True)  # or Return would mean "Cancel" wherever no name is proposed
        self._buttons.addButton(self._start, QDialogButtonBox.ButtonRole.AcceptRole)
        self._lay_out()
        self._buttons.accepted.connect(self.accept)
        self._buttons.rejected.connect(self.reject)
        self.name.textChanged.connect(self._check)
        self.setWindowTitle(self.tr("New lot"))
        self.setMinimumWidth(480)
        self.name.setFocus()
        self.name.selectAll()
        self._check()

    def plan(self) -> LotPlan:
        """Return what was typed."""
        return LotPlan(
            self.name.text().strip(), self.grower.text().strip(), self.recipe.text().strip(), self.note.text().strip()
        )

    def _lay_out(self) -> None:
        form = QFormLayout()
        form.setSpacing(2 * GRID)
        for text, field in (
            (self.tr("&Lot"), self.name),
            (self.tr("&Grower"), self.grower),
            (self.tr("&Recipe"), self.recipe),
            (self.tr("&Note"), self.note),
        ):
            named = QLabel(text)
            named.setMinimumHeight(TOUCH)
            named.setBuddy(field)
            field.setMinimumHeight(TOUCH)
            field.setAccessibleName(text.replace("&", ""))
            form.addRow(named, field)
        column = QVBoxLayout(self)
        column.setContentsMargins(3 * GRID, 3 * GRID, 3 * GRID, 3 * GRID)
        column.setSpacing(3 * GRID)
        column.addWidget(label(self.tr("New lot"), "page"))
        column.addLayout(form)
        column.addStretch()
        column.addWidget(self._buttons)

    def _check(self) -> None:
        self._start.setEnabled(bool(self.name.text().strip()))
