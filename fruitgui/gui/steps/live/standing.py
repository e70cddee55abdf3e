"""Says over the counts, in large, that nothing is being counted."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from fruitgui.gui.theme import icons
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID, RADIUS
from fruitgui.gui.widgets.fitting import fitted

HEIGHT, TALLEST = 64, 144
"""Pixels: it is as high as its width asks for, so that it is read from as far as the counts."""

HEIGHT_SHARE, ICON_SHARE = 0.12, 0.55


class StandingBand(QWidget):
    """A band in the colour of warnings; seen only while there is something to say."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._words, self._why = "", ""
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setVisible(False)
        theme.changed.connect(self.update)

    def show_words(self, words: str, why: str) -> None:
        """Say that nothing is counted, and why; empty words take no room."""
        self._words, self._why = words, why
        self.setAccessibleName(f"{words}. {why}" if words else "")
        self.setVisible(bool(words))
        self.update()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        """Be as high as the width asks for."""
        super().resizeEvent(event)
        self.setFixedHeight(round(min(max(HEIGHT_SHARE * self.width(), HEIGHT), TALLEST)))

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(300, HEIGHT)

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        theme, box = self._theme, QRectF(self.rect())
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(theme.colour("warn"))
            painter.drawRoundedRect(box, RADIUS, RADIUS)
            ink, side = theme.colour("ground"), ICON_SHARE * box.height()
            icons.paint(painter, QRectF(2 * GRID, box.center().y() - side / 2, side, side), "pause", ink)
            painter.setPen(ink)
            text = box.adjusted(side + 4 * GRID, GRID, -2 * GRID, -GRID)
            left = Qt.AlignmentFlag.AlignLeft
            painter.setFont(self._fitting(self._words, text.width()))
            painter.drawText(text, left | Qt.AlignmentFlag.AlignTop, self._words)
            painter.setFont(self._grown("small", QFont.Weight.Medium))
            why = fitted(painter, self._why, text.width())
            painter.drawText(text, left | Qt.AlignmentFlag.AlignBottom, why)

    def _fitting(self, words: str, width: float) -> QFont:
        """Return the largest of the theme's fonts in which the words fit."""
        fonts = [self._grown(size, QFont.Weight.Bold) for size in ("page", "title", "body")]
        return next((one for one in fonts if QFontMetricsF(one).horizontalAdvance(words) <= width), fonts[-1])

    def _grown(self, size: str, weight: QFont.Weight) -> QFont:
        """Return one of the theme's fonts, as much larger as the band is higher."""
        font = self._theme.font(size, weight)
        font.setPixelSize(round(font.pixelSize() * self.height() / HEIGHT))
        return font
