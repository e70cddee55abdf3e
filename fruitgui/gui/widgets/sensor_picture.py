"""A sensor's picture with what was seen in it drawn over it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TypeVar

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
    QPixmap,
    QTransform,
)
from PySide6.QtWidgets import QSizePolicy, QWidget

from fruitgui.frame import F64, U8
from fruitgui.gui.drawn import DrawnFruit, DrawnPicture
from fruitgui.gui.theme import icons
from fruitgui.gui.theme.stamps import drawn_pixmap, stamp
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID, RADIUS
from fruitgui.gui.widgets.focus import paint_focus
from fruitgui.gui.widgets.fruit_labels import CHIP, INK, FruitLabels
from fruitgui.gui.widgets.pictures import image_of
from fruitgui.gui.widgets.strokes import ellipse, on_screen, paint_lines, thinned

WORDS_FROM = 0.85
"""Labels have words where a pixel of the sensor takes at least so many of the screen; below, mark and number only."""

SHADE = QColor(0, 0, 0, 150)
VEIL = QColor(20, 24, 28, 165)
"""Over a picture that is not of now."""

VEIL_WORDS_SHARE = 1 / 22
"""How high the words over it are, of the picture's width."""

HEALTH = {"good": "#4cc38a", "warn": "#f0b23e", "bad": "#ff7a70", "info": "#a4afb8"}

T = TypeVar("T")


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
        self._labels = FruitLabels(theme)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(160, 120)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setAccessibleName(sensor)
        theme.changed.connect(self.update)

    @property
    def shown(self) -> U8 | None:
        """The picture that is shown, without what is drawn over it."""
        return None if self._drawn is None else self._drawn.color

    def show_picture(self, drawn: DrawnPicture) -> None:
        """Show another picture."""
        before, self._drawn = self._drawn, drawn
        if before is None or drawn.color is not before.color or bool(drawn.stale) != bool(before.stale):
            image = image_of(drawn.color)
            self._image = image.convertToFormat(QImage.Format.Format_Grayscale8) if drawn.stale else image
        self.setAccessibleDescription(drawn.stale)
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
            painter.drawPixmap(QPointF(GRID, GRID), self._caption())
            painter.setClipping(False)
            if self.hasFocus():
                paint_focus(painter, QRectF(self.rect()), RADIUS, self._theme)

    def _paint_picture(self, painter: QPainter, drawn: DrawnPicture) -> None:
        size = self._image.size().scaled(self.size(), Qt.AspectRatioMode.KeepAspectRatio)
        place = QRectF(0, 0, size.width(), size.height())
        place.moveCenter(QRectF(self.rect()).center())
        painter.drawImage(place, self._image)
        if drawn.stale:
            self._paint_veil(painter, place, drawn.stale)
            return  # the fruit that were in it are elsewhere by now
        scale = place.width() / max(self._image.width(), 1)
        to_screen = QTransform.fromTranslate(place.left(), place.top()).scale(scale, scale)
        outlined = [(one, on_screen(thinned(one.outline_px, scale), to_screen)) for one in drawn.fruit]
        painter.setBrush(Qt.BrushStyle.NoBrush)
        if self._overlays.trails:
            _paint_trails(painter, drawn.fruit, to_screen)
        if self._overlays.outlines:
            _paint_outlines(painter, outlined)
        if self._overlays.ellipses:
            painter.setBrush(QColor(255, 255, 255, 60))
            spreads = [one.ellipse for one in drawn.fruit if one.ellipse is not None]
            paint_lines(painter, [ellipse(one, to_screen) for one in spreads], INK, closed=True)
        if self._overlays.labels:
            worded, ratio = scale >= WORDS_FROM, self.devicePixelRatioF()
            self._labels.paint(painter, outlined, place, worded=worded, ratio=ratio)

    def _paint_veil(self, painter: QPainter, place: QRectF, words: str) -> None:
        """Draw what keeps an old picture from looking as if it were of now."""
        painter.fillRect(place, VEIL)
        font = self._theme.font("title", QFont.Weight.DemiBold)
        font.setPixelSize(max(font.pixelSize(), round(place.width() * VEIL_WORDS_SHARE)))
        painter.setFont(font)
        painter.setPen(INK)
        painter.drawText(place, int(Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap), words)

    def _caption(self) -> QPixmap:
        """Return the words on the sensor."""
        drawn = self._drawn
        health = drawn.health if drawn is not None and drawn.health in HEALTH else "info"
        text = self.sensor if drawn is None or not drawn.words else f"{self.sensor} · {drawn.words}"
        key = ("caption", text, health, self.width(), self.devicePixelRatioF())
        return stamp(key, lambda: self._drawn_caption(text, health))

    def _drawn_caption(self, text: str, health: str) -> QPixmap:
        font = self._theme.font("small", QFont.Weight.DemiBold)
        metrics = QFontMetricsF(font)
        text = metrics.elidedText(text, Qt.TextElideMode.ElideRight, self.width() - 6.0 * GRID)
        side = metrics.height()
        box = QRectF(0, 0, metrics.horizontalAdvance(text) + 4.5 * GRID, side + GRID)

        def paint(painter: QPainter) -> None:
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(CHIP)
            painter.drawRoundedRect(box, box.height() / 2, box.height() / 2)
            icons.paint(painter, QRectF(GRID * 0.75, GRID / 2, side, side), health, QColor(HEALTH[health]))
            painter.setFont(font)
            painter.setPen(INK)
            left = Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft
            painter.drawText(box.adjusted(side + 1.5 * GRID, 0, 0, 0), left, text)

        return drawn_pixmap(box.width(), box.height(), self.devicePixelRatioF(), paint)


def _paint_trails(painter: QPainter, fruit: Sequence[DrawnFruit], to_screen: QTransform) -> None:
    """Draw where fruit were, all of one colour at once."""
    for colour, some in _by_colour(fruit, lambda one: one.mark.colour):
        paint_lines(painter, [on_screen(one.trail_px, to_screen) for one in some], colour)


def _paint_outlines(painter: QPainter, outlined: Sequence[tuple[DrawnFruit, F64]]) -> None:
    """Draw outlines over a shade that lets them be seen on any ground, all of one colour at once."""
    paint_lines(painter, [outline for _, outline in outlined], SHADE, 4.0, closed=True)
    for colour, some in _by_colour(outlined, lambda one: one[0].mark.colour):
        paint_lines(painter, [outline for _, outline in some], colour, 2.0, closed=True)


def _by_colour(things: Sequence[T], colour_of: Callable[[T], str]) -> Iterator[tuple[QColor, list[T]]]:
    for colour in dict.fromkeys(colour_of(one) for one in things):
        yield QColor(colour), [one for one in things if colour_of(one) == colour]
