"""Most fruit unknown though there is a model: said when chance and foreign things cannot be why."""

from __future__ import annotations

from concurrent.futures import Future
from dataclasses import replace
from typing import Any, cast

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fruitgui.classification.evidence import UNKNOWN, Evidence, KindVote
from fruitgui.geometry.rig import Rig
from fruitgui.station.judging import NOBODY_SAYS, Judgement
from fruitgui.station.live.finishing import Finishing
from fruitgui.station.live.following import Parted
from fruitgui.station.live.weighing import Weighing
from fruitgui.station.unknowns import LAST_FRUIT, LEAST_FRUIT, UnknownWatch, mostly_unknown, unknown_warnings
from fruitgui.tracking.track import Track
from tests.unit.station.fruit_made import made_fruit

LOT = 1


def fruit(unknown: int, known: int) -> list[str]:
    return [UNKNOWN] * unknown + ["lemon"] * known


@pytest.mark.parametrize(
    ("unknown", "known", "said"),
    [
        (0, 0, False), (LEAST_FRUIT - 1, 0, False), (LEAST_FRUIT, 0, True), (10, 2, True), (9, 3, False),
        (20, 0, True), (16, 4, True), (21, 9, True), (20, 10, False), (15, 15, False), (0, 500, False),
        (270, 230, False), (273, 227, True),
    ],
)  # fmt: skip
def test_more_than_half_is_said_from_when_on_it_is_clear(unknown: int, known: int, said: bool) -> None:
    kinds = list(np.random.default_rng(3).permutation(fruit(unknown, known)))
    assert mostly_unknown(kinds) is said


def test_a_run_tells_how_many_and_why() -> None:
    (line,) = unknown_warnings(fruit(16, 4))
    assert line.startswith("16 of 20 fruit are unknown")
    assert "belt" in line
    assert "train again" in line
    assert unknown_warnings([]) == unknown_warnings(fruit(3, 60)) == []


def test_a_run_that_began_well_tells_where_it_went_wrong() -> None:
    assert not mostly_unknown(fruit(40, 200))
    (line,) = unknown_warnings(fruit(40, 200)[::-1])
    assert line.startswith("Of fruit 192 to 221, 21 are unknown")


def test_foreign_things_among_the_fruit_of_a_long_run_are_nothing() -> None:
    chance = np.random.default_rng(5)
    kinds = [UNKNOWN if foreign else "lemon" for foreign in chance.random(5000) < 0.2]
    assert unknown_warnings(kinds) == []


def said_at(kinds: list[str]) -> list[int]:
    watch = UnknownWatch()
    return [number for number, kind in enumerate(kinds, 1) if watch.see(kind) is not None]


def test_a_line_says_it_once_until_it_has_recovered() -> None:
    good, bad = fruit(0, 60), fruit(60, 0)
    assert said_at(good) == []
    assert said_at(bad) == [LEAST_FRUIT]
    assert said_at(good + bad) == [60 + 21]
    assert said_at(bad + good + bad) == [LEAST_FRUIT, 120 + 21]


@given(st.integers(0, LAST_FRUIT))
def test_it_is_not_said_again_where_it_goes_on_about_half(well: int) -> None:
    again = said_at(fruit(60, 0) + fruit(0, well) + fruit(60, 0))
    assert len(again) == (1 if well < 21 else 2)


class Counted:
    """A line's end whose fruit were measured beside, by kind."""

    def __init__(self) -> None:
        self.said: list[str] = []
        rig, worker = cast("Rig", None), cast("Any", None)
        self._finishing = Finishing(rig, worker, self._warn)

    def _warn(self, code: str, text: str, sensors: tuple[str, ...]) -> None:
        assert text
        assert sensors == ()
        self.said.append(code)

    def count(self, votes: list[KindVote], lot: int | None = LOT) -> None:
        for number, vote in enumerate(votes, 1):
            like = made_fruit(number)
            done: Future[Any] = Future()
            done.set_result(Judgement(vote, like.size, NO_VIEW, like.volume_m3, None))
            track = Track(number, (), like.path, np.zeros(3))
            self._finishing.finish(Weighing(Parted(track, ()), lot, done))


NO_VIEW = Evidence(np.zeros((1, 1), np.float32), np.zeros(1))
LEMON = KindVote("lemon", 0.97, {"lemon": 0.97, UNKNOWN: 0.03})
STRANGE = KindVote(UNKNOWN, 1.0, {"lemon": 0.0, UNKNOWN: 1.0})


def test_a_lot_that_goes_wrong_is_said_once() -> None:
    line = Counted()
    line.count([LEMON] * 40)
    assert line.said == []
    line.count([STRANGE] * 60)
    assert line.said == ["mostly_unknown"]


def test_fruit_of_which_no_model_was_asked_and_those_in_a_pause_tell_nothing() -> None:
    line = Counted()
    line.count([replace(NOBODY_SAYS)] * 60)
    line.count([STRANGE] * 60, lot=None)
    assert line.said == []
