"""Backup and restore of all that is kept of a line."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QEvent, QObject, QPoint, QUrl
from PySide6.QtGui import QAction, QDesktopServices
from PySide6.QtWidgets import QFileDialog, QMenu, QMessageBox, QWidget

from fruitgui.errors import FruitguiError, InputError
from fruitgui.gui.messages import Messages
from fruitgui.gui.tasks import TaskRunner
from fruitgui.gui.times import moment_text
from fruitgui.gui.told import Told
from fruitgui.progress import Cancelled, Progress
from fruitgui.records.backup import Backup, back_up, backup_path
from fruitgui.records.restore import forget_restore, is_prepared, prepare_restore
from fruitgui.records.unpacking import find_backups


class StoreMenu(QObject):
    """The menu, and what it does.

    Args:
        folder: the workspace.
        counting: whether a lot runs: nothing is restored meanwhile.
    """

    def __init__(
        self, folder: Path, tasks: TaskRunner, messages: Messages, window: QWidget, counting: Callable[[], bool]
    ) -> None:
        super().__init__(window)
        self._folder, self._tasks, self._messages, self._window = folder, tasks, messages, window
        self._counting = counting
        self.menu = QMenu(window)
        self.menu.setToolTipsVisible(True)
        self.back_up_now, self.back_up_to = QAction(self.menu), QAction(self.menu)
        self.restore, self.forget, self.show_folder = QAction(self.menu), QAction(self.menu), QAction(self.menu)
        self.dialog: QFileDialog | None = None
        self.question: QMessageBox | None = None
        for action in (self.back_up_now, self.back_up_to, self.restore, self.forget, self.show_folder):
            self.menu.addAction(action)
        self.menu.insertSeparator(self.restore)
        self.menu.insertSeparator(self.show_folder)
        self.back_up_now.triggered.connect(self._back_up_here)
        self.back_up_to.triggered.connect(self._ask_where)
        self.restore.triggered.connect(self._ask_which)
        self.forget.triggered.connect(self._forget)
        self.show_folder.triggered.connect(self._show_folder)
        window.installEventFilter(self)
        self._say_words()

    def open_at(self, place: QPoint) -> None:
        """Open the menu somewhere on the screen."""
        prepared = is_prepared(self._folder)
        self.restore.setVisible(not prepared)
        self.forget.setVisible(prepared)
        self.restore.setEnabled(not self._counting())
        self.menu.popup(place)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        """Take over another language."""
        if watched is self._window and event.type() == QEvent.Type.LanguageChange:
            self._say_words()
        return False

    def write_backup(self, path: Path) -> None:
        """Write a backup beside the window; counting goes on."""

        def job(progress: Progress, cancelled: Cancelled) -> Backup:
            return back_up(self._folder, path, None, progress, cancelled)

        task = self._tasks.run(lambda: self.tr("Backup"), job)
        task.succeeded.connect(lambda _: self._messages.good(lambda: self._backed_up(path)))
        task.failed.connect(self._messages.error)

    def lay_ready(self, path: Path) -> None:
        """Check a backup and lay it ready for the next start."""

        def job(progress: Progress, cancelled: Cancelled) -> Backup:
            backup = prepare_restore(self._folder, path, time.time(), progress, cancelled)
            if self._counting():  # begun while this was checked: its fruit would be kept aside
                forget_restore(self._folder)
                raise self._lot_runs()
            return backup

        task = self._tasks.run(lambda: self.tr("Checking the backup"), job)
        task.succeeded.connect(self._laid_ready)
        task.failed.connect(self._messages.error)

    def _backed_up(self, path: Path) -> Told:
        return Told(self.tr("{path} holds all of it.").format(path=path))

    def _say_words(self) -> None:
        for action, text, tip in (
            (self.back_up_now, self.tr("Back up now"), self.tr("Keep a copy of all records in this line's folder")),
            (self.back_up_to, self.tr("Back up to …"), self.tr("Keep a copy somewhere else, for example on a stick")),
            (self.restore, self.tr("Restore a backup …"), self.tr("Go back to a copy; nothing runs meanwhile")),
            (self.forget, self.tr("Do not restore after all"), self.tr("Leave everything as it is at the next start")),
            (self.show_folder, self.tr("Show the folder"), self.tr("Open the folder that holds this line's files")),
        ):
            action.setText(text)
            action.setToolTip(tip)

    def _back_up_here(self) -> None:
        self.write_backup(backup_path(self._folder, time.time()))

    def _ask_where(self) -> None:
        name = str(Path.home() / backup_path(self._folder, time.time()).name)
        dialog = QFileDialog(self._window, self.tr("Back up to"), name, self.tr("Backup (*.zip)"))
        dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
        dialog.setDefaultSuffix("zip")
        dialog.selectFile(name)
        dialog.fileSelected.connect(self._where)
        self._open(dialog)

    def _where(self, name: str) -> None:
        self.write_backup(Path(name))

    def _ask_which(self) -> None:
        if self._counting():
            self._messages.error(self._lot_runs())
            return
        there = find_backups(self._folder)
        start = str(there[0]) if there else str(self._folder)
        dialog = QFileDialog(self._window, self.tr("Which backup?"), start, self.tr("Backup (*.zip)"))
        dialog.setFileMode(QFileDialog.FileMode.ExistingFile)
        if there:
            dialog.selectFile(start)
        dialog.fileSelected.connect(self._which)
        self._open(dialog)

    def _lot_runs(self) -> InputError:
        return InputError("lot_runs", self.tr("A lot is running."), self.tr("End it before you restore a backup."))

    def _which(self, name: str) -> None:
        question = QMessageBox(self._window)
        question.setIcon(QMessageBox.Icon.NoIcon)
        question.setWindowTitle(self.tr("Restore a backup"))
        question.setText(self.tr("Restore {name} at the next start?").format(name=Path(name).name))
        question.setInformativeText(
            self.tr(
                "Lots, fruit, taught fruit, models and settings go back to what they were then. What is there now is "
                "kept in a folder of its own."
            )
        )
        yes = question.addButton(self.tr("Restore"), QMessageBox.ButtonRole.AcceptRole)
        question.addButton(QMessageBox.StandardButton.Cancel)
        yes.clicked.connect(lambda: self.lay_ready(Path(name)))
        question.finished.connect(question.deleteLater)
        self.question = question
        question.open()

    def _laid_ready(self, backup: Backup) -> None:
        self._messages.info(lambda: self._whole(backup), self._close)

    def _whole(self, backup: Backup) -> Told:
        text = self.tr("The backup of {when} is whole. Close the window and start again: it is put in place then.")
        return Told(text.format(when=moment_text(backup.made_s)), action=self.tr("Close now"))

    def _close(self) -> None:
        self._window.window().close()

    def _forget(self) -> None:
        try:
            forget_restore(self._folder)
        except FruitguiError as error:
            self._messages.error(error)
            return
        self._messages.info(lambda: Told(self.tr("Everything stays as it is at the next start.")))

    def _show_folder(self) -> None:
        QDesktopServices.openUrl(QUrl.fromLocalFile(str(self._folder)))

    def _open(self, dialog: QFileDialog) -> None:
        dialog.finished.connect(dialog.deleteLater)
        self.dialog = dialog
        dialog.open()
