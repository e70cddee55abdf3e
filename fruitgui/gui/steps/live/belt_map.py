"""The belt from above: what each sensor sees of it, and every fruit on it with how surely its place is known."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QPainter, QPaintEvent, QPen, QPolygonF, QTransform
from PySide6.QtWidgets import QSizePolicy, QWidget

from fruitgui.frame import F64
from fruitgui.gui.drawn import BeltMap, MappedFruit
from fruitgui.gui.numbers import THIN, number_text
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.kind_mark import paint_mark
from fruitgui.gui.widgets.sensor_picture import paint_ellipse

MARGIN = 0.04
LETTERS_FROM_PX = 9.0


class BeltView(QWidget):
    """Paints a `BeltMap`; the belt runs from left to right."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._map: BeltMap | None = None
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumHeight(96)
        theme.changed.connect(self.update)

    def show_map(self, belt: BeltMap) -> None:
        """Show another moment."""
        self._map = belt
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(640, 160)

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            belt = self._map
            if belt is not None and belt.footprints_m:
                to_screen = self._fitted(belt)
                for number, (sensor, corners_m) in enumerate(belt.footprints_m.items()):
                    self._paint_footprint(painter, sensor, corners_m, to_screen, belt, number)
                for fruit in belt.fruit:
                    self._paint_fruit(painter, fruit, to_screen)
                self._paint_speed(painter, belt)
            else:
                painter.setFont(self._theme.font("small"))
                painter.setPen(self._theme.colour("text_dim"))
                text = self.tr("The belt from above appears here while a lot runs.")
                painter.drawText(QRectF(self.rect()), Qt.AlignmentFlag.AlignCenter, text)

    def _fitted(self, belt: BeltMap) -> QTransform:
        """Return the way from metres to the screen that fits all footprints; y goes up on the screen."""
        corners = np.concatenate(list(belt.footprints_m.values()))
        low, high = corners.min(axis=0), corners.max(axis=0)
        size = np.maximum(high - low, 1e-3) * (1.0 + 2.0 * MARGIN)
        scale = min(self.width() / size[0], self.height() / size[1])
        middle = (low + high) / 2.0
        to_screen = QTransform.fromTranslate(self.width() / 2.0, self.height() / 2.0)
        return to_screen.scale(scale, -scale).translate(-middle[0], -middle[1])

    def _paint_footprint(
        self, painter: QPainter, sensor: str, corners_m: F64, to_screen: QTransform, belt: BeltMap, number: int
    ) -> None:
        blind = sensor in belt.blind
        colour = self._theme.colour("bad" if blind else "accent")
        fill = QColor(colour)
        fill.setAlpha(18)
        painter.setBrush(Qt.BrushStyle.BDiagPattern if blind else fill)
        painter.setPen(QPen(colour, 1.5, Qt.PenStyle.DashLine if blind else Qt.PenStyle.SolidLine))
        polygon = to_screen.map(QPolygonF([QPointF(x, y) for x, y in corners_m.tolist()]))
        painter.drawPolygon(polygon)
        painter.setFont(self._theme.font("small"))
        painter.setPen(self._theme.colour("bad" if blind else "text_dim"))
        box = polygon.boundingRect().adjusted(GRID, GRID / 2, -GRID, -GRID / 2)
        side = Qt.AlignmentFlag.AlignTop if number % 2 == 0 else Qt.AlignmentFlag.AlignBottom
        painter.drawText(box, side | Qt.AlignmentFlag.AlignRight, sensor)

    def _paint_fruit(self, painter: QPainter, fruit: MappedFruit, to_screen: QTransform) -> None:
        colour = QColor(fruit.mark.colour)
        if len(fruit.trail_m) > 1:
            painter.setPen(QPen(colour, 1.5, Qt.PenStyle.DotLine))
            painter.drawPolyline(to_screen.map(QPolygonF([QPointF(x, y) for x, y in fruit.trail_m.tolist()])))
        centre = to_screen.map(QPointF(fruit.ellipse.x, fruit.ellipse.y))
        radius = max(fruit.radius_m * float(np.sqrt(abs(to_screen.determinant()))), 4.0)
        if radius >= LETTERS_FROM_PX:
            paint_mark(painter, QRectF(centre.x() - radius, centre.y() - radius, 2 * radius, 2 * radius), fruit.mark)
        else:
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(colour)
            painter.drawEllipse(centre, radius, radius)
        painter.setPen(QPen(self._theme.colour("text"), 1.5))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        paint_ellipse(painter, fruit.ellipse, to_screen)

    def _paint_speed(self, painter: QPainter, belt: BeltMap) -> None:
        if belt.speed_m_s is None:
            return
        painter.setFont(self._theme.font("small", QFont.Weight.DemiBold))
        painter.setPen(self._theme.colour("text_dim"))
        text = f"→  {number_text(belt.speed_m_s, 2)}{THIN}m/s"
        painter.drawText(QRectF(self.rect()).adjusted(GRID, GRID / 2, -GRID, -GRID / 2),
                         Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop, text)  # fmt: skip
