from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtCore import QRectF
from PySide6.QtGui import QColor, QImage, QPainter
from pytestqt.qtbot import QtBot

from fruitgui.gui.kind_book import KindBook
from fruitgui.gui.theme.contrast import SHAPES, contrast
from fruitgui.gui.theme.kinds import UNKNOWN, kind_marks
from fruitgui.gui.theme.tokens import THEMES, Colours
from fruitgui.gui.widgets.kind_mark import paint_mark, point_pixmap
from fruitgui.station.kinds_file import KindNotes


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


@given(st.lists(st.sampled_from("abcdefghijkl"), max_size=12), st.lists(st.sampled_from("abcdefghijkl"), max_size=12))
def test_a_kind_keeps_its_mark_whatever_comes_or_goes(first: list[str], then: list[str]) -> None:
    kept: list[KindNotes] = []
    book = KindBook(KindNotes(), kept.append)
    before = book.looks(first)
    after = KindBook(kept[-1] if kept else KindNotes(), kept.append).looks(then)
    assert {kind: after[kind] for kind in after if kind in before} == {
        kind: before[kind] for kind in after if kind in before
    }
    assert len({(mark.colour, mark.shape) for mark in after.values()}) == len(after)


def test_marks_are_kept_once_and_not_at_every_look() -> None:
    kept: list[KindNotes] = []
    book = KindBook(KindNotes(), kept.append)
    assert book.looks(["lemon", "pear"])["pear"] == book.looks(["pear"])["pear"]
    book.looks([UNKNOWN])
    assert len(kept) == 1


def test_a_typed_density_is_told_once_and_again_where_it_could_not_be_kept() -> None:
    told: list[bool] = []
    kept: list[KindNotes] = []
    book = KindBook(KindNotes(), kept.append)
    book.changed.connect(lambda: told.append(True))
    book.type_densities({"lemon": 0.97, "pear": None})
    book.type_densities({"lemon": 0.97})
    assert (book.densities_g_ml, told, len(kept)) == ({"lemon": 0.97}, [True], 1), "nothing new is neither"
    book.take(KindNotes())
    assert (book.densities_g_ml, told) == ({}, [True, True])
    book.type_densities({"lemon": 0.97})
    book.type_densities({"lemon": None})
    assert book.densities_g_ml == {}


@pytest.mark.parametrize("colours", THEMES.values(), ids=THEMES.keys())
def test_every_mark_has_an_edge_that_is_seen_on_either_ground(qtbot: QtBot, colours: Colours) -> None:  # noqa: ARG001
    for mark in kind_marks([f"kind {number}" for number in range(8)]).values():
        image = QImage(40, 40, QImage.Format.Format_RGB32)
        image.fill(QColor(colours.surface))
        with QPainter(image) as painter:
            paint_mark(painter, QRectF(0, 0, 40, 40), mark)
        row = [image.pixelColor(x, 20).name() for x in range(20)]
        first = next(x for x, one in enumerate(row) if one != colours.surface)
        assert max(contrast(one, colours.surface) for one in row[first : first + 4]) >= SHAPES, mark


def test_points_that_are_too_small_for_letters_differ_in_shape_too(qtbot: QtBot) -> None:  # noqa: ARG001 - Qt runs
    marks = kind_marks(["lemon", "pear", "quince"])
    shapes = [
        [point_pixmap(marks[kind], 12).toImage().pixelColor(x, y).alpha() > 128 for x in range(12) for y in range(12)]
        for kind in ("lemon", "pear", "quince")
    ]
    assert shapes[0] != shapes[1] != shapes[2] != shapes[0]
