"""What is asked before a recording: its name, and how long."""

from __future__ import annotations

from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QLabel,
    QLineEdit,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from fruitgui.gui.recorder_words import size_text
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.times import duration_text
from fruitgui.gui.widgets.cards import label
from fruitgui.gui.widgets.choice_box import ChoiceBox

LENGTHS_S = (None, 10.0, 60.0, 300.0, 1800.0, 3600.0)


class RecordDialog(QDialog):
    """Asks for a recording's name and length.

    Args:
        name: that is proposed.
        room_bytes: what may be used of the disk.
        folder: where it will lie, as a person reads it.
    """

    def __init__(self, name: str, room_bytes: int, folder: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.name, self.length = QLineEdit(name), ChoiceBox()
        for seconds in LENGTHS_S:
            text = self.tr("Until I stop it") if seconds is None else duration_text(seconds)
            self.length.addItem(text, seconds)
        self._room = label("", "dim")
        self._room.setWordWrap(True)
        self._buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel, parent=self)
        self._start = QPushButton(self.tr("Record"))
        self._start.setProperty("role", "main")
        self._start.setDefault(True)  # or Return would mean "Cancel" wherever no name is proposed
        self._buttons.addButton(self._start, QDialogButtonBox.ButtonRole.AcceptRole)
        self._has_room = True
        self._lay_out()
        self._buttons.accepted.connect(self.accept)
        self._buttons.rejected.connect(self.reject)
        self.name.textChanged.connect(self._check)
        self.setWindowTitle(self.tr("Record the sensors"))
        self.setMinimumWidth(480)
        self.name.setFocus()
        self.name.selectAll()
        self.show_room(room_bytes, folder)

    @property
    def seconds(self) -> float | None:
        """How long it shall last; None until it is stopped."""
        seconds = self.length.currentData()
        return None if seconds is None else float(seconds)

    def show_room(self, room_bytes: int, folder: str) -> None:
        """Show how much may be recorded, and where it will lie."""
        text = self.tr("{size} of the disk may be used. The recording will be in {folder}.")
        self._room.setText(text.format(size=size_text(room_bytes), folder=folder))
        self._has_room = room_bytes > 0
        self._check()

    def _lay_out(self) -> None:
        form = QFormLayout()
        form.setSpacing(2 * GRID)
        for text, field in ((self.tr("&Name"), self.name), (self.tr("&Length"), self.length)):
            named = QLabel(text)
            named.setBuddy(field)
            field.setAccessibleName(text.replace("&", ""))
            form.addRow(named, field)
        column = QVBoxLayout(self)
        column.setContentsMargins(3 * GRID, 3 * GRID, 3 * GRID, 3 * GRID)
        column.setSpacing(3 * GRID)
        column.addWidget(label(self.tr("Record the sensors"), "page"))
        column.addLayout(form)
        column.addWidget(self._room)
        column.addStretch()
        column.addWidget(self._buttons)

    def _check(self) -> None:
        self._start.setEnabled(bool(self.name.text().strip()) and self._has_room)
