"""Moments and durations as people read them, in the window's language and the floor's own time."""

from __future__ import annotations

from PySide6.QtCore import QDateTime, QLocale

from fruitgui.gui.numbers import THIN


def moment_text(time_s: float) -> str:
    """Return a moment as day and time."""
    return _formatted(time_s, "d MMM yyyy HH:mm")


def recent_text(time_s: float, now_s: float) -> str:
    """Return a moment as day and time, with its year where that is not the present one."""
    now, then = (QDateTime.fromSecsSinceEpoch(round(one)).date().year() for one in (now_s, time_s))
    return _formatted(time_s, "d MMM HH:mm") if now == then else moment_text(time_s)


def clock_text(time_s: float) -> str:
    """Return the time of day of a moment."""
    return _formatted(time_s, "HH:mm")


def second_text(time_s: float) -> str:
    """Return the time of day of a moment to the second."""
    return _formatted(time_s, "HH:mm:ss")


def _formatted(time_s: float, how: str) -> str:
    return QLocale().toString(QDateTime.fromSecsSinceEpoch(round(time_s)), how)


def duration_text(duration_s: float) -> str:
    """Return how long something took: seconds below two minutes, then minutes, then hours with minutes."""
    if duration_s < 120:
        return f"{round(duration_s)}{THIN}s"
    minutes = round(duration_s / 60)
    if minutes < 60:
        return f"{minutes}{THIN}min"
    return f"{minutes // 60}{THIN}h {minutes % 60}{THIN}min"
