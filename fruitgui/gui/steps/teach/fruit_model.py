"""The fruit of the shelf as a list that Qt shows; pictures are fetched beside the window as they come into view."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Sequence

from PySide6.QtCore import QAbstractListModel, QModelIndex, QObject, QPersistentModelIndex, Qt, QTimer, Signal

from fruitgui.gui.queries import Queries
from fruitgui.gui.view_pictures import ViewPictures, view_pictures
from fruitgui.records.crops import Crops

Index = QModelIndex | QPersistentModelIndex
Views = tuple[ViewPictures, ...]

MOST_PICTURES = 600
"""Fruit whose pictures are held, some 0.2 MB each."""

AT_ONCE = 12
"""Fruit whose pictures are read in one go, so that the newest in view never wait long."""

PAGE = 150
"""Fruit that are laid out at once; more come as one scrolls down to them."""

KEY = int(Qt.ItemDataRole.UserRole)


class FruitModel(QAbstractListModel):
    """Keys of fruit in rows; what is painted is asked for by key.

    Args:
        crops: of the store.
        described: says what a fruit is, for screen readers.

    Attributes:
        came: pictures were fetched.
    """

    came = Signal()

    def __init__(self, crops: Crops, described: Callable[[int], str], parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._crops = crops
        self._described = described
        self._keys: list[int] = []
        self._rows = 0
        self._views: OrderedDict[int, Views] = OrderedDict()
        self._wanted: OrderedDict[int, None] = OrderedDict()
        self._asked: set[int] = set()
        self.queries = Queries(self)
        self._soon = QTimer(self, singleShot=True, interval=0)
        self._soon.timeout.connect(self._fetch)

    @property
    def keys(self) -> Sequence[int]:
        """The fruit in the order in which they are shown."""
        return self._keys

    def rowCount(self, parent: Index | None = None) -> int:  # noqa: N802 - Qt's name
        """Return the number of fruit."""
        return 0 if parent is not None and parent.isValid() else self._rows

    def canFetchMore(self, _parent: Index) -> bool:  # noqa: N802 - Qt's name
        """Tell whether there are fruit further down."""
        return self._rows < len(self._keys)

    def fetchMore(self, _parent: Index) -> None:  # noqa: N802 - Qt's name
        """Show some of them too."""
        self._show_rows(self._rows + PAGE)

    def _show_rows(self, rows: int) -> None:
        rows = min(rows, len(self._keys))
        if rows > self._rows:
            self.beginInsertRows(QModelIndex(), self._rows, rows - 1)
            self._rows = rows
            self.endInsertRows()

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> object:
        """Return a fruit's key, or its description."""
        if not index.isValid():
            return None
        key = self._keys[index.row()]
        if role == KEY:
            return key
        if role in (Qt.ItemDataRole.AccessibleTextRole, Qt.ItemDataRole.ToolTipRole):
            return self._described(key)
        return None

    def show_keys(self, keys: Sequence[int]) -> None:
        """Show other fruit; where some only left, the rest keep their places."""
        gone = set(self._keys) - set(keys)
        if len(gone) <= AT_ONCE and [key for key in self._keys if key not in gone] == list(keys):
            for key in gone:
                self._take_out(self._keys.index(key))
        elif list(keys) != self._keys:
            self.beginResetModel()
            self._keys = list(keys)
            self._rows = min(PAGE, len(self._keys))
            self.endResetModel()

    def _take_out(self, row: int) -> None:
        if row >= self._rows:
            del self._keys[row]
            return
        self.beginRemoveRows(QModelIndex(), row, row)
        del self._keys[row]
        self._rows -= 1
        self.endRemoveRows()

    def row(self, key: int) -> int:
        """Return a fruit's row, which is shown from here on; −1 where it is none of these fruit."""
        row = self._keys.index(key) if key in self._keys else -1
        self._show_rows(row + 1)
        return row

    def views(self, key: int) -> Views | None:
        """Return a fruit's pictures; None while they are fetched, which this begins."""
        views = self._views.get(key)
        if views is not None:
            self._views.move_to_end(key)
        elif key not in self._asked:
            self._wanted[key] = None
            self._wanted.move_to_end(key)
            self._soon.start()
        return views

    def rest(self) -> None:
        """Fetch nothing more for now."""
        self._wanted.clear()
        self._asked.clear()
        self.queries.rest()

    def _fetch(self) -> None:
        """Ask for the newest of what is wanted; what was scrolled past long ago is forgotten."""
        if self._asked or not self._wanted:
            return
        keys = [self._wanted.popitem()[0] for _ in range(min(AT_ONCE, len(self._wanted)))]
        self._asked.update(keys)
        crops = self._crops
        self.queries.ask("pictures", lambda: {key: view_pictures(crops.of("taught", key)) for key in keys}, self._take)

    def _take(self, views: dict[int, Views]) -> None:
        self._asked.clear()
        self._views.update(views)
        while len(self._views) > MOST_PICTURES:
            self._views.popitem(last=False)
        while len(self._wanted) > MOST_PICTURES // 2:
            self._wanted.popitem(last=False)
        self.came.emit()
        self._fetch()
