"""What stands on the belt covers a fifth of the picture: its boxes, laid side by side, make a much smaller one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from fruitgui.frame import F32, U8

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
        shape: rows and columns of the mosaic.
        at_border: the tiles that lie at the picture's border.
    """

    sources: tuple[Place, ...]
    places: tuple[Place, ...]
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

    def shift(self, number: int) -> tuple[int, int]:
        """Return by how many columns and rows a tile was moved."""
        (rows, columns), (down, across) = self.sources[number], self.places[number]
        return across.start - columns.start, down.start - rows.start

    def thinned(self, down: int, across: int) -> tuple[list[Place], list[Place]]:
        """Return sources and places of those pixels alone whose rows and columns in the picture are such multiples."""
        steps = (down, across)
        skips = [tuple(-side.start % step for side, step in zip(one, steps, strict=True)) for one in self.sources]
        return _every(self.sources, skips, steps), _every(self.places, skips, steps)


def _every(places: Sequence[Place], skips: Sequence[tuple[int, ...]], steps: tuple[int, int]) -> list[Place]:
    return [
        (slice(rows.start + top, rows.stop, steps[0]), slice(columns.start + left, columns.stop, steps[1]))
        for (rows, columns), (top, left) in zip(places, skips, strict=True)
    ]


def edge_distance(tiles: Tiles, inside: U8) -> F32:
    """Return how far (pixels) every pixel of a mosaic is from the nearest that is 0; the picture's border is none."""
    distance = cv2.distanceTransform(inside, cv2.DIST_L2, 3)
    for number in tiles.at_border:
        place = tiles.places[number]
        distance[place] = cv2.distanceTransform(inside[place], cv2.DIST_L2, 3)
    return np.asarray(distance)


def laid_out(boxes: Sequence[Box], shape: tuple[int, int], gap: int = 1) -> Tiles:
    """Return boxes (at least one) of a picture of some shape on shelves, the tallest first.

    Each is widened by a pixel where the picture goes on; a gap of pixels that belong to nothing is round each.
    """
    rows, columns = shape
    sources = [
        (slice(max(top - 1, 0), min(top + height + 1, rows)),
         slice(max(left - 1, 0), min(left + width + 1, columns)))
        for left, top, width, height in boxes
    ]  # fmt: skip
    sizes = [(rows.stop - rows.start, columns.stop - columns.start) for rows, columns in sources]
    widest = max(max(width for _, width in sizes), int(sum(height * width for height, width in sizes) ** 0.5)) + gap
    places: list[Place] = [(slice(0), slice(0))] * len(sizes)
    left, top, shelf = gap, gap, 0
    for number in sorted(range(len(sizes)), key=lambda number: -sizes[number][0]):
        height, width = sizes[number]
        if left + width > widest:
            left, top, shelf = gap, top + shelf + gap, 0
        places[number] = (slice(top, top + height), slice(left, left + width))
        left, shelf = left + width + gap, max(shelf, height)
    at_border = tuple(
        number for number, (down, across) in enumerate(sources)
        if down.start == 0 or across.start == 0 or down.stop == rows or across.stop == columns
    )  # fmt: skip
    return Tiles(tuple(sources), tuple(places), (top + shelf + gap, widest + gap), at_border)
