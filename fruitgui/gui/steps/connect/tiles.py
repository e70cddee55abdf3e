"""All sensors as tiles, from one to many, arranged so that their pictures are as large as they can be."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial

from PySide6.QtCore import QRect, QTimer, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QWidget

from fruitgui.gui.queries import Queries
from fruitgui.gui.steps.connect.arrangement import arranged
from fruitgui.gui.steps.connect.presenter import SensorView
from fruitgui.gui.steps.connect.thumbnails import Thumbnails, thumbnails
from fruitgui.gui.steps.connect.tile import INSET, WORDS, SensorTile
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.sensors.feed import Feed

DRAW_MS = 67
"""Fifteen pictures a second."""

GAP = 2 * GRID


class SensorTiles(QWidget):
    """The tiles; one is chosen. Pictures are made beside the window while `run` says so.

    Attributes:
        queries: what is being made.
        chosen: name of the sensor that a person chose.
    """

    chosen = Signal(str)

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._feed: Feed | None = None
        self._tiles: list[SensorTile] = []
        self.queries = Queries(self)
        self._draw = QTimer(self, interval=DRAW_MS)
        self._draw.timeout.connect(self._show_frames)
        self.setMinimumSize(240, 240)

    @property
    def tiles(self) -> tuple[SensorTile, ...]:
        """The tiles, in order."""
        return tuple(self._tiles)

    def run(self, on: bool) -> None:
        """Draw live pictures, or rest."""
        (self._draw.start if on else self._draw.stop)()

    def show_feed(self, feed: Feed | None) -> None:
        """Take pictures from another feed."""
        self._feed = feed

    def show_views(self, views: Sequence[SensorView], chosen: str) -> None:
        """Show these sensors, one of them chosen."""
        if len(views) != len(self._tiles):
            self._make(len(views))
        for tile, view in zip(self._tiles, views, strict=True):
            tile.show_view(view)
            if view.name == chosen:
                tile.setChecked(True)

    def flash(self, name: str) -> None:
        """Let a sensor's tile say which it is."""
        for tile in self._tiles:
            if tile.text() == name:
                tile.flash()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        """Arrange the tiles anew."""
        super().resizeEvent(event)
        self._arrange()

    def _make(self, count: int) -> None:
        for tile in self._tiles[count:]:
            tile.hide()
            tile.deleteLater()
        del self._tiles[count:]
        while len(self._tiles) < count:
            tile = SensorTile(self._theme, self)
            tile.clicked.connect(self._tell_chosen)
            tile.show()
            self._tiles.append(tile)
        self._arrange()

    def _arrange(self) -> None:
        if not self._tiles:
            return
        count, around = len(self._tiles), 2 * INSET
        fit = arranged(count, self.width(), self.height(), around=around, words=WORDS, gap=GAP, between=GRID)
        rows = math.ceil(count / fit.columns)
        width = (self.width() - (fit.columns - 1) * GAP) / fit.columns
        room = (self.height() - (rows - 1) * GAP) / rows
        height = min(fit.pictures_height(GRID) + around + WORDS, room)
        for number, tile in enumerate(self._tiles):
            row, column = divmod(number, fit.columns)
            tile.stack(fit.stacked)
            place = QRect(round(column * (width + GAP)), round(row * (height + GAP)), int(width), round(height))
            tile.setGeometry(place)

    def _tell_chosen(self) -> None:
        tile = self.sender()
        if isinstance(tile, SensorTile):
            self.chosen.emit(tile.text())

    def _show_frames(self) -> None:
        """Begin to make pictures of frames that are new, unless some are being made."""
        feed = self._feed
        if feed is None or self.queries.busy:
            return
        wanted = {}
        for tile in self._tiles:
            frame, shown = feed.newest(tile.text()) if tile.text() in feed.infos else None, tile.thumbnails
            if frame is not None and (shown is None or not shown.of(frame)):
                wanted[tile.text()] = partial(thumbnails, frame, tile.picture_px, shown)
        if wanted:
            self.queries.ask("pictures", lambda: {name: make() for name, make in wanted.items()}, self._take)

    def _take(self, made: dict[str, Thumbnails]) -> None:
        for tile in self._tiles:
            if tile.text() in made:
                tile.show_thumbnails(made[tile.text()])
