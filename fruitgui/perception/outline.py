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
        area_px, hull_px: (N,) areas of the outline and of its convex hull.
    """

    centre_px: F64
    axes_px: F64
    angle_rad: F64
    error: F64
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
    return Ellipses(centre, axes, angle, _errors(contours, centre, axes, angle), rows[:, 5], rows[:, 6])


def _ellipse_row(contour: np.ndarray) -> tuple[float, ...]:
    (u, v), (first, second), degrees = cv2.fitEllipseDirect(contour)
    if not np.isfinite(first + second + u + v) or min(first, second) <= 0.0:
        (u, v), (first, second), degrees = cv2.minAreaRect(contour)
    if second > first:
        first, second, degrees = second, first, degrees + 90.0
    hull = cv2.contourArea(cv2.convexHull(contour))
    return u, v, first, second, float(np.deg2rad(degrees)), cv2.contourArea(contour), hull


def _errors(contours: tuple[np.ndarray, ...], centre: F64, axes: F64, angle: F64) -> F64:
    """Return the rms of (distance from the centre / ellipse's radius in that direction − 1) over every outline."""
    if not contours:
        return np.zeros(0)
    counts = np.array([len(contour) for contour in contours])
    owner = np.repeat(np.arange(len(contours)), counts)
    offset = np.concatenate(contours)[:, 0, :] - centre[owner]
    cosine, sine = np.cos(angle)[owner], np.sin(angle)[owner]
    along = (offset[:, 0] * cosine + offset[:, 1] * sine) / (0.5 * axes[owner, 0])
    across = (offset[:, 1] * cosine - offset[:, 0] * sine) / (0.5 * axes[owner, 1])
    deviation = np.hypot(along, across) - 1.0
    return np.asarray(np.sqrt(np.bincount(owner, weights=deviation**2) / counts))
