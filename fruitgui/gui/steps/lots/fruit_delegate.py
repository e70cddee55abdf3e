"""How a fruit is drawn in the table of a lot's fruit."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QFont, QImage, QPainter, QPainterPath
from PySide6.QtWidgets import QStyle, QStyledItemDelegate, QTableView

from fruitgui.gui.kind_words import kind_name
from fruitgui.gui.steps.lots.fruit_model import FRUIT, PICTURE
from fruitgui.gui.steps.lots.fruit_rows import COLUMNS, Column, correction_text
from fruitgui.gui.steps.lots.paged_model import Index
from fruitgui.gui.theme.kinds import UNKNOWN_MARK, KindMark
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.fitting import fitted
from fruitgui.gui.widgets.kind_mark import paint_mark
from fruitgui.records.fruit_record import FruitRecord

ROW = 56


class FruitDelegate(QStyledItemDelegate):
    """Paints pictures and kinds; all else is text."""

    def __init__(self, theme: Theme, view: QTableView) -> None:
        super().__init__(view)
        self._theme = theme
        self.marks: Mapping[str, KindMark] = {}

    def paint(self, painter: QPainter, option: Any, index: Index) -> None:  # noqa: ANN401 - its fields are not typed
        """Draw a cell."""
        column, fruit = COLUMNS[index.column()], index.data(FRUIT)
        box = QRectF(option.rect)
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        if option.state & QStyle.StateFlag.State_Selected:
            painter.fillRect(box, self._theme.colour("raised"))
        if isinstance(fruit, FruitRecord):
            if column is Column.PICTURE:
                self._paint_picture(painter, index.data(PICTURE), box)
                if option.state & QStyle.StateFlag.State_Selected:
                    painter.fillRect(QRectF(box.left(), box.top(), 3, box.height()), self._theme.colour("accent"))
            elif column is Column.KIND:
                self._paint_kind(painter, fruit, box.adjusted(GRID / 2, GRID / 2, -GRID, -GRID / 2))
            else:
                self._paint_text(painter, str(index.data()), fruit, box.adjusted(0, 0, -GRID, 0))
        painter.setPen(self._theme.colour("line"))
        painter.drawLine(box.bottomLeft(), box.bottomRight())
        painter.restore()

    def _paint_picture(self, painter: QPainter, image: object, box: QRectF) -> None:
        place = QRectF(0, 0, ROW - GRID, ROW - GRID)
        place.moveCenter(box.center())
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(self._theme.colour("picture"))
        path = QPainterPath()
        path.addRoundedRect(place, 6, 6)
        painter.drawPath(path)
        if isinstance(image, QImage):
            side = min(image.width(), image.height())
            middle = QRectF((image.width() - side) / 2, (image.height() - side) / 2, side, side)
            painter.setClipPath(path)
            painter.drawImage(place, image, middle)
            painter.setClipping(False)

    def _paint_kind(self, painter: QPainter, fruit: FruitRecord, box: QRectF) -> None:
        side = 26.0
        place = QRectF(box.left(), box.center().y() - side / 2, side, side)
        paint_mark(painter, place, self.marks.get(fruit.kind, UNKNOWN_MARK))
        words = box.adjusted(side + GRID, 0, 0, 0)
        painter.setFont(self._theme.font("body", QFont.Weight.DemiBold))
        painter.setPen(self._theme.colour("text" if fruit.counted else "text_dim"))
        more = correction_text(fruit)
        name = fitted(painter, kind_name(fruit.kind), words.width())
        if not more:
            painter.drawText(words, Qt.AlignmentFlag.AlignVCenter, name)
            return
        half = words.height() / 2
        upper = QRectF(words.left(), words.top(), words.width(), half)
        painter.drawText(upper, Qt.AlignmentFlag.AlignBottom, name)
        painter.setFont(self._theme.font("small"))
        painter.setPen(self._theme.colour("warn"))
        more = fitted(painter, more, words.width())
        painter.drawText(upper.translated(0, half), Qt.AlignmentFlag.AlignTop, more)

    def _paint_text(self, painter: QPainter, text: str, fruit: FruitRecord, box: QRectF) -> None:
        font = self._theme.font("body")
        font.setStrikeOut(not fruit.counted)
        painter.setFont(font)
        painter.setPen(self._theme.colour("text" if fruit.counted else "text_dim"))
        painter.drawText(box, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight, text)
