"""The counts: the largest thing on the screen, read from two metres away."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPaintEvent, QPixmap
from PySide6.QtWidgets import QSizePolicy, QWidget

from fruitgui.gui.drawn import KindLine
from fruitgui.gui.numbers import THIN, count_text, number_text
from fruitgui.gui.theme.stamps import drawn_pixmap, stamp
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.fitting import fitted
from fruitgui.gui.widgets.kind_mark import paint_mark

TALLEST, LEAST = 168, 26
"""Pixels: of a kind's row. Where rows would be lower, they stand in two columns."""

TWO_LINES, ROOMY = 38, 52
"""Rows at least so high have a second line of figures, and larger names; from there on their words grow with them."""

MOST_COLUMNS, LARGEST_WORDS = 2, 2.0

TOTAL_SHARE, TOTAL, TALLEST_TOTAL = 0.115, 48, 128
"""The row of all fruit together: a part of the height, at least and at most."""

TOTAL_FIGURE_SHARE = 0.75
FAR_PX = 40
"""Figures of this size are read from two metres away."""

FIGURE_SHARE, TIGHT_SHARE, FIGURE_WIDTH_SHARE = 0.78, 0.95, 0.15
SMALLEST_FIGURE_PX = 20
"""Counts take so much of their row's height, more of it where they could not be read from afar, and no more of its
width."""


