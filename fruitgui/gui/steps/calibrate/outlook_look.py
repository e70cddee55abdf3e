"""Looks now and then at what calibrating would have to work with."""

from __future__ import annotations

from PySide6.QtCore import QObject, QTimer, Signal

from fruitgui.sensors.feed import Feed
from fruitgui.station.outlook_watch import OutlookWatch

LOOK_MS = 250


class OutlookLook(QObject):
    """Has the sensors looked at while it is asked to.

    Attributes:
        looked: it is time to show what was seen.
        watch: what looks at the sensors; None while nothing does.
    """

    looked = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.watch: OutlookWatch | None = None
        self._timer = QTimer(self, interval=LOOK_MS)
        self._timer.timeout.connect(self.looked)

    def begin(self, feed: Feed) -> None:
        """Look at a feed's sensors, unless that is done already."""
        if self.watch is None:
            self.watch = OutlookWatch(feed)
            self.watch.start()
            self._timer.start()

    def end(self) -> None:
        """Look no more."""
        if self.watch is not None:
            self.watch.stop()
            self.watch = None
            self._timer.stop()
