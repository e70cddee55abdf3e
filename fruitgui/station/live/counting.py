"""The end of the line: fruit that left are measured and named, kept for good, and only then counted."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence

from fruitgui.classification.evidence import KindVote
from fruitgui.errors import FruitguiError
from fruitgui.geometry.rig import Rig
from fruitgui.measurement.rough import rough_size
from fruitgui.perception.view import FruitView
from fruitgui.station.fruit import Fruit
from fruitgui.station.judging import NOBODY_SAYS, Judgement, evidence
from fruitgui.station.live.crops import coded
from fruitgui.station.live.helper import HelperLostError, JobError, Weigh, Worker, attempted
from fruitgui.station.live.state import Finished, KindTotal, Spot, Totals
from fruitgui.station.live.weighing import Weighing
from fruitgui.station.sink import CountedFruit
from fruitgui.station.unknowns import UnknownWatch
from fruitgui.station.waiting import BufferedSink, SinkState
from fruitgui.tracking.track import Track

LAST_FRUIT = 12
UNKEPT = 256
"""Fruit that wait to be kept and are shown with their pictures once they are; beyond that only their number is."""

SURELY = 0.8
"""Part of half a view's shorter side within which one surely points at its fruit."""

Teacher = Callable[[Finished], None]
"""Told of every fruit that left, counted or not; quick, and never raises."""


class Counting:
    """Counts fruit, one after the other, on one thread.

    Args:
        rig: of the sensors that are there.
        worker: measures what no helper did.
        sink: keeps fruit.
        teacher: told of every fruit.
        warn: told what went wrong: code, text, sensors.
    """

    def __init__(
        self,
        rig: Rig,
        worker: Worker,
        sink: BufferedSink,
        teacher: Teacher | None,
        warn: Callable[[str, str, tuple[str, ...]], None],
    ) -> None:
        self._rig = rig
        self._worker = worker
        self._sink = sink
        self._teacher = teacher
        self._warn = warn
        self._judged: Callable[[Weighing], Judgement] = self._weighed
        self._unknowns = UnknownWatch()
        self._number = 0
        self._unkept: dict[int, Finished] = {}
        self._last: deque[tuple[CountedFruit, Finished]] = deque(maxlen=LAST_FRUIT)
        self.totals = Totals()

    @property
    def last(self) -> tuple[tuple[CountedFruit, Finished], ...]:
        """The last fruit counted, the newest first."""
        return tuple(reversed(self._last))

    @property
    def sink_state(self) -> SinkState:
        """How the store fares."""
        return self._sink.state

    def hurry(self) -> None:
        """Measure roughly from now on: somebody waits for the end, and a fruit is better counted than lost."""
        self._judged = self._hurried

    def count(self, weighing: Weighing) -> None:
        """Count a fruit once it is measured."""
        judgement, parted, lot = self._judged(weighing), weighing.parted, weighing.lot
        self._number += 1
        seen_by = tuple(sorted({sighting.view.sensor for sighting in parted.track.sightings}))
        finished = Finished(
            judgement.fruit(self._number, parted.track), coded(parted.cuts), judgement.evidence, seen_by,
            spots_of(parted.track),
        )  # fmt: skip
        if self._teacher is not None:
            self._teacher(finished)
        if lot is None:
            self.totals = Totals(self.totals.kinds, self.totals.passed + 1)
            return
        self._watch_unknown(judgement.vote)
        self._unkept[self._number] = finished
        while len(self._unkept) > UNKEPT:
            del self._unkept[next(iter(self._unkept))]
        self._add(self._sink.take(lot, finished.fruit, finished.crops))

    def retry(self) -> None:
        """Try again to keep what waits, if anything does."""
        if self._sink.state.waiting:
            self._add(self._sink.retry())

    def _watch_unknown(self, vote: KindVote) -> None:
        """Say it where most fruit are unknown to the model; those of which no model was asked tell nothing."""
        said = None if vote == NOBODY_SAYS else self._unknowns.see(vote.kind)
        if said is not None:
            self._warn("mostly_unknown", said, ())

    def _weighed(self, weighing: Weighing) -> Judgement:
        """Measure a track, beside or here; one that cannot be measured is counted all the same, and said."""
        try:
            if weighing.answer is not None:
                done: Judgement = weighing.answer.result()
                return done
        except (HelperLostError, JobError):
            pass  # once more, here
        here, error = attempted(self._worker, Weigh(weighing.parted.track))
        if isinstance(here, Judgement):
            return here
        self._warn("fruit_not_measured", f"A fruit could not be measured, only counted: {error}", ())
        return self._roughly(weighing)

    def _hurried(self, weighing: Weighing) -> Judgement:
        self._warn("fruit_not_measured", "A fruit could not be measured in time, only counted.", ())
        return self._roughly(weighing)

    def _roughly(self, weighing: Weighing) -> Judgement:
        """Return a judgement that no kind is named by, and that knows the size from the tracker alone."""
        track = weighing.parted.track
        size = rough_size(track, self._rig)
        return Judgement(NOBODY_SAYS, size, evidence(track, size), size.volume_m3, None)

    def _add(self, counted: Sequence[CountedFruit]) -> None:
        """Count what is durable now."""
        for one in counted:
            finished = self._unkept.pop(one.fruit.fruit, None)
            if finished is not None:
                self._last.append((one, finished))
            self.totals = _with(self.totals, one.fruit)
        problem = self._sink.state.problem
        if problem is not None:
            self._say(problem)

    def _say(self, problem: FruitguiError) -> None:
        self._warn("not_kept", f"{problem.what} {problem.remedy}", ())


def spots_of(track: Track) -> tuple[Spot, ...]:
    """Return where each view of a track shows it."""
    return tuple(_spot(sighting.view) for sighting in track.sightings)


def _spot(view: FruitView) -> Spot:
    left, top, width, height = view.box_px
    radius_px = SURELY * min(width, height) / 2.0
    return Spot(view.sensor, view.time_s, left + width / 2.0, top + height / 2.0, radius_px)


def _with(totals: Totals, fruit: Fruit) -> Totals:
    before = totals.kinds.get(fruit.kind, KindTotal())
    mass_kg = before.mass_kg
    if fruit.mass_kg is not None:
        mass_kg = (mass_kg or 0.0) + fruit.mass_kg.value
    after = KindTotal(before.count + 1, before.volume_m3 + fruit.volume_m3.value, mass_kg)
    return Totals({**totals.kinds, fruit.kind: after}, totals.passed)
