"""How far two colours stand apart, and which edge a shape needs to be seen."""

from __future__ import annotations

from functools import cache

from PySide6.QtGui import QColor

SHAPES, WORDS = 3.0, 4.5
"""The least contrast of shapes that mean something, and of words (WCAG 2.1, AA)."""


@cache
def contrast(one: str, other: str) -> float:
    """Return the contrast of two colours, `#rrggbb` (WCAG 2.1, 1 to 21)."""
    light, dark = sorted((_luminance(one), _luminance(other)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


def _luminance(colour: str) -> float:
    made = QColor(colour)
    parts = (made.redF(), made.greenF(), made.blueF())
    linear = [part / 12.92 if part <= 0.03928 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
