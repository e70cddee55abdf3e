"""What was true of the pictures that were looked at while the projectors of a simulated rig were tried."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass

import pytest

from fruitgui.calibration.projectors.glimpse import Glimpse, glimpse
from fruitgui.calibration.projectors.settling import LEAST_PICTURES, Settled
from fruitgui.frame import U16
from fruitgui.simulation.projector import Beams
from fruitgui.station import projector_job

ALMOST = 0.98
"""Of its time a light is as good as settled: what it still lacks is less than a picture differs by itself."""


@dataclass(frozen=True, slots=True)
class Looked:
    """One picture that was looked at: how long its projector had been on as the job has it, and in truth."""

    since_s: float
    frames: int
    true_s: float


class TrueLight:
    """Notes how long each picture's projector had truly been on; a busy computer makes pictures late, not wrong."""

    def __init__(self, patch: pytest.MonkeyPatch) -> None:
        self._made: dict[int, tuple[str, float]] = {}
        self._looked: dict[str, list[Looked]] = defaultdict(list)
        lit = Beams.lit

        def noted(beams: Beams, sensor: str, number: int, depth_mm: U16, on_for_s: Mapping[str, float]) -> U16 | None:
            seen = lit(beams, sensor, number, depth_mm, on_for_s)
            if seen is not None:
                self._made[id(seen)] = sensor, on_for_s[sensor]
            return seen

        def looked(depth_mm: U16, since_s: float, frames: int) -> Glimpse:
            sensor, true_s = self._made[id(depth_mm)]
            self._looked[sensor].append(Looked(since_s, frames, true_s))
            return glimpse(depth_mm, since_s, frames)

        patch.setattr(Beams, "lit", noted)
        patch.setattr(projector_job, "glimpse", looked)

    def check(self, sensor: str, settle_s: float, found: object) -> None:
        """See that a sensor was found to be steady with the first picture after it was, of that time when it came last.

        Args:
            sensor: in the simulated rig.
            settle_s: its true time.
            found: of it.
        """
        assert isinstance(found, Settled), f"{sensor}: {found}"
        assert found.trials == projector_job.TRIALS
        trials = self._trials(sensor, settle_s)
        first_steady_s = max(next(one.since_s for one in trial if one.true_s >= settle_s) for trial in trials)
        last_bad_s = max(max(one.since_s for one in trial if one.true_s < ALMOST * settle_s) for trial in trials)
        assert last_bad_s < found.steady_s <= first_steady_s, sensor
        assert found.settle_s > found.steady_s

    def _trials(self, sensor: str, settle_s: float) -> list[list[Looked]]:
        """Return the times that count: whole, and seen from before the light was steady."""
        trials: list[list[Looked]] = []
        for one in self._looked[sensor]:
            if not trials or one.frames <= trials[-1][-1].frames:
                trials.append([])
            trials[-1].append(one)
        whole = [one for one in trials if len(one) >= LEAST_PICTURES and one[0].true_s < ALMOST * settle_s]
        assert len(whole) >= projector_job.TRIALS
        return whole[: projector_job.TRIALS]
