"""A fruit's crops as pictures, and its way over the belt as seen from above; no widgets."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from PySide6.QtCore import QPointF
from PySide6.QtGui import QImage, QPolygonF

from fruitgui.frame import F64
from fruitgui.geometry.pose import Pose
from fruitgui.gui.widgets.pictures import depth_image
from fruitgui.records.correcting import Correction
from fruitgui.records.fruit_record import FruitRecord
from fruitgui.station.live.above import spread_of
from fruitgui.station.live.state import Spread
from fruitgui.station.sink import Crop
from fruitgui.station.station import Station
from fruitgui.tracking.track import PathPoint

DEPTH_ROOM_MM = 40.0
"""Beyond the fruit's own depths, what is shown of the belt behind it."""


@dataclass(frozen=True, slots=True, eq=False)
class ViewPictures:
    """One view of a fruit.

    Attributes:
        number: of the view. sensor: that saw it.
        colour, depth: the pictures; depth in false colours; null where there is none.
        outline: in pixels of either.
    """

    number: int
    sensor: str
    colour: QImage
    depth: QImage
    outline: QPolygonF


def view_pictures(crops: Sequence[Crop]) -> tuple[ViewPictures, ...]:
    """Return a fruit's views as pictures; what is damaged is left out."""
    numbers = dict.fromkeys(crop.number for crop in crops)
    views = (_view([crop for crop in crops if crop.number == number]) for number in numbers)
    return tuple(view for view in views if not (view.colour.isNull() and view.depth.isNull()))


def _view(crops: Sequence[Crop]) -> ViewPictures:
    by_content = {crop.content: crop for crop in crops}
    colour, depth, outline = (by_content.get(content) for content in ("colour", "depth", "outline"))
    mask = None if outline is None else _decoded(outline)
    return ViewPictures(
        crops[0].number, crops[0].sensor,
        QImage() if colour is None else QImage.fromData(colour.data),
        QImage() if depth is None else _depth(depth, mask),
        QPolygonF() if mask is None else _outline(mask),
    )  # fmt: skip


def _decoded(crop: Crop) -> np.ndarray | None:
    bytes_ = np.frombuffer(crop.data, np.uint8)
    return None if not bytes_.size else cv2.imdecode(bytes_, cv2.IMREAD_UNCHANGED)


def _depth(crop: Crop, mask: np.ndarray | None) -> QImage:
    depth_mm = _decoded(crop)
    if depth_mm is None or depth_mm.ndim != 2:
        return QImage()
    depth_mm = depth_mm.astype(np.uint16)
    fruit = depth_mm > 0 if mask is None or mask.shape != depth_mm.shape else (depth_mm > 0) & (mask > 0)
    if not fruit.any():
        return QImage()
    near, far = np.percentile(depth_mm[fruit], [2, 98])
    return depth_image(depth_mm, float(near), float(far) + DEPTH_ROOM_MM)


def _outline(mask: np.ndarray) -> QPolygonF:
    if mask.ndim != 2:
        return QPolygonF()
    contours, _ = cv2.findContours((mask > 0).astype(np.uint8), cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_SIMPLE)
    if not contours:
        return QPolygonF()
    largest = max(contours, key=cv2.contourArea).reshape(-1, 2)
    return QPolygonF([QPointF(x + 0.5, y + 0.5) for x, y in largest.tolist()])


@dataclass(frozen=True, slots=True, eq=False)
class Way:
    """A fruit's path from above: x along the belt's motion, y to its left, metres.

    Attributes:
        spreads: an ellipse of 95 % for each point, in order of time.
        duration_s: from the first to the last.
    """

    spreads: tuple[Spread, ...]
    duration_s: float

    @property
    def length_m(self) -> float:
        """How far the fruit went from the first to the last point."""
        first, last = self.spreads[0], self.spreads[-1]
        return float(np.hypot(last.x - first.x, last.y - first.y))


def way(path: Sequence[PathPoint], station: Station | None) -> Way | None:
    """Return a path from above; None where there are fewer than two points.

    Args:
        path: reference frame.
        station: that the lot ran on. Without it, the plane is the one in which the path itself lies.
    """
    if len(path) < 2:
        return None
    places_m = np.array([point.position_m for point in path])
    pose = _from_above(places_m, station)
    flat = pose.apply(places_m)[:, :2]
    flat = flat - flat.mean(axis=0)
    R = pose.rotation
    spreads = tuple(
        spread_of(place, (R @ point.covariance_m2 @ R.T)[:2, :2]) for place, point in zip(flat, path, strict=True)
    )
    return Way(spreads, path[-1].time_s - path[0].time_s)


def _from_above(places_m: F64, station: Station | None) -> Pose:
    """Return the pose into a frame seen from above, x along the way."""
    if station is None:
        _, _, axes = np.linalg.svd(places_m - places_m.mean(axis=0))
        belt = Pose(axes if np.linalg.det(axes) > 0 else axes * np.array([[1.0], [1.0], [-1.0]]), np.zeros(3))
    else:
        belt = station.sensors[station.reference].surface.plane.frame()
    along = belt.turn(places_m[-1] - places_m[0])
    angle = np.arctan2(along[1], along[0])
    cosine, sine = np.cos(angle), np.sin(angle)
    turn = np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    return Pose(turn @ belt.rotation, turn @ belt.translation_m)


@dataclass(frozen=True, slots=True, eq=False)
class ShownFruit:
    """One fruit with all that is shown of it."""

    fruit: FruitRecord
    corrections: Sequence[Correction]
    views: Sequence[ViewPictures]
    way: Way | None
