"""A drawing of what to put where, seen from the side: sensor, belt, box or ball, and the length to measure."""

from __future__ import annotations

from PySide6.QtCore import QLineF, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen, QPolygonF, QRadialGradient
from PySide6.QtWidgets import QSizePolicy, QWidget

from fruitgui.gui.steps.connect.depth.course import Stage
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import RADIUS

WIDE, HIGH = 200.0, 96.0
"""Of the sketch, in its own units."""

BELT_Y, SENSOR_Y = 84.0, 14.0
WAS_Y = 34.0
"""Where a raised sensor hung before."""

BELT, BOX, BALL, SENSOR = "#5b646b", "#b08a5e", "#d98b2b", "#8b979f"


class DepthSketch(QWidget):
    """Shows one stage; the rules beside it say the same in words."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._stage = Stage.BELT
        policy = QSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)
        self.setMinimumSize(140, 68)
        theme.changed.connect(self.update)

    def show_stage(self, stage: Stage, said: str) -> None:
        """Show a stage, and what it says in words."""
        self._stage = stage
        self.setAccessibleName(said)
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(360, self.heightForWidth(360))

    def heightForWidth(self, width: int) -> int:  # noqa: N802 - Qt's name
        """Return the height that goes with a width."""
        return round(width * HIGH / WIDE)

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(self._theme.colour("raised"))
            painter.drawRoundedRect(QRectF(self.rect()), RADIUS, RADIUS)
            scale = min(self.width() / WIDE, self.height() / HIGH)
            painter.translate((self.width() - scale * WIDE) / 2, (self.height() - scale * HIGH) / 2)
            painter.scale(scale, scale)
            self._paint_sight(painter)
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(QColor(BELT))
            painter.drawRect(QRectF(14, BELT_Y, WIDE - 28, 5))
            for x in (20.0, WIDE - 20.0):
                painter.drawEllipse(QPointF(x, BELT_Y + 5), 4.5, 4.5)
            self._paint_thing(painter)
            self._paint_sensor(painter)

    def _paint_sight(self, painter: QPainter) -> None:
        sight = QColor(self._theme.colour("accent"))
        sight.setAlpha(34)
        painter.setBrush(sight)
        painter.drawPolygon(QPolygonF([QPointF(WIDE / 2, SENSOR_Y), QPointF(48, BELT_Y), QPointF(WIDE - 48, BELT_Y)]))

    def _paint_sensor(self, painter: QPainter) -> None:
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(SENSOR))
        painter.drawRoundedRect(QRectF(WIDE / 2 - 20, 4, 40, 10), 3, 3)
        painter.setBrush(self._theme.colour("accent"))
        for x in (-12.0, 0.0, 8.0):
            painter.drawEllipse(QPointF(WIDE / 2 + x, 10.5), 2.0, 2.0)

    def _paint_thing(self, painter: QPainter) -> None:
        middle = WIDE / 2
        if self._stage is Stage.BELT:
            self._paint_length(painter, QLineF(middle, SENSOR_Y + 1, middle, BELT_Y))
        elif self._stage is Stage.BOARD:
            painter.setBrush(QColor(BOX))
            painter.drawRect(QRectF(middle - 27, BELT_Y - 30, 54, 30))
            painter.setBrush(QColor(BOX).lighter(130))
            painter.drawRect(QRectF(middle - 29, BELT_Y - 33, 58, 3.5))
            self._paint_length(painter, QLineF(middle + 37, BELT_Y - 33, middle + 37, BELT_Y))
        elif self._stage is Stage.BALL:
            shine = QRadialGradient(QPointF(middle - 5, BELT_Y - 20), 22)
            shine.setColorAt(0.0, QColor(BALL).lighter(150))
            shine.setColorAt(1.0, QColor(BALL))
            painter.setBrush(shine)
            painter.drawEllipse(QPointF(middle, BELT_Y - 15), 15, 15)
            self._paint_length(painter, QLineF(middle - 15, BELT_Y - 37, middle + 15, BELT_Y - 37))
        elif self._stage is Stage.RAISED:
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(QColor(SENSOR), 1.3, Qt.PenStyle.DashLine))
            painter.drawRoundedRect(QRectF(middle - 20, WAS_Y - 10, 40, 10), 3, 3)
            self._paint_length(painter, QLineF(middle + 30, SENSOR_Y, middle + 30, WAS_Y))

    def _paint_length(self, painter: QPainter, line: QLineF) -> None:
        """Draw a length with an end stop and an arrow at both ends."""
        painter.setPen(QPen(self._theme.colour("text"), 1.3))
        painter.drawLine(line)
        along = line.unitVector()
        step = QPointF(along.dx(), along.dy())
        aside = QPointF(-along.dy(), along.dx())
        for end, inward in ((line.p1(), step), (line.p2(), -step)):
            painter.drawLine(QLineF(end - aside * 4.0, end + aside * 4.0))
            for side in (-1.0, 1.0):
                painter.drawLine(QLineF(end, end + inward * 4.5 + aside * (2.6 * side)))
        painter.setPen(Qt.PenStyle.NoPen)
