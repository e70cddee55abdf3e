"""Outlines and the ellipses fitted to them (paper 2.4.1: what does not fit an ellipse is not one fruit)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from fruitgui.frame import F64, Ints

Contour = NDArray[np.int32]
"""An outline as OpenCV gives it: (K, 1, 2), closed, u and v."""


EVERY = 2
"""Where outlines are long, every second place is looked at: neighbours are a pixel apart and tell the same."""

LONG = 24
"""So many places leave enough of an outline when every second is left out."""


@dataclass(frozen=True, slots=True, eq=False)
class Outlines:
    """The outlines of N fruit, one after another; M places in all.

    Attributes:
        each: N outlines (K, 1, 2) int32, crop pixels, u and v.
        places: (M, 2) int32, all of them.
        owner: (M,) whose each place is, 0-based.
        starts, counts: (N,) where each outline begins, and its length.
    """

    each: tuple[Contour, ...]
    places: NDArray[np.int32]
    owner: Ints
    starts: Ints
    counts: Ints

    def thinned(self) -> Outlines:
        """Return every second place of the outlines, or all where one of them is short."""
        if self.counts.min() < LONG:
            return self
        places = self.places[::EVERY].copy()
        ends = (self.starts + self.counts + EVERY - 1) // EVERY
        starts = (self.starts + EVERY - 1) // EVERY
        each = tuple([places[start:end, None] for start, end in zip(starts.tolist(), ends.tolist(), strict=True)])
        return Outlines(each, places, self.owner[::EVERY], starts, ends - starts)


def joined(contours: tuple[Contour, ...]) -> Outlines:
    """Return outlines (at least one) laid one after another."""
    counts = np.array([len(contour) for contour in contours], dtype=np.intp)
    starts = np.cumsum(counts) - counts
    owner = np.repeat(np.arange(len(contours)), counts)
    return Outlines(contours, np.concatenate(contours)[:, 0, :], owner, starts, counts)


@dataclass(frozen=True, slots=True, eq=False)
class Ellipses:
    """One ellipse per outline; N outlines.

    Attributes:
        centre_px: (N, 2).
        axes_px: (N, 2) full lengths, the longer first.
        angle_rad: (N,) direction of the longer axis, from the u axis towards v.
        error: (N,) rms of the outline's distance from the ellipse, as a part of the radius there.
        tips: (N,) mean of the same, signed, at the ends of the longer axis: positive where they are drawn out.
        area_px, hull_px: (N,) areas of the outline and of its convex hull.
    """

    centre_px: F64
    axes_px: F64
    angle_rad: F64
    error: F64
    tips: F64
    area_px: F64
    hull_px: F64

    @property
    def solidity(self) -> F64:
        """Area of each outline as a part of its convex hull's, (N,)."""
        return self.area_px / np.maximum(self.hull_px, 1e-9)


def fit_ellipses(outlines: Outlines) -> Ellipses:
    """Fit an ellipse to every outline, of at least 5 places each (Fitzgibbon, Pilu & Fisher 1999).

    One that is three pixels wide or less has the sides of its rectangle instead.
    """
    area_px = np.array([cv2.contourArea(contour) for contour in outlines.each])
    thin = outlines.thinned()
    # Nearly all places of what is three pixels wide lie on two lines; OpenCV moves them at random then.
    slim = (area_px < outlines.counts).tolist()
    rows = np.array([(_rectangle if low else _ellipse)(one) for low, one in zip(slim, thin.each, strict=True)])
    hull_px = np.array([cv2.contourArea(cv2.convexHull(contour)) for contour in thin.each])
    across = rows[:, 3] > rows[:, 2]
    axes = np.maximum(np.where(across[:, None], rows[:, 3:1:-1], rows[:, 2:4]), 1.0)
    centre, angle = rows[:, :2], np.radians(rows[:, 4] + 90.0 * across)
    error, tips = _errors(thin, centre, axes, angle)
    return Ellipses(centre, axes, angle, error, tips, area_px, hull_px)


def _ellipse(contour: Contour) -> tuple[float, ...]:
    (u, v), (first, second), degrees = cv2.fitEllipseDirect(contour)
    if not math.isfinite(first + second + u + v) or first <= 0.0 or second <= 0.0:
        return _rectangle(contour)
    return u, v, first, second, degrees


def _rectangle(contour: Contour) -> tuple[float, ...]:
    (u, v), (first, second), degrees = cv2.minAreaRect(contour)
    return u, v, first, second, degrees


def _errors(outlines: Outlines, centre: F64, axes: F64, angle: F64) -> tuple[F64, F64]:
    """Return rms of (distance from the centre / ellipse's radius in that direction − 1), and its mean at the tips."""
    u, v = outlines.places.T
    cosine, sine = np.cos(angle) * 2.0, np.sin(angle) * 2.0
    to_axes = np.array([cosine / axes[:, 0], sine / axes[:, 0], cosine / axes[:, 1], sine / axes[:, 1], *centre.T])
    along_u, along_v, across_v, across_u, middle_u, middle_v = np.repeat(to_axes, outlines.counts, axis=1)
    u, v = u - middle_u, v - middle_v
    along, across = u * along_u + v * along_v, v * across_v - u * across_u
    distance = np.sqrt(along * along + across * across)
    deviation = distance - 1.0
    tip = (np.abs(along) > 0.92 * distance).astype(np.float64)
    square, tip_deviation, tips = np.add.reduceat(
        np.stack([deviation * deviation, deviation * tip, tip]), outlines.starts, axis=1
    )
    return np.sqrt(square / outlines.counts), tip_deviation / np.maximum(tips, 1.0)


def ellipse_error(contour: Contour) -> float:
    """Return the error of the ellipse fitted to one outline, see `Ellipses.error`."""
    return float(fit_ellipses(joined((contour,))).error[0])


def solidity(contour: Contour) -> float:
    """Return the area of an outline as a part of its convex hull's."""
    return float(cv2.contourArea(contour) / max(cv2.contourArea(cv2.convexHull(contour)), 1.0))
