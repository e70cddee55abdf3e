"""Words that are made to fit: smaller where there is little room, and cut off only where they could not be read."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QFont, QFontMetricsF, QPainter

LEAST_PX = 12
"""Smaller letters are not read at arm's length."""


def fitted(painter: QPainter, text: str, width: float, least_px: int = LEAST_PX) -> str:
    """Make the painter's font as much smaller as a text needs; return the text, cut off where that was not enough.

    Args:
        painter: its font is the largest that is taken.
        text: one line.
        width: pixels that there are.
        least_px: the smallest font that is taken.
    """
    font = QFont(painter.font())
    while font.pixelSize() > least_px and QFontMetricsF(font).horizontalAdvance(text) > width:
        font.setPixelSize(font.pixelSize() - 1)
    painter.setFont(font)
    return cut(painter, text, width)


def cut(painter: QPainter, text: str, width: float) -> str:
    """Return a text, cut off where it is wider than there is room."""
    return QFontMetricsF(painter.font()).elidedText(text, Qt.TextElideMode.ElideRight, width)
