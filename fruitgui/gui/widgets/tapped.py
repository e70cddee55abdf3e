"""A finger on a list: it chooses where it is lifted, and nothing where it scrolled."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication, QEvent, QObject
from PySide6.QtGui import QGuiApplication, QInputDevice, QMouseEvent
from PySide6.QtWidgets import QAbstractItemView, QScroller


class TapChooses(QObject):
    """Holds a finger's press back from a list until it is lifted; a mouse presses as ever.

    Qt makes a press of the mouse from a finger's, and a list chooses a row as soon as it is pressed: a finger that is
    about to scroll would choose the row under it.
    """

    def __init__(self, view: QAbstractItemView) -> None:
        super().__init__(view)
        self._viewport = view.viewport()
        self._held: QMouseEvent | None = None
        self._giving = False
        self._viewport.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        """Hold back what is a finger's, and give it once it is known to be a tap."""
        if self._giving or not isinstance(event, QMouseEvent) or not _by_finger(event):
            return super().eventFilter(watched, event)
        if event.type() == QEvent.Type.MouseButtonPress:
            self._held = event.clone()
            return True
        if event.type() == QEvent.Type.MouseMove:
            return True
        if event.type() == QEvent.Type.MouseButtonRelease:
            return not self._tapped(event)
        return super().eventFilter(watched, event)

    def _tapped(self, lifted: QMouseEvent) -> bool:
        """Give the list the press that was held back, where the finger is lifted without having scrolled."""
        held, self._held = self._held, None
        if held is None:
            return True
        moved = (lifted.position() - held.position()).manhattanLength()
        if moved >= QGuiApplication.styleHints().startDragDistance() or self._scrolls():
            return False
        self._giving = True
        try:
            QCoreApplication.sendEvent(self._viewport, held)
        finally:
            self._giving = False
        return True

    def _scrolls(self) -> bool:
        state = QScroller.scroller(self._viewport).state()
        return state in (QScroller.State.Dragging, QScroller.State.Scrolling)


def _by_finger(event: QMouseEvent) -> bool:
    return event.device().type() == QInputDevice.DeviceType.TouchScreen
