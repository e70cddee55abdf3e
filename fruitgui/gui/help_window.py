"""The operator's manual, in the window's language."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QEvent, QUrl
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QDialog, QHBoxLayout, QPushButton, QVBoxLayout, QWidget

from fruitgui.gui.manual_view import ManualView
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.translate import Language
from fruitgui.resources import folder
from fruitgui.station.workflow import Step

WIDTH, HEIGHT = 960, 680


class HelpWindow(QDialog):
    """Shows the manual, opened at the chapter of a step.

    Args:
        theme: in which it is set.
        language: of the manual, followed when it changes; English where there is none in that language.
        log: file that the button beside it shows.
    """

    def __init__(self, theme: Theme, language: Language, log: Path, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._language, self._log = language, log
        self._step: Step | None = None
        self.text = ManualView(theme, self)
        self._show_log_button, self._close_button = QPushButton(), QPushButton()
        self._lay_out()
        self._say_words()
        self.resize(WIDTH, max(HEIGHT, 0 if parent is None else parent.height() * 3 // 4))

    def show_step(self, step: Step) -> None:
        """Scroll to the chapter of a step: the chapters are numbered as the steps are."""
        self._step = step
        self.text.show_chapter(list(Step).index(step) + 1)

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Take over another language: the manual in it, at the chapter that was opened."""
        if event.type() == QEvent.Type.LanguageChange:
            self._say_words()
            if self._step is not None:
                self.show_step(self._step)
        super().changeEvent(event)

    def _say_words(self) -> None:
        self.setWindowTitle(self.tr("Help"))
        self._show_log_button.setText(self.tr("Show log"))
        self._show_log_button.setToolTip(self.tr("Open the file in which everything that went wrong is written down"))
        self._close_button.setText(self.tr("Close"))
        self.text.show_page(manual_page(self._language.name))

    def _lay_out(self) -> None:
        show_log, close = self._show_log_button, self._close_button
        show_log.clicked.connect(self._show_log)
        close.setProperty("role", "main")
        close.clicked.connect(self.accept)
        row = QHBoxLayout()
        row.addWidget(show_log)
        row.addStretch()
        row.addWidget(close)
        column = QVBoxLayout(self)
        column.setContentsMargins(2 * GRID, 2 * GRID, 2 * GRID, 2 * GRID)
        column.setSpacing(2 * GRID)
        column.addWidget(self.text, 1)
        column.addLayout(row)

    def _show_log(self) -> None:
        QDesktopServices.openUrl(QUrl.fromLocalFile(str(self._log)))


def manual_page(language: str) -> Path:
    """Return the manual's file in a language, or in English."""
    place = folder("docs") / "manual"
    wanted = place / f"{language}.md"
    return wanted if wanted.is_file() else place / "en.md"
