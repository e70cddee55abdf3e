"""Where everything on the live screen is: pictures, belt and last fruit at the left, counts at the right."""

from __future__ import annotations

import math
from collections.abc import Sequence

from PySide6.QtCore import QEvent, QObject, QSize, Signal
from PySide6.QtGui import QAction, QResizeEvent
from PySide6.QtWidgets import QGridLayout, QHBoxLayout, QMenu, QToolButton, QVBoxLayout, QWidget

from fruitgui.gui.drawn import KindLine
from fruitgui.gui.steps.live.belt_map import BeltView
from fruitgui.gui.steps.live.counts import CountsView
from fruitgui.gui.steps.live.last_fruit import LastFruitView
from fruitgui.gui.steps.live.standing import StandingBand
from fruitgui.gui.theme import icons
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import Card, label
from fruitgui.gui.widgets.histogram import HistogramView
from fruitgui.gui.widgets.sensor_picture import SensorPicture
from fruitgui.gui.widgets.worded import Worded

MOST_COLUMNS = 4
LAYERS_PX = 22

COUNTS_SHARE = 3
"""The counts are so many times as high as the histogram below them."""


class Pictures(QWidget):
    """One picture for each sensor, arranged by their number; one of them can be made large.

    Attributes:
        enlarged: whether one is large now.
    """

    enlarged = Signal(bool)

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setSpacing(GRID)
        self._large: str | None = None
        self.pictures: dict[str, SensorPicture] = {}

    def show_sensors(self, sensors: Sequence[str]) -> None:
        """Show these sensors, in this order."""
        if list(self.pictures) == list(sensors):
            return
        for picture in self.pictures.values():
            self._grid.removeWidget(picture)
            picture.hide()
            picture.deleteLater()
        self.pictures = {sensor: SensorPicture(sensor, self._theme, self) for sensor in sensors}
        for picture in self.pictures.values():
            picture.pressed.connect(self.toggle)
        self._large = None
        self._arrange()
        self.enlarged.emit(False)

    def toggle(self, sensor: str) -> None:
        """Make one picture large, or all alike again."""
        self._large = None if self._large == sensor else sensor
        self._arrange()
        self.enlarged.emit(self._large is not None)

    def _arrange(self) -> None:
        shown = [one for one in self.pictures if self._large in (None, one)]
        columns = columns_for(len(shown))
        for picture in self.pictures.values():
            self._grid.removeWidget(picture)
            picture.setVisible(picture.sensor in shown)
        for number, sensor in enumerate(shown):
            self._grid.addWidget(self.pictures[sensor], number // columns, number % columns)


def columns_for(pictures: int) -> int:
    """Return how many columns so many pictures are shown in."""
    return max(1, min(MOST_COLUMNS, math.ceil(math.sqrt(pictures)) if pictures != 2 else 2))


class LiveLayout(Worded, QWidget):
    """The furniture of the live screen."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.pictures, self.belt = Pictures(theme), BeltView(theme)
        self.last, self.counts = LastFruitView(theme), CountsView(theme)
        self.histogram, self.standing = HistogramView(theme), StandingBand(theme)
        belt_card, counts_card, histogram_card = Card(), Card(), Card()
        for card, widget in (
            (belt_card, self.belt), (counts_card, self.counts), (histogram_card, self.histogram),
        ):  # fmt: skip
            card.body.addWidget(widget)
        self.no_histogram = label("", "small")
        self.no_histogram.setWordWrap(True)
        self.no_histogram.setVisible(False)
        counts_card.body.addWidget(self.no_histogram)
        belt_card.setProperty("role", "picture")
        left, right, whole = QVBoxLayout(), QVBoxLayout(), QHBoxLayout(self)
        for column in (left, right, whole):
            column.setContentsMargins(0, 0, 0, 0)
            column.setSpacing(GRID)
        left.addWidget(self.pictures, 5)
        left.addWidget(belt_card, 3)
        left.addWidget(self.last)
        right.addWidget(self.standing)
        right.addWidget(counts_card, COUNTS_SHARE)
        right.addWidget(histogram_card, 1)
        whole.setSpacing(2 * GRID)
        whole.addLayout(left, 8)
        whole.addLayout(right, 5)
        self._shown = QToolButton(self.pictures)
        self._shown.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self._shown.setIconSize(QSize(LAYERS_PX, LAYERS_PX))
        self._menu = QMenu(self._shown)
        self._shown.setMenu(self._menu)
        self.pictures.installEventFilter(self)
        self.pictures.enlarged.connect(self._give_way)
        self._belt_card, self._counts_card, self._histogram_card = belt_card, counts_card, histogram_card
        theme.changed.connect(self._draw)
        self._theme = theme
        self._draw()
        self._say_words()

    def show_overlay_actions(self, actions: Sequence[QAction]) -> None:
        """Offer to choose what is drawn over the pictures."""
        self._menu.addActions(list(actions))

    def show_counts(self, lines: Sequence[KindLine]) -> None:
        """Show other counts."""
        self.counts.show_lines(lines)
        self._share_right()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        """Use the room."""
        super().resizeEvent(event)
        self._share_right()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        """Keep the button in its corner."""
        if watched is self.pictures and event.type() in (QEvent.Type.Resize, QEvent.Type.ChildAdded):
            self._shown.adjustSize()
            self._shown.move(self.pictures.width() - self._shown.width() - GRID, GRID)
            self._shown.raise_()
        return super().eventFilter(watched, event)

    def _give_way(self, enlarged: bool) -> None:
        """Give a large picture all the room at the left: only there its labels have words in the least window."""
        for one in (self._belt_card, self.last):
            one.setVisible(not enlarged)

    def _share_right(self) -> None:
        """Let the histogram give way where the counts beside it could not be read from two metres away.

        That is said below the counts where there is room for it, and else where a pointer rests on them.
        """
        around = self._counts_card.body.contentsMargins()
        room = self.height() - (0 if self.standing.isHidden() else self.standing.height() + GRID)
        beside = (room - GRID) * COUNTS_SHARE / (COUNTS_SHARE + 1) - around.top() - around.bottom()
        fits = beside >= self.counts.far_height
        self._histogram_card.setVisible(fits)
        words = self.no_histogram.heightForWidth(max(self.counts.width(), 1)) + self._counts_card.body.spacing()
        frame = self._counts_card.height() - self._counts_card.body.geometry().height()
        alone = room - frame - words >= self.counts.far_height
        self.no_histogram.setVisible(not fits and alone)
        self.counts.setToolTip("" if fits or alone else self.no_histogram.text())

    def _draw(self) -> None:
        self._shown.setIcon(icons.icon("layers", self._theme.colour("text"), size_px=LAYERS_PX))

    def _say_words(self) -> None:
        text = self.tr("What is drawn over the pictures (F5 to F8)")
        self._shown.setToolTip(text)
        self._shown.setAccessibleName(text)
        self.no_histogram.setText(self.tr("How volumes are spread is shown at step 7: here the counts take the room."))
