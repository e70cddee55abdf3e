"""Small pictures of a sensor's newest frame: colour, and depth in false colours that do not flicker."""

from __future__ import annotations

import numpy as np
from PySide6.QtGui import QImage

from fruitgui.frame import U8, U16, Frame
from fruitgui.gui.widgets.pictures import depth_image, image_of

EASE = 0.1
"""How much of a new range of depths is taken over with each picture."""

MARGIN = 0.06


class Thumbnails:
    """Keeps the last pictures of one sensor, and makes new ones only of a new frame."""

    def __init__(self) -> None:
        self._sequence: tuple[int, float] | None = None
        self._range_mm: tuple[float, float] | None = None
        self.colour: QImage | None = None
        self.depth: QImage | None = None

    def take(self, frame: Frame | None, width_px: int) -> bool:
        """Take in the newest frame, thinned to about a width; tell whether the pictures are new."""
        if frame is None or (frame.sequence, frame.time_s) == self._sequence or width_px < 1:
            return False
        self._sequence = (frame.sequence, frame.time_s)
        step = max(frame.depth_mm.shape[1] // width_px, 1)
        depth_mm = frame.depth_mm[::step, ::step]
        self._range_mm = _eased(self._range_mm, depth_mm)
        self.colour = image_of(_thinned(frame.color, step))
        self.depth = depth_image(depth_mm, *(self._range_mm or (500.0, 2000.0)))
        return True


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
