"""Shows clouds in three dimensions where OpenGL works: turn with the mouse, or with the arrow keys."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from PySide6.QtGui import QGuiApplication, QOpenGLContext
from PySide6.QtWidgets import QVBoxLayout, QWidget

from fruitgui.gui.steps.calibrate.cloud import coloured, extent_of, weights
from fruitgui.gui.theme.theme import Theme
from fruitgui.station.fused_cloud import SensorCloud

WITHOUT = ("offscreen", "minimal", "vnc", "linuxfb")
POINT_PX = 2.0


def gl_works() -> bool:
    """Tell whether this screen can show three dimensions."""
    return QGuiApplication.platformName() not in WITHOUT and QOpenGLContext().create()


class GlCloud(QWidget):
    """One scatter of points for each sensor."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        import pyqtgraph.opengl as gl

        self._theme = theme
        self._gl: Any = gl
        self._clouds: tuple[SensorCloud, ...] = ()
        self._after = True
        self._at: float | None = None
        self._items: list[Any] = []
        self.view: Any = gl.GLViewWidget()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.view)
        theme.changed.connect(self._dress)
        self._dress()

    def show_clouds(self, clouds: Sequence[SensorCloud]) -> None:
        """Show these, seen from where the whole belt fits."""
        for item in self._items:
            self.view.removeItem(item)
        self._clouds = tuple(clouds)
        self._items = [self._gl.GLScatterPlotItem(size=POINT_PX, pxMode=True) for _ in self._clouds]
        for item in self._items:
            item.setGLOptions("translucent")
            self.view.addItem(item)
        extent = extent_of(self._clouds)
        self.view.opts["center"] = _middle(extent.low_m, extent.high_m)
        length_m = extent.high_m[0] - extent.low_m[0]
        self.view.setCameraPosition(distance=max(0.9 * length_m, 0.5), elevation=38, azimuth=-75)
        self._place()

    def look(self, *, after: bool) -> None:
        """Look at before or after."""
        if after != self._after:
            self._after = after
            self._place()

    def fade(self, at: float | None) -> None:
        """Fade between the sensors."""
        self._at = at
        self._place()

    def _dress(self) -> None:
        self.view.setBackgroundColor(self._theme.colour("picture"))

    def _place(self) -> None:
        strengths = weights(len(self._clouds), self._at)
        for number, (item, cloud, strength) in enumerate(zip(self._items, self._clouds, strengths, strict=True)):
            points = cloud.after_m if self._after else cloud.before_m
            rgb = coloured(points, number).astype(np.float32) / 255.0
            alpha = np.full((len(points), 1), strength, np.float32)
            item.setData(pos=points, color=np.hstack([rgb, alpha]))
            item.setVisible(strength > 0.01)


def _middle(low: Sequence[float], high: Sequence[float]) -> Any:  # noqa: ANN401 - pyqtgraph's vector
    import pyqtgraph as pg

    return pg.Vector(*((a + b) / 2 for a, b in zip(low, high, strict=True)))
