"""The sensor's depth, live, with what was found in it, and a cross straight ahead."""

from __future__ import annotations

from functools import partial

import numpy as np
from PySide6.QtCore import QLineF, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPainterPath, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from fruitgui.frame import U8, Bools, Frame
from fruitgui.gui.queries import Queries
from fruitgui.gui.steps.connect.thumbnails import Thumbnails, thumbnails
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import RADIUS

FOUND = (255, 255, 255)
THIN_PX = 320
ARM_PX = 13.0


class DepthPreview(QWidget):
    """Shows one sensor's newest depth; its pictures are made beside the window."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._queries = Queries(self)
        self._thumbnails: Thumbnails | None = None
        self._found: QImage | None = None
        self._found_for: object = None
        self._ahead: tuple[float, float] | None = None
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(240, 180)
        theme.changed.connect(self.update)

    @property
    def found(self) -> QImage | None:
        """What is marked in the picture."""
        return self._found

    def begin(self, said: str) -> None:
        """Forget the sensor that was shown."""
        self._queries.rest()
        self._thumbnails = None
        self._found = self._found_for = self._ahead = None
        self.setAccessibleName(said)
        self.update()

    def show_frame(self, frame: Frame | None, *, cross: bool) -> None:
        """Show the newest frame, with a cross where the sensor looks straight ahead, or without."""
        shown = self._thumbnails
        if frame is None or self._queries.busy or (shown is not None and shown.of(frame)):
            return
        camera = frame.intrinsics
        ahead = ((camera.cx + 0.5) / camera.width, (camera.cy + 0.5) / camera.height) if cross else None
        self._queries.ask("picture", partial(thumbnails, frame, THIN_PX, shown), partial(self._take, ahead))

    def _take(self, ahead: tuple[float, float] | None, made: Thumbnails) -> None:
        self._ahead, self._thumbnails = ahead, made
        self.update()

    def show_found(self, on: Bools | None) -> None:
        """Mark pixels (H, W); None marks nothing."""
        if on is not self._found_for:
            self._found_for = on
            self._found = None if on is None else _marked(on)
            self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(640, 480)

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        with QPainter(self) as painter:
            painter.setRenderHints(QPainter.RenderHint.Antialiasing | QPainter.RenderHint.SmoothPixmapTransform)
            card = QPainterPath()
            card.addRoundedRect(QRectF(self.rect()), RADIUS, RADIUS)
            painter.setClipPath(card)
            painter.fillRect(self.rect(), self._theme.colour("picture"))
            if self._thumbnails is None:
                return
            picture = self._thumbnails.depth
            size = picture.size().scaled(self.size(), Qt.AspectRatioMode.KeepAspectRatio)
            place = QRectF(0, 0, size.width(), size.height())
            place.moveCenter(QRectF(self.rect()).center())
            painter.drawImage(place, picture)
            if self._found is not None:
                painter.drawImage(place, self._found)
            if self._ahead is not None:
                self._paint_cross(painter, place, self._ahead)

    def _paint_cross(self, painter: QPainter, place: QRectF, ahead: tuple[float, float]) -> None:
        middle = QPointF(place.left() + ahead[0] * place.width(), place.top() + ahead[1] * place.height())
        for colour, width in (("#000000", 5.0), ("#ffffff", 2.0)):
            painter.setPen(QPen(QColor(colour), width))
            painter.drawLine(QLineF(middle.x() - ARM_PX, middle.y(), middle.x() + ARM_PX, middle.y()))
            painter.drawLine(QLineF(middle.x(), middle.y() - ARM_PX, middle.x(), middle.y() + ARM_PX))


def _marked(on: Bools) -> QImage:
    """Return a clear picture in which pixels are veiled, and their edge is drawn."""
    import cv2

    step = max(on.shape[1] // THIN_PX, 1)
    mask = cv2.morphologyEx(on[::step, ::step].astype(np.uint8), cv2.MORPH_CLOSE, np.ones((3, 3), np.uint8))
    edge = mask - cv2.erode(mask, np.ones((3, 3), np.uint8))
    drawn: U8 = np.zeros((*mask.shape, 4), np.uint8)
    drawn[mask > 0] = (*FOUND, 70)
    drawn[edge > 0] = (*FOUND, 235)
    height, width = mask.shape
    return QImage(drawn.data, width, height, 4 * width, QImage.Format.Format_RGBA8888).copy()
