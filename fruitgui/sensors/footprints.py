"""Readings drawn over the area that each covers in a picture: the nearest surface on top, cracks within one closed."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fruitgui.frame import F32, U16, Ints

Whole = NDArray[np.int32]

_SAME_SURFACE_SHIFT = 6
"""Readings nearer to each other than 1/64 of the distance are of one surface."""
EMPTY = 64000
"""Stands for "no reading" while readings are drawn: farther than any, and any reading goes before it."""
_PAST_PX = np.float32(1.01)
"""From an edge to the first middle past it is this much, rounded down.

The hundredth sets all edges aside alike: of a depth picture of twice the pixels
they run through middles, and rounding would decide to which side each belongs.
"""


def reach(begin: F32, end: F32, size: int) -> tuple[Whole, Whole]:
    """Return the first pixel whose middle lies between two edges, and how many there are, (N,) each; overwrites both.

    Args:
        begin, end: (N,) coordinates along one axis, middles of pixels at whole numbers.
        size: pixels along that axis; no other is counted.
    """
    begin += _PAST_PX
    first = np.clip(begin, 0.0, size, out=begin).astype(np.int32)
    end += _PAST_PX
    many = np.clip(end, 0.0, size, out=end).astype(np.int32)
    many -= first
    return first, many


def spread(corners: Whole, wide: Whole, high: Whole, columns: int, z_mm: U16) -> tuple[Ints, U16]:
    """Return every place of rectangles in a picture of so many columns, laid out row by row, and the depth there.

    Args:
        corners: (N,) the place of each upper left corner.
        wide, high: (N,) pixels, none where either is 0 or less.
        columns: of the picture.
        z_mm: (N,) depth of each rectangle.
    """
    places, depths = [], []
    for down in range(int(high.max(initial=0))):
        for right in range(int(wide.max(initial=0))):
            here = np.flatnonzero((high > down) & (wide > right))
            places.append(corners.take(here) + np.intp(down * columns + right))
            depths.append(z_mm.take(here))
    if len(places) == 1:
        return places[0], depths[0]
    return np.concatenate([np.zeros(0, np.intp), *places]), np.concatenate([z_mm[:0], *depths])


def nearest(pixels: int, places: Ints, z_mm: U16) -> U16:
    """Draw each reading at its places; where several meet, one of the nearest surface stays.

    Of readings of one surface any may stay: always keeping the least would pull
    the surface towards the sensor by the noise.
    """
    canvas: U16 = np.full(pixels, EMPTY, dtype=np.uint16)
    canvas[places] = z_mm
    nearer = _goes_before(z_mm, canvas.take(places))
    while len(nearer):
        places, z_mm = places[nearer], z_mm[nearer]
        canvas[places] = z_mm
        nearer = _goes_before(z_mm, canvas.take(places))
    return canvas


def _goes_before(z_mm: U16, drawn_mm: U16) -> Ints:
    """Return which readings are of a surface that is nearer than what is drawn in their place."""
    return np.flatnonzero(z_mm + (z_mm >> _SAME_SURFACE_SHIFT) < drawn_mm)


def without_cracks(depth_mm: U16) -> U16:
    """Close single pixels between two of one surface, along the rows and then along the columns; in place."""
    _close(depth_mm[:, :-2], depth_mm[:, 1:-1], depth_mm[:, 2:])
    _close(depth_mm[:-2], depth_mm[1:-1], depth_mm[2:])
    return depth_mm


def _close(before: U16, middle: U16, after: U16) -> None:
    """Give `middle` the mean of both sides where they are of one surface and it is empty or a farther one's."""
    near, far = np.minimum(before, after), np.maximum(before, after)
    apart = far - near
    far += far >> _SAME_SURFACE_SHIFT
    # what is empty becomes the farthest of all
    open_here = middle - np.uint16(1) >= far
    open_here &= near > 0
    open_here &= apart <= near >> _SAME_SURFACE_SHIFT
    apart >>= 1
    apart += near
    np.copyto(middle, apart, where=open_here)
