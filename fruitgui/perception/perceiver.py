"""One frame in, the fruit that one sensor saw in it out."""

from __future__ import annotations

import numpy as np

from fruitgui.errors import InputError
from fruitgui.frame import U8, U16, Bools, Frame, Intrinsics
from fruitgui.geometry.plane import Surface
from fruitgui.perception.centre import Centres, Heights, find_centres, find_heights
from fruitgui.perception.colour import belt_colour, calm_picture, colour_features
from fruitgui.perception.features import shape_features
from fruitgui.perception.flat import FlatFinder
from fruitgui.perception.limits import depth_limits
from fruitgui.perception.outline import Ellipses, fit_ellipses, joined
from fruitgui.perception.parts import Parts, Splitter
from fruitgui.perception.pixels import Pixels, gather_pixels
from fruitgui.perception.segment import Groups, Segmenter
from fruitgui.perception.settings import PerceptionSettings
from fruitgui.perception.split import HeightSplitter
from fruitgui.perception.view import FruitView, Observation
from fruitgui.perception.views import Seen, build_views
from fruitgui.perception.wholeness import seen_whole


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
        self.limits = self._limits = depth_limits(intrinsics, surface, self._settings)
        noise_m = float(self._settings.noise_at_m(np.array(self._limits.belt_z_m)))
        self._jump_m = 0.3 * self._settings.smallest_m + 3.0 * noise_m
        self._segmenter = Segmenter(self._limits, self._settings)
        self._splitter = splitter or HeightSplitter(self._limits, self._settings)
        self._flat = FlatFinder(self._limits, self._settings) if splitter is None else None

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
        groups, calm = self._segmenter.groups(depth_mm), calm_picture(color, self._limits)
        if self._flat is not None:
            groups = self._flat.add(groups, depth_mm, calm)
        parts = self._splitter(groups)
        views = self._views(frame, depth_mm, calm, groups, parts) if parts.contours else ()
        return Observation(frame.sensor, frame.sequence, time_s, views)

    def _check(self, frame: Frame) -> None:
        wanted = (self._intrinsics.height, self._intrinsics.width)
        if frame.depth_mm.shape != wanted or frame.color.shape[:2] != wanted:
            raise InputError(
                "frame_size",
                f"A frame of sensor {frame.sensor} is {frame.depth_mm.shape[1]}×{frame.depth_mm.shape[0]} pixels, "
                f"but its camera was said to have {wanted[1]}×{wanted[0]}.",
                "Calibrate the station with a recording of the same resolution.",
                values={"sensor": frame.sensor},
            )

    def _views(self, frame: Frame, depth_mm: U16, calm: U8, groups: Groups, parts: Parts) -> tuple[FruitView, ...]:
        limits, settings = self._limits, self._settings
        outlines, pixels = joined(parts.contours), gather_pixels(parts, groups.standing_mm, limits)
        whole, free = seen_whole(outlines, parts, groups.standing_mm, depth_mm, limits, self._jump_m)
        ellipses = fit_ellipses(outlines)
        heights = find_heights(pixels)
        rough_m = ellipses.axes_px[:, 0] * (limits.belt_z_m / limits.focal_px)
        centres = find_centres(pixels, heights.top_m, rough_m, whole, limits, settings)
        shapes = shape_features(pixels, ellipses, heights, centres.centre_m, limits)
        colours = colour_features(pixels, calm, belt_colour(calm, parts.labels, limits))
        is_fruit = self._is_fruit(pixels, heights, centres, ellipses, parts.group >= len(groups.contours) - groups.flat)
        features = np.hstack([colours, shapes]).astype(np.float32)
        return build_views(
            frame, np.ascontiguousarray(frame.color), limits, np.flatnonzero(is_fruit).tolist(), settings.max_points,
            Seen(parts, outlines, pixels, ellipses, heights, centres, whole, free, features),
        )  # fmt: skip

    def _is_fruit(self, pixels: Pixels, heights: Heights, centres: Centres, ellipses: Ellipses, flat: Bools) -> Bools:
        """Tell which groups can be something of a fruit's size, (N,): not noise, not rails; or are known to be flat."""
        smallest_m, counts = self._settings.smallest_m, pixels.runs.counts
        pixel_m = centres.centre_m[:, 2] / self._limits.focal_px
        return np.asarray(
            (centres.seen >= 0.3 * counts)
            & (counts >= 4)
            & (ellipses.axes_px[:, 0] * pixel_m <= self._settings.largest_m)
            & (flat | (2.0 * pixels.deepest_px * pixel_m >= 0.5 * smallest_m))
            & (flat | (heights.top_m >= 0.4 * smallest_m))
            & (self._limits.inside_m(centres.mean_m) >= 0.4 * smallest_m)
        )
