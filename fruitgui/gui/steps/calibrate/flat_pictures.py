"""Pictures of clouds from above and from the side; any thread may make them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PySide6.QtGui import QImage

from fruitgui.frame import U8
from fruitgui.gui.steps.calibrate.cloud import Fit, coloured, layer
from fruitgui.station.fused_cloud import SensorCloud


@dataclass(frozen=True, slots=True)
class Wanted:
    """One picture.

    Attributes:
        sensor: number of the sensor that is shown; None for all together.
        after: as they stand after calibrating, or as they were thought to stand before.
    """

    sensor: int | None
    after: bool


def flat_picture(clouds: Sequence[SensorCloud], wanted: Wanted, fit: Fit) -> QImage:
    """Return a picture of a fit's size, clear where there is no point."""
    chosen = range(len(clouds)) if wanted.sensor is None else (wanted.sensor,)
    points = {one: clouds[one].after_m if wanted.after else clouds[one].before_m for one in chosen}
    colours = [coloured(shown, one) for one, shown in points.items()]
    return _image(layer(np.concatenate(list(points.values())), np.concatenate(colours), fit))


def _image(picture: U8) -> QImage:
    height, width = picture.shape[:2]
    image = QImage(picture.data, width, height, 4 * width, QImage.Format.Format_RGBA8888)
    return image.convertToFormat(QImage.Format.Format_ARGB32_Premultiplied)  # a copy, and drawn as it is
