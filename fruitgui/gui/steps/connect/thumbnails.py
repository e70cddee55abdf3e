"""Small pictures of a sensor's newest frame: colour, and depth in false colours that do not flicker."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from PySide6.QtGui import QImage

from fruitgui.frame import U8, U16, Frame
from fruitgui.gui.widgets.pictures import depth_image, image_of

EASE = 0.1
"""How much of a new range of depths is taken over with each picture."""

MARGIN = 0.06
USUAL_RANGE_MM = (500.0, 2000.0)


@dataclass(frozen=True, slots=True, eq=False)
class Thumbnails:
    """Both pictures of one frame.

    Attributes:
        sequence, time_s: of the frame.
        range_mm: depths that are drawn; None while too few were read.
        colour, depth: the pictures.
    """

    sequence: int
    time_s: float
    range_mm: tuple[float, float] | None
    colour: QImage
    depth: QImage

    def of(self, frame: Frame) -> bool:
        """Tell whether they show this frame."""
        return (frame.sequence, frame.time_s) == (self.sequence, self.time_s)


def thumbnails(frame: Frame, width_px: int, before: Thumbnails | None) -> Thumbnails:
    """Return a frame's pictures, thinned to about a width; any thread may call.

    Args:
        before: of the same sensor, whose range of depths is gone on with.
    """
    step = max(frame.depth_mm.shape[1] // max(width_px, 1), 1)
    depth_mm = frame.depth_mm[::step, ::step]
    range_mm = _eased(None if before is None else before.range_mm, depth_mm)
    depth = depth_image(depth_mm, *(range_mm or USUAL_RANGE_MM))
    return Thumbnails(frame.sequence, frame.time_s, range_mm, image_of(_thinned(frame.color, step)), depth)


def _thinned(color: U8, step: int) -> U8:
    """Return every so-manieth pixel, each the mean of its neighbours, so that nothing glitters."""
    import cv2

    if step == 1:
        return color
    height, width = color.shape[:2]
    return np.asarray(cv2.resize(color, (width // step, height // step), interpolation=cv2.INTER_AREA), dtype=np.uint8)


def _eased(before: tuple[float, float] | None, depth_mm: U16) -> tuple[float, float] | None:
    readings = depth_mm[depth_mm > 0]
    if readings.size < 50:
        return before
    near, far = np.percentile(readings[::7], (1.0, 99.0))
    margin = MARGIN * (far - near) + 10.0
    now = (float(near - margin), float(far + margin))
    if before is None:
        return now
    return before[0] + EASE * (now[0] - before[0]), before[1] + EASE * (now[1] - before[1])
