"""The table of fruit as Qt's view reads it, with a small picture for each."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from PySide6.QtCore import Qt
from PySide6.QtGui import QImage

from fruitgui.gui.steps.lots.fruit_rows import COLUMNS, Column, cell_text, column_word, correction_text
from fruitgui.gui.steps.lots.paged_model import Index, PagedModel
from fruitgui.records.fruit_record import FruitRecord
from fruitgui.station.sink import Crop

FRUIT = Qt.ItemDataRole.UserRole
PICTURE = Qt.ItemDataRole.UserRole + 1
MOST_PICTURES = 2_000
THUMB_PX = 96


class FruitModel(PagedModel[FruitRecord]):
    """The fruit that were found."""

    def __init__(self) -> None:
        super().__init__(len(COLUMNS))
        self._pictures: dict[int, QImage] = {}
        self._sorted = (Column.NUMBER, False)

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:  # noqa: ANN401 - Qt's
        """Return a cell's text, or the whole fruit, or its picture."""
        fruit = self.pages.row(index.row())
        if fruit is None:
            return None
        column = COLUMNS[index.column()]
        if role == Qt.ItemDataRole.DisplayRole:
            return cell_text(fruit, column)
        if role == FRUIT:
            return fruit
        if role == PICTURE:
            return self._pictures.get(fruit.key)
        if role == Qt.ItemDataRole.TextAlignmentRole and column not in (Column.KIND, Column.PICTURE):
            return Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight
        if role == Qt.ItemDataRole.AccessibleTextRole and column is Column.KIND:
            return " ".join((cell_text(fruit, column), correction_text(fruit)))
        return None

    def headerData(  # noqa: N802 - Qt's name
        self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole
    ) -> Any:  # noqa: ANN401 - Qt's
        """Return the head of a column."""
        if orientation != Qt.Orientation.Horizontal:
            return None
        column = COLUMNS[section]
        if role == Qt.ItemDataRole.DisplayRole:
            by, falling = self._sorted
            return column_word(column) + ((" ↓" if falling else " ↑") if column is by else "")
        if role == Qt.ItemDataRole.TextAlignmentRole:
            left = column in (Column.KIND, Column.PICTURE)
            side = Qt.AlignmentFlag.AlignLeft if left else Qt.AlignmentFlag.AlignRight
            return Qt.AlignmentFlag.AlignVCenter | side
        return None

    def show_order(self, column: Column, *, falling: bool) -> None:
        """Say in the head by what the fruit are sorted."""
        self._sorted = (column, falling)
        self.headerDataChanged.emit(Qt.Orientation.Horizontal, 0, len(COLUMNS) - 1)

    def take_pictures(self, pictures: Mapping[int, QImage]) -> None:
        """Show pictures, by the keys of their fruit; the oldest ones are let go."""
        self._pictures.update(pictures)
        while len(self._pictures) > MOST_PICTURES:
            del self._pictures[next(iter(self._pictures))]
        self.redraw()


def thumbnails(crops: Mapping[int, Crop]) -> dict[int, QImage]:
    """Return pictures of fruit as small as the table shows them; what is no picture is left out."""
    found = {}
    for key, crop in crops.items():
        image = QImage.fromData(crop.data)
        if not image.isNull():
            keep, smooth = Qt.AspectRatioMode.KeepAspectRatioByExpanding, Qt.TransformationMode.SmoothTransformation
            found[key] = image.scaled(THUMB_PX, THUMB_PX, keep, smooth)
    return found
