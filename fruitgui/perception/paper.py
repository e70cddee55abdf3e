"""What the source computes of one view (paper 3.1–3.3, method 3.2–3.7): the baseline beside which the product stands.

Pure functions; nothing here runs unless it is asked for.
"""

from __future__ import annotations

import cv2
import numpy as np

from fruitgui.frame import F32, F64, U8, Intrinsics
from fruitgui.perception.limits import DepthLimits
from fruitgui.perception.outline import Contour, ellipse_error
from fruitgui.perception.parts import Parts, with_parts
from fruitgui.perception.segment import Groups
from fruitgui.perception.settings import PerceptionSettings
from fruitgui.perception.view import FruitView

PAPER_FEATURE_NAMES: tuple[str, ...] = (
    *(f"{channel}_{number}" for channel in ("hue", "saturation", "value") for number in range(10)),
    "perimeter_m",
    "volume_share",
)
"""The names of the source's 32 features, in order."""

FARTHEST_PART = 97.0
"""Percentile along the line of sight at which the mirror stands (method 3.7)."""

MOST_PIECES = 5
"""K-Means is tried with 2 … this many clusters (paper 3.1)."""


def paper_features(patch: U8, perimeter_m: float, volume_m3: float, cube_m3: float) -> F32:
    """Return the source's feature vector (32,): three histograms of 10 bins, perimeter, volume (paper 3.2).

    Args:
        patch: (40, 40, 3) uint8 RGB, centred on the fruit.
        perimeter_m: of the fruit's outline.
        volume_m3: of this view.
        cube_m3: volume of the cube that contains the fruit, by which the volume is divided.
    """
    hsv = cv2.cvtColor(np.ascontiguousarray(patch), cv2.COLOR_RGB2HSV)
    histograms = [
        np.histogram(hsv[..., channel], bins=10, range=(0, top))[0] / hsv[..., channel].size
        for channel, top in ((0, 180), (1, 256), (2, 256))
    ]
    return np.concatenate([*histograms, [perimeter_m, volume_m3 / max(cube_m3, 1e-12)]]).astype(np.float32)


def paper_view_features(view: FruitView, intrinsics: Intrinsics) -> F32:
    """Return the source's feature vector (32,) of a view, volume and perimeter computed the source's way."""
    both = with_mirror_image(view.points_m)
    cube_m3 = float(np.ptp(both, axis=0).max(initial=0.0) ** 3)
    return paper_features(view.patch, paper_perimeter_m(view, intrinsics), hull_volume_m3(both), cube_m3)


def paper_volume_m3(points_m: F32) -> float:
    """Return the volume (m³) of one view's points (N, 3) in the optical frame (paper 3.3, method 3.7).

    The seen points are one half; the other half is their mirror image in the
    plane normal to the line of sight through the farthest seen points; the volume
    is that of the convex hull of both. 0 where the points span no volume.
    """
    return hull_volume_m3(with_mirror_image(points_m))


def with_mirror_image(points_m: F32) -> F64:
    """Return points (N, 3) and their mirror image in the plane through the farthest, (2 M, 3), M ≤ N.

    Points beyond the 97th percentile lie behind the mirror and are left out.
    """
    points = np.asarray(points_m, dtype=np.float64).reshape(-1, 3)
    if len(points) == 0:
        return points
    sight = points.mean(axis=0)
    sight /= np.linalg.norm(sight)
    along = points @ sight
    mirror = np.percentile(along, FARTHEST_PART)
    front, gap = points[along <= mirror], mirror - along[along <= mirror]
    return np.vstack([front, front + 2.0 * gap[:, None] * sight])


def hull_volume_m3(points_m: F64) -> float:
    """Return the volume of the convex hull of points (N, 3); 0 where they span none."""
    from scipy.spatial import ConvexHull, QhullError

    if len(points_m) < 4:
        return 0.0
    try:
        return float(ConvexHull(points_m).volume)
    except QhullError:
        return 0.0


