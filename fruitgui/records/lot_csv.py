"""A lot as CSV: one row for each fruit, units in the names, those that a person left out too."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterable
from datetime import UTC, datetime
from pathlib import Path

from fruitgui.files import written_whole
from fruitgui.measurement.fruit import Quantity
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress, stop_if
from fruitgui.records.fruit_record import FruitRecord
from fruitgui.records.fruit_search import FruitQuery
from fruitgui.records.lot import Lot
from fruitgui.records.lot_sensors import serials_of
from fruitgui.records.spells import SPELL_SORTS, SpellSort
from fruitgui.records.store import Store
from fruitgui.station.report import G_PER_KG, ML_PER_M3, MM_PER_M

HEADER = (
    "lot", "number", "kind", "machine_kind", "kind_probability", "counted",
    "volume_ml", "volume_std_ml", "mass_g", "mass_std_g", "length_mm", "length_std_mm",
    "diameter_mm", "diameter_std_mm", "perimeter_mm", "perimeter_std_mm",
    "views", "coverage", "recipe", "size_band", "outlet", "counted_at_utc", "first_seen_s", "last_seen_s",
    "sensors_away", "sensors_sparse", "lot_unseen_s", "lot_sensors",
)  # fmt: skip
"""`kind` is what holds, `machine_kind` what the machine said (empty where a person added the fruit); `counted` is 1 or
0 (left out by a person); what was not measured is empty; `_std_` is one standard deviation; `size_band` and
`outlet` are empty where a lot sorts nothing; `first_seen_s` and `last_seen_s` are in the reference sensor's clock;
`sensors_away` names those that gave nothing while the fruit passed, up to when it was counted, `sensors_sparse` those
that gave too few pictures for the belt's speed; `lot_unseen_s` is for how long fruit of this lot may have passed
unseen, or too seldom seen to be counted; `lot_sensors` tells which device each sensor of the lot was: name=serial,
or the name alone where it has none. A word that a spreadsheet would take for a formula has an apostrophe before it: of
kinds, the lot, its recipe and outlet."""

FORMULAS = ("=", "+", "-", "@", "\t", "\r")
"""With these a cell begins that a spreadsheet works out, or runs."""

TOLD_EVERY = 2_000


def write_lot(
    store: Store,
    lot: int,
    path: Path,
    progress: Progress = no_progress,
    cancelled: Cancelled = never_cancelled,
    now_s: float | None = None,
) -> int:
    """Write a lot, whole or not at all; return the number of fruit. `now_s`: time of day, Unix seconds.

    Raises:
        InputError: there is no such lot.
        WorldError: it cannot be read or written.
        CancelledByUserError: a person stopped it; no file is left.
    """
    of = store.lots.get(lot)
    unseen_s = _unseen_s(of, store.now_s() if now_s is None else now_s)
    sensors = " ".join(f"{name}={serial}" if serial else name for name, serial in serials_of(store, lot).items())
    found = sum(store.fruit.find(FruitQuery(lot, which=which, count=0)).found for which in ("counted", "left_out"))
    written = 0
    with written_whole(path) as beside, beside.open("w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out)
        writer.writerow(HEADER)
        for fruit in store.fruit.walk(lot):
            missed = (" ".join(_missed(of, fruit, sort)) for sort in SPELL_SORTS)
            writer.writerow([*_row(of, fruit), *missed, _digits(unseen_s, 1), sensors])
            written += 1
            if written % TOLD_EVERY == 0:
                stop_if(cancelled)
                progress(min(written / found, 1.0), f"{written} fruit")
    return written


def _row(lot: Lot, fruit: FruitRecord) -> Iterable[object]:
    return (
        _word(lot.name), fruit.number, _word(fruit.kind), _word(fruit.machine_kind),
        _digits(fruit.kind_probability, 1), int(fruit.counted),
        *_quantity(fruit.volume_m3, ML_PER_M3), *_quantity(fruit.mass_kg, G_PER_KG),
        *_quantity(fruit.length_m, MM_PER_M), *_quantity(fruit.diameter_m, MM_PER_M),
        *_quantity(fruit.perimeter_m, MM_PER_M), fruit.views, _digits(fruit.coverage, 1),
        _word(lot.recipe), "", _word(fruit.outlet),
        datetime.fromtimestamp(fruit.counted_s, UTC).isoformat(timespec="milliseconds"),
        fruit.first_seen_s, fruit.last_seen_s,
    )  # fmt: skip


def _word(text: str | None) -> str | None:
    """Return a word that a person chose as one that stays a word in every spreadsheet."""
    return f"'{text}" if text is not None and text.startswith(FORMULAS) else text


def _unseen_s(lot: Lot, now_s: float) -> float:
    """Return for how long sensors gave so little that fruit can have passed where nobody saw them often enough."""
    unseen_s, until_s = 0.0, -math.inf
    for spell in lot.spells:  # in order of their beginnings; what two have in common counts once
        if spell.blind.loses_fruit:
            ends_s = spell.from_s + spell.lasted_s(now_s)
            unseen_s += max(ends_s - max(spell.from_s, until_s), 0.0)
            until_s = max(until_s, ends_s)
    return unseen_s


def _missed(lot: Lot, fruit: FruitRecord, sort: SpellSort) -> list[str]:
    """Return who gave nothing, or too little, at any time from when a fruit came into view until it was counted."""
    if fruit.first_seen_s is None or fruit.last_seen_s is None:
        return []  # a person added it, whenever it passed
    came_s = fruit.counted_s - max(fruit.last_seen_s - fruit.first_seen_s, 0.0)
    of_sort = (one for one in lot.spells if one.sort == sort)
    passing = (one for one in of_sort if one.from_s <= fruit.counted_s and (one.to_s is None or one.to_s >= came_s))
    return sorted({sensor for one in passing for sensor in one.blind.sensors})


def _quantity(quantity: Quantity | None, factor: float) -> tuple[str, str]:
    if quantity is None:
        return "", ""
    return _digits(quantity.value, factor), _digits(quantity.std, factor)


def _digits(value: float | None, factor: float) -> str:
    """Return six digits, more than any measurement has; nothing where it is not known."""
    return "" if value is None or math.isnan(value) else f"{value * factor:.6g}"
