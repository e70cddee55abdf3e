"""One sensor as a tile: its colour and depth live, its name, and how it is."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize, Qt, QTimer
from PySide6.QtGui import QFont, QFontMetricsF, QImage, QPainter, QPainterPath, QPaintEvent, QPen
from PySide6.QtWidgets import QAbstractButton, QSizePolicy, QWidget

from fruitgui.gui.steps.connect.arrangement import PICTURE_SHAPE
from fruitgui.gui.steps.connect.presenter import SensorView
from fruitgui.gui.steps.connect.thumbnails import Thumbnails
from fruitgui.gui.theme import icons
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID, RADIUS
from fruitgui.gui.widgets.fitting import fitted
from fruitgui.gui.widgets.focus import paint_focus

INSET = 1.5 * GRID
WORDS = 7 * GRID
"""Height of the two lines of words above the pictures."""

FLASHES = 6
FLASH_MS = 220
_ICONS = {"good": "good", "warn": "warn", "bad": "bad", "": "clock"}


class SensorTile(QAbstractButton):
    """A tile that can be chosen; it paints itself, since its pictures change fifteen times a second."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._view: SensorView | None = None
        self._thumbnails: Thumbnails | None = None
        self._stacked = False
        self._flash = QTimer(self, interval=FLASH_MS)
        self._flashes = 0
        self._flash.timeout.connect(self._flash_on)
        self.setCheckable(True)
        self.setAutoExclusive(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        theme.changed.connect(self.update)

    @property
    def view(self) -> SensorView | None:
        """What is shown."""
        return self._view

    @property
    def flashing(self) -> bool:
        """Whether it says which sensor it is."""
        return self._flashes > 0

    def show_view(self, view: SensorView) -> None:
        """Show how the sensor is."""
        if view == self._view:
            return
        self._view = view
        self.setText(view.name)
        reference = self.tr(", reference") if view.reference else ""
        self.setAccessibleName(f"{view.place}. {view.name}{reference}: {view.condition.word}, {view.rate}")
        self.setToolTip("\n".join(part for part in (view.name, view.condition.word, view.condition.remedy) if part))
        self.update()

    @property
    def thumbnails(self) -> Thumbnails | None:
        """The pictures that are shown."""
        return self._thumbnails

    @property
    def picture_px(self) -> int:
        """Device pixels: how wide a picture is shown."""
        return int(self._places()[0].width() * self.devicePixelRatioF())

    def show_thumbnails(self, shown: Thumbnails) -> None:
        """Show the newest pictures."""
        self._thumbnails = shown
        self.update()

    def stack(self, stacked: bool) -> None:
        """Put depth below colour, or beside it."""
        if stacked != self._stacked:
            self._stacked = stacked
            self.update()

    def flash(self) -> None:
        """Blink for a moment, so that a person finds the tile of a sensor."""
        self._flashes = FLASHES
        self._flash.start()
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(320, 220)

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the least size at which something can be seen."""
        return QSize(120, 120)

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        painter = QPainter(self)
        painter.setRenderHints(QPainter.RenderHint.Antialiasing | QPainter.RenderHint.SmoothPixmapTransform)
        self._paint_ground(painter)
        if self._view is not None:
            self._paint_words(painter, self._view)
        colour, depth = self._places()
        shown = self._thumbnails
        self._paint_picture(painter, colour, None if shown is None else shown.colour, "camera")
        self._paint_picture(painter, depth, None if shown is None else shown.depth, "layers")
        painter.end()

    def _flash_on(self) -> None:
        self._flashes -= 1
        if self._flashes <= 0:
            self._flash.stop()
        self.update()

    def _places(self) -> tuple[QRectF, QRectF]:
        """Return where the two pictures are, centred in what the words leave."""
        room = QRectF(self.rect()).adjusted(INSET, INSET + WORDS, -INSET, -INSET)
        if self._stacked:
            height = min((room.height() - GRID) / 2, room.width() / PICTURE_SHAPE)
            size = (height * PICTURE_SHAPE, height)
            whole = QRectF(0, 0, size[0], 2 * height + GRID)
        else:
            width = min((room.width() - GRID) / 2, room.height() * PICTURE_SHAPE)
            size = (width, width / PICTURE_SHAPE)
            whole = QRectF(0, 0, 2 * width + GRID, size[1])
        whole.moveCenter(room.center())
        whole.moveTop(room.top())
        first = QRectF(whole.left(), whole.top(), *size)
        step = (0.0, size[1] + GRID) if self._stacked else (size[0] + GRID, 0.0)
        return first, first.translated(*step)

    def _paint_ground(self, painter: QPainter) -> None:
        theme = self._theme
        edge = QRectF(self.rect()).adjusted(1, 1, -1, -1)
        lit = self._flashes % 2 == 1
        painter.setBrush(theme.colour("accent" if lit else "surface"))
        chosen = self.isChecked()
        painter.setPen(QPen(theme.colour("accent" if chosen else "edge"), 2.0 if chosen else 1.0))
        painter.drawRoundedRect(edge, RADIUS, RADIUS)
        if self.hasFocus():
            paint_focus(painter, edge, RADIUS, theme)

    def _paint_words(self, painter: QPainter, view: SensorView) -> None:
        theme, left, width = self._theme, INSET, self.width() - 2 * INSET
        strong = theme.font("body", QFont.Weight.DemiBold)
        text, lit = f"{view.place}  {view.name}", self._flashes % 2 == 1
        line = QRectF(left, INSET - 2, width, 3 * GRID)
        if view.reference:
            room = width - QFontMetricsF(strong).horizontalAdvance(text) - GRID
            line.setRight(self._paint_badge(painter, line, room, lit) - GRID)
        painter.setPen(theme.colour("on_accent" if lit else "text"))
        painter.setFont(strong)
        name = fitted(painter, text, line.width())
        painter.drawText(line, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, name)
        self._paint_condition(painter, view, QRectF(left, line.bottom() + 2, width, 3 * GRID), lit)

    def _paint_badge(self, painter: QPainter, line: QRectF, room: float, lit: bool) -> float:
        """Mark the reference at the right end, in a word where there is room for it; return where the mark begins."""
        theme, font = self._theme, self._theme.font("small")
        colour, word = theme.colour("on_accent" if lit else "accent"), self.tr("reference")
        width = QFontMetricsF(font).horizontalAdvance(word) + 2 * GRID
        if width > room:
            icons.paint(painter, QRectF(line.right() - 20, line.center().y() - 10, 20, 20), "link", colour)
            return line.right() - 20
        place = QRectF(line.right() - width, line.top() + 1, width, 22)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(colour, 1.2))
        painter.drawRoundedRect(place, 11, 11)
        painter.setFont(font)
        painter.drawText(place, Qt.AlignmentFlag.AlignCenter, word)
        return place.left()

    def _paint_condition(self, painter: QPainter, view: SensorView, line: QRectF, lit: bool) -> None:
        theme, health = self._theme, view.condition.health
        colour = theme.colour("on_accent" if lit else health or "text_dim")
        icons.paint(painter, QRectF(line.left(), line.center().y() - 9, 18, 18), _ICONS[health], colour)
        font, plain = theme.font("small", QFont.Weight.DemiBold), theme.font("small")
        used = 24 + QFontMetricsF(font).horizontalAdvance(view.condition.word) + 2 * GRID
        roomy = QFontMetricsF(plain).horizontalAdvance(view.rate) + used <= line.width()
        word = view.short_rate if health == "good" and not roomy and view.short_rate else view.condition.word
        painter.setFont(font)
        painter.setPen(colour)
        painter.drawText(line.adjusted(24, 0, 0, 0), Qt.AlignmentFlag.AlignVCenter, word)
        if roomy:
            painter.setFont(plain)
            painter.setPen(theme.colour("on_accent" if lit else "text_dim"))
            right = Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight
            painter.drawText(line, right, view.rate)

    def _paint_picture(self, painter: QPainter, place: QRectF, picture: QImage | None, icon: str) -> None:
        theme = self._theme
        clip = QPainterPath()
        clip.addRoundedRect(place, 6, 6)
        painter.save()
        painter.setClipPath(clip)
        painter.fillRect(place, theme.colour("picture"))
        if picture is not None:
            painter.drawImage(place, picture)
        else:
            spot = QRectF(0, 0, 28, 28)
            spot.moveCenter(place.center())
            painter.setOpacity(0.5)
            icons.paint(painter, spot, icon, theme.colour("line"))
        painter.restore()
