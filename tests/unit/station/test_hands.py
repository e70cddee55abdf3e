"""Helpers do what this process would have, and nothing is lost with them."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Sequence
from contextlib import closing

import psutil
import pytest

from fruitgui.station.hands import Hands

PIECES = 20_000
PATIENCE_S = 60.0


def squared(number: int) -> tuple[int, int]:
    return number * number, os.getpid()


def one_is_bad(number: int) -> int:
    if number == 7:
        raise ValueError("seven")
    return number


def gone_beside(number: int) -> tuple[int, int]:
    """Break off in a helper, as if it had been killed."""
    if os.environ["HANDS_OWNER"] != str(os.getpid()):
        os.kill(os.getpid(), signal.SIGKILL)
    return number, os.getpid()


def children() -> Sequence[int]:
    return [child.pid for child in psutil.Process().children()]


def test_every_piece_is_done_once_and_a_helper_takes_part() -> None:
    began_s, pids = time.monotonic(), {os.getpid()}
    with Hands(cores=2) as hands:
        while len(pids) == 1 and time.monotonic() - began_s < PATIENCE_S:
            found = dict(hands.each(squared, range(PIECES)))
            assert found.keys() == set(range(PIECES))
            assert all(found[number][0] == number * number for number in found)
            pids = {pid for _, pid in found.values()}
    assert len(pids) == 2
    assert os.getpid() in pids


def test_helpers_end_with_the_hands_and_one_core_needs_none() -> None:
    before = set(children())
    with Hands(cores=1) as hands:
        assert dict(hands.each(one_is_bad, [1, 2])) == {0: 1, 1: 2}
        assert set(children()) == before
    with Hands(cores=3) as hands:
        assert dict(hands.each(one_is_bad, [1, 2, 3])) == {0: 1, 1: 2, 2: 3}
        assert len(set(children()) - before) == 2 + extra(children(), before)
    assert not [pid for pid in set(children()) - before if "resource_tracker" not in name(pid)]


def extra(now: Sequence[int], before: set[int]) -> int:
    """Return how many of the new processes only watch over shared things for the interpreter."""
    return sum("resource_tracker" in name(pid) for pid in set(now) - before)


def name(pid: int) -> str:
    return " ".join(psutil.Process(pid).cmdline())


def test_what_a_piece_raises_is_raised_here() -> None:
    with Hands(cores=2) as hands, pytest.raises(ValueError, match="seven"):
        list(hands.each(one_is_bad, range(200)))


def test_what_a_lost_helper_had_is_done_here(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HANDS_OWNER", str(os.getpid()))
    with Hands(cores=2) as hands:
        found = dict(hands.each(gone_beside, range(PIECES)))
    assert found.keys() == set(range(PIECES))
    assert {pid for _, pid in found.values()} == {os.getpid()}


def test_work_that_was_broken_off_leaves_nothing_behind() -> None:
    with Hands(cores=2) as hands:
        with closing(hands.each(squared, range(PIECES))) as results:
            next(iter(results))
        assert dict(hands.each(one_is_bad, [4, 5])) == {0: 4, 1: 5}
