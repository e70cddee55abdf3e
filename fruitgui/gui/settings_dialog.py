"""The settings of a line: language, look, how long pictures are kept, how much room the disk must have."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QLabel,
    QPushButton,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.translate import LANGUAGES
from fruitgui.gui.widgets.cards import label
from fruitgui.station.settings import Settings

MB_PER_GB = 1000
MOST_DAYS = 3650


class SettingsDialog(QDialog):
    """Shows settings and takes changes; `chosen` is what the person left it with."""

    def __init__(self, settings: Settings, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._settings = settings
        self.language, self.theme = QComboBox(), QComboBox()
        self.days, self.free_gb = QSpinBox(), QSpinBox()
        self._fill()
        self._lay_out()
        self.setWindowTitle(self.tr("Settings"))
        self.setMinimumWidth(520)

    @property
    def chosen(self) -> Settings:
        """The settings as they stand in the dialog."""
        return self._settings.model_copy(
            update={
                "language": self.language.currentData(),
                "theme": self.theme.currentData(),
                "crops_kept_days": self.days.value(),
                "least_free_mb": self.free_gb.value() * MB_PER_GB,
            }
        )

    def _fill(self) -> None:
        self.language.addItem(self.tr("As the system"), "")
        for name, own in LANGUAGES.items():
            self.language.addItem(own, name)
        for name, text in (
            ("system", self.tr("As the system")),
            ("dark", self.tr("Dark")),
            ("light", self.tr("Light")),
        ):
            self.theme.addItem(text, name)
        self.language.setCurrentIndex(max(self.language.findData(self._settings.language), 0))
        self.theme.setCurrentIndex(max(self.theme.findData(self._settings.theme), 0))
        self.days.setRange(0, MOST_DAYS)
        self.days.setSpecialValueText(self.tr("for ever"))
        self.days.setSuffix(self.tr(" days"))
        self.days.setValue(self._settings.crops_kept_days)
        self.free_gb.setRange(0, 1000)
        self.free_gb.setSuffix(" GB")
        self.free_gb.setValue(round(self._settings.least_free_mb / MB_PER_GB))

    def _lay_out(self) -> None:
        form = QFormLayout()
        form.setSpacing(2 * GRID)
        form.setLabelAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        self._row(form, self.tr("&Language"), self.language)
        self._row(form, self.tr("L&ook"), self.theme)
        self._row(form, self.tr("Keep &pictures of fruit"), self.days)
        form.addRow(self._note(self.tr("Counts, sizes and kinds are kept for ever; only the pictures are deleted.")))
        self._row(form, self.tr("&Free room that stays on the disk"), self.free_gb)
        form.addRow(self._note(self.tr("With less, recording stops and no more pictures are kept. Counting goes on.")))
        buttons = QDialogButtonBox(
            QDialogButtonBox.StandardButton.Save | QDialogButtonBox.StandardButton.Cancel, parent=self
        )
        save = buttons.button(QDialogButtonBox.StandardButton.Save)
        if isinstance(save, QPushButton):
            save.setProperty("role", "main")
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        column = QVBoxLayout(self)
        column.setContentsMargins(3 * GRID, 3 * GRID, 3 * GRID, 3 * GRID)
        column.setSpacing(3 * GRID)
        column.addWidget(label(self.tr("Settings"), "page"))
        column.addLayout(form)
        column.addStretch()
        column.addWidget(buttons)

    def _row(self, form: QFormLayout, text: str, field: QWidget) -> None:
        named = QLabel(text)
        named.setBuddy(field)
        field.setAccessibleName(text.replace("&", ""))
        form.addRow(named, field)

    def _note(self, text: str) -> QLabel:
        note = label(text, "small")
        note.setWordWrap(True)
        return note
