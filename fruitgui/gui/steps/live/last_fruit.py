"""The last fruit that were counted, with their pictures."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QFont, QPainter, QPainterPath, QPaintEvent, QPixmap
from PySide6.QtWidgets import QSizePolicy, QWidget

from fruitgui.gui.drawn import LastFruit
from fruitgui.gui.numbers import measured_text, percent_text
from fruitgui.gui.theme.kinds import UNKNOWN
from fruitgui.gui.theme.stamps import drawn_pixmap, stamp
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.fitting import fitted
from fruitgui.gui.widgets.kind_mark import paint_mark

HEIGHT = 88
PICTURE = 72
WIDEST = 232


class LastFruitView(QWidget):
    """A strip of the newest fruit, the newest at the left; as many as there is room for."""

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._fruit: tuple[LastFruit, ...] = ()
        self._pictures: dict[int, QPixmap] = {}
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setFixedHeight(HEIGHT)
        theme.changed.connect(self.update)

    def show_fruit(self, fruit: Sequence[LastFruit]) -> None:
        """Show other fruit, the newest first."""
        shown = tuple(fruit)
        if [one.key for one in shown] == [one.key for one in self._fruit]:
            return
        self._pictures = {one.key: self._pictures.get(one.key) or _decoded(one.picture) for one in shown}
        self._fruit = shown
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(640, HEIGHT)

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
            if not self._fruit:
                painter.setFont(self._theme.font("body"))
                painter.setPen(self._theme.colour("text_dim"))
                text = self.tr("Each fruit appears here as it is counted.")
                painter.drawText(QRectF(self.rect()), Qt.AlignmentFlag.AlignCenter, text)
            room = max(self.width() // WIDEST, 1)
            width = (self.width() + GRID) / room  # the last one ends where the strip does
            for number, fruit in enumerate(self._fruit[:room]):
                drawn = self._card(fruit, width - GRID, newest=number == 0)
                painter.drawPixmap(QPointF(number * width, 0), drawn)

    def _card(self, fruit: LastFruit, width: float, *, newest: bool) -> QPixmap:
        theme, box, ratio = self._theme, QRectF(0, 0, width, HEIGHT), self.devicePixelRatioF()
        key = ("fruit", id(self), fruit.key, fruit.name, width, newest, ratio, theme.name)
        return stamp(
            key,
            lambda: drawn_pixmap(
                width, HEIGHT, ratio, lambda painter: self._paint(painter, fruit, box, newest=newest)
            ),
        )  # fmt: skip

    def _paint(self, painter: QPainter, fruit: LastFruit, box: QRectF, *, newest: bool) -> None:
        theme = self._theme
        painter.setPen(theme.colour("accent") if newest else Qt.PenStyle.NoPen)
        painter.setBrush(theme.colour("raised"))
        painter.drawRoundedRect(box.adjusted(0.5, 0.5, -0.5, -0.5), GRID, GRID)
        place = QRectF(box.left() + GRID, box.center().y() - PICTURE / 2, PICTURE, PICTURE)
        _paint_picture(painter, place, self._pictures[fruit.key])
        text = QRectF(place.right() + GRID, box.top() + GRID, box.right() - place.right() - 2 * GRID, HEIGHT - 2 * GRID)
        third = text.height() / 3.0
        mark = QRectF(text.left(), text.top(), third, third)
        paint_mark(painter, mark, fruit.mark)
        painter.setFont(theme.font("body", QFont.Weight.DemiBold))
        painter.setPen(theme.colour("text"))
        name = QRectF(mark.right() + GRID / 2, text.top(), text.right() - mark.right() - GRID / 2, third)
        shown = fitted(painter, fruit.name, name.width())
        left = Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft
        painter.drawText(name, left, shown)
        painter.setFont(theme.font("small"))
        painter.drawText(QRectF(text.left(), text.top() + third, text.width(), third), left,
                         measured_text(fruit.volume_ml, fruit.volume_std_ml, "ml"))  # fmt: skip
        painter.setPen(theme.colour("text_dim"))
        painter.drawText(QRectF(text.left(), text.top() + 2 * third, text.width(), third), left,
                         _small_print(fruit))  # fmt: skip


def _small_print(fruit: LastFruit) -> str:
    sure = "" if fruit.mark.kind == UNKNOWN else f" · {percent_text(fruit.probability)}"
    return f"{fruit.number}{sure}"


def _decoded(picture: bytes | None) -> QPixmap:
    pixmap = QPixmap()
    if picture is not None:
        pixmap.loadFromData(picture)
    return pixmap


def _paint_picture(painter: QPainter, place: QRectF, pixmap: QPixmap) -> None:
    """Draw the middle of a picture into a square with round corners."""
    if pixmap.isNull():
        return
    painter.save()
    path = QPainterPath()
    path.addRoundedRect(place, 6, 6)
    painter.setClipPath(path)
    side = min(pixmap.width(), pixmap.height())
    source = QRectF((pixmap.width() - side) / 2, (pixmap.height() - side) / 2, side, side)
    painter.drawPixmap(place, pixmap, source)
    painter.restore()
