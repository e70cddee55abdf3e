"""What the teaching screen asks before it does something: which file, for which fruit, whether for good."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path

from PySide6.QtCore import QCoreApplication, Qt
from PySide6.QtWidgets import QFileDialog, QInputDialog, QMessageBox, QWidget

from fruitgui.gui.kind_book import KindBook
from fruitgui.gui.steps.teach.classroom import Classroom
from fruitgui.gui.steps.teach.densities import DensitiesDialog
from fruitgui.gui.steps.teach.desk import KindLine
from fruitgui.gui.theme.kinds import UNKNOWN, KindMark

translate = QCoreApplication.translate


class Asking:
    """Asks, and lets the room do what was answered.

    Args:
        room: does it.
        over: the screen that the questions are shown over.
    """

    def __init__(self, room: Classroom, over: QWidget) -> None:
        self._room = room
        self._over = over

    def remove(self, fruit: Sequence[int]) -> None:
        """Ask whether fruit are to be forgotten for good."""
        text = translate("TeachPage", "Remove {count} fruit with their pictures? This cannot be undone.")
        title = translate("TeachPage", "Remove for good")
        box = QMessageBox(QMessageBox.Icon.Question, title, text.format(count=len(fruit)), parent=self._over)
        keep = box.addButton(translate("TeachPage", "Keep"), QMessageBox.ButtonRole.RejectRole)
        remove = box.addButton(translate("TeachPage", "Remove"), QMessageBox.ButtonRole.DestructiveRole)
        remove.clicked.connect(partial(self._room.remove, fruit))
        box.setDefaultButton(keep)
        box.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        box.open()

    def densities(self, lines: Sequence[KindLine], marks: Mapping[str, KindMark], book: KindBook) -> None:
        """Ask for the density of each kind, and write it into the book."""
        kinds = [line for line in lines if line.kind != UNKNOWN]
        dialog = DensitiesDialog(kinds, marks, book.densities_g_ml, self._over)
        dialog.accepted.connect(lambda: book.type_densities(dialog.typed))
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.open()

    def recording(self) -> None:
        """Ask for a recording whose fruit are to come in."""
        kinds = translate("TeachPage", "Recordings (*.mcap *.bag);;All files (*)")
        title = translate("TeachPage", "Choose a recording")
        path, _ = QFileDialog.getOpenFileName(self._over, title, "", kinds)
        if path:
            self._room.lessons.open(Path(path))

    def labels(self) -> None:
        """Ask for a labels file, and for which fruit it is."""
        question = translate("TeachPage", "For which fruit are the labels?")
        source = self._source(self._room.sources(named=False), question)
        if source:
            title, kinds = translate("TeachPage", "Choose a labels file"), translate("TeachPage", "Labels (*.csv)")
            path, _ = QFileDialog.getOpenFileName(self._over, title, "", kinds)
            if path:
                self._room.import_labels(source, Path(path))

    def where_to_export(self) -> None:
        """Ask which labels are to be written, and where."""
        source = self._source(self._room.sources(named=True), translate("TeachPage", "The labels of which fruit?"))
        if source:
            title, kinds = translate("TeachPage", "Write labels"), translate("TeachPage", "Labels (*.csv)")
            name = f"{Path(source).stem.replace(':', '.')}.csv"
            path, _ = QFileDialog.getSaveFileName(self._over, title, name, kinds)
            if path:
                self._room.export(source, Path(path))

    def _source(self, sources: list[str], question: str) -> str:
        """Return the one source, or the one that a person chooses among several; empty for none."""
        if len(sources) < 2:
            return sources[0] if sources else ""
        title = translate("TeachPage", "Labels")
        chosen, good = QInputDialog.getItem(self._over, title, question, sources, 0, False)
        return chosen if good else ""
