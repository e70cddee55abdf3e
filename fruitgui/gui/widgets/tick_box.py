"""A box that is ticked: all of it can be pressed, not only its drawing and words."""

from __future__ import annotations

from PySide6.QtCore import QPoint
from PySide6.QtWidgets import QCheckBox


class TickBox(QCheckBox):
    """Takes a press anywhere in its rectangle, which is as high as what a gloved finger presses."""

    def hitButton(self, position: QPoint) -> bool:  # noqa: N802 - Qt's name
        """Tell whether a press there is for it."""
        return self.rect().contains(position)
