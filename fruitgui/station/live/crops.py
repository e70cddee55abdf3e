"""Pictures of each fruit, cut out while it passes: the best view of each sensor, a few in all."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import cv2
import numpy as np

from fruitgui.frame import F32, U8, U16, Frame
from fruitgui.perception.view import FruitView
from fruitgui.station.sink import Crop

MOST_SENSORS = 4
"""Sensors of which one picture each is kept of a fruit."""

LONGEST_PX = 160
"""A crop's side, at most; a fruit is some 50 pixels wide at a metre."""

MOST_TRACKS = 120
"""Tracks whose cuts are kept; a twin that was taken for another fruit leaves its own behind for a while."""

MARGIN = 0.2
CLEARLY_BETTER = 1.15
JPEG_QUALITY = 88


@dataclass(frozen=True, slots=True, eq=False)
class Cut:
    """One view of one fruit, cut out of its frame: copies, so that the frame can go.

    Attributes:
        sensor: the station's id.
        time_s: of the frame, in the sensor's own clock.
        box_px: of the view, in the picture.
        left_px, top_px: of the corner, in the picture.
        color, depth_mm: of the part.
        outline_px: (K, 2) of the fruit, within the part.
        worth: the larger the better: pixels of fruit, more where it is seen whole and alone.
    """

    sensor: str
    time_s: float
    box_px: tuple[int, int, int, int]
    left_px: int
    top_px: int
    color: U8
    depth_mm: U16
    outline_px: F32
    worth: float


class Album:
    """The best cuts of the fruit in view, by track; memory is bounded by their number."""

    def __init__(self) -> None:
        self._cuts: dict[int, dict[str, Cut]] = {}
        self._loose: dict[tuple[str, float, tuple[int, int, int, int]], Cut] = {}

    def look(self, track: int, view: FruitView, frame: Frame) -> None:
        """Cut a view out if it is clearly better than what there is of its sensor."""
        cuts = self._cuts.setdefault(track, {})
        if len(self._cuts) > MOST_TRACKS:
            del self._cuts[min(self._cuts)]
        before = cuts.get(view.sensor)
        worth = worth_of(view)
        if before is None and len(cuts) >= MOST_SENSORS:
            return
        if before is None or worth > CLEARLY_BETTER * before.worth:
            cuts[view.sensor] = cut(view, frame, worth)

    def begin_anew(self, more: Iterable[Cut]) -> None:
        """Forget whose cuts these are, but not the cuts; `more` were given away and are to be found again too."""
        cuts = [one for of_track in self._cuts.values() for one in of_track.values()]
        self._loose = {(one.sensor, one.time_s, one.box_px): one for one in (*cuts, *more)}
        self._cuts = {}

    def find(self, track: int, view: FruitView) -> None:
        """Give a track the cut of one of its views, if there is one: the frame itself is gone."""
        found = self._loose.get((view.sensor, view.time_s, view.box_px))
        cuts = self._cuts.setdefault(track, {})
        before = cuts.get(view.sensor)
        if found is not None and (before is None or found.worth > before.worth):
            cuts[view.sensor] = found

    def take(self, track: int) -> tuple[Cut, ...]:
        """Return the cuts of a track and forget them, the best first."""
        return tuple(sorted(self._cuts.pop(track, {}).values(), key=lambda one: -one.worth))

    def __len__(self) -> int:
        return sum(len(cuts) for cuts in self._cuts.values())


def worth_of(view: FruitView) -> float:
    """Return how good a picture of its fruit a view is."""
    return view.area_px * (4.0 if view.whole else 1.0) * (0.5 if view.shared else 1.0)


def cut(view: FruitView, frame: Frame, worth: float) -> Cut:
    """Return a view cut out of its frame, with some belt around it."""
    left, top, width, height = view.box_px
    pad = round(MARGIN * max(width, height)) + 2
    x0, x1 = _span(left - pad, left + width + pad, frame.color.shape[1])
    y0, y1 = _span(top - pad, top + height + pad, frame.color.shape[0])
    return Cut(
        sensor=view.sensor,
        time_s=frame.time_s,
        box_px=view.box_px,
        left_px=x0,
        top_px=y0,
        color=frame.color[y0:y1, x0:x1].copy(),
        depth_mm=frame.depth_mm[y0:y1, x0:x1].copy(),
        outline_px=(view.outline_px - np.array([x0, y0], dtype=np.float32)).astype(np.float32),
        worth=worth,
    )


def _span(low: int, high: int, size: int) -> tuple[int, int]:
    """Return a span inside a picture, no longer than a crop may be, about the same middle."""
    excess = max(high - low - LONGEST_PX, 0)
    low, high = low + excess // 2, high - (excess + 1) // 2
    return max(low, 0), min(high, size)


def coded(cuts: tuple[Cut, ...]) -> tuple[Crop, ...]:
    """Return the crops of cuts: of each its colour as JPEG, its depth and its outline as PNG."""
    return tuple(crop for number, one in enumerate(cuts) for crop in _crops(number, one))


def _crops(number: int, one: Cut) -> tuple[Crop, Crop, Crop]:
    mask = np.zeros(one.color.shape[:2], dtype=np.uint8)
    cv2.fillPoly(mask, [np.rint(one.outline_px).astype(np.int32)], 255)
    bgr = cv2.cvtColor(one.color, cv2.COLOR_RGB2BGR)
    jpeg = cv2.imencode(".jpg", bgr, [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY])[1].tobytes()
    depth, outline = (cv2.imencode(".png", picture)[1].tobytes() for picture in (one.depth_mm, mask))
    place = (one.sensor, one.time_s, one.left_px, one.top_px)
    return (
        Crop(number, "colour", *place, "jpeg", jpeg),
        Crop(number, "depth", *place, "png", depth),
        Crop(number, "outline", *place, "png", outline),
    )
