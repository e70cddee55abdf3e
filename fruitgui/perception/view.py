"""What perception gives: one fruit as one sensor saw it in one frame."""

from __future__ import annotations

from dataclasses import dataclass

from fruitgui.frame import F32, F64, U8, Bools


@dataclass(frozen=True, slots=True, eq=False)
class FruitView:
    """One fruit as one sensor saw it in one frame. All geometry is in that sensor's optical frame.

    Attributes:
        sensor: the sensor's id.
        sequence: the frame's number.
        time_s: the frame's capture time, in the sensor's own clock.
        box_px: left, top, width, height of the outline in the picture.
        outline_px: (K, 2) outline in the picture, closed, u and v.
        points_m: (N, 3) seen surface, at most a few thousand points, spread evenly over the view.
        edge_px: (N,) distance of each point from the edge of the fruit's pixels, in pixels; structured light
            fattens edges by up to two pixels, so points near the edge lie.
        area_px: pixels that belong to the fruit.
        centre_m: (3,) estimate of the centre of volume.
        centre_covariance_m2: (3, 3) of that estimate, quantisation and correlated noise included.
        mean_m: (3,) mean of all seen points (the source's measurement).
        mean_covariance_m2: (3, 3) of that mean.
        height_m: height of the highest points above the belt.
        features: (F,) product feature vector, see `perception.features.FEATURE_NAMES`.
        patch: (40, 40, 3) uint8 RGB, centred on the fruit (the source's patch, and a picture for people).
        whole: seen whole: not cut by the picture's edge or the region's, not hidden by another fruit.
        shared: the outline was cut out of a group of touching fruit.
        outline_free: (K,) beyond which places of the outline lies bare belt: neither another thing on it, nor the end
            of the picture or of the region. What of an outline is free is silhouette, whole or not.
    """

    sensor: str
    sequence: int
    time_s: float
    box_px: tuple[int, int, int, int]
    outline_px: F32
    points_m: F32
    edge_px: F32
    area_px: int
    centre_m: F64
    centre_covariance_m2: F64
    mean_m: F64
    mean_covariance_m2: F64
    height_m: float
    features: F32
    patch: U8
    whole: bool
    shared: bool
    outline_free: Bools


@dataclass(frozen=True, slots=True, eq=False)
class Observation:
    """All fruit that one sensor saw in one frame; none is an observation too.

    Attributes:
        sensor: the sensor's id.
        sequence: the frame's number.
        time_s: in the reference sensor's clock (clock offset applied).
        views: the fruit, in no particular order.
    """

    sensor: str
    sequence: int
    time_s: float
    views: tuple[FruitView, ...]
