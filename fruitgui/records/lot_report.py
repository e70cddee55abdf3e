"""What a report on a lot says; it is drawn elsewhere."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from fruitgui.measurement.fruit import Quantity
from fruitgui.measurement.sums import SharedSum
from fruitgui.records.distribution import Distribution, Measured
from fruitgui.records.fruit_search import FruitQuery
from fruitgui.records.lot import Lot
from fruitgui.records.lot_sensors import serials_of
from fruitgui.records.store import Store
from fruitgui.records.totals import SHARING, KindTotal

SPREAD: tuple[Measured, ...] = ("volume_m3", "mass_kg", "diameter_m", "length_m")


@dataclass(frozen=True, slots=True, eq=False)
class LotReport:
    """A lot as one would hand it to a grower. SI units; whoever draws it converts.

    Attributes:
        lot: itself, with its pauses.
        made_s: when this was read, Unix seconds.
        ran_s: how long it ran, pauses left out.
        kinds: sums of each kind, the most frequent first.
        fruit: how many count.
        left_out, corrected: how many a person left out, or said something else of (the left out among them).
        measured, weighed: how many have a volume, a mass.
        volume_m3, mass_kg: of all kinds together; std as `note` says.
        spread: how each measure is spread over the fruit.
        note: what the ± of totals means.
        serials: of the sensors, by name; empty where one has none.
    """

    lot: Lot
    made_s: float
    ran_s: float
    kinds: tuple[KindTotal, ...]
    fruit: int
    left_out: int
    corrected: int
    measured: int
    weighed: int
    volume_m3: Quantity
    mass_kg: Quantity
    spread: Mapping[Measured, Distribution]
    note: str
    serials: Mapping[str, str]


def report_lot(store: Store, lot: int, now_s: float, bins: int = 30) -> LotReport:
    """Return the report on a lot as it is now.

    Raises:
        InputError: there is no such lot.
        WorldError: the records cannot be read.
    """
    found = store.lots.get(lot)
    kinds = store.lots.totals(lot)
    return LotReport(
        lot=found,
        made_s=now_s,
        ran_s=found.ran_s(now_s),
        kinds=kinds,
        fruit=sum(one.fruit for one in kinds),
        left_out=store.fruit.find(FruitQuery(lot, which="left_out", count=0)).found,
        corrected=store.fruit.find(FruitQuery(lot, which="corrected", count=0)).found,
        measured=sum(one.measured for one in kinds),
        weighed=sum(one.weighed for one in kinds),
        volume_m3=sum((one.volume for one in kinds), SharedSum()).quantity,
        mass_kg=sum((one.mass for one in kinds), SharedSum()).quantity,
        spread={measured: store.fruit.distribution(lot, measured, bins) for measured in SPREAD},
        note=SHARING,
        serials=serials_of(store, lot),
    )
