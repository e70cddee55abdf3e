"""What was true of the pictures that were looked at while the projectors of a simulated rig were tried."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import pytest

from fruitgui.calibration.projectors.glimpse import Glimpse, glimpse
from fruitgui.calibration.projectors.settling import Refusal, Settled, settling_of, whole_of
from fruitgui.frame import U16
from fruitgui.simulation.projector import Beams
from fruitgui.station import projector_job

ALMOST = 0.98
"""Of its time a light is as good as settled: what it still lacks is less than a picture differs by itself."""


class TrueLight:
    """Notes how long each picture's projector had truly been on; a busy computer makes pictures late, not wrong."""

    def __init__(self, patch: pytest.MonkeyPatch) -> None:
        self._made: dict[int, float] = {}
        self._true_s: dict[int, float] = {}
        self._tried: dict[int, Sequence[Sequence[Glimpse]]] = {}
        lit = Beams.lit

        def noted(beams: Beams, sensor: str, number: int, depth_mm: U16, on_for_s: Mapping[str, float]) -> U16 | None:
            seen = lit(beams, sensor, number, depth_mm, on_for_s)
            if seen is not None:
                self._made[id(seen)] = on_for_s[sensor]
            return seen

        def looked(depth_mm: U16, since_s: float, frames: int) -> Glimpse:
            seen = glimpse(depth_mm, since_s, frames)
            self._true_s[id(seen)] = self._made[id(depth_mm)]
            return seen

        def told(trials: Sequence[Sequence[Glimpse]]) -> Settled | Refusal:
            found = settling_of(trials)
            self._tried[id(found)] = trials
            return found

        patch.setattr(Beams, "lit", noted)
        patch.setattr(projector_job, "glimpse", looked)
        patch.setattr(projector_job, "settling_of", told)

    def check(self, sensor: str, settle_s: float, found: object) -> None:
        """See that a sensor was found to be steady with the first picture after it was, of that time when it came last.

        Args:
            sensor: in the simulated rig.
            settle_s: its true time.
            found: of it.
        """
        assert isinstance(found, Settled), f"{sensor}: {found}"
        trials = [[(one.since_s, self._true_s[id(one)]) for one in trial] for trial in whole_of(self._tried[id(found)])]
        assert found.trials == len(trials)
        first_steady_s = max(next(since_s for since_s, true_s in trial if true_s >= settle_s) for trial in trials)
        bad_s = [since_s for trial in trials for since_s, true_s in trial if true_s < ALMOST * settle_s]
        assert max(bad_s) < found.steady_s <= first_steady_s, sensor
        assert found.settle_s > found.steady_s
