"""Old pictures of fruit go, a few at a time, beside whatever else is going on."""

from __future__ import annotations

import logging

from PySide6.QtCore import QCoreApplication, QObject, QTimer

from fruitgui.errors import FruitguiError
from fruitgui.gui.session import Session
from fruitgui.gui.tasks import Task
from fruitgui.progress import Cancelled, Progress

EVERY_MS = 6 * 3600 * 1000
FIRST_MS = 60 * 1000
"""A minute after the start the window has better things to do no more."""

log = logging.getLogger(__name__)


class Housekeeping(QObject):
    """Lets pictures go that are older than the settings say; numbers are kept for ever."""

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._task: Task[int] | None = None
        self._timer = QTimer(self, singleShot=True)
        self._timer.timeout.connect(self.clear_up)

    def start(self) -> None:
        """Clear up in a minute, and every six hours from then on."""
        self._timer.start(FIRST_MS)

    def clear_up(self) -> None:
        """Clear up now."""
        if self._task is not None:
            return
        days, crops = self._session.settings.crops_kept_days, self._session.store.crops

        def job(progress: Progress, cancelled: Cancelled) -> int:  # noqa: ARG001 - nobody waits for it
            return crops.age_out(days, cancelled)

        self._task = Task(_doing, job, self)
        self._task.succeeded.connect(self._cleared)
        self._task.failed.connect(self._failed)
        self._task.ended.connect(self._ended)
        self._task.start()

    def stop(self) -> bool:
        """End clearing up, in the middle of it if need be. Tell whether it ended in time."""
        self._timer.stop()
        if self._task is None:
            return True
        self._task.cancel()
        return self._task.wait()

    def _cleared(self, gone: int) -> None:
        log.info("%d pictures were let go", gone)

    def _failed(self, error: FruitguiError) -> None:
        self._session.messages.error(error)

    def _ended(self) -> None:
        if self._task is not None:
            self._task.deleteLater()
            self._task = None
        self._timer.start(EVERY_MS)


def _doing() -> str:
    """Return what is being done; a method would be held by its own child, which Qt destroys after it."""
    return QCoreApplication.translate("Housekeeping", "Letting old pictures go")
