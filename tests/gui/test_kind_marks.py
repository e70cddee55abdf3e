from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from fruitgui.gui.theme.kinds import UNKNOWN, kind_marks


@given(st.lists(st.text(st.characters(categories=["L", "N", "Zs"]), min_size=1, max_size=12), max_size=40))
def test_no_two_kinds_look_the_same(kinds: list[str]) -> None:
    marks = kind_marks(kinds)
    assert marks.keys() == {*kinds, UNKNOWN}
    looks = {(mark.colour, mark.shape) for mark in marks.values()}
    assert len(looks) == len(marks)
    assert len({mark.letters for mark in marks.values()}) == len(marks)


def test_letters_are_the_first_of_the_name_as_far_as_they_go() -> None:
    marks = kind_marks(["lemon", "Chilean avocado", "Peruvian avocado", "pear"])
    assert [marks[kind].letters for kind in ("lemon", "Chilean avocado", "Peruvian avocado", "pear")] == [
        "L", "C", "P", "Pe",
    ]  # fmt: skip
