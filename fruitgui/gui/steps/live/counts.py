"""The counts: the largest thing on the screen, read from two metres away."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPaintEvent, QPixmap
from PySide6.QtWidgets import QSizePolicy, QWidget

from fruitgui.gui.drawn import KindLine
from fruitgui.gui.numbers import THIN, count_text, number_text
from fruitgui.gui.theme.stamps import drawn_pixmap, stamp
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.kind_mark import paint_mark

TALLEST, LOWEST = 84, 40
ROOMY = 52
"""Rows at least so high have larger names."""

TOTAL, TOTAL_FIGURE_PX = 48, 36
"""The row of all fruit together, and its figure."""

FIGURE_SHARE = 0.78
SMALLEST_FIGURE_PX, LARGEST_FIGURE_PX = 28, 64
"""Counts take so much of their row's height; from 40 pixels on they are read from two metres away."""


class CountsView(QWidget):
    """A row for each kind, and all of them together above."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._lines: tuple[KindLine, ...] = ()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(300, 200)
        theme.changed.connect(self.update)

    def show_lines(self, lines: Sequence[KindLine]) -> None:
        """Show other counts."""
        if tuple(lines) != self._lines:
            self._lines = tuple(lines)
            said = "; ".join(f"{line.name}: {line.count}" for line in lines)
            self.setAccessibleDescription(said)
            self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(400, 56 + 64 * max(len(self._lines), 4))

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            top = self._paint_total(painter)
            rows = max(len(self._lines), 1)
            height = min(max((self.height() - top) / rows, LOWEST), TALLEST)
            for number, line in enumerate(self._lines):
                drawn = self._row(line, height, ruled=number > 0)
                painter.drawPixmap(QPointF(0, top + number * height), drawn)

    def _paint_total(self, painter: QPainter) -> float:
        theme = self._theme
        count = sum(line.count for line in self._lines)
        litres = sum(line.total_l for line in self._lines)
        rate = sum(line.per_minute for line in self._lines)
        box = QRectF(0, 0, self.width(), TOTAL)
        painter.setPen(theme.colour("text"))
        painter.setFont(theme.font("title", QFont.Weight.DemiBold))
        painter.drawText(box, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, self.tr("All fruit"))
        painter.setFont(self._figure(TOTAL_FIGURE_PX))
        painter.drawText(box, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight, count_text(count))
        right = box.right() - QFontMetricsF(painter.font()).horizontalAdvance(count_text(count)) - 1.5 * GRID
        painter.setFont(theme.font("small"))
        painter.setPen(theme.colour("text_dim"))
        text = self.tr("{litres} · {rate}/min").format(litres=f"{number_text(litres, 1)}{THIN}l", rate=count_text(rate))
        box.setRight(right)
        painter.drawText(box, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight, text)
        return TOTAL

    def _figure(self, size_px: float) -> QFont:
        font = self._theme.font("figure", QFont.Weight.DemiBold)
        font.setPixelSize(round(size_px))
        return font

    def _row(self, line: KindLine, height: float, *, ruled: bool) -> QPixmap:
        """Return a kind's row; of all rows few change from look to look."""
        theme, box, ratio = self._theme, QRectF(0, 0, self.width(), height), self.devicePixelRatioF()
        key = ("count", line, box.width(), height, ruled, ratio, theme.name, theme.text_scale, self.tr("mean {volume}"))
        return stamp(
            key,
            lambda: drawn_pixmap(
                box.width(), height, ratio, lambda painter: self._paint_line(painter, line, box, ruled=ruled)
            ),
        )

    def _paint_line(self, painter: QPainter, line: KindLine, box: QRectF, *, ruled: bool) -> None:
        theme = self._theme
        if ruled:
            painter.setPen(theme.colour("line"))
            painter.drawLine(box.topLeft(), box.topRight())
        side = min(box.height() * 0.62, 44.0)
        paint_mark(painter, QRectF(0, box.center().y() - side / 2, side, side), line.mark)
        painter.setFont(self._figure(min(max(FIGURE_SHARE * box.height(), SMALLEST_FIGURE_PX), LARGEST_FIGURE_PX)))
        painter.setPen(theme.colour("text" if line.count else "text_dim"))
        count = count_text(line.count)
        width = QFontMetricsF(painter.font()).horizontalAdvance(count)
        painter.drawText(box, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight, count)
        words = QRectF(side + 1.5 * GRID, box.top(), box.width() - side - width - 3 * GRID, box.height())
        self._paint_words(painter, line, words)

    def _paint_words(self, painter: QPainter, line: KindLine, box: QRectF) -> None:
        theme = self._theme
        middle = box.center().y()
        two = bool(line.count)
        painter.setFont(theme.font("title" if box.height() >= ROOMY else "body", QFont.Weight.Medium))
        painter.setPen(theme.colour("text"))
        name = QFontMetricsF(painter.font()).elidedText(line.name, Qt.TextElideMode.ElideRight, box.width())
        left = Qt.AlignmentFlag.AlignLeft
        if not two:
            painter.drawText(box, left | Qt.AlignmentFlag.AlignVCenter, name)
            return
        painter.drawText(QRectF(box.left(), box.top(), box.width(), middle - box.top() + 2),
                         left | Qt.AlignmentFlag.AlignBottom, name)  # fmt: skip
        painter.setFont(theme.font("small"))
        painter.setPen(theme.colour("text_dim"))
        painter.drawText(QRectF(box.left(), middle + 3, box.width(), box.bottom() - middle),
                         left | Qt.AlignmentFlag.AlignTop, self._details(painter, line, box.width()))  # fmt: skip

    def _details(self, painter: QPainter, line: KindLine, width: float) -> str:
        """Return mean, total and rate, as many of them as there is room for."""
        parts = []
        if line.volume_ml is not None:
            spread = "" if line.spread_ml is None else f" (±{number_text(line.spread_ml, 0)})"
            volume = f"{number_text(line.volume_ml, 0)}{spread}{THIN}ml"
            parts.append(self.tr("mean {volume}").format(volume=volume))
        parts.append(self.tr("{rate}/min").format(rate=count_text(line.per_minute)))
        parts.append(f"{number_text(line.total_l, 1)}{THIN}l")
        if line.mass_kg is not None:
            parts.append(f"{number_text(line.mass_kg, 1)}{THIN}kg")
        metrics = QFontMetricsF(painter.font())
        while len(parts) > 1 and metrics.horizontalAdvance(" · ".join(parts)) > width:
            parts.pop()
        return " · ".join(parts)
