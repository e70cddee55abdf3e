"""Outlines and the ellipses fitted to them (paper 2.4.1: what does not fit an ellipse is not one fruit)."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.frame import F64


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


def fit_ellipses(contours: tuple[np.ndarray, ...]) -> Ellipses:
    """Fit an ellipse to every outline (K, 1, 2), K ≥ 5 (Fitzgibbon, Pilu & Fisher 1999)."""
    rows = np.array([_ellipse_row(contour) for contour in contours]).reshape(-1, 7)
    centre, axes, angle = rows[:, :2], np.maximum(rows[:, 2:4], 1.0), rows[:, 4]
    error, tips = _errors(contours, centre, axes, angle)
    return Ellipses(centre, axes, angle, error, tips, rows[:, 5], rows[:, 6])


def _ellipse_row(contour: np.ndarray) -> tuple[float, ...]:
    (u, v), (first, second), degrees = cv2.fitEllipseDirect(contour)
    if not np.isfinite(first + second + u + v) or min(first, second) <= 0.0:
        (u, v), (first, second), degrees = cv2.minAreaRect(contour)
    if second > first:
        first, second, degrees = second, first, degrees + 90.0
    hull = cv2.contourArea(cv2.convexHull(contour))
    return u, v, first, second, float(np.deg2rad(degrees)), cv2.contourArea(contour), hull


def _errors(contours: tuple[np.ndarray, ...], centre: F64, axes: F64, angle: F64) -> tuple[F64, F64]:
    """Return rms of (distance from the centre / ellipse's radius in that direction − 1), and its mean at the tips."""
    if not contours:
        return np.zeros(0), np.zeros(0)
    counts = np.array([len(contour) for contour in contours])
    owner = np.repeat(np.arange(len(contours)), counts)
    offset = np.concatenate(contours)[:, 0, :] - centre.take(owner, axis=0)
    cosine, sine = np.cos(angle).take(owner), np.sin(angle).take(owner)
    half = (0.5 * axes).take(owner, axis=0)
    along = (offset[:, 0] * cosine + offset[:, 1] * sine) / half[:, 0]
    across = (offset[:, 1] * cosine - offset[:, 0] * sine) / half[:, 1]
    distance = np.sqrt(along * along + across * across)
    deviation = distance - 1.0
    tip = (np.abs(along) > 0.92 * distance).astype(np.float64)
    square, at_tips, tips = (
        np.bincount(owner, weights=values, minlength=len(contours)) for values in (deviation**2, deviation * tip, tip)
    )
    return np.sqrt(square / counts), at_tips / np.maximum(tips, 1.0)
