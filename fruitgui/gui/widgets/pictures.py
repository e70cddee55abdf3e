"""From arrays to Qt's pictures."""

from __future__ import annotations

import numpy as np
from PySide6.QtGui import QImage

from fruitgui.frame import U8, U16


def image_of(color: U8) -> QImage:
    """Return a copy of an RGB array (h, w, 3) as Qt's image; any thread may call.

    A `QImage` over an array does not own it; it is copied, so that neither outlives the other. The copy has four bytes
    to a pixel: Qt paints those several times as fast.
    """
    rgb = np.ascontiguousarray(color)
    height, width = rgb.shape[:2]
    image = QImage(rgb.data, width, height, 3 * width, QImage.Format.Format_RGB888)
    return image.convertToFormat(QImage.Format.Format_RGB32)


def depth_image(depth_mm: U16, nearest_mm: float, farthest_mm: float) -> QImage:
    """Return depth (h, w) in false colours, near bright, far dark; black where there is no reading."""
    import cv2

    span = max(farthest_mm - nearest_mm, 1.0)
    near = np.clip((farthest_mm - depth_mm.astype(np.float32)) * (255.0 / span), 0.0, 255.0).astype(np.uint8)
    coloured = cv2.cvtColor(cv2.applyColorMap(near, cv2.COLORMAP_VIRIDIS), cv2.COLOR_BGR2RGB)
    coloured[depth_mm == 0] = 0
    return image_of(coloured)
