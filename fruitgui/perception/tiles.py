"""What stands on the belt covers a fifth of the picture: its boxes, laid side by side, make a much smaller one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from fruitgui.frame import F32, U8, Ints

Box = tuple[int, int, int, int]
"""Left, top, width and height, pixels."""

Place = tuple[slice, slice]
"""Rows and columns of a rectangle."""


@dataclass(frozen=True, slots=True, eq=False)
class Tiles:
    """Where rectangles of a picture lie in the mosaic; N tiles.

    Attributes:
        sources: where each is in the picture.
        places: where each is in the mosaic.
        shifts: (N, 2) by how many columns and rows each was moved.
        shape: rows and columns of the mosaic.
        at_border: the tiles that lie at the picture's border.
    """

    sources: tuple[Place, ...]
    places: tuple[Place, ...]
    shifts: Ints
    shape: tuple[int, int]
    at_border: tuple[int, ...]

    def cut(self, picture: NDArray[Any]) -> NDArray[Any]:
        """Return the mosaic of a picture; 0 in between."""
        mosaic = np.zeros(self.shape, picture.dtype)
        for source, place in zip(self.sources, self.places, strict=True):
            mosaic[place] = picture[source]
        return mosaic

    def owned(self, labels: U8) -> U8:
        """Return the mosaic of labels in which tile i (0-based) shows label i + 1 only."""
        numbers = np.zeros(self.shape, np.uint8)
        for number, place in enumerate(self.places):
            numbers[place] = number + 1
        mosaic = self.cut(labels)
        return np.asarray(cv2.copyTo(mosaic, cv2.compare(mosaic, numbers, cv2.CMP_EQ)))


def edge_distance(tiles: Tiles, inside: U8) -> F32:
    """Return how far (pixels) every pixel of a mosaic is from the nearest that is 0; the picture's border is none."""
    distance = cv2.distanceTransform(inside, cv2.DIST_L2, 3)
    for number in tiles.at_border:
        place = tiles.places[number]
        distance[place] = cv2.distanceTransform(inside[place], cv2.DIST_L2, 3)
    return np.asarray(distance)


def laid_out(boxes: Sequence[Box], shape: tuple[int, int], gap: int = 1, steps: tuple[int, int] = (1, 1)) -> Tiles:
    """Return boxes (at least one) of a picture of some shape on shelves, the tallest first.

    Each is widened by a pixel where the picture goes on; a gap of pixels that belong to nothing is round each. Tiles
    are moved by multiples of `steps` (rows, columns): every so manieth pixel of the picture is one of the mosaic.
    """
    (rows, columns), (down, across) = shape, steps
    left, top, width, height = np.array(boxes, dtype=np.intp).T
    x, y = np.maximum(left - 1, 0) // across * across, np.maximum(top - 1, 0) // down * down
    right, below = np.minimum(left + width + 1, columns), np.minimum(top + height + 1, rows)
    wide, tall = -((x - right - gap) // across) * across, -((y - below - gap) // down) * down
    first_left, first_top = -(-gap // across) * across, -(-gap // down) * down
    widest = first_left + max(int(wide.max()), int((wide * tall).sum() ** 0.5))
    corners, bottom = _shelved(wide.tolist(), tall.tolist(), (first_left, first_top), widest)
    shifts = corners - np.stack([x, y], axis=1)
    sources = np.stack([x, y, right, below], axis=1)
    at_border = (x == 0) | (y == 0) | (right == columns) | (below == rows)
    return Tiles(
        _places(sources), _places(sources + np.tile(shifts, 2)), shifts,
        (bottom, widest), tuple(np.flatnonzero(at_border).tolist()),
    )  # fmt: skip


def _shelved(wide: list[int], tall: list[int], first: tuple[int, int], widest: int) -> tuple[Ints, int]:
    """Return the left and top (N, 2) of rectangles put on shelves, the tallest first, and where the last shelf ends."""
    corners = np.zeros((len(wide), 2), dtype=np.intp)
    (left, top), shelf = first, 0
    for number in sorted(range(len(wide)), key=lambda number: -tall[number]):
        if left + wide[number] > widest:
            left, top, shelf = first[0], top + shelf, 0
        corners[number] = left, top
        left, shelf = left + wide[number], max(shelf, tall[number])
    return corners, top + shelf


def _places(sides: Ints) -> tuple[Place, ...]:
    """Return rows and columns of rectangles (N, 4: left, top, right, bottom)."""
    return tuple([(slice(top, bottom), slice(left, right)) for left, top, right, bottom in sides.tolist()])
