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
    corners, rooms = [], []
    for left, top, width, height in boxes:
        x, y = max(left - 1, 0) // across * across, max(top - 1, 0) // down * down
        right, below = min(left + width + 1, columns), min(top + height + 1, rows)
        corners.append((x, y, right, below))
        rooms.append((-(-(right - x + gap) // across) * across, -(-(below - y + gap) // down) * down))
    first_left, first_top = -(-gap // across) * across, -(-gap // down) * down
    widest = first_left + max(max(wide for wide, _ in rooms), int(sum(wide * tall for wide, tall in rooms) ** 0.5))
    shifts = [(0, 0)] * len(rooms)
    left, top, shelf = first_left, first_top, 0
    for number in sorted(range(len(rooms)), key=lambda number: -rooms[number][1]):
        wide, tall = rooms[number]
        if left + wide > widest:
            left, top, shelf = first_left, top + shelf, 0
        shifts[number] = (left - corners[number][0], top - corners[number][1])
        left, shelf = left + wide, max(shelf, tall)
    return Tiles(
        tuple([(slice(y, below), slice(x, right)) for x, y, right, below in corners]),
        tuple([
            (slice(y + dy, below + dy), slice(x + dx, right + dx))
            for (x, y, right, below), (dx, dy) in zip(corners, shifts, strict=True)
        ]),
        np.array(shifts, dtype=np.intp),
        (top + shelf, widest),
        tuple([
            number for number, (x, y, right, below) in enumerate(corners)
            if x == 0 or y == 0 or right == columns or below == rows
        ]),
    )  # fmt: skip
