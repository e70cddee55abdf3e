"""A lot as a line of the list, and the time in which lots are looked for."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date, datetime, time, timedelta
from enum import StrEnum

from PySide6.QtCore import QCoreApplication

from fruitgui.gui.numbers import THIN, count_text, number_text
from fruitgui.gui.steps.lots.words import L_PER_M3
from fruitgui.gui.times import recent_text
from fruitgui.records.lot import Lot
from fruitgui.records.lot_search import LotLine

translate = QCoreApplication.translate


class LotState(StrEnum):
    """How a lot is: `open` was not ended, and does not run; it can be taken up again."""

    RUNNING = "running"
    PAUSED = "paused"
    OPEN = "open"
    ENDED = "ended"


@dataclass(frozen=True, slots=True)
class LotEntry:
    """A lot as it is listed.

    Attributes:
        key: of the lot. state: how it is.
        name, who, when, fruit, litres: as people read them; `who` is the grower, or empty.
    """

    key: int
    state: LotState
    name: str
    who: str
    when: str
    fruit: str
    litres: str


def state_of(lot: Lot, running: int | None) -> LotState:
    """Return how a lot is; `running` is the key of the one that the line counts into."""
    if lot.ended_s is not None:
        return LotState.ENDED
    if lot.key != running:
        return LotState.OPEN
    return LotState.PAUSED if lot.paused else LotState.RUNNING


def lot_entry(line: LotLine, running: int | None, now_s: float) -> LotEntry:
    """Return a lot as it is listed."""
    lot = line.lot
    return LotEntry(
        lot.key, state_of(lot, running), lot.name, lot.grower, recent_text(lot.started_s, now_s),
        count_text(line.fruit), f"{number_text(line.volume_m3 * L_PER_M3, 1)}{THIN}l",
    )  # fmt: skip


def state_word(state: LotState) -> str:
    """Return a state in a word or two."""
    return {
        LotState.RUNNING: translate("Lots", "running"),
        LotState.PAUSED: translate("Lots", "paused"),
        LotState.OPEN: translate("Lots", "not ended"),
        LotState.ENDED: translate("Lots", "ended"),
    }[state]


class Period(StrEnum):
    """The time in which lots are looked for."""

    ANY = "any"
    TODAY = "today"
    WEEK = "week"
    MONTH = "month"
    YEAR = "year"
    CHOSEN = "chosen"


def bounds_s(period: Period, today: date, chosen: tuple[date, date]) -> tuple[float | None, float | None]:
    """Return from when to when lots are looked for, Unix seconds; whole days of the local time, both included."""
    if period is Period.ANY:
        return None, None
    first, last = {
        Period.TODAY: (today, today),
        Period.WEEK: (today - timedelta(days=6), today),
        Period.MONTH: (today - timedelta(days=29), today),
        Period.YEAR: (today.replace(month=1, day=1), today),
        Period.CHOSEN: (min(chosen), max(chosen)),
    }[period]
    return _midnight_s(first), _midnight_s(last + timedelta(days=1)) - 1e-3


def _midnight_s(day: date) -> float:
    return datetime.combine(day, time()).timestamp()
