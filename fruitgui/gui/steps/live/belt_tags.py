"""Where the names of sensors stand on the belt from above: on the edge of what each sees, none over another."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain

import numpy as np
from PySide6.QtCore import QRectF, QSizeF

from fruitgui.frame import F64
from fruitgui.gui.theme.tokens import GRID

STEPS = 24
"""Places along an edge that are tried, from its right end on."""

DEPTHS = 2
"""Where an edge is full, a name stands further inside, by its own height."""


def tag_places(
    edges_px: Mapping[str, F64], sizes: Mapping[str, QSizeF], room: QRectF, taken: Sequence[QRectF] = ()
) -> dict[str, QRectF]:
    """Return where each sensor's name stands, so that it hides no other name and is seen to belong to its footprint.

    A name lies across the upper edge of one footprint and the lower of the next, where neighbours overlap least.

    Args:
        edges_px: corners (N, 2) of each sensor's footprint, on the screen, in order round it.
        sizes: of the names with what is round them.
        room: that there is.
        taken: what is written there already.
    """
    places: dict[str, QRectF] = {}
    for number, (sensor, corners) in enumerate(edges_px.items()):
        others = [*taken, *places.values()]
        tried = _tried(corners, sizes[sensor], room, upper_first=number % 2 == 0)
        first = next(tried)
        free = (one for one in chain((first,), tried) if not any(one.intersects(other) for other in others))
        places[sensor] = next(free, first)
    return places


def _tried(corners: F64, size: QSizeF, room: QRectF, *, upper_first: bool) -> Iterator[QRectF]:
    """Give the places where a name may stand, the best first; most names stand in one of the first."""
    for depth in range(DEPTHS):
        for upper in (upper_first, not upper_first):
            yield from _along(corners, size, room, depth * (1 if upper else -1), upper=upper)


def _along(corners: F64, size: QSizeF, room: QRectF, rows: int, *, upper: bool) -> Iterator[QRectF]:
    """Give places across an edge of a footprint, or so many rows inside it, from right to left."""
    left, right = float(corners[:, 0].min()), float(corners[:, 0].max())
    middles = np.linspace(right - size.width() / 2 - GRID, left + size.width() / 2 + GRID, STEPS)
    for x in np.clip(middles, left, right):
        box = QRectF(0, 0, size.width(), size.height())
        box.moveLeft(min(max(x - size.width() / 2, room.left()), room.right() - size.width()))
        y = _crossing(corners, float(x), upper=upper)
        box.moveTop(min(max(y - size.height() / 2, room.top()), room.bottom() - size.height()))
        box.translate(0, rows * (size.height() + 1))
        yield box


def _crossing(corners: F64, x: float, *, upper: bool) -> float:
    """Return the height on the screen at which a footprint's upper or lower edge passes x, within its ends."""
    heights = []
    for (x0, y0), (x1, y1) in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        if min(x0, x1) <= x <= max(x0, x1):
            heights += [y0, y1] if x0 == x1 else [y0 + (x - x0) / (x1 - x0) * (y1 - y0)]
    return float(min(heights) if upper else max(heights))
