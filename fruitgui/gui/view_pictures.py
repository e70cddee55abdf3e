"""A fruit's crops as pictures to be drawn; no widgets."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from PySide6.QtCore import QPointF
from PySide6.QtGui import QImage, QPolygonF

from fruitgui.frame import U8, U16
from fruitgui.gui.widgets.pictures import depth_image
from fruitgui.station.sink import Crop

Picture = U8 | U16

BEHIND_MM = 40.0
"""Beyond the fruit's own depths, what is shown of the belt behind it."""


@dataclass(frozen=True, slots=True, eq=False)
class ViewPictures:
    """One view of a fruit.

    Attributes:
        number: of the view. sensor: that saw it.
        colour, depth: the pictures, depth in false colours; null where there is none.
        outline: in pixels of either; empty where there is none.
    """

    number: int
    sensor: str
    colour: QImage
    depth: QImage
    outline: QPolygonF


def view_pictures(crops: Sequence[Crop]) -> tuple[ViewPictures, ...]:
    """Return the views of a fruit, the best first; a damaged crop leaves a gap, never an error. Any thread may call."""
    numbers = dict.fromkeys(crop.number for crop in crops)
    views = (_view([crop for crop in crops if crop.number == number]) for number in numbers)
    return tuple(view for view in views if not (view.colour.isNull() and view.depth.isNull()))


def _view(crops: Sequence[Crop]) -> ViewPictures:
    found = {crop.content: crop for crop in crops}
    colour, mask = found.get("colour"), _decoded(found.get("outline"))
    return ViewPictures(
        crops[0].number,
        crops[0].sensor,
        QImage() if colour is None else QImage.fromData(colour.data),
        _depth(_decoded(found.get("depth")), mask),
        _outline(mask),
    )


def _decoded(crop: Crop | None) -> Picture | None:
    if crop is None or not crop.data:
        return None
    decoded: Picture | None = cv2.imdecode(np.frombuffer(crop.data, np.uint8), cv2.IMREAD_UNCHANGED)
    return decoded


def _depth(depth_mm: Picture | None, mask: Picture | None) -> QImage:
    """Return depth in false colours, spread over the depths of the fruit itself."""
    if depth_mm is None or depth_mm.ndim != 2:
        return QImage()
    known = depth_mm > 0
    fruit = known & (mask > 0) if mask is not None and mask.shape == depth_mm.shape else known
    if not fruit.any():
        return QImage()
    near, far = np.percentile(depth_mm[fruit], [2, 98])
    return depth_image(depth_mm.astype(np.uint16), float(near), float(far) + BEHIND_MM)


def _outline(mask: Picture | None) -> QPolygonF:
    if mask is None or mask.ndim != 2:
        return QPolygonF()
    contours, _ = cv2.findContours((mask > 0).astype(np.uint8), cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_SIMPLE)
    if not contours:
        return QPolygonF()
    largest = max(contours, key=cv2.contourArea).reshape(-1, 2)
    return QPolygonF([QPointF(x + 0.5, y + 0.5) for x, y in largest.tolist()])
