"""Looks at the sensors now and then, on a thread of its own, and says what calibrating would have to work with."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations

from fruitgui.calibration.outlook import Outlook, in_common, outlook
from fruitgui.errors import FruitguiError
from fruitgui.sensors.feed import Feed
from fruitgui.station.stills import collect_stills

CAPTURES = 3
REST_S = 1.0
REST_SHARE = 1.0
"""It rests at least so long, and so many times as long as it worked: the window and the sensors come first."""

log = logging.getLogger(__name__)


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


class OutlookWatch:
    """Runs from `start` to `stop`; `newest` is what it saw last. Stopping waits for nothing."""

    def __init__(self, feed: Feed) -> None:
        self._feed = feed
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, name="outlook", daemon=True)
        self.newest: RigOutlook | None = None

    def start(self) -> None:
        """Begin. Once only."""
        self._thread.start()

    def stop(self) -> None:
        """Let it end after what it does just now, a second at most."""
        self._stop.set()

    @property
    def running(self) -> bool:
        """Whether its thread has not ended yet."""
        return self._thread.is_alive()

    def _run(self) -> None:
        while not self._stop.is_set():
            began_s = time.monotonic()
            try:
                self.newest = self._look()
            except FruitguiError:
                self.newest = None  # the screen that shows the sensors' health says why
            except Exception:  # the edge of a thread; this is a help, and must not end anything else
                log.exception("looking at what can be calibrated")
            self._stop.wait(max(REST_S, REST_SHARE * (time.monotonic() - began_s)))

    def _look(self) -> RigOutlook:
        stills = collect_stills(self._feed, CAPTURES, cancelled=self._stop.is_set)
        sensors: dict[str, Outlook] = {}
        for name, frames in stills.items():
            if self._stop.is_set():
                break
            sensors[name] = outlook(frames)
        pairs = combinations(sensors, 2)
        return RigOutlook(sensors, {pair: in_common(sensors[pair[0]], sensors[pair[1]]) for pair in pairs})
