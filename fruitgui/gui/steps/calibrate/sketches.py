"""Drawn advice as plain data: a belt from above, what lies on it, and what the sensors see of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

LENGTH, WIDTH = 100.0, 40.0
"""Of the belt in a sketch, in its own units."""

Corner = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Piece:
    """A piece of fruit from above: middle, radius, and the number of its colour."""

    x: float
    y: float
    radius: float
    colour: int


@dataclass(frozen=True, slots=True)
class Sketch:
    """One drawing.

    Attributes:
        pieces: on the belt.
        views: what each sensor sees of the belt, four corners each.
        good: a tick or a cross in the corner; None for neither.
        moving: arrows say that things move.
    """

    pieces: tuple[Piece, ...]
    views: tuple[tuple[Corner, ...], ...]
    good: bool | None = None
    moving: bool = False


def _pieces(*rows: tuple[float, float, float, int]) -> tuple[Piece, ...]:
    return tuple(Piece(*row) for row in rows)


_WIDE = (((4, -3), (70, -8), (76, 48), (8, 43)), ((26, -8), (96, -3), (92, 43), (22, 48)))
_APART = (((2, -3), (42, -6), (44, 46), (4, 43)), ((58, -6), (98, -3), (96, 43), (56, 46)))
_THIRD = (((2, -3), (62, -6), (64, 46), (4, 43)), ((38, -6), (98, -3), (96, 43), (36, 46)))

_UNEVEN = _pieces(
    (14, 9, 4, 0), (22, 30, 5.5, 1), (31, 14, 4.5, 2), (38, 33, 3.5, 3), (43, 8, 5.5, 1), (48, 22, 4, 0),
    (55, 33, 5, 2), (60, 12, 3.5, 3), (66, 24, 5.5, 1), (72, 35, 4, 0), (76, 8, 4.5, 2), (84, 21, 4, 3), (90, 33, 5, 1),
)  # fmt: skip
_FEW = _pieces((18, 10, 4.5, 0), (25, 18, 5, 1), (15, 22, 4, 2))
_SIDES = _pieces((12, 10, 4, 0), (20, 28, 5, 1), (30, 16, 4, 2), (70, 12, 4, 3), (80, 27, 5, 1), (89, 14, 4, 0))
_GRID = tuple(Piece(20 + 15 * column, 9 + 11 * row, 4.2, 0) for column in range(5) for row in range(3))
_GROUPS = (
    ((2, -3), (36, -6), (38, 46), (4, 43)),
    ((22, -6), (54, -3), (52, 43), (20, 46)),
    ((68, -6), (98, -3), (96, 43), (66, 46)),
)
_LINKED = (_GROUPS[0], _GROUPS[1], ((42, -6), (84, -3), (82, 43), (40, 46)))

PREPARE = (Sketch(_UNEVEN, _WIDE),)

WRONG_AND_RIGHT: Mapping[str, tuple[Sketch, Sketch]] = {
    "too_little_structure": (Sketch(_FEW, _WIDE, good=False), Sketch(_UNEVEN, _WIDE, good=True)),
    "too_little_overlap": (Sketch(_SIDES, _APART, good=False), Sketch(_UNEVEN, _THIRD, good=True)),
    "ambiguous": (Sketch(_GRID, _WIDE, good=False), Sketch(_UNEVEN, _WIDE, good=True)),
    "scene_moved": (Sketch(_UNEVEN, _WIDE, good=False, moving=True), Sketch(_UNEVEN, _WIDE, good=True)),
    "disconnected": (Sketch(_UNEVEN, _GROUPS, good=False), Sketch(_UNEVEN, _LINKED, good=True)),
}
"""By the code of a refusal: how it is, and how it should be."""
