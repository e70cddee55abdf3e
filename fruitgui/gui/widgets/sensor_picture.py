"""A sensor's picture with what was seen in it drawn over it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontMetricsF,
    QImage,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPainterPath,
    QPaintEvent,
    QPen,
    QPolygonF,
    QTransform,
)
from PySide6.QtWidgets import QSizePolicy, QWidget

from fruitgui.frame import F32, F64
from fruitgui.gui.drawn import DrawnFruit, DrawnPicture
from fruitgui.gui.theme import icons
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID, RADIUS
from fruitgui.gui.widgets.kind_mark import paint_mark
from fruitgui.gui.widgets.pictures import image_of
from fruitgui.station.live.state import Spread

WORDS_FROM = 0.85
"""Labels have words where a pixel of the sensor takes at least so many of the screen; below, mark and number only."""

CHIP = QColor(10, 12, 13, 205)
INK = QColor("#f4f6f7")


@dataclass(frozen=True, slots=True)
class Overlays:
    """What is drawn over the pictures."""

    outlines: bool = True
    labels: bool = True
    ellipses: bool = True
    trails: bool = True


class SensorPicture(QWidget):
    """Shows one sensor; a click or Return asks for it to be made large.

    Attributes:
        pressed: the sensor's name.
    """

    pressed = Signal(str)

    def __init__(self, sensor: str, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.sensor = sensor
        self._theme = theme
        self._drawn: DrawnPicture | None = None
        self._image = QImage()
        self._overlays = Overlays()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(160, 120)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setAccessibleName(sensor)
        theme.changed.connect(self.update)

    def show_picture(self, drawn: DrawnPicture) -> None:
        """Show another picture."""
        if self._drawn is None or drawn.color is not self._drawn.color:
            self._image = image_of(drawn.color)
        self._drawn = drawn
        self.update()

    def show_overlays(self, overlays: Overlays) -> None:
        """Choose what is drawn over the picture."""
        self._overlays = overlays
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(320, 240)

    def hasHeightForWidth(self) -> bool:  # noqa: N802 - Qt's name
        """Tell that any height will do: the picture keeps its shape inside."""
        return False

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        """Ask to be made large."""
        if event.button() == Qt.MouseButton.LeftButton and self.rect().contains(event.position().toPoint()):
            self.pressed.emit(self.sensor)

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802 - Qt's name
        """Ask to be made large."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Space):
            self.pressed.emit(self.sensor)
        else:
            super().keyPressEvent(event)

    def event(self, event: QEvent) -> bool:
        """Draw the frame of whoever has the keyboard."""
        if event.type() in (QEvent.Type.FocusIn, QEvent.Type.FocusOut):
            self.update()
        return bool(super().event(event))

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
            card = QPainterPath()
            card.addRoundedRect(QRectF(self.rect()), RADIUS, RADIUS)
            painter.setClipPath(card)
            painter.fillRect(self.rect(), self._theme.colour("picture"))
            if self._drawn is not None:
                self._paint_picture(painter, self._drawn)
            self._paint_caption(painter)
            painter.setClipping(False)
            if self.hasFocus():
                painter.setPen(QPen(self._theme.colour("accent"), 3))
                painter.drawRoundedRect(QRectF(self.rect()).adjusted(1.5, 1.5, -1.5, -1.5), RADIUS, RADIUS)

    def _paint_picture(self, painter: QPainter, drawn: DrawnPicture) -> None:
        size = self._image.size().scaled(self.size(), Qt.AspectRatioMode.KeepAspectRatio)
        place = QRectF(0, 0, size.width(), size.height())
        place.moveCenter(QRectF(self.rect()).center())
        painter.drawImage(place, self._image)
        scale = place.width() / max(self._image.width(), 1)
        to_screen = QTransform.fromTranslate(place.left(), place.top()).scale(scale, scale)
        for fruit in drawn.fruit:
            self._paint_fruit(painter, fruit, to_screen)
        if self._overlays.labels:
            labels = _Labels(self._theme, place, worded=scale >= WORDS_FROM)
            for fruit in sorted(drawn.fruit, key=lambda one: -float(one.outline_px[:, 1].max(initial=0.0))):
                labels.paint(painter, fruit, to_screen)

    def _paint_fruit(self, painter: QPainter, fruit: DrawnFruit, to_screen: QTransform) -> None:
        colour = QColor(fruit.mark.colour)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        if self._overlays.trails and len(fruit.trail_px) > 1:
            painter.setPen(QPen(colour, 1.5, Qt.PenStyle.DotLine))
            painter.drawPolyline(_polygon(fruit.trail_px, to_screen))
        if self._overlays.outlines and len(fruit.outline_px) > 2:
            outline = _polygon(fruit.outline_px, to_screen)
            painter.setPen(QPen(QColor(0, 0, 0, 150), 4.0))
            painter.drawPolygon(outline)
            painter.setPen(QPen(colour, 2.0))
            painter.drawPolygon(outline)
        if self._overlays.ellipses and fruit.ellipse is not None:
            painter.setPen(QPen(INK, 1.5))
            painter.setBrush(QColor(255, 255, 255, 60))
            paint_ellipse(painter, fruit.ellipse, to_screen)
            painter.setBrush(Qt.BrushStyle.NoBrush)

    def _paint_caption(self, painter: QPainter) -> None:
        drawn = self._drawn
        painter.setFont(self._theme.font("small", QFont.Weight.DemiBold))
        text = self.sensor if drawn is None or not drawn.words else f"{self.sensor} · {drawn.words}"
        metrics = QFontMetricsF(painter.font())
        text = metrics.elidedText(text, Qt.TextElideMode.ElideRight, self.width() - 6.0 * GRID)
        box = QRectF(GRID, GRID, metrics.horizontalAdvance(text) + 4.5 * GRID, metrics.height() + GRID)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(CHIP)
        painter.drawRoundedRect(box, box.height() / 2, box.height() / 2)
        health = drawn.health if drawn is not None else "info"
        side = metrics.height()
        mark = QRectF(box.left() + GRID * 0.75, box.center().y() - side / 2, side, side)
        colours = {"good": "#4cc38a", "warn": "#f0b23e", "bad": "#ff7a70"}
        icons.paint(painter, mark, health if health in colours else "info", QColor(colours.get(health, "#a4afb8")))
        painter.setPen(INK)
        painter.drawText(
            box.adjusted(mark.width() + 1.5 * GRID, 0, 0, 0),
            Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, text,
        )  # fmt: skip


