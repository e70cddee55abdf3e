"""Shows clouds from above or from the side, anywhere: no graphics card is needed."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, QTimer
from PySide6.QtGui import QImage, QPainter, QPainterPath, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from fruitgui.frame import U8
from fruitgui.gui.numbers import THIN
from fruitgui.gui.steps.calibrate.cloud import Fit, Side, coloured, extent_of, fitted, layer, weights
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID, RADIUS
from fruitgui.station.fused_cloud import SensorCloud

BAR_M = 0.1
MOST_PX = 1400
"""Layers are no wider than this, however large the screen: the points would lie apart."""

RESIZED_MS = 80


class FlatCloud(QWidget):
    """Pictures are made when they are first wanted after clouds, side or size changed; fading only mixes them."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._clouds: tuple[SensorCloud, ...] = ()
        self._extent = extent_of(())
        self._side, self._after = Side.TOP, True
        self._at: float | None = None
        self._made: dict[int | None, QImage] = {}
        self._fit: Fit | None = None
        self._settled = QTimer(self, singleShot=True, interval=RESIZED_MS)
        self._settled.timeout.connect(self._render)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(240, 160)
        theme.changed.connect(self.update)

    def show_clouds(self, clouds: Sequence[SensorCloud]) -> None:
        """Show these."""
        self._clouds = tuple(clouds)
        self._extent = extent_of(self._clouds)
        self._render()

    def look(self, side: Side, *, after: bool) -> None:
        """Look from another side, or at before or after."""
        if (side, after) != (self._side, self._after):
            self._side, self._after = side, after
            self._render()

    def fade(self, at: float | None) -> None:
        """Fade between the sensors; see `cloud.weights`."""
        self._at = at
        self.update()

    @property
    def clouds(self) -> tuple[SensorCloud, ...]:
        """What is shown."""
        return self._clouds

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(560, 360)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        """Make the layers anew, once the size stays."""
        super().resizeEvent(event)
        self._settled.start()

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        with QPainter(self) as painter:
            painter.setRenderHints(QPainter.RenderHint.Antialiasing | QPainter.RenderHint.SmoothPixmapTransform)
            clip = QPainterPath()
            clip.addRoundedRect(QRectF(self.rect()), RADIUS, RADIUS)
            painter.setClipPath(clip)
            painter.fillRect(self.rect(), self._theme.colour("picture"))
            self._paint_points(painter)
            if self._fit is not None and self._clouds:
                self._paint_bar(painter, self._fit)

    def _paint_points(self, painter: QPainter) -> None:
        strengths = weights(len(self._clouds), self._at)
        if self._fit is None or not self._clouds:
            return
        if all(weight >= 1.0 for weight in strengths):
            painter.drawImage(QRectF(self.rect()), self._picture(None, self._fit))
            return
        for number, weight in enumerate(strengths):
            if weight > 0.0:
                painter.setOpacity(weight)
                painter.drawImage(QRectF(self.rect()), self._picture(number, self._fit))
        painter.setOpacity(1.0)

    def _render(self) -> None:
        """Forget the pictures, and make them as they are wanted."""
        if self.width() < 2 or self.height() < 2:
            return
        thin = min(1.0, MOST_PX / self.width())
        width, height = max(int(self.width() * thin), 1), max(int(self.height() * thin), 1)
        side = Side.TOP if self._side is Side.FREE else self._side
        self._fit = fitted(self._extent, side, width, height)
        self._made = {}
        self.update()

    def _picture(self, number: int | None, fit: Fit) -> QImage:
        """Return one sensor's picture, or that of all together."""
        if number not in self._made:
            chosen = range(len(self._clouds)) if number is None else (number,)
            clouds = {one: self._clouds[one] for one in chosen}
            points = {one: cloud.after_m if self._after else cloud.before_m for one, cloud in clouds.items()}
            colours = [coloured(shown, one) for one, shown in points.items()]
            self._made[number] = _image(layer(np.concatenate(list(points.values())), np.concatenate(colours), fit))
        return self._made[number]

    def _paint_bar(self, painter: QPainter, fit: Fit) -> None:
        """Draw a bar of ten centimetres."""
        length = BAR_M * fit.scale * self.width() / fit.width
        start = QPointF(2 * GRID, self.height() - 2 * GRID)
        painter.setPen(QPen(Qt.GlobalColor.white, 2.0))
        painter.drawLine(start, start + QPointF(length, 0))
        painter.setFont(self._theme.font("small"))
        note = f"10{THIN}cm"
        if fit.side is Side.SIDE:
            note = self.tr("{length}; heights drawn 2.5 times as large").format(length=note)
        painter.drawText(start + QPointF(0, -6), note)


def _image(picture: U8) -> QImage:
    height, width = picture.shape[:2]
    return QImage(picture.data, width, height, 4 * width, QImage.Format.Format_RGBA8888).copy()
