"""Fruit that left, measured and named: what is to be kept of each."""

from __future__ import annotations

from collections.abc import Callable

from fruitgui.classification.evidence import KindVote
from fruitgui.geometry.rig import Rig
from fruitgui.measurement.rough import rough_size
from fruitgui.perception.view import FruitView
from fruitgui.station.judging import NOBODY_SAYS, Judgement, evidence
from fruitgui.station.live.crops import coded
from fruitgui.station.live.helper import HelperLostError, JobError, Weigh, Worker, attempted
from fruitgui.station.live.state import Finished, Spot
from fruitgui.station.live.weighing import Weighing
from fruitgui.station.unknowns import UnknownWatch
from fruitgui.tracking.track import Track

SURELY = 0.8
"""Part of half a view's shorter side within which one surely points at its fruit."""


class Finishing:
    """Finishes fruit, one after the other, on one thread.

    Args:
        rig: of the sensors that are there.
        worker: measures what no helper did.
        warn: told what went wrong: code, text, sensors.
    """

    def __init__(self, rig: Rig, worker: Worker, warn: Callable[[str, str, tuple[str, ...]], None]) -> None:
        self._rig = rig
        self._worker = worker
        self._warn = warn
        self._judged: Callable[[Weighing], Judgement] = self._weighed
        self._unknowns = UnknownWatch()
        self._number = 0

    def hurry(self) -> None:
        """Measure roughly from now on: somebody waits for the end, and a fruit is better counted than lost."""
        self._judged = self._hurried

    def finish(self, weighing: Weighing) -> Finished:
        """Return a fruit once it is measured."""
        judgement, parted = self._judged(weighing), weighing.parted
        self._number += 1
        if weighing.lot is not None:
            self._watch_unknown(judgement.vote)
        seen_by = tuple(sorted({sighting.view.sensor for sighting in parted.track.sightings}))
        return Finished(
            judgement.fruit(self._number, parted.track), coded(parted.cuts), judgement.evidence, seen_by,
            spots_of(parted.track),
        )  # fmt: skip

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


def spots_of(track: Track) -> tuple[Spot, ...]:
    """Return where each view of a track shows it."""
    return tuple(_spot(sighting.view) for sighting in track.sightings)


def _spot(view: FruitView) -> Spot:
    left, top, width, height = view.box_px
    radius_px = SURELY * min(width, height) / 2.0
    return Spot(view.sensor, view.time_s, left + width / 2.0, top + height / 2.0, radius_px)
