"""The program's own icons: line drawings that take the colour of the theme."""

from __future__ import annotations

from functools import cache

from PySide6.QtCore import QByteArray, QRectF, Qt
from PySide6.QtGui import QColor, QIcon, QPainter, QPixmap
from PySide6.QtSvg import QSvgRenderer

from fruitgui.resources import folder

SIZES_PX = (16, 20, 24, 32, 48, 64, 96)


def icon(name: str, colour: QColor, disabled: QColor | None = None) -> QIcon:
    """Return an icon by the name of its file, in a colour, and in another where it cannot be pressed."""
    made = QIcon()
    for size in SIZES_PX:
        made.addPixmap(pixmap(name, colour, size))
        if disabled is not None:
            made.addPixmap(pixmap(name, disabled, size), QIcon.Mode.Disabled)
    return made


def pixmap(name: str, colour: QColor, size_px: int, ratio: float = 1.0) -> QPixmap:
    """Return a drawing at a size, `ratio` device pixels to each of ours."""
    drawn = QPixmap(round(size_px * ratio), round(size_px * ratio))
    drawn.fill(Qt.GlobalColor.transparent)
    painter = QPainter(drawn)
    paint(painter, QRectF(drawn.rect()), name, colour)
    painter.end()
    drawn.setDevicePixelRatio(ratio)
    return drawn


def paint(painter: QPainter, place: QRectF, name: str, colour: QColor, ground: QColor | None = None) -> None:
    """Draw an icon into a place; `ground` is what shows through where it is cut out."""
    text = _source(name).replace("currentColor", colour.name())
    text = text.replace("#ground", (ground or _opposite(colour)).name())
    QSvgRenderer(QByteArray(text.encode())).render(painter, place)


def _opposite(colour: QColor) -> QColor:
    return QColor("#0c1013") if colour.lightnessF() > 0.5 else QColor("#ffffff")


@cache
def _source(name: str) -> str:
    return (folder("icons") / f"{name}.svg").read_text(encoding="utf-8")
