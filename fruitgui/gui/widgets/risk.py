"""A question of which one answer cannot be taken back."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtWidgets import QDialog, QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from fruitgui.gui.theme.tokens import GRID


def lay_out_risk(dialog: QDialog, said: Sequence[QLabel], go: QPushButton, stay: QPushButton) -> None:
    """Lay a question out: what is said, then both answers. Return and Escape stay; only the button itself goes.

    Args:
        dialog: accepted where a person goes.
        said: from above; too long ones are wrapped.
        go, stay: the answers.
    """
    for one in said:
        one.setWordWrap(True)
    go.setProperty("role", "danger")
    go.setAutoDefault(False)  # Return means "stay", wherever the focus is
    go.clicked.connect(dialog.accept)
    stay.clicked.connect(dialog.reject)
    stay.setDefault(True)
    buttons = QHBoxLayout()
    buttons.setSpacing(GRID)
    buttons.addStretch()
    buttons.addWidget(go)
    buttons.addWidget(stay)
    column = QVBoxLayout(dialog)
    column.setContentsMargins(3 * GRID, 3 * GRID, 3 * GRID, 3 * GRID)
    column.setSpacing(2 * GRID)
    for one in said:
        column.addWidget(one)
    column.addStretch()
    column.addLayout(buttons)
    dialog.setMinimumWidth(480)
    QWidget.setTabOrder(stay, go)
    stay.setFocus()
