"""The operator's manual, in the window's language."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QUrl
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QDialog, QHBoxLayout, QPushButton, QVBoxLayout, QWidget

from fruitgui.gui.manual_view import ManualView
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.resources import folder
from fruitgui.station.workflow import Step


class HelpWindow(QDialog):
    """Shows the manual, opened at the chapter of a step.

    Args:
        theme: in which it is set.
        language: of the manual; English where it is not there in that language.
        log: file that the button beside it shows.
    """

    def __init__(self, theme: Theme, language: str, log: Path, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._log = log
        self.text = ManualView(theme, self)
        self.text.show_page(manual_page(language))
        self._lay_out()
        self.setWindowTitle(self.tr("Help"))
        self.resize(900, 680)

    def show_step(self, step: Step) -> None:
        """Scroll to the chapter of a step: the chapters are numbered as the steps are."""
        self.text.show_chapter(list(Step).index(step) + 1)

    def _lay_out(self) -> None:
        show_log, close = QPushButton(self.tr("Show log")), QPushButton(self.tr("Close"))
        show_log.setToolTip(self.tr("Open the file in which everything that went wrong is written down"))
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
