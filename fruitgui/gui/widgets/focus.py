"""The ring round whatever has the keyboard, where the style sheet draws none."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, QRectF, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QAbstractScrollArea, QScrollArea, QWidget

from fruitgui.gui.theme.theme import Theme

WIDTH, RADIUS = 2.0, 8.0


def paint_focus(painter: QPainter, box: QRectF, radius: float, theme: Theme) -> None:
    """Draw the ring just inside a box: of the colour of text, as a frame of the accent's says what is chosen."""
    half = WIDTH / 2
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QPen(theme.colour("text"), WIDTH))
    painter.drawRoundedRect(box.adjusted(half, half, -half, -half), radius, radius)


class FocusRing(QWidget):
    """Lies over something that scrolls, and is seen while that has the keyboard; takes no room and no presses.

    Args:
        area: whose ring it is; it goes with it.
    """

    def __init__(self, area: QAbstractScrollArea) -> None:
        super().__init__(area)
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.hide()
        area.installEventFilter(self)
        if isinstance(area, QScrollArea):
            area.verticalScrollBar().rangeChanged.connect(self._reach)
            self._reach()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        """Follow what it belongs to."""
        if isinstance(watched, QAbstractScrollArea):
            if event.type() == QEvent.Type.FocusIn:
                self.setGeometry(watched.rect())
                self.raise_()
                self.show()
            elif event.type() == QEvent.Type.FocusOut:
                self.hide()
            elif event.type() == QEvent.Type.Resize:
                self.setGeometry(watched.rect())
        return super().eventFilter(watched, event)

    def _reach(self) -> None:
        """Let the keyboard come to what only scrolls where there is something to scroll."""
        area = self.parentWidget()
        if isinstance(area, QScrollArea):
            moves = area.verticalScrollBar().maximum() > 0
            area.setFocusPolicy(Qt.FocusPolicy.StrongFocus if moves else Qt.FocusPolicy.NoFocus)

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it, of the colour of words."""
        half = WIDTH / 2
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setPen(QPen(self.palette().windowText().color(), WIDTH))
            painter.drawRoundedRect(QRectF(self.rect()).adjusted(half, half, -half, -half), RADIUS, RADIUS)
