"""The recordings that were made here, to be found again."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import QEvent, QSize, Qt, Signal
from PySide6.QtWidgets import QListWidget, QListWidgetItem, QVBoxLayout, QWidget

from fruitgui.gui.recorder_words import size_text
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.times import moment_text
from fruitgui.gui.widgets.cards import label
from fruitgui.gui.widgets.reach import reach
from fruitgui.station.recordings_made import MadeRecording

ROW = 60
MOST_LISTED = 200


class MadeList(QWidget):
    """A list of recordings.

    Attributes:
        chosen: the `Path` of one that the person chose.
    """

    chosen = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._made: Sequence[MadeRecording] = ()
        self._title = label("", "strong")
        self.list = QListWidget()
        reach(self.list)
        self.list.setVerticalScrollMode(QListWidget.ScrollMode.ScrollPerPixel)
        self.list.setUniformItemSizes(True)
        self.list.setMinimumHeight(2 * ROW)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(GRID)
        column.addWidget(self._title)
        column.addWidget(self.list, 1)
        self.list.itemClicked.connect(self._choose)
        self.list.itemActivated.connect(self._choose)
        self._say_words()

    def show_made(self, made: Sequence[MadeRecording]) -> None:
        """List these, the newest first."""
        if list(made) != list(self._made):
            self._made = tuple(made)
            self._fill()

    def lists(self, path: Path) -> bool:
        """Tell whether the recording at a path is listed."""
        return any(one.path == path for one in self._made)

    def choose_path(self, path: Path | None) -> None:
        """Mark the recording at a path, if it is listed; otherwise none."""
        for row in range(self.list.count()):
            item = self.list.item(row)
            if item.data(Qt.ItemDataRole.UserRole) == path:
                self.list.setCurrentItem(item)
                return
        self.list.clearSelection()
        self.list.setCurrentRow(-1)

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Take over another language."""
        if event.type() == QEvent.Type.LanguageChange:
            self._say_words()
            self._fill()
        super().changeEvent(event)

    def _fill(self) -> None:
        before = self.list.currentItem()
        path = None if before is None else before.data(Qt.ItemDataRole.UserRole)
        self.list.clear()
        for one in self._made[:MOST_LISTED]:
            item = QListWidgetItem(f"{one.name}\n{self._facts(one)}")
            item.setData(Qt.ItemDataRole.UserRole, one.path)
            item.setSizeHint(QSize(0, ROW))
            self.list.addItem(item)
        self.choose_path(path)

    def _facts(self, one: MadeRecording) -> str:
        facts = [moment_text(one.made_s), size_text(one.size)]
        if one.parts > 1:
            facts.append(self.tr("{count} parts").format(count=one.parts))
        if one.cut_off:
            facts.append(self.tr("cut off, usable up to there"))
        return " · ".join(facts)

    def _say_words(self) -> None:
        self._title.setText(self.tr("Recorded here"))
        self.list.setAccessibleName(self.tr("Recorded here"))

    def _choose(self, item: QListWidgetItem) -> None:
        self.chosen.emit(item.data(Qt.ItemDataRole.UserRole))
