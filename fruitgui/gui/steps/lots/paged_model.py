"""A list as Qt's views read it, filled a page at a time while it is looked at."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Generic, TypeVar

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QObject, QPersistentModelIndex, Signal
from PySide6.QtWidgets import QAbstractItemView

from fruitgui.gui.steps.lots.paged import Pages

R = TypeVar("R")
Index = QModelIndex | QPersistentModelIndex


class PagedModel(QAbstractTableModel, Generic[R]):
    """Rows that are asked for as they come into view; those before them are shown until the answer is there.

    Attributes:
        wanted: the number of a page that is to be given to `take`.
        taken: a page was.
    """

    wanted = Signal(int)
    taken = Signal()

    def __init__(self, columns: int, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.pages: Pages[R] = Pages()
        self._columns = columns
        self._fresh = True
        self._asked: int | None = None
        self._seen = (0, 0)

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: N802, B008 - Qt's
        """Return how many rows there are, held or not."""
        return 0 if parent.isValid() else self.pages.found

    def columnCount(self, parent: Index = QModelIndex()) -> int:  # noqa: N802, B008 - Qt's
        """Return how many columns there are."""
        return 0 if parent.isValid() else self._columns

    def restart(self) -> None:
        """Ask for another list from its beginning."""
        self._fresh, self._asked, self._seen = True, 0, (0, 0)
        self.wanted.emit(0)

    def refresh(self) -> None:
        """Ask again for what is in view: it may have changed."""
        self.pages.make_stale()
        self._asked = None
        if self.pages.found:
            self.look(*self._seen)
        else:
            self.restart()

    def look(self, first: int, last: int) -> None:
        """Take note that the rows from `first` to `last` are in view."""
        self._seen = (first, last)
        page = None if self._fresh else self.pages.wanted(first, last)
        if page is not None and page != self._asked:
            self._asked = page
            self.wanted.emit(page)

    def take(self, page: int, rows: Sequence[R], found: int) -> None:
        """Take the rows of a page, and how many rows there are in all."""
        self._asked = None
        if self._fresh:
            self._fresh = False
            self.beginResetModel()
            self.pages.clear(found)
            self.pages.put(page, rows, found)
            self.endResetModel()
        else:
            self._put(page, rows, found)
        self.taken.emit()
        self.look(*self._seen)

    def row_of(self, key: int) -> int | None:
        """Return the number of the row with a key, if it is held."""
        return next((number for number, row in self.pages.held() if getattr(row, "key", None) == key), None)

    def redraw(self) -> None:
        """Let every row be drawn again: something beside the rows changed."""
        if self.pages.found:
            self.dataChanged.emit(self.index(0, 0), self.index(self.pages.found - 1, self._columns - 1))

    def _put(self, page: int, rows: Sequence[R], found: int) -> None:
        before = self.pages.found
        if found > before:
            self.beginInsertRows(QModelIndex(), before, found - 1)
            self.pages.put(page, rows, found)
            self.endInsertRows()
        elif found < before:
            self.beginRemoveRows(QModelIndex(), found, before - 1)
            self.pages.put(page, rows, found)
            self.endRemoveRows()
        else:
            self.pages.put(page, rows, found)
        first, last = page * self.pages.size, min((page + 1) * self.pages.size, found) - 1
        if last >= first:
            self.dataChanged.emit(self.index(first, 0), self.index(last, self._columns - 1))


def visible_rows(view: QAbstractItemView) -> tuple[int, int]:
    """Return the numbers of the first and the last row in view."""
    model = view.model()
    rows = 0 if model is None else model.rowCount()
    place = view.viewport().rect()
    first, last = view.indexAt(place.topLeft()), view.indexAt(place.bottomLeft())
    return (first.row() if first.isValid() else 0), (last.row() if last.isValid() else rows - 1)
