"""The way back from fields that are typed into, so that keys name fruit again."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtWidgets import QWidget


class FieldKeys(QObject):
    """Escape goes back to the fruit; Enter goes on to what follows a field.

    Args:
        fields: that are typed into, each with what follows it; None where Enter is the field's own.
        back: the fruit.
    """

    def __init__(
        self, fields: Mapping[QWidget, QWidget | None], back: QWidget, parent: QObject | None = None
    ) -> None:  # fmt: skip
        super().__init__(parent)
        self._fields = dict(fields)
        self._back = back
        for field in self._fields:
            field.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        """Hear the two keys."""
        if event.type() == QEvent.Type.KeyPress and isinstance(watched, QWidget):
            key = event.key()  # type: ignore[attr-defined]
            following = self._fields.get(watched)
            if key == Qt.Key.Key_Escape:
                following = self._back
            elif key not in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
                following = None
            if following is not None:
                following.setFocus()
                return True
        return super().eventFilter(watched, event)
