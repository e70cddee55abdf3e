"""A counted fruit as it is read back."""

from __future__ import annotations

from dataclasses import dataclass

from fruitgui.measurement.fruit import Quantity
from fruitgui.records.packing import quantity
from fruitgui.records.tables import FruitRow


@dataclass(frozen=True, slots=True)
class FruitRecord:
    """One counted fruit. What was not measured is None.

    Attributes:
        key: unique in the store.
        lot: key of its lot.
        number: within the lot.
        counted_s: when it was kept, Unix seconds.
        machine_kind, kind_probability: what the machine said; None where a person added it.
        kind: that holds: a person's word, or else the machine's.
        counted: whether it counts.
        outlet: where it went.
        volume_m3: corrected by what reference fruit taught.
        fitted_volume_m3: as fitted.
        paper_volume_m3: by the source's method.
        mass_kg, length_m, diameter_m, perimeter_m, coverage, spoilt: see `station.fruit.Fruit`.
        views: how many frames saw it.
        first_seen_s, last_seen_s: reference clock.
    """

    key: int
    lot: int
    number: int
    counted_s: float
    machine_kind: str | None
    kind_probability: float | None
    kind: str
    counted: bool
    outlet: str | None
    volume_m3: Quantity | None
    fitted_volume_m3: Quantity | None
    paper_volume_m3: float | None
    mass_kg: Quantity | None
    length_m: Quantity | None
    diameter_m: Quantity | None
    perimeter_m: Quantity | None
    coverage: float | None
    spoilt: float | None
    views: int
    first_seen_s: float | None
    last_seen_s: float | None

    @property
    def corrected(self) -> bool:
        """Whether a person said otherwise than the machine."""
        return self.kind != self.machine_kind or not self.counted


def fruit_record(row: FruitRow) -> FruitRecord:
    """Return a row as a record."""
    return FruitRecord(
        key=row.id, lot=row.lot_id, number=row.number, counted_s=row.counted_s, machine_kind=row.machine_kind,
        kind_probability=row.kind_probability, kind=row.kind, counted=row.counted, outlet=row.outlet,
        volume_m3=quantity(row.volume_m3, row.volume_std_m3),
        fitted_volume_m3=quantity(row.fitted_volume_m3, row.fitted_volume_std_m3),
        paper_volume_m3=row.paper_volume_m3, mass_kg=quantity(row.mass_kg, row.mass_std_kg),
        length_m=quantity(row.length_m, row.length_std_m), diameter_m=quantity(row.diameter_m, row.diameter_std_m),
        perimeter_m=quantity(row.perimeter_m, row.perimeter_std_m), coverage=row.coverage, spoilt=row.spoilt,
        views=row.views, first_seen_s=row.first_seen_s, last_seen_s=row.last_seen_s,
    )  # fmt: skip
