"""Shows clouds in three dimensions where OpenGL works: turn with the mouse, or with the arrow keys."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from PySide6.QtGui import QGuiApplication, QOpenGLContext
from PySide6.QtWidgets import QVBoxLayout, QWidget

from fruitgui.frame import F32
from fruitgui.gui.queries import Queries
from fruitgui.gui.steps.calibrate.cloud import Extent, coloured, extent_of, weights
from fruitgui.gui.theme.theme import Theme
from fruitgui.station.fused_cloud import SensorCloud

WITHOUT = ("offscreen", "minimal", "vnc", "linuxfb")
POINT_PX = 2.0


def gl_works() -> bool:
    """Tell whether this screen can show three dimensions."""
    return QGuiApplication.platformName() not in WITHOUT and QOpenGLContext().create()


@dataclass(frozen=True, slots=True, eq=False)
class _Points:
    """The points of one sensor (N, 3), and their colours (N, 4), 0 to 1; fading changes how clear they are."""

    at_m: F32
    rgba: F32


class GlCloud(QWidget):
    """One scatter of points for each sensor.

    Attributes:
        queries: what is being made.
        view: pyqtgraph's.
    """

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        import pyqtgraph.opengl as gl

        self._theme = theme
        self._gl: Any = gl
        self._clouds: tuple[SensorCloud, ...] = ()
        self._after = True
        self._at: float | None = None
        self._items: list[Any] = []
        self._seen: dict[bool, tuple[_Points, ...]] = {}
        self.queries = Queries(self)
        self.view: Any = gl.GLViewWidget()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.view)
        theme.changed.connect(self._dress)
        self._dress()

    @property
    def drawn(self) -> bool:
        """Whether all colours are made."""
        return not self.queries.busy

    def show_clouds(self, clouds: Sequence[SensorCloud]) -> None:
        """Show these, seen from where the whole belt fits, as soon as their colours are made beside the window."""
        for item in self._items:
            self.view.removeItem(item)
        self._clouds, self._seen = tuple(clouds), {}
        self._items = [self._gl.GLScatterPlotItem(size=POINT_PX, pxMode=True) for _ in self._clouds]
        for item in self._items:
            item.setGLOptions("translucent")
            self.view.addItem(item)
        if clouds:
            self.queries.ask("points", partial(_points, self._clouds), self._take)

    def _take(self, made: tuple[Extent, dict[bool, tuple[_Points, ...]]]) -> None:
        extent, self._seen = made
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
        for item, points, strength in zip(self._items, self._seen.get(self._after, ()), strengths, strict=False):
            points.rgba[:, 3] = strength
            item.setData(pos=points.at_m, color=points.rgba)
            item.setVisible(strength > 0.01)


def _points(clouds: Sequence[SensorCloud]) -> tuple[Extent, dict[bool, tuple[_Points, ...]]]:
    """Return what the clouds fill, and their points before and after; any thread may make them."""
    seen = {
        after: tuple(
            _Points(at_m, _rgba(at_m, number))
            for number, cloud in enumerate(clouds)
            for at_m in (cloud.after_m if after else cloud.before_m,)
        )
        for after in (False, True)
    }
    return extent_of(clouds), seen


def _rgba(points_m: F32, number: int) -> F32:
    opaque = np.ones((len(points_m), 4), np.float32)
    opaque[:, :3] = coloured(points_m, number)
    opaque[:, :3] /= 255.0
    return opaque


def _middle(low: Sequence[float], high: Sequence[float]) -> Any:  # noqa: ANN401 - pyqtgraph's vector
    import pyqtgraph as pg

    return pg.Vector(*((a + b) / 2 for a, b in zip(low, high, strict=True)))