class _Labels:
    """Puts a label beside each fruit, and none over another."""

    def __init__(self, theme: Theme, place: QRectF, *, worded: bool) -> None:
        self._theme = theme
        self._place = place
        self._worded = worded
        self._taken: list[QRectF] = []

    def paint(self, painter: QPainter, fruit: DrawnFruit, to_screen: QTransform) -> None:
        """Draw one label, with fewer words where there is no room for more."""
        outline = _polygon(fruit.outline_px, to_screen).boundingRect()
        lines = [f"{fruit.number}", *fruit.words] if self._worded else [f"{fruit.number}"]
        for count in range(len(lines), 0, -1):
            if self._try(painter, fruit, outline, lines[:count]):
                return

    def _try(self, painter: QPainter, fruit: DrawnFruit, outline: QRectF, lines: list[str]) -> bool:
        painter.setFont(self._theme.font("small", QFont.Weight.DemiBold))
        metrics = QFontMetricsF(painter.font())
        side = metrics.height() + 2
        first = f"{lines[0]}  {lines[1]}" if len(lines) > 1 else lines[0]
        rows = [first, *lines[2:]]
        width = max(metrics.horizontalAdvance(row) for row in rows) + side + 1.25 * GRID
        box = QRectF(0, 0, width, len(rows) * metrics.height() + GRID / 2)
        for x, y in (
            (outline.center().x() - width / 2, outline.top() - box.height() - 3),
            (outline.center().x() - width / 2, outline.bottom() + 3),
            (outline.right() + 3, outline.center().y() - box.height() / 2),
            (outline.left() - width - 3, outline.center().y() - box.height() / 2),
        ):
            box.moveTo(x, y)
            if self._place.contains(box) and not any(box.intersects(one) for one in self._taken):
                self._taken.append(QRectF(box))
                self._draw(painter, fruit, QRectF(box), rows, side)
                return True
        return False

    def _draw(self, painter: QPainter, fruit: DrawnFruit, box: QRectF, rows: list[str], side: float) -> None:
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(CHIP)
        painter.drawRoundedRect(box, 5, 5)
        paint_mark(painter, QRectF(box.left() + 3, box.top() + 2, side, side), fruit.mark)
        painter.setPen(INK)
        text = box.adjusted(side + GRID * 0.75, 2, 0, 0)
        painter.drawText(text, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop, "\n".join(rows))


def paint_ellipse(painter: QPainter, ellipse: Spread, to_screen: QTransform) -> None:
    """Draw an ellipse of picture or belt coordinates; one too small to be seen is a point of two pixels."""
    scale = float(np.sqrt(abs(to_screen.determinant())))
    painter.save()
    painter.translate(to_screen.map(QPointF(ellipse.x, ellipse.y)))
    turned = -ellipse.angle_rad if to_screen.m22() < 0 else ellipse.angle_rad
    painter.rotate(float(np.degrees(turned)))
    painter.drawEllipse(QPointF(0, 0), max(ellipse.major * scale, 2.0), max(ellipse.minor * scale, 2.0))
    painter.restore()


def _polygon(points: F32 | F64, to_screen: QTransform) -> QPolygonF:
    return to_screen.map(QPolygonF([QPointF(x, y) for x, y in points.tolist()]))
