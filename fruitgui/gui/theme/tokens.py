"""The colours and sizes of the window, as plain data: two themes, one grid."""

from __future__ import annotations

from dataclasses import dataclass

GRID = 8
"""Pixels: every distance is a multiple or a half of it."""

RADIUS = 10
"""Pixels: of cards; controls have less."""

TOUCH = 44
"""Pixels: the least height of what a gloved finger presses."""

RAIL = 208
"""Pixels: width of the strip of steps."""


@dataclass(frozen=True, slots=True)
class TypeScale:
    """Font sizes in pixels: four for reading, and the figures that are read from two metres away."""

    small: int = 13
    body: int = 15
    title: int = 20
    page: int = 26
    figure: int = 44


@dataclass(frozen=True, slots=True)
class Colours:
    """One theme's colours, `#rrggbb`.

    Attributes:
        ground: behind everything. surface: of cards. raised: of what lies on cards. line: hairlines and borders.
        edge: of what can be pressed or typed into; reaches a contrast of 3 on all three (WCAG 2.1, 1.4.11).
        picture: behind camera pictures.
        text, text_dim: of reading matter; both reach a contrast of 4.5 on `surface` (WCAG 2.1 AA).
        accent, on_accent: of what can be pressed, and of text on it.
        good, warn, bad: health, always beside an icon and a word.
    """

    ground: str
    surface: str
    raised: str
    line: str
    edge: str
    picture: str
    text: str
    text_dim: str
    accent: str
    on_accent: str
    good: str
    warn: str
    bad: str


DARK = Colours(
    ground="#111416", surface="#1a1e21", raised="#252a2e", line="#343b41", edge="#6b757d",
    picture="#0a0c0d",
    text="#f0f3f5", text_dim="#a4afb8", accent="#63b0f4", on_accent="#06121d",
    good="#4cc38a", warn="#f0b23e", bad="#ff7a70",
)  # fmt: skip

LIGHT = Colours(
    ground="#eef1f3", surface="#ffffff", raised="#f3f6f8", line="#cfd7dd", edge="#7f8a93",
    picture="#1c2226",
    text="#14191d", text_dim="#515d67", accent="#0b63b0", on_accent="#ffffff",
    good="#137a4b", warn="#8a5a00", bad="#b3261e",
)  # fmt: skip

THEMES = {"dark": DARK, "light": LIGHT}
"""By the name that settings keep."""
