"""What a lot amounts to, and its times: what the summary shows, without widgets."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import PurePosixPath

from PySide6.QtCore import QCoreApplication

from fruitgui.gui.blind_words import blind_text, sparse_text
from fruitgui.gui.kind_words import kind_name
from fruitgui.gui.numbers import THIN, count_text, number_text
from fruitgui.gui.steps.lots.words import NONE, kilograms_text, litres_text, measure_text, why_text
from fruitgui.gui.times import clock_text, duration_text, moment_text, second_text
from fruitgui.measurement.fruit import Quantity
from fruitgui.measurement.sums import SharedSum
from fruitgui.records.fruit_search import FruitQuery
from fruitgui.records.lot import Lot
from fruitgui.records.spells import Spell, SpellSort, Trouble
from fruitgui.records.store import Store
from fruitgui.records.totals import KindTotal

translate = QCoreApplication.translate

MOST_MOMENTS = 3
"""So many times of day are told of what came more often."""


@dataclass(frozen=True, slots=True)
class LotFigures:
    """A lot and its sums at one moment.

    Attributes:
        lot: itself.
        kinds: sums of each kind, the most frequent first.
        left_out, corrected: how many a person left out, or said something else of (the left out among them).
        now_s: Unix seconds.
    """

    lot: Lot
    kinds: tuple[KindTotal, ...]
    left_out: int
    corrected: int
    now_s: float

    @property
    def fruit(self) -> int:
        """How many count."""
        return sum(one.fruit for one in self.kinds)

    @property
    def measured(self) -> int:
        """How many of these have a volume."""
        return sum(one.measured for one in self.kinds)

    @property
    def weighed(self) -> int:
        """How many of these have a mass."""
        return sum(one.weighed for one in self.kinds)

    @property
    def volume_m3(self) -> Quantity | None:
        """Of all measured fruit."""
        return sum((one.volume for one in self.kinds), SharedSum()).quantity if self.measured else None

    @property
    def mass_kg(self) -> Quantity | None:
        """Of all weighed fruit."""
        return sum((one.mass for one in self.kinds), SharedSum()).quantity if self.weighed else None

    @property
    def per_minute(self) -> float | None:
        """Fruit a minute while the lot ran."""
        ran_s = self.lot.ran_s(self.now_s)
        return self.fruit / ran_s * 60 if ran_s >= 1 else None


def read_figures(store: Store, lot: int, now_s: float) -> LotFigures:
    """Return what a lot amounts to now.

    Raises:
        InputError: there is no such lot.
        WorldError: the records cannot be read.
    """
    return LotFigures(
        store.lots.get(lot), store.lots.totals(lot),
        store.fruit.find(FruitQuery(lot, which="left_out", count=0)).found,
        store.fruit.find(FruitQuery(lot, which="corrected", count=0)).found, now_s,
    )  # fmt: skip


@dataclass(frozen=True, slots=True)
class KindRow:
    """One kind's sums as people read them."""

    kind: str
    name: str
    fruit: str
    mean: str
    volume: str
    mass: str


def kind_rows(figures: LotFigures) -> list[KindRow]:
    """Return a row for each kind, the most frequent first."""
    return [
        KindRow(
            one.kind, kind_name(one.kind), count_text(one.fruit),
            measure_text("volume_m3", one.mean_volume_m3), litres_text(one.volume_m3 if one.measured else None),
            kilograms_text(one.mass_kg if one.weighed else None),
        )
        for one in figures.kinds
    ]  # fmt: skip


@dataclass(frozen=True, slots=True)
class Span:
    """A part of a lot's time; `why` it stood still is empty where it ran."""

    from_s: float
    to_s: float
    why: str

    @property
    def words(self) -> str:
        """When it was, how long, and why the lot stood still."""
        times = f"{clock_text(self.from_s)}–{clock_text(self.to_s)}"
        what = self.why or translate("Lots", "ran")
        return f"{times}, {duration_text(self.to_s - self.from_s)}: {what}"


def spans(lot: Lot, now_s: float) -> list[Span]:
    """Return a lot's time until now or its end, in parts that ran and parts that stood still."""
    end_s = now_s if lot.ended_s is None else lot.ended_s
    found, at_s = [], lot.started_s
    for pause in lot.pauses:
        to_s = end_s if pause.to_s is None else pause.to_s
        found += [Span(at_s, pause.from_s, ""), Span(pause.from_s, to_s, why_text(pause.why))]
        at_s = to_s
    return [span for span in [*found, Span(at_s, end_s, "")] if span.to_s > span.from_s]


def times_text(lot: Lot, now_s: float) -> str:
    """Return when a lot ran, and how long it stood still, in one sentence."""
    ran = duration_text(lot.ran_s(now_s))
    parts = [translate("Lots", "Started {when}").format(when=moment_text(lot.started_s))]
    if lot.ended_s is not None:
        parts.append(translate("Lots", "ended {when}").format(when=moment_text(lot.ended_s)))
    parts.append(translate("Lots", "ran {time}").format(time=ran))
    still_s = sum(span.to_s - span.from_s for span in spans(lot, now_s) if span.why)
    if len(lot.pauses) == 1:
        parts.append(translate("Lots", "one pause of {time}").format(time=duration_text(still_s)))
    elif lot.pauses:
        text = translate("Lots", "{count} pauses, together {time}")
        parts.append(text.format(count=len(lot.pauses), time=duration_text(still_s)))
    return ", ".join(parts)


