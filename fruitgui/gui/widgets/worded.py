"""What says its words anew when another language is chosen."""

from __future__ import annotations

from PySide6.QtCore import QEvent


class Worded:
    """Goes before a widget's own class; the widget has `_say_words`, which writes whatever it shows."""

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Take over another language."""
        if event.type() == QEvent.Type.LanguageChange:
            self._say_words()
        super().changeEvent(event)  # type: ignore[misc]  # the widget's own class has it

    def _say_words(self) -> None:
        raise NotImplementedError
