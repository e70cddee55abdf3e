"""A lot as a file for others: the report, and the table of its fruit."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject, QStandardPaths, QUrl
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QFileDialog, QWidget

from fruitgui.gui.messages import Messages
from fruitgui.gui.steps.lots.report import doing_words, write_report
from fruitgui.gui.tasks import Job, TaskRunner
from fruitgui.gui.theme.kinds import KindMark
from fruitgui.gui.told import Told, Words
from fruitgui.progress import Cancelled, Progress
from fruitgui.records.lot import Lot
from fruitgui.records.lot_csv import write_lot
from fruitgui.records.store import Store


class HandingOn(QObject):
    """Asks where a file is to go, and writes it beside the window; a file that is there is asked about first."""

    def __init__(self, store: Store, tasks: TaskRunner, messages: Messages, window: QWidget) -> None:
        super().__init__(window)
        self._store, self._tasks, self._messages, self._window = store, tasks, messages, window
        self._folder = QStandardPaths.writableLocation(QStandardPaths.StandardLocation.DocumentsLocation)
        self.dialog: QFileDialog | None = None

    def ask_report(self, lot: Lot, marks: Sequence[KindMark]) -> None:
        """Ask where the report is to go; kinds have these marks."""
        self._ask(
            self.tr("Save the report"), self.tr("Report (*.pdf)"), lot, "pdf", partial(self.write_report, marks=marks)
        )

    def ask_table(self, lot: Lot) -> None:
        """Ask where the table is to go."""
        self._ask(self.tr("Save the table of fruit"), self.tr("Table (*.csv)"), lot, "csv", self.write_table)

    def write_report(self, lot: Lot, path: Path, marks: Sequence[KindMark] = ()) -> None:
        """Write the report."""

        def job(progress: Progress, cancelled: Cancelled) -> None:
            write_report(self._store, lot.key, path, self._store.now_s(), marks, progress, cancelled)

        self._run(lambda: self.tr("Report on lot {name}").format(name=lot.name), job, path)

    def write_table(self, lot: Lot, path: Path) -> None:
        """Write the table of fruit."""

        def job(progress: Progress, cancelled: Cancelled) -> None:
            write_lot(self._store, lot.key, path, lambda share, _: progress(share, path.name), cancelled)

        self._run(lambda: self.tr("Table of lot {name}").format(name=lot.name), job, path)

    def _run(self, name: Words, job: Job[None], path: Path) -> None:
        task = self._tasks.run(name, job, doing_words)
        task.succeeded.connect(lambda _: self._written(path))
        task.failed.connect(self._messages.error)

    def _written(self, path: Path) -> None:
        def told() -> Told:
            return Told(self.tr("{path} is written.").format(path=path), action=self.tr("Open"))

        def look() -> None:
            QDesktopServices.openUrl(QUrl.fromLocalFile(str(path)))

        self._messages.info(told, look)

    def _ask(self, title: str, kinds: str, lot: Lot, suffix: str, write: Callable[[Lot, Path], None]) -> None:
        dialog = QFileDialog(self._window, title, self._folder, kinds)
        dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
        dialog.setDefaultSuffix(suffix)  # before the question whether a file may be replaced
        word = self.tr("lot")
        dialog.selectFile(f"{file_name(word, lot.name)}.{suffix}")
        dialog.fileSelected.connect(lambda name: self._chosen(Path(name), lot, write))
        dialog.finished.connect(dialog.deleteLater)
        self.dialog = dialog
        dialog.open()

    def _chosen(self, path: Path, lot: Lot, write: Callable[[Lot, Path], None]) -> None:
        self._folder = str(path.parent)
        write(lot, path)


MOST_BYTES = 120
"""Of a proposed name: half of what file systems take, so that it can be written beside under a longer one."""


def file_name(word: str, name: str) -> str:
    """Return a name that every file system takes."""
    short = re.sub(r"[^\w.-]+", "-", name).encode()[:MOST_BYTES].decode(errors="ignore")
    plain = short.strip("-.")
    return f"{word}-{plain}" if plain else word
