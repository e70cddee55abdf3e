"""What can be connected, asked for beside: no driver that hangs holds anybody up, and what returns is opened again."""

from __future__ import annotations

import logging
import threading

from fruitgui.sensors.feed import Feed, Running
from fruitgui.station.sources import DevicesSource, Make, Source, Sources

log = logging.getLogger(__name__)


class FoundWatch:
    """Asks each make of sources what there is of it, whenever it is told to; answers come in when they come.

    Makes that ask devices are asked on a thread each, which ends with the answer. Any thread may call; no call waits.
    """

    def __init__(self, sources: Sources) -> None:
        self._makes = tuple(sources.makes)
        self._answers: dict[str, tuple[Source, ...]] = {}
        self._asked: set[str] = set()
        self._lock = threading.Lock()

    def ask(self) -> None:
        """Ask every make that is not being asked still."""
        for make in self._makes:
            if not make.asks_devices:
                self._answers[make.kind] = tuple(make.find())
            elif self._begins(make.kind):
                threading.Thread(target=self._ask, args=(make,), name=f"find {make.kind}", daemon=True).start()

    @property
    def found(self) -> list[Source]:
        """What there was at the last answers."""
        return [source for make in self._makes for source in self._answers.get(make.kind, ())]

    @property
    def serials(self) -> frozenset[str]:
        """Of the devices that were plugged in at the last answer."""
        devices = (source.devices for source in self.found if isinstance(source, DevicesSource))
        return frozenset(device.serial for some in devices for device in some)

    @property
    def asking(self) -> bool:
        """Whether an answer is still to come."""
        return bool(self._asked)

    def _begins(self, kind: str) -> bool:
        with self._lock:
            if kind in self._asked:
                return False
            self._asked.add(kind)
            return True

    def _ask(self, make: Make) -> None:
        try:
            self._answers[make.kind] = tuple(make.find())
        except Exception:  # the edge of a thread; a driver's bug hides its devices, and nothing else
            log.exception("finding %s", make.kind)
            self._answers[make.kind] = ()
        finally:
            with self._lock:
                self._asked.discard(make.kind)


class Returning:
    """Has a sensor that failed opened again at once when its device is seen to be back.

    A feed tries by itself every few seconds; this spares the wait after a plug was put back.
    """

    def __init__(self, found: FoundWatch) -> None:
        self._found = found
        self._absent: set[str] = set()

    def look(self, feed: Feed) -> None:
        """Look after a feed's sensors; to be called about once a second. Asks nobody while all of them run."""
        failed = {
            info.serial: name
            for name, info in feed.infos.items()
            if info.serial and feed.health(name).state is Running.FAILED
        }
        self._absent &= failed.keys()
        if not failed:
            return
        there = self._found.serials
        for serial in sorted(self._absent & there):
            feed.try_again(failed[serial])
        self._absent = set(failed) - there
        self._found.ask()
