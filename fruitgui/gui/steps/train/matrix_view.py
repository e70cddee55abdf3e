"""The confusion matrix: rows what the fruit are, columns what they were taken for, and how many of each are right."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from fruitgui.gui.kind_words import kind_name
from fruitgui.gui.steps.train.report import Matrix, MatrixRow, interval_text
from fruitgui.gui.theme.kinds import UNKNOWN_MARK, KindMark
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.fitting import fitted
from fruitgui.gui.widgets.kind_mark import paint_mark

TALLEST, LOWEST = 96.0, 22.0
MARK = 24.0
NAME, RIGHT = 190.0, 140.0
HEAD = 44.0


class MatrixView(QWidget):
    """Paints a `Matrix`; what is right in the colour of health, what is wrong in that of warning, by its share."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._matrix: Matrix | None = None
        self._marks: Mapping[str, KindMark] = {}
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        theme.changed.connect(self.update)

    def show_matrix(self, matrix: Matrix, marks: Mapping[str, KindMark]) -> None:
        """Show another matrix."""
        self._matrix, self._marks = matrix, marks
        rows = (f"{kind_name(row.kind)}: {interval_text(row.right)}" for row in matrix.rows)
        self.setAccessibleDescription("; ".join(rows))
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(640, 360)

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        matrix = self._matrix
        if matrix is None or not matrix.rows:
            return
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            height = min(max((self.height() - HEAD) / len(matrix.rows), LOWEST), TALLEST)
            width = min((self.width() - NAME - RIGHT) / len(matrix.columns), 1.6 * TALLEST)
            self._paint_head(painter, matrix, width)
            for number, row in enumerate(matrix.rows):
                self._paint_row(painter, matrix, row, HEAD + number * height, QSize(round(width), round(height)))

    def _paint_head(self, painter: QPainter, matrix: Matrix, width: float) -> None:
        theme, centre = self._theme, Qt.AlignmentFlag.AlignVCenter
        painter.setFont(theme.font("small"))
        painter.setPen(theme.colour("text_dim"))
        painter.drawText(QRectF(0, 0, NAME, HEAD), centre, self.tr("Is  ↓     taken for  →"))
        right = QRectF(NAME + width * len(matrix.columns) + GRID, 0, RIGHT, HEAD)
        painter.drawText(right, centre, self.tr("Right, % (95 %)"))
        for number, kind in enumerate(matrix.columns):
            box = QRectF(NAME + number * width, 0, width, HEAD - GRID)
            place = QRectF(0, 0, MARK + 4, MARK + 4)
            place.moveCenter(QPointF(box.center().x(), box.center().y()))
            paint_mark(painter, place, self._marks.get(kind, UNKNOWN_MARK))

    def _paint_row(self, painter: QPainter, matrix: Matrix, row: MatrixRow, top: float, cell: QSize) -> None:
        theme = self._theme
        middle = top + cell.height() / 2
        side = min(MARK, cell.height() - 4)
        paint_mark(painter, QRectF(0, middle - side / 2, side, side), self._marks.get(row.kind, UNKNOWN_MARK))
        painter.setFont(theme.font("body", QFont.Weight.Medium))
        painter.setPen(theme.colour("text"))
        words = QRectF(MARK + GRID, top, NAME - MARK - 2 * GRID, cell.height())
        name = fitted(painter, kind_name(row.kind), words.width())
        painter.drawText(words, Qt.AlignmentFlag.AlignVCenter, name)
        total = max(sum(row.counts), 1)
        for number, (kind, count) in enumerate(zip(matrix.columns, row.counts, strict=True)):
            box = QRectF(NAME + number * cell.width(), top, cell.width(), cell.height()).adjusted(1.5, 1.5, -1.5, -1.5)
            self._paint_cell(painter, box, count, count / total, right=kind == row.kind)
        painter.setFont(theme.font("small"))
        painter.setPen(theme.colour("text"))
        place = QRectF(NAME + cell.width() * len(matrix.columns) + GRID, top, RIGHT, cell.height())
        painter.drawText(place, Qt.AlignmentFlag.AlignVCenter, interval_text(row.right))

    def _paint_cell(self, painter: QPainter, box: QRectF, count: int, share: float, *, right: bool) -> None:
        theme = self._theme
        colour = QColor(theme.colour("good" if right else "bad"))
        colour.setAlphaF(0.12 + 0.55 * share if count else 0.0)
        painter.setBrush(colour)
        painter.setPen(QPen(theme.colour("line"), 2.0 if right else 1.0))
        painter.drawRoundedRect(box, 4, 4)
        painter.setFont(theme.font("title" if box.height() > 1.3 * MARK else "body", QFont.Weight.DemiBold))
        painter.setPen(theme.colour("text" if count else "text_dim"))
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, str(count) if count else "·")
