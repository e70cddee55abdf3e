"""What lies below the region: one sensor's newest picture, or all of them laid on the belt; made beside the window."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QImage

from fruitgui.frame import U8, Frame, Intrinsics
from fruitgui.gui.queries import Queries
from fruitgui.gui.steps.belt.projection import Above, Projection, Through, plan_points
from fruitgui.gui.widgets.pictures import image_of
from fruitgui.sensors.feed import Feed
from fruitgui.station.belt_mosaic import Mosaic, mosaic_of
from fruitgui.station.station import Station

MOSAIC_WIDTH = 700


@dataclass(frozen=True, slots=True, eq=False)
class Laid:
    """All pictures laid on the belt, and the way there, which serves the next ones too."""

    mosaic: Mosaic
    image: QImage


class Backdrop(QObject):
    """Makes one picture at a time, and only of frames that are new.

    Attributes:
        made: a `QImage` of the view that was shown last.
        queries: what is being made.
    """

    made = Signal(object)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.queries = Queries(self)
        self._station: Station | None = None
        self._view: Projection | None = None
        self._mosaic: Mosaic | None = None
        self._drawn: object = None

    def show_view(self, station: Station, view: Projection) -> None:
        """Make pictures of another view from here on."""
        self._station, self._view = station, view
        self._mosaic, self._drawn = None, None
        self.queries.rest()

    def draw(self, feed: Feed) -> None:
        """Begin to make a picture of the newest frames, unless there is nothing new, or one is being made."""
        station, view = self._station, self._view
        if station is None or view is None or self.queries.busy:
            return
        sensors = (
            [view.sensor] if isinstance(view, Through) else [name for name in feed.infos if name in station.sensors]
        )
        frames = {name: frame for name in sensors if (frame := feed.newest(name)) is not None}
        newest = tuple((name, frame.sequence) for name, frame in frames.items())
        if not frames or newest == self._drawn:
            return
        self._drawn = newest
        if isinstance(view, Above):
            cameras = {name: feed.infos[name].intrinsics for name in sensors}
            self.queries.ask("picture", partial(_laid, self._mosaic, station, view, cameras, frames), self._take_laid)
        else:
            (frame,) = frames.values()
            self.queries.ask("picture", partial(image_of, frame.color), self.made.emit)

    def _take_laid(self, laid: Laid) -> None:
        self._mosaic = laid.mosaic
        self.made.emit(laid.image)


def _laid(
    mosaic: Mosaic | None,
    station: Station,
    view: Above,
    cameras: Mapping[str, Intrinsics],
    frames: Mapping[str, Frame],
) -> Laid:
    """Lay pictures on the belt as a view from above shows it; any thread may call.

    Args:
        mosaic: of this view, where it was made before. cameras: of all sensors that see the belt.
        frames: the newest of each.
    """
    if mosaic is None:
        height = round(MOSAIC_WIDTH * view.size[1] / view.size[0])
        mosaic = mosaic_of(station, cameras, plan_points(view, MOSAIC_WIDTH, height))
    return Laid(mosaic, _image(mosaic.laid(frames)))


def _image(laid: U8) -> QImage:
    height, width = laid.shape[:2]
    image = QImage(laid.data, width, height, 4 * width, QImage.Format.Format_RGBA8888)
    return image.convertToFormat(QImage.Format.Format_ARGB32_Premultiplied)  # a copy, and drawn as it is
