"""A line that hangs is told from one that is slow, that waits, or that nobody listens to."""

from __future__ import annotations

from collections.abc import Iterable

from fruitgui.station.live.apart.hang_watch import MOST_LOADING, MOST_SILENT, MOST_UNTAKEN, HangWatch, Signs

BEGUN = Signs(answers=1, given=0, taken=0, heard=True)
LONG = 2 * MOST_LOADING


def hung_at(looks: Iterable[Signs]) -> int | None:
    """Return the number of the first look at which a line is said to hang."""
    watch = HangWatch()
    return next((at for at, signs in enumerate(looks) if watch.look(signs)), None)


def test_a_line_that_says_nothing_hangs() -> None:
    assert hung_at([BEGUN] * LONG) == MOST_SILENT


def test_a_line_that_answers_does_not_hang_for_want_of_frames() -> None:
    assert hung_at(Signs(at, 5, 5, heard=True) for at in range(LONG)) is None


def test_a_line_that_answers_and_takes_no_frame_up_hangs() -> None:
    assert hung_at(Signs(1 + at, 5, 4, heard=True) for at in range(LONG)) == MOST_UNTAKEN


def test_a_line_that_is_slow_does_not_hang() -> None:
    answers, frames = MOST_SILENT - 1, MOST_UNTAKEN - 1
    slow = (Signs(1 + at // answers, 4 + at // frames, at // frames, heard=True) for at in range(5 * MOST_UNTAKEN))
    assert hung_at(slow) is None


def test_a_line_that_nobody_listens_to_does_not_hang() -> None:
    assert hung_at(Signs(1, 4, 0, heard=False) for _ in range(LONG)) is None


def test_a_line_has_longer_to_load() -> None:
    loading = [Signs(0, 4, 0, heard=True)] * (MOST_LOADING - 1)
    assert hung_at([*loading, BEGUN]) is None
    assert hung_at([*loading, loading[0]]) == MOST_LOADING - 1
