"""Keeps Python's cyclic garbage collector on the thread of the window.

Collected on a worker thread, it would destroy Qt objects there and crash the
process (PYSIDE-810). Automatic collection is switched off and a timer of the
window's thread collects instead. What the program is made of (its modules, its
screens) lives as long as the window and is left out of it: looking through all
of that takes a tenth of a second.
"""

from __future__ import annotations

import gc

from PySide6.QtCore import QObject, QTimer

EVERY_MS = 1000


class ConfinedCollector(QObject):
    """Collects on the thread that it lives on, once a second, by generations as Python would."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._timer = QTimer(self)
        self._timer.setInterval(EVERY_MS)
        self._timer.timeout.connect(self._collect)
        self._was_on = gc.isenabled()

    def start(self) -> None:
        """Take over from Python."""
        gc.disable()
        self.leave_out()
        self._timer.start()

    def leave_out(self) -> None:
        """Collect nothing of what exists by now: it lives as long as the window."""
        gc.freeze()

    def stop(self) -> None:
        """Give back to Python what it had."""
        self._timer.stop()
        gc.unfreeze()
        if self._was_on:
            gc.enable()

    def _collect(self) -> None:
        counts, limits = gc.get_count(), gc.get_threshold()
        for generation in (2, 1, 0):
            if counts[generation] > limits[generation]:
                gc.collect(generation)
                return
