"""The processes beside the line: as many as there are cores, so that the line's own process has its hands free.

What a thread of the line's own process works on in Python keeps those that follow and count waiting for the
interpreter's lock. So frames are perceived and tracks measured beside it, and the line waits where all helpers are
busy; only where there are none, or none yet, it works itself.
"""

from __future__ import annotations

import threading
from concurrent.futures import Future
from typing import Any

from fruitgui.station.crew import usable_cores
from fruitgui.station.live.helper import HANDED, Helper, Look, Skills, Weigh

MOST_HELPERS = 3
"""Eight sensors at their rate need no more; each takes a tenth of a gigabyte of memory."""


class Bench:
    """Hands jobs to whoever has the fewest. Any thread may ask; one owner starts and closes.

    Args:
        skills: what the helpers work with.
        helpers: how many there are to be; one for each core, up to three, unless given.

    Attributes:
        helpers: all of them, whether they are up or not.
    """

    def __init__(self, skills: Skills, helpers: int | None = None) -> None:
        count = min(usable_cores(), MOST_HELPERS) if helpers is None else helpers
        self._room = threading.Condition()
        self.helpers = tuple(Helper(skills, self._tell) for _ in range(count))

    def start(self) -> None:
        """Start the helpers."""
        for helper in self.helpers:
            helper.start()

    @property
    def idle(self) -> bool:
        """Whether a helper is up and has nothing to do."""
        return any(helper.works and helper.outstanding == 0 for helper in self.helpers)

    def ask(self, job: Look | Weigh, most: int = HANDED) -> Future[Any] | None:
        """Hand a job over; None where no helper is up, or all have `most` jobs already."""
        for helper in sorted(self.helpers, key=lambda helper: helper.outstanding):
            answer = helper.ask(job, most)
            if answer is not None:
                return answer
        return None

    def hand(self, job: Look | Weigh) -> Future[Any] | None:
        """Hand a job over as soon as a helper has room for it; None where none is up."""
        with self._room:
            while any(helper.works for helper in self.helpers):
                answer = self.ask(job)
                if answer is not None:
                    return answer
                self._room.wait()
        return None

    def close(self) -> None:
        """End the helpers; what they left undone fails with `HelperLostError`. Any number of times."""
        for helper in self.helpers:
            helper.close()

    def _tell(self) -> None:
        with self._room:
            self._room.notify_all()
