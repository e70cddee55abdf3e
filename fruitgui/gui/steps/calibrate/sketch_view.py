"""Draws advice: a belt from above with fruit, what each sensor sees, and whether that is how it should be."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen, QPolygonF, QRadialGradient, QTransform
from PySide6.QtWidgets import QSizePolicy, QWidget

from fruitgui.gui.steps.calibrate.sketches import LENGTH, WIDTH, Piece, Sketch
from fruitgui.gui.theme import icons
from fruitgui.gui.theme.kinds import OKABE_ITO
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID, RADIUS

AROUND = 12.0
"""Room around the belt, in the sketch's units."""

FRUIT = ("#e8c33b", "#5f8f3c", "#c2412f", "#6b4a2f")
BELT, RAIL = "#5b646b", "#aeb7bd"


class SketchView(QWidget):
    """One sketch; a sentence stands for it where it cannot be seen."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._sketch: Sketch | None = None
        policy = QSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)
        self.setMinimumSize(140, 80)
        theme.changed.connect(self.update)

    def show_sketch(self, sketch: Sketch, said: str) -> None:
        """Show a sketch, and what it says in words."""
        self._sketch = sketch
        self.setAccessibleName(said)
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(360, self.heightForWidth(360))

    def heightForWidth(self, width: int) -> int:  # noqa: N802 - Qt's name
        """Return the height that goes with a width."""
        return round(width * (WIDTH + 2 * AROUND) / (LENGTH + 2 * AROUND))

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        if self._sketch is None:
            return
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(self._theme.colour("raised"))
            painter.drawRoundedRect(QRectF(self.rect()), RADIUS, RADIUS)
            painter.setTransform(self._to_screen())
            self._paint_belt(painter)
            self._paint_views(painter, self._sketch)
            for piece in self._sketch.pieces:
                self._paint_piece(painter, piece, moving=self._sketch.moving)
            painter.resetTransform()
            self._paint_sensors(painter, self._sketch)
            self._paint_mark(painter, self._sketch)

    def _to_screen(self) -> QTransform:
        scale = min(self.width() / (LENGTH + 2 * AROUND), self.height() / (WIDTH + 2 * AROUND))
        to_screen = QTransform.fromTranslate(self.width() / 2, self.height() / 2).scale(scale, scale)
        return to_screen.translate(-LENGTH / 2, -WIDTH / 2)

    def _paint_belt(self, painter: QPainter) -> None:
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(BELT))
        painter.drawRect(QRectF(-AROUND, 0, LENGTH + 2 * AROUND, WIDTH))
        painter.setBrush(QColor(RAIL))
        for y in (-2.5, WIDTH + 0.5):
            painter.drawRect(QRectF(-AROUND, y, LENGTH + 2 * AROUND, 2.0))

    def _paint_views(self, painter: QPainter, sketch: Sketch) -> None:
        for number, corners in enumerate(sketch.views):
            colour = QColor(OKABE_ITO[(number + 1) % len(OKABE_ITO)])
            fill = QColor(colour)
            fill.setAlpha(46)
            painter.setBrush(fill)
            pen = QPen(colour, 2.0)
            pen.setCosmetic(True)
            painter.setPen(pen)
            painter.drawPolygon(QPolygonF([QPointF(*corner) for corner in corners]))

    def _paint_sensors(self, painter: QPainter, sketch: Sketch) -> None:
        """Draw who looks, on the screen's own pixels: a drawing that is scaled up blurs."""
        to_screen = self._to_screen()
        for number, corners in enumerate(sketch.views):
            middle = sum(corner[0] for corner in corners) / len(corners)
            place = to_screen.mapRect(QRectF(middle - 4, -AROUND + 0.5, 8, 8))
            side = round(place.width())
            whole = QRectF(round(place.left()), max(round(place.top()), 1), side, side)
            icons.paint(painter, whole, "camera", QColor(OKABE_ITO[(number + 1) % len(OKABE_ITO)]))

    def _paint_piece(self, painter: QPainter, piece: Piece, *, moving: bool) -> None:
        colour = QColor(FRUIT[piece.colour % len(FRUIT)])
        if moving:
            pen = QPen(self._theme.colour("bad"), 1.5, Qt.PenStyle.DotLine)
            pen.setCosmetic(True)
            painter.setPen(pen)
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawEllipse(QPointF(piece.x - 4, piece.y + 1), piece.radius, piece.radius)
        shine = QRadialGradient(QPointF(piece.x - piece.radius / 3, piece.y - piece.radius / 3), piece.radius * 1.4)
        shine.setColorAt(0.0, colour.lighter(145))
        shine.setColorAt(1.0, colour.darker(115))
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(shine)
        painter.drawEllipse(QPointF(piece.x, piece.y), piece.radius, piece.radius)

    def _paint_mark(self, painter: QPainter, sketch: Sketch) -> None:
        if sketch.good is None:
            return
        name = "good" if sketch.good else "bad"
        place = QRectF(GRID, self.height() - GRID - 28, 28, 28)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(self._theme.colour("surface"))
        painter.drawEllipse(place.adjusted(-2, -2, 2, 2))
        icons.paint(painter, place, "done" if sketch.good else "close", self._theme.colour(name))
