"""The settings of a line: language, look, how long pictures are kept, how much room the disk must have."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QLabel,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from fruitgui.gui.enlarged import offered
from fruitgui.gui.numbers import THIN
from fruitgui.gui.theme.tokens import GRID, TOUCH
from fruitgui.gui.translate import LANGUAGES
from fruitgui.gui.widgets.cards import label, set_health
from fruitgui.gui.widgets.choice_box import ChoiceBox
from fruitgui.gui.widgets.decimal_box import DecimalBox
from fruitgui.gui.widgets.keeping_time import KeepingTime, shorter
from fruitgui.station.settings import Settings

MB_PER_GB = 1000
GB_DIGITS = 2
WIDTH = 620
MOST_GB = 10_000


class SettingsDialog(QDialog):
    """Shows settings and takes changes; `chosen` is what the person left it with."""

    def __init__(self, settings: Settings, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._settings = settings
        self.language, self.theme, self.words = ChoiceBox(), ChoiceBox(), ChoiceBox()
        self.pictures, self.free_gb = KeepingTime(settings.crops_kept_days), DecimalBox()
        self.gone = self._note("")
        self._fill()
        self._lay_out()
        self.pictures.changed.connect(self._show_gone)
        self._show_gone()
        self.setWindowTitle(self.tr("Settings"))
        self.setMinimumWidth(WIDTH)

    @property
    def chosen(self) -> Settings:
        """The settings as they stand in the dialog."""
        return self._settings.model_copy(
            update={
                "language": self.language.currentData(),
                "theme": self.theme.currentData(),
                "words_percent": self.words.currentData(),
                "crops_kept_days": self.pictures.days,
                "least_free_mb": self._least_free_mb(),
            }
        )

    def _least_free_mb(self) -> int:
        """Return the room as it was typed; to the megabyte as it was where nobody touched it."""
        kept_mb, typed_gb = self._settings.least_free_mb, self.free_gb.value()
        return kept_mb if typed_gb == round(kept_mb / MB_PER_GB, GB_DIGITS) else round(typed_gb * MB_PER_GB)

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
        for percent in offered(self.screen().availableSize(), self._settings.words_percent):
            named = {100: self.tr("Normal"), 125: self.tr("Large"), 150: self.tr("Larger"), 200: self.tr("Very large")}
            self.words.addItem(f"{named[percent]} ({percent}{THIN}%)", percent)
        self.words.setCurrentIndex(self.words.findData(self._settings.words_percent))
        self.language.setCurrentIndex(max(self.language.findData(self._settings.language), 0))
        self.theme.setCurrentIndex(max(self.theme.findData(self._settings.theme), 0))
        for box in (self.pictures.own, self.free_gb):
            box.lineEdit().setTextMargins(2 * GRID - 2, 0, 0, 0)
        self.free_gb.setMinimumHeight(TOUCH)
        self.free_gb.setDecimals(GB_DIGITS)
        self.free_gb.setRange(0, MOST_GB)
        self.free_gb.setSuffix(f"{THIN}GB")
        self.free_gb.setValue(self._settings.least_free_mb / MB_PER_GB)

    def _lay_out(self) -> None:
        form = QFormLayout()
        form.setSpacing(2 * GRID)
        form.setLabelAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        self._row(form, self.tr("&Language"), self.language)
        self._row(form, self.tr("L&ook"), self.theme)
        self._row(form, self.tr("Size of &words"), self.words)
        form.addRow(self._note(self.tr("Buttons and pictures grow with them, from the next start on.")))
        self._row(form, self.tr("Keep &pictures of fruit"), self.pictures)
        form.addRow(self.gone)
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
        named.setMinimumHeight(TOUCH)
        named.setBuddy(field)
        named_field = field.focusProxy() or field
        named_field.setAccessibleName(text.replace("&", ""))
        form.addRow(named, field)

    def _show_gone(self) -> None:
        """Say what goes; pictures that go at once, by what is chosen now, go for good."""
        soon = shorter(self.pictures.days, self._settings.crops_kept_days)
        set_health(self.gone, "warn" if soon else "")
        self.gone.setText(
            self.tr("Once saved, older pictures are deleted for good. Counts, sizes and what was taught stay for ever.")
            if soon
            else self.tr("Older pictures of counted fruit go. Counts, sizes and what was taught stay for ever.")
        )

    def _note(self, text: str) -> QLabel:
        note = label(text, "small")
        note.setWordWrap(True)
        return note
