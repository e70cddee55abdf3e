"""What a person sees when the records cannot be opened: what is wrong, and the ways out of it."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from PySide6.QtCore import QCoreApplication, QEvent, Qt
from PySide6.QtWidgets import QDialog, QHBoxLayout, QProgressBar, QPushButton, QVBoxLayout, QWidget

from fruitgui.errors import FruitguiError, WorldError
from fruitgui.gui import error_words
from fruitgui.gui.tasks import Job, Task, TaskRunner
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.times import moment_text
from fruitgui.gui.told import Words
from fruitgui.gui.widgets.cards import label, set_health
from fruitgui.progress import Cancelled, Progress
from fruitgui.records.backup import Backup
from fruitgui.records.condition import set_aside
from fruitgui.records.migrating import NEWER
from fruitgui.records.restore import restore
from fruitgui.records.told import DAMAGED, FAILED
from fruitgui.records.unpacking import last_good_backup

T = TypeVar("T")

WIDTH = 620

translate = QCoreApplication.translate


class StoreTrouble(QDialog):
    """Names what is wrong; accepted means that opening may be tried again, rejected that the person gives up.

    Nothing is deleted: a restore keeps what is there in a folder of its own, and a damaged file is only renamed.

    Args:
        folder: the workspace.
        error: with which its store could not be opened.
    """

    def __init__(self, folder: Path, error: FruitguiError, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._folder, self._error = folder, error
        self._backup: Backup | None = None
        self._tasks = TaskRunner(self)
        self._what, self._remedy, self._state = label("", "strong"), label(""), label("", "dim")
        self._place = label(error.file or str(folder), "small")
        self._bar = QProgressBar()
        self.restore, self.anew = QPushButton(), QPushButton()
        self.again, self.leave = QPushButton(), QPushButton()
        self._lay_out()
        self._say_words()
        self._connect()
        if self.damaged or error.code == NEWER:
            self._look()
        else:
            self._offer()

    @property
    def damaged(self) -> bool:
        """Whether the file itself is what is wrong, so that it can be set aside and a backup is the best way out."""
        return self._error.code in (DAMAGED, FAILED)

    @property
    def busy(self) -> bool:
        """Whether a backup is being looked for or restored."""
        return bool(self._tasks.running)

    def done(self, result: int) -> None:
        """End what runs, then close."""
        self._tasks.close()
        super().done(result)

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Take over another language."""
        if event.type() == QEvent.Type.LanguageChange:
            self._say_words()
            if not self.busy:
                self._offer()
        super().changeEvent(event)

    def _lay_out(self) -> None:
        title = label("", "page")
        self._title = title
        for one in (self._what, self._place, self._remedy, self._state):
            one.setWordWrap(True)
            one.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        set_health(self._what, "bad")
        self._bar.setRange(0, 0)
        self._bar.setTextVisible(False)
        buttons = QHBoxLayout()
        buttons.setSpacing(GRID)
        buttons.addWidget(self.leave)
        buttons.addStretch()
        for button in (self.again, self.anew, self.restore):
            buttons.addWidget(button)
        column = QVBoxLayout(self)
        column.setContentsMargins(3 * GRID, 3 * GRID, 3 * GRID, 3 * GRID)
        column.setSpacing(2 * GRID)
        for widget in (title, self._what, self._place, self._remedy, self._state, self._bar):
            column.addWidget(widget)
        column.addStretch()
        column.addLayout(buttons)
        self.resize(WIDTH, self.sizeHint().height())  # a least width would let it be narrower than its buttons

    def _say_words(self) -> None:
        self.setWindowTitle(self.tr("fruitgui: the records cannot be opened"))
        self._title.setText(self.tr("The records cannot be opened"))
        told = error_words.told(self._error)
        self._what.setText(told.what)
        self._remedy.setText(told.remedy)
        for button, text, tip in (
            (self.again, self.tr("Try again"), self.tr("Try to open the records once more")),
            (
                self.anew,
                self.tr("Begin anew"),
                self.tr("Keep the damaged file aside, unharmed, and begin an empty one"),
            ),
            (self.restore, self.tr("Restore"), self.tr("Go back to this backup; what is there now is kept aside")),
            (self.leave, self.tr("Close"), self.tr("Change nothing and end the program")),
        ):
            button.setText(text)
            button.setToolTip(tip)
            button.setAccessibleName(text)

    def _connect(self) -> None:
        self.again.clicked.connect(self.accept)
        self.leave.clicked.connect(self.reject)
        self.anew.clicked.connect(self._begin_anew)
        self.restore.clicked.connect(self._restore)

    def _look(self) -> None:
        folder = self._folder

        def job(progress: Progress, cancelled: Cancelled) -> Backup | None:  # noqa: ARG001 - how long is not known
            return last_good_backup(folder, cancelled)

        self._run(lambda: translate("StoreTrouble", "Looking for the last good backup …"), job, self._found)

    def _restore(self) -> None:
        folder, backup = self._folder, self._backup
        if backup is None:
            return

        def job(progress: Progress, cancelled: Cancelled) -> None:
            restore(folder, backup.path, time.time(), progress, cancelled)

        self._run(lambda: translate("StoreTrouble", "Restoring the backup …"), job, self._restored)

    def _run(self, words: Words, job: Job[T], done: Callable[[T], None]) -> None:
        self._state.setText(words())
        self._bar.show()
        for button in (self.again, self.anew, self.restore):
            button.setEnabled(False)
        task: Task[T] = self._tasks.run(words, job)
        task.succeeded.connect(done)
        task.failed.connect(self._failed)

    def _found(self, backup: Backup | None) -> None:
        self._backup = backup
        self._offer()

    def _restored(self, _: None) -> None:
        self.accept()

    def _failed(self, error: FruitguiError) -> None:
        self._offer()
        told = error_words.told(error)
        self._state.setText(f"{told.what} {told.remedy}")

    def _offer(self) -> None:
        """Offer the ways out that there are, the best as the main one."""
        backup = self._backup
        self._bar.hide()
        self.restore.setVisible(backup is not None)
        self.anew.setVisible(self.damaged)
        for button in (self.again, self.anew, self.restore):
            button.setEnabled(True)
        if backup is not None:
            when = moment_text(backup.made_s)
            self._state.setText(
                self.tr("The last good backup is of {when}. What was counted after it is kept aside.").format(when=when)
            )
            self.restore.setText(self.tr("Restore the backup of {when}").format(when=when))
        elif self.damaged:
            self._state.setText(self.tr("There is no good backup in this line's folder."))
        else:
            self._state.setText(self.tr("Nothing was changed, and nothing is lost."))
        main = self.restore if backup is not None and self.damaged else self.again
        for button in (self.again, self.restore):
            button.setProperty("role", "main" if button is main else "plain")
            button.style().unpolish(button)
            button.style().polish(button)
        main.setDefault(True)
        main.setFocus()

    def _begin_anew(self) -> None:
        damaged = None if self._error.file is None else Path(self._error.file)
        if damaged is not None and damaged.exists() and set_aside(damaged) is None:
            self._state.setText(self.tr("{file} cannot be renamed. Check that its folder may be written to.").format(
                file=damaged))  # fmt: skip
            return
        self.accept()


def opened(open_: Callable[[], T], trouble: Callable[[FruitguiError], StoreTrouble]) -> T:
    """Return what `open_` opens, tried again as long as the person finds a way out.

    Args:
        open_: opens a store, or what holds one.
        trouble: makes the window that asks.

    Raises:
        WorldError: the person gave up.
    """
    while True:
        try:
            return open_()
        except WorldError as error:
            dialog = trouble(error)
            dialog.exec()
            tried = dialog.result() == QDialog.DialogCode.Accepted
            dialog.deleteLater()
            if not tried:
                raise
