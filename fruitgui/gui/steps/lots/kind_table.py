"""The kinds of a lot in rows: how many, mean and total volume, mass."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QFont, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from fruitgui.gui.steps.lots.figures import KindRow
from fruitgui.gui.theme.kinds import KindMark
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.fitting import fitted
from fruitgui.gui.widgets.kind_mark import paint_mark

ROW, HEAD = 28, 24
WIDEST = 1080
"""Pixels: beyond, a figure is too far from its kind's name to be read with it."""

FIGURE_WIDTH, NAME_WIDTH = 128, 130


class KindTable(QWidget):
    """One row for each kind: how many, mean and total volume, mass."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._rows: Sequence[KindRow] = ()
        self._marks: Mapping[str, KindMark] = {}
        self.setMaximumWidth(WIDEST)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        theme.changed.connect(self.update)

    def show_rows(self, rows: Sequence[KindRow], marks: Mapping[str, KindMark]) -> None:
        """Show other sums."""
        self._rows, self._marks = rows, marks
        self.setAccessibleName("; ".join(", ".join((row.name, row.fruit, row.mean, row.volume)) for row in rows))
        self.updateGeometry()
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(NAME_WIDTH + 4 * FIGURE_WIDTH, HEAD + ROW * max(len(self._rows), 1))

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the least size."""
        return QSize(NAME_WIDTH + 3 * FIGURE_WIDTH, self.sizeHint().height())

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        with QPainter(self) as painter:
            painter.setFont(self._theme.font("small"))
            painter.setPen(self._theme.colour("text_dim"))
            heads = (self.tr("Fruit"), self.tr("Mean volume"), self.tr("Total volume"), self.tr("Total mass"))
            self._write(painter, QRectF(0, 0, self.width(), HEAD), heads)
            painter.drawText(QRectF(0, 0, NAME_WIDTH, HEAD), Qt.AlignmentFlag.AlignVCenter, self.tr("Kind"))
            for number, row in enumerate(self._rows):
                self._paint_row(painter, row, QRectF(0, HEAD + number * ROW, self.width(), ROW))

    def _paint_row(self, painter: QPainter, row: KindRow, box: QRectF) -> None:
        theme = self._theme
        painter.setPen(theme.colour("line"))
        painter.drawLine(box.topLeft(), box.topRight())
        side = 20.0
        mark = self._marks.get(row.kind)
        if mark is not None:
            paint_mark(painter, QRectF(box.left(), box.center().y() - side / 2, side, side), mark)
        painter.setPen(theme.colour("text"))
        painter.setFont(theme.font("body", QFont.Weight.DemiBold))
        width = box.width() - len(self._columns()) * FIGURE_WIDTH + 44 - side - GRID
        name = fitted(painter, row.name, width)
        painter.drawText(box.adjusted(side + GRID, 0, 0, 0), Qt.AlignmentFlag.AlignVCenter, name)
        painter.setFont(theme.font("body"))
        self._write(painter, box, (row.fruit, row.mean, row.volume, row.mass))

    def _columns(self) -> tuple[int, ...]:
        """Return which columns there is room for: mass is the first to go."""
        return (0, 1, 2, 3) if self.width() >= self.sizeHint().width() else (0, 1, 2)

    def _write(self, painter: QPainter, box: QRectF, texts: Sequence[str]) -> None:
        right = box.right()
        for column in reversed(self._columns()):
            place = QRectF(right - FIGURE_WIDTH, box.top(), FIGURE_WIDTH, box.height())
            painter.drawText(place, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight, texts[column])
            right -= FIGURE_WIDTH
