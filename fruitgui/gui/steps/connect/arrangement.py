"""How tiles fill an area: as many columns as make the pictures largest."""

from __future__ import annotations

import math
from dataclasses import dataclass

PICTURE_SHAPE = 4 / 3
"""Width over height of a picture."""

MOST_COLUMNS = 8


@dataclass(frozen=True, slots=True)
class Arrangement:
    """Tiles in rows.

    Attributes:
        columns: tiles in a row.
        stacked: depth stands below colour, not beside it.
        picture_width: of each of the two pictures, pixels.
    """

    columns: int
    stacked: bool
    picture_width: float

    def pictures_height(self, gap: float) -> float:
        """Return the height that the two pictures take, with the gap between them where they are stacked."""
        height = self.picture_width / PICTURE_SHAPE
        return 2 * height + gap if self.stacked else height


def arranged(
    count: int, width: float, height: float, *, around: float, words: float, gap: float, between: float
) -> Arrangement:
    """Return the arrangement of so many tiles, each with two pictures, that shows these largest.

    Args:
        count: tiles, at least one.
        width, height: of the area.
        around: room that a tile takes around its contents, both sides together.
        words: height of what is written in a tile.
        gap: between tiles. between: a tile's two pictures.
    """
    tried = []
    for columns in range(1, min(max(count, 1), MOST_COLUMNS) + 1):
        rows = math.ceil(count / columns)
        inner_width = (width - (columns - 1) * gap) / columns - around
        inner_height = (height - (rows - 1) * gap) / rows - around - words
        for stacked in (False, True):
            tried.append(
                Arrangement(columns, stacked, _picture_width(inner_width, inner_height, between, stacked=stacked))
            )
    return max(tried, key=lambda one: one.picture_width)


def _picture_width(width: float, height: float, gap: float, *, stacked: bool) -> float:
    if stacked:
        return max(min(width, (height - gap) / 2 * PICTURE_SHAPE), 0.0)
    return max(min((width - gap) / 2, height * PICTURE_SHAPE), 0.0)
