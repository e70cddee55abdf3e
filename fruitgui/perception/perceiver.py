"""One frame in, the fruit that one sensor saw in it out."""

from __future__ import annotations

import cv2
import numpy as np

from fruitgui.errors import InputError
from fruitgui.frame import F32, F64, U8, Bools, Frame, Intrinsics
from fruitgui.geometry.plane import Surface
from fruitgui.perception.centre import Centres, find_centres
from fruitgui.perception.colour import belt_colour, colour_features
from fruitgui.perception.features import shape_features
from fruitgui.perception.limits import DepthLimits, depth_limits
from fruitgui.perception.outline import Ellipses, fit_ellipses
from fruitgui.perception.pixels import Pixels, gather_pixels
from fruitgui.perception.segment import Segmenter
from fruitgui.perception.settings import PerceptionSettings
from fruitgui.perception.split import HeightSplitter, Parts, Splitter
from fruitgui.perception.wholeness import seen_whole
from fruitgui.perception.view import FruitView, Observation

PATCH_PX = 40


class Perceiver:
    """Sees fruit in the frames of one sensor. Everything that does not depend on the frame is worked out here, once.

    Args:
        sensor: the sensor's id.
        intrinsics: of its colour camera; frames must have its size.
        surface: the belt as it sees it.
        settings: limits inside which something is looked at as fruit.
        splitter: how touching fruit are taken apart; by the prominence of their tops unless given.
    """

    def __init__(
        self,
        sensor: str,
        intrinsics: Intrinsics,
        surface: Surface,
        settings: PerceptionSettings | None = None,
        splitter: Splitter | None = None,
    ) -> None:
        self.sensor = sensor
        self._settings = settings or PerceptionSettings()
        self._intrinsics = intrinsics
        self._limits = depth_limits(intrinsics, surface, self._settings)
        noise_m = float(self._settings.noise_at_m(np.array(self._limits.belt_z_m)))
        self._jump_m = 0.3 * self._settings.smallest_m + 3.0 * noise_m
        self._segmenter = Segmenter(self._limits, self._settings)
        self._splitter = splitter or HeightSplitter(self._limits, self._settings)

    def observe(self, frame: Frame, time_s: float) -> Observation:
        """Return the fruit in a frame.

        Args:
            frame: of this sensor.
            time_s: its capture time in the reference sensor's clock.

        Raises:
            InputError: the frame has another size than the sensor's intrinsics.
        """
        self._check(frame)
        depth_mm, color = np.ascontiguousarray(frame.depth_mm), np.ascontiguousarray(frame.color)
        groups = self._segmenter.groups(depth_mm)
        parts = self._splitter(groups, depth_mm)
        views: tuple[FruitView, ...] = ()
        if parts.contours:
            edge_px = _edge_distance(parts)
            pixels = gather_pixels(parts.labels, groups.solid, edge_px, depth_mm, self._limits, len(parts.contours))
            whole = seen_whole(parts, groups.solid, depth_mm, self._limits, self._jump_m)
            views = self._views(frame, color, parts, pixels, whole)
        return Observation(frame.sensor, frame.sequence, time_s, views)

    def _check(self, frame: Frame) -> None:
        wanted = (self._intrinsics.height, self._intrinsics.width)
        if frame.depth_mm.shape != wanted or frame.color.shape[:2] != wanted:
            raise InputError(
                "frame_size",
                f"A frame of sensor {frame.sensor} is {frame.depth_mm.shape[1]}×{frame.depth_mm.shape[0]} pixels, "
                f"but its camera was said to have {wanted[1]}×{wanted[0]}.",
                "Calibrate the station with a recording of the same resolution.",
            )

    def _views(self, frame: Frame, color: U8, parts: Parts, pixels: Pixels, whole: Bools) -> tuple[FruitView, ...]:
        limits = self._limits
        ellipses = fit_ellipses(parts.contours)
        rough = ellipses.axes_px[:, 0] * limits.belt_z_m / limits.focal_px
        centres = find_centres(pixels, rough, whole, limits, self._settings)
        shapes = shape_features(pixels, ellipses, centres.top_m, centres.centre_m[:, 2], limits)
        belt = belt_colour(color, parts.labels, limits)
        features = np.hstack([colour_features(pixels, color, belt, limits), shapes]).astype(np.float32)
        length = ellipses.axes_px[:, 0] * centres.centre_m[:, 2] / limits.focal_px
        kept = np.flatnonzero(self._is_fruit(pixels, centres, length))
        return tuple(
            self._view(frame, color, parts, pixels, ellipses, centres, features[number], bool(whole[number]), int(number))
            for number in kept
        )

    def _is_fruit(self, pixels: Pixels, centres: Centres, length_m: F64) -> Bools:
        """Tell which groups can be something of a fruit's size: not noise, not rails."""
        seen = pixels.sums(pixels.valid)
        deepest = np.maximum.reduceat(pixels.edge_px, np.minimum(pixels.starts, len(pixels.owner) - 1))
        thickness_m = 2.0 * deepest * centres.centre_m[:, 2] / self._limits.focal_px
        return np.asarray(
            (seen >= 0.3 * pixels.counts)
            & (length_m <= self._settings.largest_m)
            & (thickness_m >= 0.5 * self._settings.smallest_m)
            & (centres.top_m >= 0.5 * self._settings.smallest_m)
            & (self._limits.inside_m(centres.mean_m) >= 0.4 * self._settings.smallest_m)
        )

    def _view(
        self,
        frame: Frame,
        color: U8,
        parts: Parts,
        pixels: Pixels,
        ellipses: Ellipses,
        centres: Centres,
        features: F32,
        whole: bool,
        number: int,
    ) -> FruitView:
        rows, columns = self._limits.crop
        contour = parts.contours[number][:, 0, :] + np.array([columns.start, rows.start])
        left, top = contour.min(axis=0)
        right, bottom = contour.max(axis=0)
        points, edge_px = self._points(pixels, number)
        u, v = ellipses.centre_px[number] + [columns.start, rows.start]
        return FruitView(
            sensor=frame.sensor,
            sequence=frame.sequence,
            time_s=frame.time_s,
            box_px=(int(left), int(top), int(right - left + 1), int(bottom - top + 1)),
            outline_px=contour.astype(np.float32),
            points_m=points,
            edge_px=edge_px,
            area_px=int(pixels.counts[number]) * pixels.every,
            centre_m=centres.centre_m[number],
            centre_covariance_m2=centres.centre_covariance_m2[number],
            mean_m=centres.mean_m[number],
            mean_covariance_m2=centres.mean_covariance_m2[number],
            height_m=float(centres.top_m[number]),
            features=features,
            patch=patch_at(color, u, v),
            whole=whole,
            shared=bool(parts.shared[number]),
        )

    def _points(self, pixels: Pixels, number: int) -> tuple[F32, F32]:
        """Return points of one fruit, spread evenly, and their distance from its edge."""
        part = pixels.part(number)
        seen = np.flatnonzero(pixels.valid[part]) + part.start
        if len(seen) > self._settings.max_points:
            seen = seen[np.linspace(0, len(seen) - 1, self._settings.max_points).astype(np.intp)]
        z = pixels.depth_m[seen]
        points = np.stack([pixels.ray_x[seen] * z, pixels.ray_y[seen] * z, z], axis=1)
        return points, pixels.edge_px[seen]


def _edge_distance(parts: Parts) -> F32:
    """Return the distance of every pixel from the edge of its fruit; where two fruit touch is an edge too."""
    inside = cv2.compare(parts.labels, 0, cv2.CMP_GT)
    if parts.shared.any():
        labels = parts.labels
        across, down = labels[:, 1:] != labels[:, :-1], labels[1:] != labels[:-1]
        inside[:, 1:][across & (labels[:, :-1] > 0)] = 0
        inside[1:][down & (labels[:-1] > 0)] = 0
    return np.asarray(cv2.distanceTransform(inside, cv2.DIST_L2, 3))


def patch_at(color: U8, u_px: float, v_px: float, size: int = PATCH_PX) -> U8:
    """Return the (size, size, 3) patch around a point, shifted inwards at the picture's edge."""
    height, width = color.shape[:2]
    left = int(np.clip(round(u_px) - size // 2, 0, max(width - size, 0)))
    top = int(np.clip(round(v_px) - size // 2, 0, max(height - size, 0)))
    patch = color[top : top + size, left : left + size]
    if patch.shape[:2] != (size, size):
        patch = np.pad(patch, ((0, size - patch.shape[0]), (0, size - patch.shape[1]), (0, 0)), mode="edge")
    return patch.copy()
