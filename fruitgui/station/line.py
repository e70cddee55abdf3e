"""The running line: observations in, finished fruit out. It reads no file and owns no thread."""

from __future__ import annotations

from collections.abc import Iterable

from fruitgui.geometry.rig import Rig
from fruitgui.perception.view import Observation
from fruitgui.station.fruit import Fruit
from fruitgui.station.judging import Judge, PaperVolume
from fruitgui.station.model import Model
from fruitgui.station.timing import Stopwatch
from fruitgui.tracking.track import Track
from fruitgui.tracking.tracker import Tracker


class Line:
    """Follows, measures and names fruit; each is given out once, when it has left.

    Args:
        rig: the sensors as placed.
        tracker: follows the fruit over that rig.
        model: names and corrects; without one every kind is `unknown` and volumes are as fitted.
        paper_volume: the source's volume beside ours, where it is wanted.
        watch: times the stages.
    """

    def __init__(
        self,
        rig: Rig,
        tracker: Tracker,
        model: Model | None = None,
        paper_volume: PaperVolume | None = None,
        watch: Stopwatch | None = None,
    ) -> None:
        self._tracker = tracker
        self._watch = watch or Stopwatch()
        self._judge = Judge(rig, model, paper_volume, self._watch)
        self._given_out = 0

    def feed(self, observation: Observation) -> list[Fruit]:
        """Return the fruit that were finished by this observation; they come in order of time."""
        return self.fruit(self.follow(observation))

    def finish(self) -> list[Fruit]:
        """Return the fruit that were still in view when it ended, where they count."""
        return self.fruit(self._tracker.finish())

    def follow(self, observation: Observation) -> list[Track]:
        """Return the tracks that were finished by this observation."""
        with self._watch.stage("track"):
            return self._tracker.update(observation)

    def fruit(self, tracks: Iterable[Track]) -> list[Fruit]:
        """Measure and name finished tracks."""
        fruit = []
        for track in tracks:
            self._given_out += 1
            fruit.append(self._judge.judge(track).fruit(self._given_out, track))
        return fruit