def paper_perimeter_m(view: FruitView, intrinsics: Intrinsics) -> float:
    """Return the perimeter (m) of the ellipse fitted to a view's outline, at the distance of its points (paper 3.3).

    The outline is taken on the plane through the mean of the points, normal to the
    line of sight. The ellipse's perimeter is Ramanujan's second approximation.
    """
    centre = np.linalg.norm(view.mean_m)
    sight = view.mean_m / centre
    last = [[intrinsics.width - 1], [intrinsics.height - 1]]
    columns, rows = np.clip(np.rint(view.outline_px).astype(int).T, 0, last)
    rays = np.column_stack([intrinsics.rays()[rows, columns].astype(np.float64), np.ones(len(rows))])
    flat = rays * (centre / (rays @ sight))[:, None]
    across = np.linalg.svd(sight[None, :])[2][1:]
    _, axes, _ = cv2.fitEllipseDirect(((flat - view.mean_m) @ across.T * 1e3).astype(np.float32))
    return ellipse_perimeter(axes[0] * 5e-4, axes[1] * 5e-4)


def ellipse_perimeter(a: float, b: float) -> float:
    """Return the perimeter of an ellipse with half axes a and b (Ramanujan 1914; 1e-4 even for a = 5 b)."""
    h = ((a - b) / (a + b)) ** 2
    return float(np.pi * (a + b) * (1.0 + 3.0 * h / (10.0 + np.sqrt(4.0 - 3.0 * h))))


class KMeansSplitter:
    """Splits groups as the source does (paper 3.1): K-Means on the pixels, until every cluster fits an ellipse.

    A group whose ellipse fits is one fruit. One that does not fit, and whose area
    lies between two thresholds, is split with K = 2, 3, 4, 5; the first K is taken
    at which every cluster fits. What still does not fit is no fruit.
    """

    def __init__(self, limits: DepthLimits, settings: PerceptionSettings) -> None:
        pixels_per_m2 = limits.pixels_of(1.0, limits.belt_z_m) ** 2
        low, high = settings.paper_area_m2
        self._area_px = (low * pixels_per_m2, high * pixels_per_m2)
        self._most_error = settings.paper_ellipse_error

    def __call__(self, groups: Groups) -> Parts:
        """Return the fruit in the groups of a frame; the source looks at their outlines only."""
        cuts = {
            number: self._pieces(contour)
            for number, contour in enumerate(groups.contours)
            if ellipse_error(contour) > self._most_error
        }
        return with_parts(groups, cuts)

    def _pieces(self, contour: Contour) -> list[Contour]:
        if not self._area_px[0] <= cv2.contourArea(contour) <= self._area_px[1]:
            return []
        left, top, width, height = cv2.boundingRect(contour)
        mask = np.zeros((height, width), np.uint8)
        cv2.drawContours(mask, [contour - np.array([left, top], dtype=np.int32)], 0, 1, cv2.FILLED)
        places = np.argwhere(mask)[:, ::-1].astype(np.float32)
        for pieces in range(2, MOST_PIECES + 1):
            found = [piece + np.array([left, top], np.int32) for piece in _clusters(mask, places, pieces)]
            if len(found) == pieces and all(ellipse_error(piece) <= self._most_error for piece in found):
                return found
        return []


def _clusters(mask: U8, places: F32, pieces: int) -> list[Contour]:
    """Return the outlines of K-Means clusters of places (N, 2: u, v), where they are long enough for an ellipse."""
    cv2.setRNGSeed(pieces)
    stop = (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_MAX_ITER, 20, 0.5)
    _, which, _ = cv2.kmeans(places, pieces, None, stop, 3, cv2.KMEANS_PP_CENTERS)
    outlines = []
    for piece in range(pieces):
        alone = np.zeros_like(mask)
        u, v = places[which[:, 0] == piece].astype(int).T
        alone[v, u] = 255
        contours, _ = cv2.findContours(alone, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
        largest = max(contours, key=cv2.contourArea)
        if len(largest) >= 8:
            outlines.append(largest)
    return outlines
