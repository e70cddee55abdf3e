"""What is said of a trained model, without a window."""

from __future__ import annotations

import numpy as np
import pytest

from fruitgui.classification.account import CurvePoint, _warnings
from fruitgui.classification.account import Taught as TaughtKind
from fruitgui.classification.comparing import compare
from fruitgui.classification.confusion import Confusion
from fruitgui.classification.intervals import rate
from fruitgui.gui.steps.train import report
from fruitgui.gui.steps.train.axes import round_step
from fruitgui.gui.steps.train.core_words import _patterns, in_words
from fruitgui.gui.translate import Language
from fruitgui.records.training import Rivals


def test_the_matrix_leaves_out_what_nobody_is_and_nobody_was_taken_for() -> None:
    counts = np.array([[7, 1, 0, 0], [0, 8, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]])
    drawn = report.matrix(Confusion(("lemon", "apple", "pear", "unknown"), counts))
    assert drawn.columns == ("lemon", "apple")
    assert [(row.kind, row.counts) for row in drawn.rows] == [("lemon", (7, 1)), ("apple", (0, 8))]
    assert report.interval_text(drawn.rows[0].right) == "87\u2009% (47–100)"
    counts[0, 3] = 2
    assert report.matrix(Confusion(("lemon", "apple", "pear", "unknown"), counts)).columns[-1] == "unknown"


def test_a_comparison_says_what_flatters_the_old_model() -> None:
    alike = compare([True] * 20, [True] * 19 + [False])
    unknown, some, none = (report.comparison_text(Rivals(alike, seen)).text for seen in (None, 12, 0))
    assert "As good as" in none
    assert "20 against 19 right of the same 20 fruit" in none
    assert "Neither had seen them" in none
    assert "learned from 12 of them" in some
    assert "may have learned" in unknown
    worse = report.comparison_text(Rivals(compare([False] * 9, [True] * 9), 0))
    assert (worse.health, worse.text.startswith("Worse")) == ("bad", True)
    assert report.comparison_text(None).text == ""


@pytest.mark.parametrize(
    ("shares", "word"),
    [((0.7, 0.85), "likely help"), ((0.9, 0.905), "look at the mistakes"), ((0.98, 1.0), "Nearly all")],
)
def test_the_curve_says_whether_more_fruit_would_help(shares: tuple[float, float], word: str) -> None:
    curve = [CurvePoint(50 * n, rate(round(share * 200), 200)) for n, share in enumerate(shares, start=1)]
    assert word in report.curve_text(curve)
    assert "Too few" in report.curve_text(curve[:1])


def test_every_warning_of_the_core_is_known_in_other_languages() -> None:
    said = _warnings([TaughtKind("lemon", 1, 20), TaughtKind("red apple", 9, 70), TaughtKind("pear", 40, 400)])
    said += _warnings([TaughtKind("lemon", 12, 80)])
    assert len(said) == 5
    assert all(in_words(text) != text for text in said), said
    assert in_words("something new") == "something new"


def test_the_core_is_spoken_of_in_spanish(qapp: object) -> None:
    language = Language()
    english = list(_patterns().values())
    language.put_on(qapp, "es")
    try:
        assert all(one != other for one, other in zip(english, _patterns().values(), strict=True))
    finally:
        language.put_on(qapp, "en")


@pytest.mark.parametrize(("span", "step"), [(100.0, 20.0), (9.0, 2.0), (0.4, 0.1), (260.0, 100.0), (50.0, 10.0)])
def test_axes_have_round_numbers(span: float, step: float) -> None:
    assert round_step(span) == pytest.approx(step)


def test_many_kinds_of_few_fruit_leave_the_matrix_its_room() -> None:
    said = _warnings([TaughtKind(f"kind {number}", 1, 20) for number in range(12)])
    assert len(said) == 24
    words = report.warnings(said)
    assert len(words) == report.MOST_WARNINGS
    assert words[:5] == [in_words(one) for one in said[:5]]
    assert words[-1].startswith("And 19 more")
    assert report.warnings(said[: report.MOST_WARNINGS]) == [in_words(one) for one in said[: report.MOST_WARNINGS]]
