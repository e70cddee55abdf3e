"""Whether the sensors' clocks agree, judged once by the first fruit that pass."""

from __future__ import annotations

from fruitgui.geometry.rig import Rig
from fruitgui.perception.view import Observation
from fruitgui.station.prelude import LOOK_FRAMES, LOOK_S, belt_of_one_sensor, decided_offsets_s


class FirstLook:
    """Collects the observations of the first seconds with fruit, and judges the clocks by them, once."""

    def __init__(self, rig: Rig) -> None:
        self._rig = rig
        self._seen: list[Observation] = []
        self._first_s: float | None = None
        self._done = len(rig.mounts) < 2

    def look(self, observation: Observation) -> dict[str, float]:
        """Take an observation; return what to add to the clocks (by station id), if this one decided it."""
        if self._done or (self._first_s is None and not observation.views):
            return {}
        if self._first_s is None:
            self._first_s = observation.time_s
        self._seen.append(observation)
        if len(self._seen) < LOOK_FRAMES and observation.time_s - self._first_s < LOOK_S:
            return {}
        self._done = True
        seen, self._seen = sorted(self._seen, key=lambda one: one.time_s), []
        return decided_offsets_s(seen, self._rig, belt_of_one_sensor(seen, self._rig))
