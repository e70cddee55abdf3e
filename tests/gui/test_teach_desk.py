"""What lies on the teaching desk, without a window."""

from __future__ import annotations

import pytest

from fruitgui.classification.evidence import UNKNOWN
from fruitgui.gui.steps.teach.desk import Desk, Pile, Shelf
from fruitgui.gui.steps.teach.side_panel import typed_number
from fruitgui.gui.steps.teach.tile import Tiles
from fruitgui.records.insight import Guess, Insight
from fruitgui.records.journal import Change
from fruitgui.records.teaching import Brief


def _desk(*kinds: str | None, samples: int = 6) -> Desk:
    """Return a desk with fruit 1, 2, … of these kinds, the newest first."""
    desk = Desk()
    made = [Brief(key, "line", kind, None, None, samples) for key, kind in enumerate(kinds, start=1)]
    desk.lay_out(reversed(made), ())
    return desk


def test_kinds_keep_their_keys_when_others_come() -> None:
    desk = _desk("pear", "lemon")
    desk.lay_out(desk.fruit.values(), ("pear",))
    assert [(line.kind, line.key) for line in desk.lines()] == [("pear", "1"), ("lemon", "2"), (UNKNOWN, "0")]
    desk.add_kind("apple")
    assert [line.kind for line in desk.lines()] == ["pear", "lemon", "apple", UNKNOWN]
    for number in range(9):
        desk.add_kind(f"kind {number}")
    assert [line.key for line in desk.lines()] == [*"123456789", "", "", "", "0"]


@pytest.mark.parametrize(
    ("typed", "same"),
    [
        ("  red   APPLE ", "Red apple"),
        ("red_apple", "Red apple"),
        ("Limo\u0301n", "Limón"),
        ("green apple", "green_apple"),
        ("UNKNOWN", UNKNOWN),
    ],
)
def test_a_kind_that_people_would_read_as_one_that_is_there_is_that_one(typed: str, same: str) -> None:
    desk = _desk("green_apple", "Limón", "Red apple")
    before = desk.order
    assert desk.add_kind(typed) == same
    assert desk.order == before
    assert desk.add_kind(" Lima  dulce ") == "Lima dulce"


def test_a_kind_is_full_with_enough_views_of_enough_fruit() -> None:
    few_fruit = _desk(*["lemon"] * 9, samples=60).lines()[0]
    assert (few_fruit.share, few_fruit.full) == (0.9, False)
    few_views = _desk(*["lemon"] * 12, samples=2).lines()[0]
    assert few_views.share == pytest.approx(24 / 50)
    assert _desk(*["lemon"] * 10, samples=5).lines()[0].full
    assert not _desk(*["lemon"] * 10).done, "one kind alone is not enough"
    assert _desk(*["lemon"] * 10, *["pear"] * 10, UNKNOWN).done


def test_what_would_teach_most_comes_first_and_leaves_once_it_is_named() -> None:
    desk = _desk(None, None, None, "lemon")
    assert desk.keys(Shelf()) == [3, 2, 1]
    desk.insight = Insight(order=(1, 4, 3))
    assert desk.keys(Shelf()) == [1, 3, 2]
    desk.name([1], "lemon")
    assert desk.keys(Shelf()) == [3, 2]
    assert desk.keys(Shelf(Pile.NAMED, "lemon")) == [4, 1]


def test_a_doubt_is_settled_by_the_last_word_of_a_person() -> None:
    desk = _desk("lemon", "pear")
    desk.insight = Insight(mistakes={1: Guess("pear", 0.9), 7: Guess("pear", 0.8)})
    assert desk.keys(Shelf(Pile.DOUBTFUL)) == [1]
    tile = Tiles(desk).tile(1)
    assert (tile.words, tile.sure, tile.other is not None) == ("Lemon, or Pear 90\u2009%?", "90\u2009%", True)
    desk.name([1], "lemon")
    assert desk.keys(Shelf(Pile.DOUBTFUL)) == []
    assert Tiles(desk).tile(1).other is None


def test_steps_are_followed_both_ways() -> None:
    desk = _desk("lemon", None)
    step = [Change(1, "kind", None, "lemon"), Change(1, "volume_ml", None, 99.0), Change(8, "kind", None, "x")]
    assert desk.apply(step, back=True) == [1]
    assert (desk.fruit[1].kind, desk.fruit[1].volume_ml) == (None, None)
    desk.apply(step, back=False)
    assert (desk.fruit[1].kind, desk.fruit[1].volume_ml) == ("lemon", 99.0)


def test_the_density_of_a_kind_is_that_of_its_fruit_with_both_measures() -> None:
    desk = _desk("lemon", "lemon", "lemon", None)
    desk.measure(1, 100.0, 90.0)
    desk.measure(2, 100.0, 98.0)
    desk.measure(3, 100.0, None)
    desk.measure(4, 100.0, 500.0)
    assert desk.densities() == {"lemon": pytest.approx(0.94)}
    assert desk.lines()[0].measured == 3


def test_a_model_has_no_say_before_a_first_set_is_named() -> None:
    assert not _desk(*["lemon"] * 9, "pear", "pear").can_look_through
    assert _desk(*["lemon"] * 3, *["pear"] * 3).can_look_through
    assert not _desk(*["lemon"] * 3, *[UNKNOWN] * 3).can_look_through


@pytest.mark.parametrize(
    ("text", "value"), [("112,5", 112.5), (" 9.25 ", 9.25), ("", None), ("0", None), ("abc", None)]
)
def test_a_measure_is_typed_with_a_point_or_a_comma(text: str, value: float | None) -> None:
    assert typed_number(text) == value
