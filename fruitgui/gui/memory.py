"""Memory that was let go is given back to the system: the C library would keep more of it with every hour."""

from __future__ import annotations

from PySide6.QtCore import QObject, QTimer

from fruitgui.gui.queries import Queries
from fruitgui.heap import give_back

EVERY_MS = 60_000


class GivingBack(QObject):
    """Gives memory back once a minute, on a thread of its own.

    Pictures of all sizes come and go on a dozen threads, and what lies free between them grows with the fruit.
    """

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.queries = Queries(self)
        self._timer = QTimer(self, interval=EVERY_MS)
        self._timer.timeout.connect(self.give_back)

    def start(self) -> None:
        """Give back from now on."""
        self._timer.start()

    def stop(self) -> None:
        """Give back no more."""
        self._timer.stop()

    def give_back(self) -> None:
        """Give back now."""
        self.queries.ask("memory", give_back, _nothing)


def _nothing(_given: bool) -> None:
    """Nobody waits for it."""
