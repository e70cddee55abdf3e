"""A fruit's pictures, one of them large, and its way over the belt."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QFontMetricsF,
    QImage,
    QMouseEvent,
    QPainter,
    QPainterPath,
    QPaintEvent,
    QPen,
    QPolygonF,
    QTransform,
)
from PySide6.QtWidgets import QSizePolicy, QWidget

from fruitgui.gui.numbers import THIN, number_text
from fruitgui.gui.steps.lots.fruit_pictures import Way
from fruitgui.gui.theme.contrast import SHAPES, contrast
from fruitgui.gui.theme.kinds import UNKNOWN_MARK, KindMark
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID, RADIUS
from fruitgui.gui.view_pictures import ViewPictures
from fruitgui.gui.widgets.histogram import ticks
from fruitgui.gui.widgets.strokes import ellipse, path_of

STRIP = 72
INK = QColor("#f4f6f7")


class FruitPicture(QWidget):
    """One picture large, with its outline; below it all there are, colour and depth of each view.

    Attributes:
        chosen_changed: another picture is large.
    """

    chosen_changed = Signal()

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._tiles: list[tuple[ViewPictures, bool]] = []
        self._chosen = 0
        self._mark = UNKNOWN_MARK
        self.outlined = True
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(200, 180)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        theme.changed.connect(self.update)

    def show_views(self, views: Sequence[ViewPictures], mark: KindMark) -> None:
        """Show another fruit's pictures."""
        tiles = [(view, deep) for view in views for deep in (False, True)]
        self._tiles = [(view, deep) for view, deep in tiles if not (view.depth if deep else view.colour).isNull()]
        self._chosen, self._mark = 0, mark
        self._name()
        self.update()

    @property
    def count(self) -> int:
        """How many pictures there are."""
        return len(self._tiles)

    @property
    def chosen(self) -> int:
        """Which of them is large."""
        return self._chosen

    def choose(self, number: int) -> None:
        """Make another picture large; they go round."""
        if self._tiles:
            self._chosen = number % len(self._tiles)
            self._name()
            self.chosen_changed.emit()
            self.update()

    def show_outline(self, shown: bool) -> None:
        """Draw the outline, or leave it out."""
        self.outlined = shown
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(360, 360)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        """Make the picture large that was pressed; on the large one, the next."""
        at = event.position()
        tile = next((number for number in range(self.count) if self._tile(number).contains(at)), None)
        self.choose(self._chosen + 1 if tile is None else tile)

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
            large = QRectF(0, 0, self.width(), self.height() - STRIP - GRID)
            self._ground(painter, large)
            if not self._tiles:
                painter.setPen(INK)
                painter.setFont(self._theme.font("body"))
                text = self.tr("No pictures are kept of this fruit, or they have been deleted with age.")
                words = large.adjusted(2 * GRID, 0, -2 * GRID, 0)
                painter.drawText(words, Qt.AlignmentFlag.AlignCenter.value | Qt.TextFlag.TextWordWrap.value, text)
                return
            view, deep = self._tiles[self._chosen]
            self._paint(painter, large, view, deep, self.outlined)
            self._caption(painter, large, view, deep)
            for number, (one, depth) in enumerate(self._tiles):
                place = self._tile(number)
                self._ground(painter, place)
                self._paint(painter, place, one, depth, outlined=False)
                painter.setBrush(Qt.BrushStyle.NoBrush)
                painter.setPen(QPen(self._theme.colour("accent" if number == self._chosen else "line"), 2))
                painter.drawRoundedRect(place.adjusted(1, 1, -1, -1), 6, 6)

    def _tile(self, number: int) -> QRectF:
        side = min(STRIP, (self.width() + GRID) / max(self.count, 1) - GRID)
        return QRectF(number * (side + GRID), self.height() - STRIP, side, STRIP)

    def _ground(self, painter: QPainter, place: QRectF) -> None:
        path = QPainterPath()
        path.addRoundedRect(place, RADIUS - 2, RADIUS - 2)
        painter.fillPath(path, self._theme.colour("picture"))

    def _paint(self, painter: QPainter, place: QRectF, view: ViewPictures, deep: bool, outlined: bool) -> None:
        image: QImage = view.depth if deep else view.colour
        scale = min((place.width() - 4) / image.width(), (place.height() - 4) / image.height())
        box = QRectF(0, 0, image.width() * scale, image.height() * scale)
        box.moveCenter(place.center())
        painter.drawImage(box, image)
        if outlined and view.outline.size() > 2:
            to_screen = QTransform.fromTranslate(box.left(), box.top()).scale(scale, scale)
            outline = to_screen.map(view.outline)
            painter.setBrush(Qt.BrushStyle.NoBrush)
            for colour, width in ((QColor(0, 0, 0, 150), 4.0), (QColor(self._mark.colour), 2.0)):
                painter.setPen(QPen(colour, width))
                painter.drawPolygon(outline)

    def _caption(self, painter: QPainter, place: QRectF, view: ViewPictures, deep: bool) -> None:
        text = f"{view.sensor} · {self._content(deep)}"
        painter.setFont(self._theme.font("small"))
        metrics = QFontMetricsF(painter.font())
        box = QRectF(place.left() + GRID, place.top() + GRID, metrics.horizontalAdvance(text) + 2 * GRID,
                     metrics.height() + GRID)  # fmt: skip
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(10, 12, 13, 205))
        painter.drawRoundedRect(box, box.height() / 2, box.height() / 2)
        painter.setPen(INK)
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)

    def _content(self, deep: bool) -> str:
        return self.tr("depth") if deep else self.tr("colour")

    def _name(self) -> None:
        if self._tiles:
            view, deep = self._tiles[self._chosen]
            self.setAccessibleName(f"{view.sensor} {self._content(deep)}")


