"""Recording, as the connect screen has it: the action, the question before it, the card while it goes on, the list."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Sequence

from PySide6.QtCore import QDateTime, QEvent, QObject
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QWidget

from fruitgui.gui.session import Session
from fruitgui.gui.steps.connect.record_card import RecordCard
from fruitgui.gui.steps.connect.record_dialog import RecordDialog
from fruitgui.gui.theme.theme import Theme
from fruitgui.station.record_state import RESERVE_BYTES
from fruitgui.station.recordings_made import MadeRecording, recordings_made


class RecordDesk(QObject):
    """Lets a person record, and shows how far it is.

    Args:
        session: whose sensors are recorded.
        theme: of the card.
        page: over which the question is asked.

    Attributes:
        action: asks what to record.
        card: is seen while something is being recorded.
        dialog: the question, while it is asked.
    """

    def __init__(self, session: Session, theme: Theme, page: QWidget) -> None:
        super().__init__(page)
        self._recorder = session.recorder
        self._folder = session.workspace.folder
        self._page = page
        self.action, self.card = QAction(page), RecordCard(theme)
        self.dialog: RecordDialog | None = None
        self._recorder.ticked.connect(self.show)
        self._recorder.changed.connect(self.show)
        self.card.stop_wanted.connect(self._recorder.stop)
        self.action.triggered.connect(self.ask)
        page.installEventFilter(self)
        self._say_words()
        self.show()

    @property
    def recording(self) -> bool:
        """Whether something is being recorded."""
        return self._recorder.plan is not None

    def follow(self, changed: Callable[[], None]) -> None:
        """Call something when a recording begins or ends."""
        self._recorder.changed.connect(changed)

    def made(self) -> Sequence[MadeRecording]:
        """Return the recordings that were made here."""
        plan = self._recorder.plan
        return recordings_made(self._recorder.folder, None if plan is None else plan.out)

    def show(self) -> None:
        """Show how far it is."""
        plan = self._recorder.plan
        self.card.setVisible(plan is not None)
        if plan is not None:
            self.card.show_recording(plan, self._recorder.state, stopping=self._recorder.stopping)

    def ask(self) -> None:
        """Ask what to record."""
        room = max(shutil.disk_usage(self._folder).free - RESERVE_BYTES, 0)
        name = QDateTime.currentDateTime().toString("yyyy-MM-dd_HHmm")
        dialog = self.dialog = RecordDialog(name, room, str(self._recorder.folder), self._page)
        dialog.accepted.connect(lambda: self._recorder.start(dialog.name.text().strip(), dialog.seconds))
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        """Take over another language."""
        if watched is self._page and event.type() == QEvent.Type.LanguageChange:
            self._say_words()
        return False

    def _say_words(self) -> None:
        self.action.setText(self.tr("Record…"))
        self.action.setToolTip(self.tr("Record what these sensors see"))
        self.action.setProperty("drawing", "record")
        self.action.setShortcut("Ctrl+Shift+R")
