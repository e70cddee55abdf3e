"""Paper: A4 pages, written from top to bottom in points, with a head and a foot on each."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import QMarginsF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPageLayout, QPageSize, QPainter, QPdfWriter, QPen

from fruitgui.errors import WorldError
from fruitgui.gui.theme.theme import FAMILY
from fruitgui.gui.theme.tokens import LIGHT

DPI = 600
PER_POINT = DPI / 72.0
WIDTH_PT, HEIGHT_PT = 595.0, 842.0
MARGIN_PT, HEAD_PT, FOOT_PT = 56.0, 30.0, 26.0

INK, DIM, LINE = LIGHT.text, LIGHT.text_dim, LIGHT.line
LEFT, RIGHT, TOP = Qt.AlignmentFlag.AlignLeft, Qt.AlignmentFlag.AlignRight, Qt.AlignmentFlag.AlignTop


@dataclass(frozen=True, slots=True)
class Style:
    """How words are set: points, weight, colour."""

    size_pt: float = 9.5
    weight: QFont.Weight = QFont.Weight.Normal
    colour: str = INK

    def font(self) -> QFont:
        """Return the font, in pixels of the paper."""
        font = QFont(FAMILY)
        font.setPixelSize(round(self.size_pt * PER_POINT))
        font.setWeight(self.weight)
        font.setFeature(QFont.Tag("tnum"), 1)
        return font


BODY = Style()
BODY_DIM = Style(colour=DIM)
STRONG = Style(weight=QFont.Weight.DemiBold)
SMALL = Style(8.0, colour=DIM)
TITLE = Style(22.0, QFont.Weight.DemiBold)
SECTION = Style(12.0, QFont.Weight.DemiBold)


class Sheet:
    """Pages that are written on from above; a new one begins by itself. All lengths are points.

    Args:
        path: of the PDF.
        title: in the file's own properties, and at the head of every page but the first.
        page_word: "Page {page}" in the reader's language.

    Raises:
        WorldError: the file cannot be written.
    """

    def __init__(self, path: Path, title: str, page_word: str) -> None:
        self._writer = QPdfWriter(str(path))
        self._writer.setResolution(DPI)
        self._writer.setTitle(title)
        self._writer.setCreator("fruitgui")
        self._writer.setPageLayout(
            QPageLayout(QPageSize(QPageSize.PageSizeId.A4), QPageLayout.Orientation.Portrait, QMarginsF(0, 0, 0, 0))
        )
        self._painter = QPainter()
        if not self._painter.begin(self._writer):
            raise WorldError(
                "cannot_write", f"Cannot write {path}.", "Check that the folder exists and may be written to.",
                file=path,
            )  # fmt: skip
        self._title, self._page_word, self._page = title, page_word, 1
        self.y = MARGIN_PT
        self._foot()

    @property
    def width(self) -> float:
        """Points between the margins."""
        return WIDTH_PT - 2 * MARGIN_PT

    def close(self) -> None:
        """End the last page and the file."""
        self._painter.end()

    def room(self, height: float) -> None:
        """Begin a new page unless there is so much room left."""
        if self.y + height > HEIGHT_PT - MARGIN_PT - FOOT_PT:
            self._writer.newPage()
            self._page += 1
            self.y = MARGIN_PT
            self._foot()
            self.words(self._title, SMALL)
            self.skip(HEAD_PT - 16)

    def skip(self, height: float) -> None:
        """Leave room."""
        self.y += height

    def words(self, text: str, style: Style = BODY) -> None:
        """Write a paragraph over the whole width."""
        box = QRectF(0, 0, self.width * PER_POINT, 1e6)
        flags = Qt.TextFlag.TextWordWrap.value
        height = QFontMetricsF(style.font()).boundingRect(box, flags, text).height() / PER_POINT
        self.room(height)
        self.text(QRectF(0, self.y, self.width, height + 2), text, style, wrapped=True)
        self.y += height + 3

    def text(
        self, box: QRectF, text: str, style: Style = BODY, side: Qt.AlignmentFlag = LEFT | TOP, *, wrapped: bool = False
    ) -> None:
        """Write into a box; its left edge counts from the margin."""
        self._painter.setFont(style.font())
        self._painter.setPen(QColor(style.colour))
        self._painter.drawText(_scaled(box), side.value | (Qt.TextFlag.TextWordWrap.value if wrapped else 0), text)

    def width_of(self, text: str, style: Style) -> float:
        """Return how wide words are."""
        return QFontMetricsF(style.font()).horizontalAdvance(text) / PER_POINT

    def elided(self, text: str, style: Style, width: float) -> str:
        """Return words that fit into a width."""
        return QFontMetricsF(style.font()).elidedText(text, Qt.TextElideMode.ElideRight, width * PER_POINT)

    def line(self, x0: float, x1: float, colour: str = LINE, width: float = 0.6) -> None:
        """Draw a line across at the present height."""
        self._painter.setPen(QPen(QColor(colour), width * PER_POINT))
        ends = _scaled(QRectF(x0, self.y, x1 - x0, 0))
        self._painter.drawLine(ends.topLeft(), ends.topRight())

    def bar(self, box: QRectF, colour: str) -> None:
        """Fill a box."""
        self._painter.fillRect(_scaled(box), QColor(colour))

    def row(self, texts: Sequence[str], widths: Sequence[float], style: Style = BODY, height: float = 17.0, *,
            left: Sequence[int] = (0,)) -> None:  # fmt: skip
        """Write a row of a table: the columns in `left` to the left, the others to the right."""
        self.room(height)
        x = 0.0
        for number, (text, width) in enumerate(zip(texts, widths, strict=True)):
            side = LEFT if number in left else RIGHT
            shown = self.elided(text, style, width - (4 if number else 8))
            self.text(QRectF(x, self.y, width, height), shown, style, side | Qt.AlignmentFlag.AlignVCenter)
            x += width
        self.y += height

    def painter_at(self, box: QRectF) -> tuple[QPainter, QRectF]:
        """Return the painter, and a box in its own units."""
        return self._painter, _scaled(box)

    def _foot(self) -> None:
        y = HEIGHT_PT - MARGIN_PT
        text = self._page_word.format(page=self._page)
        self.text(QRectF(0, y, self.width, 14), text, SMALL, RIGHT | TOP)


def _scaled(box: QRectF) -> QRectF:
    origin = QPointF((box.left() + MARGIN_PT) * PER_POINT, box.top() * PER_POINT)
    return QRectF(origin.x(), origin.y(), box.width() * PER_POINT, box.height() * PER_POINT)
