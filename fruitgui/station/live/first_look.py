"""Whether the sensors' clocks agree, judged once by the first fruit that pass; until then no fruit is counted.

A clock that is off makes two tracks of one fruit. What left before that was known would be counted twice, so it waits;
and where a clock is put right, everything seen so far is followed once more.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from fruitgui.perception.view import Observation
from fruitgui.station.live.following import Following, Parted
from fruitgui.station.prelude import LOOK_FRAMES, LOOK_S, belt_of_one_sensor, decided_offsets_s

Leaving = tuple[Parted, int | None]
"""A fruit that left, and the lot that was counted into at that moment."""


@dataclass(frozen=True, slots=True, eq=False)
class _Seen:
    observation: Observation
    lot: int | None


class FirstLook:
    """Holds back fruit that left, from the first view of fruit on until the clocks were judged by them.

    Args:
        following: follows the same observations.

    Attributes:
        offsets_s: what was found: to be added to the times of sensors, by station id. Empty before, and where the
            clocks agree or the fruit do not tell.
    """

    def __init__(self, following: Following) -> None:
        self._following = following
        self._seen: list[_Seen] = []
        self._held: list[Leaving] = []
        self._open = len(following.rig.mounts) > 1
        self.offsets_s: dict[str, float] = {}

    @property
    def held(self) -> int:
        """How many fruit wait for the clocks to be judged."""
        return len(self._held)

    def right(self, observation: Observation) -> Observation:
        """Return an observation with its sensor's clock put right."""
        offset_s = self.offsets_s.get(observation.sensor, 0.0)
        return replace(observation, time_s=observation.time_s + offset_s) if offset_s else observation

    def take(self, observation: Observation, parted: list[Parted], lot: int | None) -> list[Leaving]:
        """Take what was just followed and the fruit that it finished; return those that may be counted now."""
        leaving: list[Leaving] = [(one, lot) for one in parted]
        if not self._open or (not self._seen and not observation.views):
            return [*self.released(), *leaving]
        self._seen.append(_Seen(observation, lot))
        self._held += leaving
        lasted_s = observation.time_s - self._seen[0].observation.time_s
        return self.settle() if len(self._seen) >= LOOK_FRAMES or lasted_s >= LOOK_S else []

    def settle(self) -> list[Leaving]:
        """Judge the clocks by what was seen, if that was not done; return the fruit that were held back."""
        if not self._open:
            return self.released()
        self._open = False
        seen, self._seen = self._seen, []
        observations = sorted((one.observation for one in seen), key=lambda one: one.time_s)
        rig = self._following.rig
        self.offsets_s = decided_offsets_s(observations, rig, belt_of_one_sensor(observations, rig))
        held = self.released()
        return self._again(seen, held) if self.offsets_s else held

    def released(self) -> list[Leaving]:
        """Return what was held back, if judging the clocks failed and left it."""
        held, self._held = self._held, []
        return held

    def _again(self, seen: list[_Seen], held: list[Leaving]) -> list[Leaving]:
        """Follow what was seen once more, with clocks put right."""
        righted = sorted(
            (_Seen(self.right(one.observation), one.lot) for one in seen), key=lambda one: one.observation.time_s
        )
        self._following.begin_anew([cut for parted, _ in held for cut in parted.cuts])
        return [(parted, one.lot) for one in righted for parted in self._following.follow_again(one.observation)]
