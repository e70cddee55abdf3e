"""Shows clouds from above or from the side, anywhere: no graphics card is needed."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, QTimer
from PySide6.QtGui import QImage, QPainter, QPainterPath, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from fruitgui.gui.numbers import THIN
from fruitgui.gui.queries import Queries
from fruitgui.gui.steps.calibrate.cloud import Extent, Fit, Side, extent_of, fitted, weights
from fruitgui.gui.steps.calibrate.flat_pictures import Wanted, flat_picture
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID, RADIUS
from fruitgui.station.fused_cloud import SensorCloud

BAR_M = 0.1
MOST_PX = 1400
"""Layers are no wider than this, however large the screen: the points would lie apart."""

RESIZED_MS = 80


class FlatCloud(QWidget):
    """Pictures are made beside the window when they are first wanted; fading only mixes them.

    Until they are there, what was shown before stays.

    Attributes:
        queries: what is being made.
    """

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._clouds: tuple[SensorCloud, ...] = ()
        self._extent: Extent | None = None
        self._side, self._after = Side.TOP, True
        self._at: float | None = None
        self._made: dict[Wanted, QImage] = {}
        self._asked: set[Wanted] = set()
        self._shown: tuple[tuple[QImage, float], ...] = ()
        self._fit: Fit | None = None
        self.queries = Queries(self)
        self._settled = QTimer(self, singleShot=True, interval=RESIZED_MS)
        self._settled.timeout.connect(self._begin_anew)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(240, 160)
        theme.changed.connect(self.update)

    def show_clouds(self, clouds: Sequence[SensorCloud]) -> None:
        """Show these."""
        self._clouds, self._extent, self._shown = tuple(clouds), None, ()
        self._begin_anew()
        if clouds:
            self.queries.ask("extent", partial(extent_of, self._clouds), self._take_extent)

    def look(self, side: Side, *, after: bool) -> None:
        """Look from another side, or at before or after."""
        self._after = after
        if side is not self._side:
            self._side = side
            self._begin_anew()
        self.update()

    def fade(self, at: float | None) -> None:
        """Fade between the sensors; see `cloud.weights`."""
        self._at = at
        self.update()

    @property
    def clouds(self) -> tuple[SensorCloud, ...]:
        """What is shown."""
        return self._clouds

    @property
    def drawn(self) -> bool:
        """Whether everything that is to be seen now has been made."""
        return all(one in self._made for one, _ in self._wanted())

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(560, 360)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        """Make the pictures anew, once the size stays."""
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
            self._choose_pictures()
            for picture, weight in self._shown:
                painter.setOpacity(weight)
                painter.drawImage(QRectF(self.rect()), picture)
            painter.setOpacity(1.0)
            if self._fit is not None and self._shown:
                self._paint_bar(painter, self._fit)

    def _wanted(self) -> list[tuple[Wanted, float]]:
        """Return the pictures that show how the slider stands, each with its strength."""
        strengths = weights(len(self._clouds), self._at)
        if not strengths or all(weight >= 1.0 for weight in strengths):
            return [(Wanted(None, self._after), 1.0)] if strengths else []
        return [(Wanted(number, self._after), weight) for number, weight in enumerate(strengths) if weight > 0.0]

    def _choose_pictures(self) -> None:
        """Show what is wanted once all of it is there; ask for what is missing."""
        wanted = self._wanted()
        missing = [one for one, _ in wanted if one not in self._made]
        if not missing:
            self._shown = tuple((self._made[one], weight) for one, weight in wanted)
        elif self._fit is not None:
            for one in missing:
                self._ask(one, self._fit)

    def _ask(self, wanted: Wanted, fit: Fit) -> None:
        if wanted in self._asked:
            return
        self._asked.add(wanted)

        def take(picture: QImage) -> None:
            if fit is self._fit:
                self._made[wanted] = picture
                self.update()

        self.queries.ask(repr(wanted), partial(flat_picture, self._clouds, wanted, fit), take)

    def _take_extent(self, extent: Extent) -> None:
        self._extent = extent
        self._begin_anew()

    def _begin_anew(self) -> None:
        """Forget the pictures: they are made anew as they are wanted."""
        self._made, self._asked, self._fit = {}, set(), None
        self.update()
        if self._extent is None or self.width() < 2 or self.height() < 2:
            return
        thin = min(1.0, MOST_PX / self.width())
        width, height = max(int(self.width() * thin), 1), max(int(self.height() * thin), 1)
        side = Side.TOP if self._side is Side.FREE else self._side
        self._fit = fitted(self._extent, side, width, height)

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
