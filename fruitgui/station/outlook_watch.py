"""Looks at the sensors now and then, on a thread of its own, and says what calibrating would have to work with."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations

from fruitgui.calibration.outlook import Outlook, in_common, outlook
from fruitgui.errors import FruitguiError
from fruitgui.sensors.feed import Feed
from fruitgui.station.looks import Looks
from fruitgui.station.stills import collect_stills

CAPTURES = 3
REST_S = 1.0
REST_SHARE = 1.0
"""It rests at least so long, and so many times as long as it worked: the window and the sensors come first."""


@dataclass(frozen=True, slots=True, eq=False)
class RigOutlook:
    """What was seen at one look.

    Attributes:
        sensors: by name.
        common: by pair, how many things two sensors have in common.
    """

    sensors: Mapping[str, Outlook]
    common: Mapping[tuple[str, str], int]

    @property
    def moved(self) -> tuple[str, ...]:
        """The sensors before which something moves."""
        return tuple(name for name, one in self.sensors.items() if one.moved)


class OutlookWatch(Looks):
    """Looks at all sensors of a feed; `newest` is what it saw last."""

    def __init__(self, feed: Feed) -> None:
        super().__init__(name="outlook", rest_s=REST_S, rest_share=REST_SHARE)
        self._feed = feed
        self.newest: RigOutlook | None = None

    def look(self) -> None:
        """See what there is; nothing where a sensor does not run: the screen that shows their health says why."""
        try:
            self.newest = self._seen()
        except FruitguiError:
            self.newest = None

    def _seen(self) -> RigOutlook:
        stills = collect_stills(self._feed, CAPTURES, cancelled=lambda: self.stopping)
        sensors: dict[str, Outlook] = {}
        for name, frames in stills.items():
            if self.stopping:
                break
            sensors[name] = outlook(frames)
        pairs = combinations(sensors, 2)
        return RigOutlook(sensors, {pair: in_common(sensors[pair[0]], sensors[pair[1]]) for pair in pairs})
