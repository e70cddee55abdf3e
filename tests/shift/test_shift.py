"""Three minutes of a shift; `python -m tests.shift --minutes 60` runs an hour."""

from __future__ import annotations

from pathlib import Path

from tests.emulated_usb.emulation import Emulation
from tests.emulated_usb.outside import inside
from tests.shift.mishaps import SORTS
from tests.shift.shift import run

MINUTES, SEED = 3.0, 1

FRAME_MB, ON_THEIR_WAY = 640 * 480 * 5 / 1e6, 14
"""A frame's colour and depth; and how many may be on their way at one moment and not at another: four that wait in each
sensor, and six that are perceived ahead."""


@inside
def test_a_shift_in_which_everything_goes_wrong_once(usb: Emulation, tmp_path: Path) -> None:
    outcome = run(usb, 60.0 * MINUTES, SEED, tmp_path)
    assert {one.what for one in outcome.happened} == set(SORTS)
    assert outcome.unsaid == ()
    assert outcome.leaps >= sum(one.what == "clock_jump" for one in outcome.happened)
    assert outcome.count.passed > 60
    assert (outcome.count.missed, outcome.count.twice, outcome.count.strange) == ((), (), 0)
    assert abs(outcome.count.volume_error) < 0.05
    assert outcome.kept == outcome.told >= outcome.count.passed
    assert outcome.skipped == 0
    assert outcome.end.memory_mb < outcome.quarter.memory_mb + ON_THEIR_WAY * FRAME_MB
    assert outcome.end.threads <= outcome.quarter.threads + 2
    assert outcome.end.files <= outcome.quarter.files + 4
    assert outcome.end.usb <= outcome.quarter.usb + 4
    assert outcome.threads_left == 1