@dataclass(frozen=True, slots=True)
class Places:
    """Where the rows are: below `top`, in columns, each row of one size, pixels."""

    top: float
    columns: int
    width: float
    height: float

    def place(self, number: int, rows: int) -> QPointF:
        """Return the corner of a row, of so many rows in all; columns are filled one after the other."""
        down = math.ceil(rows / self.columns)
        return QPointF(number // down * (self.width + 2 * GRID), self.top + number % down * self.height)


def places_for(rows: int, width: float, height: float) -> Places:
    """Return where so many rows go, so that all of them are in view and each as large as there is room for."""
    top = min(max(TOTAL_SHARE * height, TOTAL), TALLEST_TOTAL) if height >= far_height(rows) else TOTAL
    columns = next((n for n in range(1, MOST_COLUMNS) if (height - top) / math.ceil(max(rows, 1) / n) >= LEAST),
                   MOST_COLUMNS)  # fmt: skip
    down = math.ceil(max(rows, 1) / columns)
    return Places(top, columns, (width - (columns - 1) * 2 * GRID) / columns, min((height - top) / down, TALLEST))


def far_height(rows: int) -> float:
    """Return the height, pixels, from which on so many rows in one column are read from two metres away."""
    return TOTAL + rows * FAR_PX / TIGHT_SHARE


def figure_px(width: float, height: float) -> float:
    """Return the size of the figure in a row of this size, pixels."""
    wanted = max(FIGURE_SHARE * height, min(FAR_PX, TIGHT_SHARE * height))
    return max(min(wanted, FIGURE_WIDTH_SHARE * width), SMALLEST_FIGURE_PX)


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

    @property
    def far_height(self) -> float:
        """Pixels: as high as it must be to be read from two metres away."""
        return far_height(len(self._lines))

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(400, 56 + 64 * max(len(self._lines), 4))

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            rows = len(self._lines)
            places = places_for(rows, self.width(), self.height())
            self._paint_total(painter, places.top)
            for number, line in enumerate(self._lines):
                place = places.place(number, rows)
                painter.drawPixmap(place, self._row(line, places, ruled=place.y() > places.top))

    def _paint_total(self, painter: QPainter, height: float) -> None:
        theme = self._theme
        count = sum(line.count for line in self._lines)
        litres = sum(line.total_l for line in self._lines)
        rate = sum(line.per_minute for line in self._lines)
        box, grown = QRectF(0, 0, self.width(), height), min(height / TOTAL, LARGEST_WORDS)
        painter.setPen(theme.colour("text"))
        painter.setFont(self._words("title", grown, QFont.Weight.DemiBold))
        title = self.tr("All fruit")
        painter.drawText(box, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, title)
        left = QFontMetricsF(painter.font()).horizontalAdvance(title) + 1.5 * GRID
        painter.setFont(self._figure(TOTAL_FIGURE_SHARE * height))
        painter.drawText(box, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight, count_text(count))
        right = box.right() - QFontMetricsF(painter.font()).horizontalAdvance(count_text(count)) - 1.5 * GRID
        painter.setFont(self._words("small", grown))
        painter.setPen(theme.colour("text_dim"))
        all_litres = f"{number_text(litres, 1)}{THIN}l"
        text = self.tr("{litres} · {rate}/min").format(litres=all_litres, rate=count_text(rate))
        if QFontMetricsF(painter.font()).horizontalAdvance(text) > right - left:
            text = all_litres
        box.setRight(right)
        painter.drawText(box, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight, text)

    def _words(self, size: str, grown: float, weight: QFont.Weight = QFont.Weight.Normal) -> QFont:
        """Return one of the theme's fonts, larger where there is room."""
        font = self._theme.font(size, weight)
        font.setPixelSize(round(font.pixelSize() * max(grown, 1.0)))
        return font

    def _figure(self, size_px: float) -> QFont:
        font = self._theme.font("figure", QFont.Weight.DemiBold)
        font.setPixelSize(round(size_px))
        return font

    def _row(self, line: KindLine, places: Places, *, ruled: bool) -> QPixmap:
        """Return a kind's row; of all rows few change from look to look."""
        height = places.height
        theme, box, ratio = self._theme, QRectF(0, 0, places.width, height), self.devicePixelRatioF()
        key = ("count", line, box.width(), height, ruled, ratio, theme.name, self.tr("mean {volume}"))
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
        side = box.height() * 0.62
        paint_mark(painter, QRectF(0, box.center().y() - side / 2, side, side), line.mark)
        painter.setFont(self._figure(figure_px(box.width(), box.height())))
        painter.setPen(theme.colour("text" if line.count else "text_dim"))
        count = count_text(line.count)
        width = QFontMetricsF(painter.font()).horizontalAdvance(count)
        painter.drawText(box, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight, count)
        words = QRectF(side + 1.5 * GRID, box.top(), box.width() - side - width - 3 * GRID, box.height())
        self._paint_words(painter, line, words)

    def _paint_words(self, painter: QPainter, line: KindLine, box: QRectF) -> None:
        theme = self._theme
        middle = box.center().y()
        two = bool(line.count) and box.height() >= TWO_LINES
        grown = min(0.5 + 0.5 * box.height() / ROOMY, LARGEST_WORDS)
        painter.setFont(self._words("title" if box.height() >= ROOMY else "body", grown, QFont.Weight.Medium))
        painter.setPen(theme.colour("text"))
        name = fitted(painter, line.name, box.width())
        left = Qt.AlignmentFlag.AlignLeft
        if not two:
            painter.drawText(box, left | Qt.AlignmentFlag.AlignVCenter, name)
            return
        painter.drawText(QRectF(box.left(), box.top(), box.width(), middle - box.top() + 2),
                         left | Qt.AlignmentFlag.AlignBottom, name)  # fmt: skip
        painter.setFont(self._words("small", grown))
        painter.setPen(theme.colour("text_dim"))
        painter.drawText(QRectF(box.left(), middle + 3, box.width(), box.bottom() - middle),
                         left | Qt.AlignmentFlag.AlignTop, self._details(painter, line, box.width()))  # fmt: skip

    def _details(self, painter: QPainter, line: KindLine, width: float) -> str:
        """Return mean, rate, total and spread, as many of them as there is room for: only the mean has a ±."""
        parts = []
        if line.volume_ml is not None:
            half = "" if line.volume_half_ml is None else f" ± {number_text(line.volume_half_ml, 0)}"
            volume = f"{number_text(line.volume_ml, 0)}{half}{THIN}ml"
            parts.append(self.tr("mean {volume}").format(volume=volume))
        parts.append(self.tr("{rate}/min").format(rate=count_text(line.per_minute)))
        parts.append(f"{number_text(line.total_l, 1)}{THIN}l")
        if line.spread_ml is not None:
            spread = f"{number_text(line.spread_ml, 0)}{THIN}ml"
            parts.append(self.tr("spread {spread}").format(spread=spread))
        if line.mass_kg is not None:
            parts.append(f"{number_text(line.mass_kg, 1)}{THIN}kg")
        metrics = QFontMetricsF(painter.font())
        while len(parts) > 1 and metrics.horizontalAdvance(" · ".join(parts)) > width:
            parts.pop()
        return " · ".join(parts)
