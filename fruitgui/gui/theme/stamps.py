"""Small pictures that are drawn once and copied from then on.

What is drawn again and again (a mark, an icon, a label) costs hundreds of calls each time; a copy costs one.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable

from PySide6.QtCore import Qt
from PySide6.QtGui import QPainter, QPixmap, QPixmapCache


def stamp(key: Hashable, make: Callable[[], QPixmap]) -> QPixmap:
    """Return what is made, or the copy that was made of the same key before.

    Qt keeps them, some ten megabytes, and forgets those that were not used for longest.

    Args:
        key: everything that decides how it looks, said by its `repr`.
        make: draws it.
    """
    name, kept = repr(key), QPixmap()
    if not QPixmapCache.find(name, kept):
        kept = make()
        QPixmapCache.insert(name, kept)
    return kept


def clear_pixmap(width: float, height: float, ratio: float) -> QPixmap:
    """Return a picture of a size to draw on, `ratio` device pixels to each of ours, with nothing on it yet."""
    pixmap = QPixmap(math.ceil(width * ratio), math.ceil(height * ratio))
    pixmap.setDevicePixelRatio(ratio)
    pixmap.fill(Qt.GlobalColor.transparent)
    return pixmap


def drawn_pixmap(width: float, height: float, ratio: float, paint: Callable[[QPainter], None]) -> QPixmap:
    """Return a picture of a size with what `paint` draws on it."""
    pixmap = clear_pixmap(width, height, ratio)
    with QPainter(pixmap) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        paint(painter)
    return pixmap
