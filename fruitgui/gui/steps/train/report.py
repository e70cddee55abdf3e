"""What is said of a model that was trained: figures with their intervals, in words; no widgets."""

from __future__ import annotations

import math
import statistics
from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QCoreApplication

from fruitgui.classification.account import CurvePoint, Training
from fruitgui.classification.comparing import Verdict
from fruitgui.classification.confusion import Confusion
from fruitgui.classification.intervals import Rate
from fruitgui.classification.model import KindModel
from fruitgui.gui.numbers import count_text, number_text, percent_text
from fruitgui.gui.steps.train.core_words import in_words
from fruitgui.measurement.checking import Check
from fruitgui.records.training import Rivals, Trained

translate = QCoreApplication.translate

MOST_WARNINGS = 6
"""So many lines stand below the kinds at most; many kinds of few fruit have two each."""

WORTH_IT = 0.02
"""A larger share of right ones that is worth more fruit."""


@dataclass(frozen=True, slots=True)
class Said:
    """One sentence with how good it is: `good`, `warn`, `bad`, or empty."""

    text: str
    health: str = ""


@dataclass(frozen=True, slots=True)
class MatrixRow:
    """One row of the confusion matrix.

    Attributes:
        kind: what the fruit are.
        counts: what they were taken for, a column each.
        right: share that got their kind.
    """

    kind: str
    counts: tuple[int, ...]
    right: Rate


@dataclass(frozen=True, slots=True)
class Matrix:
    """Rows true, columns taken for; rows without fruit and a last column without any are left out."""

    columns: tuple[str, ...]
    rows: tuple[MatrixRow, ...]


def interval_text(rate: Rate) -> str:
    """Return a share with the interval that holds the true one, 95 %."""
    if not rate.trials:
        return "—"
    ends = f"{number_text(100 * rate.low, 0)}–{number_text(100 * rate.high, 0)}"
    return f"{percent_text(rate.value)} ({ends})"


def headline(training: Training[KindModel]) -> Said:
    """Return how good the model is on fruit that it has not seen."""
    right = training.confusion.right
    if not right.trials:
        return Said(translate("Train", "No fruit could be held out, so nobody knows how good it is."), "warn")
    text = translate("Train", "of {count} fruit that training had not seen got their kind; the true share lies between "
                     "{low} and {high} %.").format(count=right.trials, low=number_text(100 * right.low, 0),
                                                    high=number_text(100 * right.high, 0))  # fmt: skip
    return Said(text, "good" if right.low >= 0.9 else "warn" if right.low >= 0.75 else "bad")


def comparison_text(rivals: Rivals | None) -> Said:
    """Return how the new model stands against the one in use, on the same fruit."""
    if rivals is None:
        return Said("")
    both = rivals.comparison
    words = {
        Verdict.BETTER: (translate("Train", "Better than the model in use"), "good"),
        Verdict.WORSE: (translate("Train", "Worse than the model in use"), "bad"),
        Verdict.ALIKE: (translate("Train", "As good as the model in use, as far as can be told"), ""),
    }
    text, health = words[both.verdict]
    figures = translate("Train", "{new} against {old} right of the same {count} fruit.").format(
        new=both.right, old=both.other_right, count=both.fruit
    )
    return Said(f"{text}: {figures} {_flattered(rivals)}".strip(), health)


def _flattered(rivals: Rivals) -> str:
    if rivals.seen is None:
        return translate("Train", "The one in use may have learned from these very fruit, which flatters it.")
    if rivals.seen:
        text = translate("Train", "The one in use learned from {seen} of them, which flatters it.")
        return text.format(seen=rivals.seen)
    return translate("Train", "Neither had seen them.")


def matrix(confusion: Confusion) -> Matrix:
    """Return the confusion matrix as it is drawn."""
    used = [at for at, kind in enumerate(confusion.kinds) if confusion.counts[at].sum()]
    last = len(confusion.kinds) - 1
    columns = [at for at in range(last + 1) if at in used or confusion.counts[:, at].sum()]
    rows = tuple(
        MatrixRow(
            confusion.kinds[at],
            tuple(int(confusion.counts[at, column]) for column in columns),
            confusion.right_of(confusion.kinds[at]),
        )
        for at in used
    )
    return Matrix(tuple(confusion.kinds[at] for at in columns), rows)


def curve_text(curve: Sequence[CurvePoint]) -> str:
    """Return whether more fruit would help."""
    known = [point for point in curve if point.right.trials]
    if len(known) < 2:
        return translate("Train", "Too few fruit to tell whether more would help.")
    gain = known[-1].right.value - known[-2].right.value
    if known[-1].right.value > 1 - WORTH_IT:
        return translate("Train", "Nearly all are right; more fruit of the same sort would hardly help.")
    if gain > WORTH_IT:
        return translate("Train", "It still got better with more fruit: more of them would likely help.")
    return translate("Train", "More fruit of the same sort would hardly help; look at the mistakes, or show fruit that "
                     "look different.")  # fmt: skip


def warnings(said: Sequence[str]) -> list[str]:
    """Return what a person should know, in plain words, no more than leaves the kinds their room."""
    words = [in_words(text) for text in said]
    if len(words) <= MOST_WARNINGS:
        return words
    more = len(words) - MOST_WARNINGS + 1
    rest = translate("Train", "And {count} more such words: the step before shows how far each kind is.")
    return [*words[: MOST_WARNINGS - 1], rest.format(count=count_text(more))]


@dataclass(frozen=True, slots=True)
class VolumeWords:
    """How volumes are corrected.

    Attributes:
        text: how much they err, before and after.
        densities: a line for each kind where it is known.
        left_out: how many references were taken for typing errors; empty where none were.
    """

    text: str
    densities: tuple[tuple[str, str], ...]
    left_out: str


def mean_error(checks: Sequence[Check]) -> tuple[float, float]:
    """Return the mean relative error before and after correction; NaN without fruit."""
    if not checks:
        return math.nan, math.nan
    before = statistics.fmean(abs(one.fitted_m3.value / one.true_m3 - 1.0) for one in checks)
    after = statistics.fmean(abs(one.corrected_m3.value / one.true_m3 - 1.0) for one in checks)
    return before, after


def volume_words(trained: Trained) -> VolumeWords:
    """Return what reference fruit say of volumes."""
    before, after = mean_error(trained.checks)
    if not trained.checks:
        text = translate("Train", "No reference fruit: volumes stay uncorrected. Type the measured volume of some "
                         "fruit of each kind on the screen “Teach”.")  # fmt: skip
    else:
        text = translate("Train", "Volumes err by {before} % uncorrected and by {after} % corrected, on average over "
                         "{count} fruit, each corrected by what the others teach.").format(
            before=number_text(100 * before, 1), after=number_text(100 * after, 1), count=len(trained.checks)
        )  # fmt: skip
    correction = trained.outcome.correction
    densities = tuple(
        (kind, f"{number_text(one.value / 1000, 3)} ± {number_text(1.96 * one.std / 1000, 3)} g/ml")
        for kind, one in sorted(correction.correction.densities.items())
    )
    wrong = sum(not one.used for one in correction.residuals)
    said = translate("Train", "{count} measures were left out: they cannot be of those fruit.").format(count=wrong)
    return VolumeWords(text, densities, said if wrong else "")
