"""The window larger than the system would have it: its words, and with them all that is drawn and pressed."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import get_args

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QApplication

from fruitgui.station.settings import Settings

USUAL = 100
LEAST = QSize(1280, 720)
"""The least window: at no size of its words may less than that be on the screen."""

_FACTOR = "QT_SCALE_FACTOR"
_IN_FORCE = "words_percent"


def offered(screen: QSize, chosen: int) -> tuple[int, ...]:
    """Return the sizes, percent, at which the least window is on a screen, the usual and the chosen one in any case.

    Args:
        screen: the size that a window may have on it as Qt tells it, which is by the size in force.
        chosen: percent.
    """
    application = QApplication.instance()
    now = int((application and application.property(_IN_FORCE)) or USUAL)
    every: tuple[int, ...] = get_args(Settings.model_fields["words_percent"].annotation)
    return tuple(one for one in every if one in (USUAL, chosen) or _fits(screen * (now / one)))


def enlarged(make: Callable[[], QApplication], percent: int) -> QApplication:
    """Return the application that `make` makes, larger by so many percent; as usual where the screen is too small.

    Qt hears of its size only before it is there. Who set Qt's own factor has it.
    """
    if percent == USUAL or _FACTOR in os.environ or QApplication.instance() is not None:
        return make()
    os.environ[_FACTOR] = str(percent / USUAL)
    try:
        qt = make()
    finally:
        del os.environ[_FACTOR]
    if _fits(qt.primaryScreen().availableSize()):
        qt.setProperty(_IN_FORCE, percent)
        return qt
    qt.shutdown()
    return make()


def _fits(screen: QSize) -> bool:
    return screen.width() >= LEAST.width() and screen.height() >= LEAST.height()