def unseen_text(lot: Lot, now_s: float) -> str:
    """Return for how long which sensors gave nothing or too little, and whether fruit may have passed unseen."""
    said: tuple[tuple[SpellSort, bool, str], ...] = (
        ("away", True, translate("Lots", "For {time} ({count}×, {sensors}) fruit may have passed unseen")),
        ("away", False, translate("Lots", "for {time} ({count}×, {sensors}) sizes are less sure")),
        ("sparse", True, translate("Lots", "for {time} ({count}×, {sensors}) few pictures came, fruit may be missing")),
        ("sparse", False, translate("Lots", "for {time} ({count}×, {sensors}) few pictures came, sizes are less sure")),
    )
    parts = []
    for sort, loses_fruit, text in said:
        of_sort = [one for one in lot.spells if (one.sort, one.blind.loses_fruit) == (sort, loses_fruit)]
        parts += [_lasted(text, of_sort, now_s)] if of_sort else []
    text = "; ".join(parts)
    return text[:1].upper() + text[1:]


def trouble_text(lot: Lot) -> str:
    """Return what else left a lot in doubt: moved sensors, clocks that leapt, a model that knew few fruit."""
    moved = [one for one in lot.troubles if one.sort == "moved"]
    leapt = [one for one in lot.troubles if one.sort == "clock_jumped"]
    unknown = [one for one in lot.troubles if one.sort == "mostly_unknown"]
    broken_off = [one for one in lot.troubles if one.sort == "line_begun_again"]
    parts = []
    if moved:
        text = translate("Lots", "Moved since calibrated, from {time} on ({sensors}): sizes and counts may be wrong")
        parts.append(text.format(time=second_text(moved[0].from_s), sensors=_names(moved)))
    if leapt:
        text = translate("Lots", "Clocks leapt {count}× ({sensors}): fruit of that moment may be missing or twice")
        parts.append(text.format(count=count_text(len(leapt)), sensors=_names(leapt)))
    if unknown:
        text = translate("Lots", "Most fruit were unknown to the model at {times}: kinds may lack fruit")
        parts.append(text.format(times=_moments(unknown)))
    if broken_off:
        text = translate("Lots", "The line broke off at {times} and went on: fruit in view then may be missing")
        parts.append(text.format(times=_moments(broken_off)))
    return ". ".join(parts)


def _moments(troubles: Sequence[Trouble]) -> str:
    """Return when troubles were, the first few."""
    times = ", ".join(clock_text(one.from_s) for one in troubles[:MOST_MOMENTS])
    return f"{times} …" if len(troubles) > MOST_MOMENTS else times


def _names(troubles: Sequence[Trouble]) -> str:
    return ", ".join(sorted({sensor for one in troubles for sensor in one.sensors}))


def spell_texts(lot: Lot, now_s: float, most: int) -> list[tuple[str, str, str]]:
    """Return of each spell, the longest `most` of them in order, when it was, how long, and who saw nothing of what."""
    longest = sorted(lot.spells, key=lambda one: -one.lasted_s(now_s))[:most]
    return [
        (
            f"{second_text(one.from_s)}–{second_text(now_s if one.to_s is None else one.to_s)}",
            duration_text(one.lasted_s(now_s)),
            (blind_text if one.sort == "away" else sparse_text)(one.blind),
        )
        for one in sorted(longest, key=lambda one: one.from_s)
    ]


def _lasted(text: str, spells: Sequence[Spell], now_s: float) -> str:
    lasted_s = sum(one.lasted_s(now_s) for one in spells)
    away = sorted({sensor for one in spells for sensor in one.blind.sensors})
    return text.format(time=duration_text(lasted_s), count=count_text(len(spells)), sensors=", ".join(away))


def model_name(model: str | None) -> str:
    """Return a model's name without its folder and suffix; empty where there is none."""
    return PurePosixPath(model).stem if model else ""


def about_text(lot: Lot) -> str:
    """Return who and what a lot is, in one line."""
    parts = [lot.grower]
    if lot.recipe:
        parts.append(translate("Lots", "recipe {recipe}").format(recipe=lot.recipe))
    if lot.model:
        parts.append(translate("Lots", "model {model}").format(model=model_name(lot.model)))
    return " · ".join(part for part in parts if part)


def corrected_text(figures: LotFigures) -> str:
    """Return how much of a lot people corrected."""
    if not figures.corrected:
        return translate("Lots", "nothing corrected")
    text = translate("Lots", "{count} corrected by hand").format(count=count_text(figures.corrected))
    if figures.left_out:
        more = translate("Lots", "{count} of them left out").format(count=count_text(figures.left_out))
        text = f"{text}, {more}"
    return text


def of_text(some: int, all_of: int) -> str:
    """Return of how many fruit a sum is, where it is not of all; else nothing."""
    if some == all_of or not some:
        return ""
    return translate("Lots", "of {some} of {all} fruit").format(some=count_text(some), all=count_text(all_of))


def rate_text(figures: LotFigures) -> str:
    """Return fruit a minute."""
    rate = figures.per_minute
    return NONE if rate is None else f"{number_text(rate, 0)}{THIN}/min"
