"""The program's own icons: line drawings that take the colour of the theme."""

from __future__ import annotations

from functools import cache

from PySide6.QtCore import QByteArray, QRectF
from PySide6.QtGui import QColor, QIcon, QPainter, QPixmap
from PySide6.QtSvg import QSvgRenderer

from fruitgui.gui.theme.stamps import drawn_pixmap, stamp
from fruitgui.resources import folder

RATIOS = (1, 2)
"""An icon is drawn for usual screens and for those with twice as many pixels."""


def icon(name: str, colour: QColor, disabled: QColor | None = None, size_px: int = 20) -> QIcon:
    """Return an icon by the name of its file, in a colour, and in another where it cannot be pressed."""
    made = QIcon()
    for size in (ratio * size_px for ratio in RATIOS):
        made.addPixmap(pixmap(name, colour, size))
        if disabled is not None:
            made.addPixmap(pixmap(name, disabled, size), QIcon.Mode.Disabled)
    return made


def pixmap(
    name: str, colour: QColor, size_px: float, ratio: float = 1.0, ground: QColor | None = None
) -> QPixmap:  # fmt: skip
    """Return a drawing at a size, `ratio` device pixels to each of ours; `ground` shows where it is cut out."""
    below = ground or _opposite(colour)

    def make() -> QPixmap:
        text = _source(name).replace("currentColor", colour.name()).replace("#ground", below.name())
        drawing, place = QSvgRenderer(QByteArray(text.encode())), QRectF(0, 0, size_px, size_px)
        return drawn_pixmap(size_px, size_px, ratio, lambda painter: drawing.render(painter, place))

    return stamp(("icon", name, colour.name(), below.name(), size_px, ratio), make)


def paint(painter: QPainter, place: QRectF, name: str, colour: QColor, ground: QColor | None = None) -> None:
    """Draw an icon into a square place; `ground` is what shows through where it is cut out."""
    drawn = pixmap(name, colour, place.width(), painter.device().devicePixelRatioF(), ground)
    painter.drawPixmap(place.topLeft().toPoint(), drawn)


def _opposite(colour: QColor) -> QColor:
    return QColor("#0c1013") if colour.lightnessF() > 0.5 else QColor("#ffffff")


@cache
def _source(name: str) -> str:
    return (folder("icons") / f"{name}.svg").read_text(encoding="utf-8")