class WayView(QWidget):
    """The path of a fruit from above; the belt runs from left to right."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._way: Way | None = None
        self._mark = UNKNOWN_MARK
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setFixedHeight(96)
        theme.changed.connect(self.update)

    def show_way(self, way: Way | None, mark: KindMark) -> None:
        """Show another path."""
        self._way, self._mark = way, mark
        self.setAccessibleName(self._words())
        self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(self._theme.colour("raised"))
            painter.drawRoundedRect(QRectF(self.rect()), RADIUS - 2, RADIUS - 2)
            painter.setFont(self._theme.font("small"))
            painter.setPen(self._theme.colour("text_dim"))
            words = QRectF(self.rect()).adjusted(GRID, GRID / 2, -GRID, -GRID / 2)
            painter.drawText(words, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop, self._words())
            if self._way is not None:
                self._paint(painter, self._way, words)

    def _paint(self, painter: QPainter, way: Way, words: QRectF) -> None:
        xs, ys = [one.x for one in way.spreads], [one.y for one in way.spreads]
        room = words.adjusted(2 * GRID, 2.5 * GRID, -2 * GRID, -2.5 * GRID)
        wide, high = max(max(xs) - min(xs), 1e-3), max(max(ys) - min(ys), 1e-3)
        scale = min(room.width() / wide, room.height() / high)
        to_screen = QTransform.fromTranslate(room.center().x(), room.center().y()).scale(scale, -scale)
        to_screen = to_screen.translate(-(max(xs) + min(xs)) / 2, -(max(ys) + min(ys)) / 2)
        points = QPolygonF([QPointF(x, y) for x, y in zip(xs, ys, strict=True)])
        painter.setBrush(Qt.BrushStyle.NoBrush)
        faint = contrast(self._mark.colour, self._theme.colours.raised) < SHAPES
        painter.setPen(QPen(self._theme.colour("edge") if faint else QColor(self._mark.colour), 2))
        painter.drawPolyline(to_screen.map(points))
        fill = QColor(self._mark.colour)
        fill.setAlpha(90)
        painter.setBrush(fill)
        painter.setPen(QPen(self._theme.colour("text"), 1))
        painter.drawPath(path_of([ellipse(one, to_screen) for one in way.spreads], closed=True))
        self._paint_scale(painter, scale, words)

    def _paint_scale(self, painter: QPainter, scale: float, words: QRectF) -> None:
        """Draw a bar of a round length at the lower right."""
        lengths = ticks(0.0, words.width() / 4 / scale, 2)
        if not lengths:
            return
        length_m = lengths[-1]
        y, right = words.bottom() - 4, words.right()
        painter.setPen(QPen(self._theme.colour("text_dim"), 2))
        painter.drawLine(QPointF(right - length_m * scale, y), QPointF(right, y))
        text = f"{number_text(length_m * 100, 0 if length_m >= 0.01 else 1)}{THIN}cm"
        box = QRectF(words.left(), y - 22, words.width(), 20)
        painter.drawText(box, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignBottom, text)

    def _words(self) -> str:
        if self._way is None:
            return self.tr("No path is kept of this fruit.")
        text = self.tr("→ way over the belt: {length} in {time}")
        length = f"{number_text(self._way.length_m * 100, 0)}{THIN}cm"
        return text.format(length=length, time=f"{number_text(self._way.duration_s, 1)}{THIN}s")
