"""Asks before rules are installed that let everybody on this computer use the sensors, and shows which."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtWidgets import QDialog, QHBoxLayout, QPlainTextEdit, QPushButton, QVBoxLayout, QWidget

from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import label
from fruitgui.gui.widgets.worded import Worded


class RulesDialog(Worded, QDialog):
    """Shows what will be written and where; accepted is a yes.

    Args:
        target: where the rules go.
        command: that puts them there.
        rules: their text.
    """

    def __init__(self, target: Path, command: str, rules: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._target = target
        self._title, self._what = label("", "page"), label("")
        self.rules = QPlainTextEdit(f"{command}\n\n{rules}")
        self.install, self.leave = QPushButton(), QPushButton()
        self._lay_out()
        self._say_words()
        self.resize(760, 520)

    def _lay_out(self) -> None:
        self._what.setWordWrap(True)
        self.rules.setReadOnly(True)
        self.install.setProperty("role", "main")
        self.install.clicked.connect(self.accept)
        self.leave.clicked.connect(self.reject)
        self.leave.setDefault(True)
        self.leave.setFocus()
        buttons = QHBoxLayout()
        buttons.setSpacing(GRID)
        buttons.addStretch()
        buttons.addWidget(self.leave)
        buttons.addWidget(self.install)
        column = QVBoxLayout(self)
        column.setContentsMargins(3 * GRID, 3 * GRID, 3 * GRID, 3 * GRID)
        column.setSpacing(2 * GRID)
        column.addWidget(self._title)
        column.addWidget(self._what)
        column.addWidget(self.rules, 1)
        column.addLayout(buttons)

    def _say_words(self) -> None:
        self.setWindowTitle(self.tr("Let everybody use the sensors"))
        self._title.setText(self.tr("Let everybody use the sensors?"))
        text = self.tr(
            "These rules go to {path}. From then on everybody who works on this computer may use these sensors. The "
            "system asks for the administrator's password."
        )
        self._what.setText(text.format(path=self._target))
        self.install.setText(self.tr("Install"))
        self.leave.setText(self.tr("Cancel"))
        self.rules.setAccessibleName(self.tr("What is done, and the rules"))
